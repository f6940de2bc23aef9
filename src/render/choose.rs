//! Which steps a film strip shows: the first, what happened, what was commanded, and the rest where
//! the picture changes most. No two neighbours look alike.

use aplomb_framework::events::EventKind;
use aplomb_framework::run::Trajectory;

use super::change::{Change, difference};
use super::scene::PUSH_TIME;
use super::wishes::{rank, wishes};

/// Change between neighbouring frames that is aimed at, m.
const CHANGE: f64 = 0.14;
/// Chosen frames are at least so far apart, s.
const APART: f64 = 0.03;
/// Neighbours that differ by less, m, look alike.
const ALIKE: f64 = 0.05;

/// Ranks up to this one are always heard, as far as there are frames.
const ALWAYS: u8 = 1;

/// A chosen frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shot {
    pub(super) step: usize,
    /// Places of the events that it is the first to show.
    pub(super) events: Vec<usize>,
}

/// How many frames suit the recording.
pub(super) fn suitable(trajectory: &Trajectory) -> usize {
    let change = Change::new(trajectory);
    let wanted = wishes(trajectory, &change);
    let wanted = 2 + wanted.iter().filter(|w| w.rank < 3).count();
    let moving = (change.total() / CHANGE).ceil().clamp(1.0, 1e6) as usize;
    moving.max(wanted)
}

/// At most `count` frames in the order of time, none like the one before.
pub(super) fn shots(trajectory: &Trajectory, count: usize) -> Vec<Shot> {
    let Some(last) = trajectory.len().checked_sub(1) else {
        return Vec::new();
    };
    let change = Change::new(trajectory);
    let apart = (APART / trajectory.header.dt).round() as usize;
    let mut fixed = vec![0];
    if count > 1 && last > 0 {
        fixed.push(last);
    }
    // A third remains for the motion between what is wanted.
    let most = count.min(2 + 2 * count.saturating_sub(2) / 3);
    for wish in wishes(trajectory, &change) {
        let free = |at: &usize| fixed.iter().all(|f| f.abs_diff(*at) > apart);
        let place = match wish.active {
            Some((who, controller)) => {
                let active = |at: &usize| trajectory.moment(*at, who).active == controller;
                let soon = wish.step..wish.step + 4 * apart + 4;
                if fixed.iter().any(|f| soon.contains(f) && active(f)) {
                    continue;
                }
                // Later, too, while it is still active, but not right behind another frame.
                let free = |at: &usize| fixed.iter().all(|f| f.abs_diff(*at) > 3 * apart);
                [0, 1, 2, 4, 6]
                    .map(|late| (wish.step + late * apart).min(last))
                    .into_iter()
                    .find(|at| free(at) && active(at))
            }
            None => Some(wish.step).filter(free),
        };
        let room = if wish.rank <= ALWAYS { count } else { most };
        if let Some(place) = place.filter(|_| fixed.len() < room) {
            fixed.push(place);
        }
    }
    fixed.sort_unstable();
    let steps = between(&change, &fixed, count);
    told(trajectory, without_twins(trajectory, steps))
}

/// Whether a step lies in a push: its arrow makes a picture of its own.
fn pushed(trajectory: &Trajectory, step: usize) -> bool {
    let time = step as f64 * trajectory.header.dt;
    trajectory.events.iter().any(|e| {
        let age = time - e.time;
        matches!(e.kind, EventKind::Push { .. }) && (0.0..=PUSH_TIME).contains(&age)
    })
}

/// The steps but for those that look like the one before.
fn without_twins(trajectory: &Trajectory, steps: Vec<usize>) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::new();
    for step in steps {
        let twin = kept.last().is_some_and(|last| {
            let active = |step| {
                let all = 0..trajectory.models.len();
                all.map(|who| trajectory.moment(step, who).active)
                    .collect::<Vec<_>>()
            };
            let arrow = pushed(trajectory, step) && !pushed(trajectory, *last);
            !arrow && active(*last) == active(step) && difference(trajectory, [*last, step]) < ALIKE
        });
        if !twin {
            kept.push(step);
        }
    }
    kept
}

/// The frames with what each is the first to show: a cause never stands behind its effect.
fn told(trajectory: &Trajectory, steps: Vec<usize>) -> Vec<Shot> {
    let mut shots: Vec<Shot> = steps
        .into_iter()
        .map(|step| Shot {
            step,
            events: Vec::new(),
        })
        .collect();
    for (i, event) in trajectory.events.iter().enumerate() {
        let switch = matches!(event.kind, EventKind::Switch { .. });
        if switch || rank(trajectory, event).is_none() {
            continue;
        }
        let step = trajectory.step_at(event.time);
        let first = shots.iter().position(|s| s.step >= step);
        let first = first.unwrap_or(shots.len().saturating_sub(1));
        if let Some(shot) = shots.get_mut(first) {
            shot.events.push(i);
        }
    }
    shots
}

/// Fills up with frames between the fixed ones: always where the picture changes most from one to
/// the next.
fn between(change: &Change, fixed: &[usize], count: usize) -> Vec<usize> {
    let mut extra = vec![0_usize; fixed.len().saturating_sub(1)];
    let mut left = count.saturating_sub(fixed.len());
    while left > 0 {
        let share =
            |i: usize| (change.at(fixed[i + 1]) - change.at(fixed[i])) / (extra[i] + 1) as f64;
        let room = |i: &usize| (extra[*i] + 2) * change.stride <= fixed[*i + 1] - fixed[*i];
        let widest = (0..extra.len())
            .filter(room)
            .max_by(|a, b| share(*a).total_cmp(&share(*b)));
        let Some(widest) = widest else { break };
        extra[widest] += 1;
        left -= 1;
    }
    let mut steps = fixed.to_vec();
    for (i, ends) in fixed.windows(2).enumerate() {
        let [from, to] = [change.at(ends[0]), change.at(ends[1])];
        for k in 1..=extra[i] {
            let part = k as f64 / (extra[i] + 1) as f64;
            let step = change.step(from + part * (to - from));
            steps.push(step.clamp(ends[0], ends[1]));
        }
    }
    steps.sort_unstable();
    steps.dedup();
    steps
}

#[cfg(test)]
mod tests {
    use aplomb_framework::character::Model;
    use aplomb_framework::events::{Event, Reason, Role};

    use super::*;
    use crate::render::tests::recording;

    #[test]
    fn frames_are_chosen_at_the_start_at_events_and_where_much_moves() {
        let t = recording(6000, |_, _| {});
        let shots = shots(&t, 12);
        assert!((9..=12).contains(&shots.len()), "{shots:?}");
        assert_eq!(shots[0].step, 0);
        assert!(shots.iter().any(|s| s.step == 550), "during the push");
        assert!(shots.iter().any(|s| s.step == 1100), "the fall");
        let falling = shots.iter().filter(|s| (1000..1500).contains(&s.step));
        let falling = falling.count();
        assert!(falling >= 5, "{falling} show the half second of the fall");
        let events: Vec<usize> = shots.iter().flat_map(|s| s.events.clone()).collect();
        assert_eq!(
            events,
            [0, 1, 2],
            "each on one frame, unless it is after the end"
        );
    }

    #[test]
    fn few_frames_are_chosen_of_few() {
        assert_eq!(shots(&recording(3000, |_, _| {}), 1).len(), 1);
        assert_eq!(shots(&recording(3, |_, _| {}), 12).len(), 1);
    }

    /// It stands still from 1.5 s on, and before 1 s but for its push.
    #[test]
    fn no_frame_looks_like_the_one_before() {
        let t = recording(6000, |_, _| {});
        let shots = shots(&t, 12);
        for pair in shots.windows(2) {
            let [a, b] = [pair[0].step, pair[1].step];
            let arrow = pushed(&t, b) && !pushed(&t, a);
            assert!(arrow || difference(&t, [a, b]) >= ALIKE, "{a} and {b}");
        }
        let resting = shots.iter().filter(|s| s.step > 1500).count();
        assert!(resting <= 1, "{shots:?}");
    }

    /// The frame with a push's arrow is the first after it began.
    #[test]
    fn a_cause_stands_no_later_than_its_effect() {
        let t = recording(3000, |_, _| {});
        let shots = shots(&t, 12);
        let arrow = shots.iter().position(|s| s.events.contains(&0)).unwrap();
        assert!(shots[arrow].step >= 500 && shots[arrow - 1].step < 500);
    }

    #[test]
    fn a_commanded_nod_has_three_frames_with_its_extreme() {
        let neck = 3 + Model::load("humanoid")
            .unwrap()
            .joint_index("neck")
            .unwrap();
        let mut t = recording(10_000, |step, row| {
            let s = (step as f32 - 1000.0) / 1500.0;
            let nods = (0.0..1.0).contains(&s);
            let nod = -0.4 * (std::f32::consts::PI * s).sin();
            row[1] = 0.9;
            row[2] = 0.0;
            row[neck] = if nods { nod } else { 0.0 };
        });
        let switch = |time, to: &str, reason| Event {
            time,
            character: 0,
            kind: EventKind::Switch {
                from: None,
                to: to.into(),
                role: Role::Other,
                reason,
                bids: vec![],
            },
        };
        t.events = vec![
            switch(1.0, "nod", Reason::Command),
            switch(2.5, "balance", Reason::Succeeded),
        ];
        let shots = shots(&t, suitable(&t));
        let nods = shots.iter().filter(|s| (1000..2500).contains(&s.step));
        let nods: Vec<usize> = nods.map(|s| s.step).collect();
        assert!(nods.len() >= 3, "{shots:?}");
        assert!(nods.iter().any(|s| (1700..1800).contains(s)), "{nods:?}");
    }
}

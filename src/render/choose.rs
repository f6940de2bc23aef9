//! Which steps a film strip shows: first and last, what happened, and the rest where the picture
//! changes most.

use aplomb_framework::events::{Event, EventKind};
use aplomb_framework::run::Trajectory;

use super::body::pose;
use super::scene::PUSH_TIME;

/// Between samples of the motion, s; longer in long recordings.
const SAMPLING: f64 = 0.005;
/// Fewest and most samples, as far as there are steps.
const SAMPLES: [usize; 2] = [200, 20_000];
/// Change of the picture that is counted when nothing moves, m/s.
const REST: f64 = 0.08;
/// Faster changes count as this fast, m/s.
const FASTEST: f64 = 2.5;
/// How much of a change of place counts, as the camera goes along.
const TRAVEL: f64 = 0.25;
/// Change between neighbouring frames that is aimed at, m.
const CHANGE: f64 = 0.22;
/// Chosen frames are at least so far apart, s.
const APART: f64 = 0.03;

/// A chosen frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shot {
    pub(super) step: usize,
    /// Places of the events that this frame is the nearest to.
    pub(super) events: Vec<usize>,
}

/// How far the picture has changed up to each sample, m.
struct Change {
    stride: usize,
    sums: Vec<f64>,
}

impl Change {
    fn new(trajectory: &Trajectory) -> Self {
        let dt = trajectory.header.dt;
        let stride = ((SAMPLING / dt).round().max(1.0) as usize).max(trajectory.len() / SAMPLES[1]);
        let stride = stride.min((trajectory.len() / SAMPLES[0]).max(1));
        let span = stride as f64 * dt;
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        let mut last: Option<Vec<[f64; 2]>> = None;
        for step in (0..trajectory.len()).step_by(stride) {
            let now = points(trajectory, step);
            if let Some(last) = last.replace(now.clone()) {
                let squares = now
                    .iter()
                    .zip(&last)
                    .map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
                let speed = (squares.sum::<f64>() / now.len().max(1) as f64).sqrt() / span;
                let speed = if speed.is_finite() {
                    speed.min(FASTEST)
                } else {
                    0.0
                };
                sum += (speed + REST) * span;
                sums.push(sum);
            }
        }
        Self { stride, sums }
    }

    fn at(&self, step: usize) -> f64 {
        self.sums[(step / self.stride).min(self.sums.len() - 1)]
    }

    /// The step by which the picture has changed so far.
    fn step(&self, change: f64) -> usize {
        self.sums.partition_point(|s| *s < change) * self.stride
    }
}

/// The links as a camera sees them that goes along with most of their motion.
fn points(trajectory: &Trajectory, step: usize) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (who, model) in trajectory.models.iter().enumerate() {
        let poses = pose(model, trajectory.moment(step, who).q);
        let along = (1.0 - TRAVEL) * poses.com[0];
        points.extend(poses.links.iter().map(|l| [l.com[0] - along, l.com[1]]));
    }
    points
}

/// The step that shows an event, and its rank; none for what needs no frame of its own.
fn wanted(trajectory: &Trajectory, event: &Event) -> Option<(u8, usize)> {
    let rank = match &event.kind {
        EventKind::Push { .. } => 0,
        EventKind::Fell | EventKind::Stood => 1,
        EventKind::Switch { .. } => 3,
        EventKind::Refused { .. } => return None,
        _ => 2,
    };
    let after = event.time > trajectory.duration() + trajectory.header.dt;
    if after || event.character >= trajectory.models.len() {
        return None;
    }
    let late = if rank == 0 { 0.5 * PUSH_TIME } else { 0.0 };
    Some((rank, trajectory.step_at(event.time + late)))
}

/// How many frames suit the recording.
pub(super) fn suitable(trajectory: &Trajectory) -> usize {
    let change = Change::new(trajectory);
    let total = change.sums.last().copied().unwrap_or(0.0);
    (total / CHANGE).ceil().clamp(1.0, 1e6) as usize
}

/// At most `count` different frames in the order of time.
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
    let events = trajectory.events.iter().enumerate();
    let mut events: Vec<_> = events
        .filter_map(|(i, e)| wanted(trajectory, e).map(|(rank, step)| (rank, step, i)))
        .collect();
    events.sort_unstable();
    // A third remains for the motion between the events.
    let most = count.min(2 + 2 * count.saturating_sub(2) / 3);
    for &(_, step, event) in &events {
        let free = |at: &usize| fixed.iter().all(|f| f.abs_diff(*at) > apart);
        let place = match &trajectory.events[event] {
            // A new controller may be shown later, while it is still active.
            Event {
                kind: EventKind::Switch { to, .. },
                character,
                ..
            } => [0, 1, apart + 1, 2 * apart + 2]
                .map(|late| (step + late).min(last))
                .into_iter()
                .find(|at| free(at) && trajectory.controller(*at, *character) == to),
            _ => Some(step).filter(free),
        };
        if let Some(place) = place.filter(|_| fixed.len() < most) {
            fixed.push(place);
        }
    }
    fixed.sort_unstable();
    let mut shots: Vec<Shot> = between(&change, &fixed, count)
        .into_iter()
        .map(|step| Shot {
            step,
            events: Vec::new(),
        })
        .collect();
    for (rank, step, event) in events {
        let nearest = shots.iter_mut().min_by_key(|s| s.step.abs_diff(step));
        if let Some(shot) = nearest.filter(|_| rank < 3) {
            shot.events.push(event);
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

//! What a film strip must show: pushes, commanded motions, what comes flying, what happened.
//!
//! events, motion → steps by how much they are wanted.

use std::ops::Range;

use aplomb_framework::events::{Event, EventKind, Reason};
use aplomb_framework::run::Trajectory;

use super::change::{Change, difference};
use super::scene::PUSH_TIME;

/// A prop comes flying if it is faster than this, m/s, and is seen so far from the character, m.
const FLIES: [f64; 2] = [1.5, 1.3];
/// Steps that are compared when the middle of a commanded motion is looked for.
const COMPARED: usize = 200;

/// A step that is wanted for some reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Wish {
    /// The lower, the more it is wanted.
    pub(super) rank: u8,
    pub(super) step: usize,
    /// A new controller may be shown later, while it is still active: the character and its pool's
    /// place.
    pub(super) active: Option<(usize, usize)>,
}

/// The rank of an event; none for what needs no frame of its own.
pub(super) fn rank(trajectory: &Trajectory, event: &Event) -> Option<u8> {
    let after = event.time > trajectory.duration() + trajectory.header.dt;
    if after || event.character >= trajectory.models.len() {
        return None;
    }
    Some(match &event.kind {
        EventKind::Push { .. } => 0,
        EventKind::Fell | EventKind::Stood => 2,
        EventKind::Switch {
            reason: Reason::Start,
            ..
        }
        | EventKind::Refused { .. } => return None,
        // What was commanded is shown by the motion that follows.
        EventKind::Command { .. } => 5,
        EventKind::Switch { .. } => 4,
        _ => 3,
    })
}

/// The spans of steps in which a command was carried out and then left.
fn commanded(trajectory: &Trajectory) -> Vec<Range<usize>> {
    let switches: Vec<&Event> = trajectory
        .events
        .iter()
        .filter(|e| matches!(e.kind, EventKind::Switch { .. }) && rank(trajectory, e).is_some())
        .collect();
    let mut spans = Vec::new();
    for (i, event) in switches.iter().enumerate() {
        let called = matches!(
            &event.kind,
            EventKind::Switch {
                reason: Reason::Command,
                ..
            }
        );
        let mut later = switches[i + 1..].iter();
        let next = later.find(|e| e.character == event.character);
        if let (true, Some(next)) = (called, next) {
            spans.push(trajectory.step_at(event.time)..trajectory.step_at(next.time));
        }
    }
    spans
}

/// Three steps of a commanded motion: on the way, where it is furthest from its beginning, and on
/// the way out of it.
fn three(trajectory: &Trajectory, change: &Change, span: &Range<usize>) -> [usize; 3] {
    let every = (span.len() / COMPARED).max(1);
    let far = |step: &usize| difference(trajectory, [span.start, *step]);
    let furthest = span
        .clone()
        .step_by(every)
        .max_by(|a, b| far(a).total_cmp(&far(b)))
        .unwrap_or(span.start);
    let between = |a: usize, b: usize| {
        let half = 0.5 * (change.at(a) + change.at(b));
        change.step(half).clamp(a, b)
    };
    [
        between(span.start, furthest),
        furthest,
        between(furthest, span.end),
    ]
}

/// Where a prop is seen coming: the first step at which it is near the first character and fast.
fn coming(trajectory: &Trajectory, prop: usize) -> Option<usize> {
    let every = (0.01 / trajectory.header.dt).round().max(1.0) as usize;
    let away = |step: usize| {
        let com = f64::from(trajectory.moment(step, 0).com[0]);
        f64::from(trajectory.prop(step, prop)[0]) - com
    };
    let span = every as f64 * trajectory.header.dt;
    (every..trajectory.len()).step_by(every).find(|step| {
        let (before, now) = (away(step - every), away(*step));
        let speed = (before.abs() - now.abs()) / span;
        now.abs() < FLIES[1] && before.abs() > 0.6 * FLIES[1] && speed > FLIES[0]
    })
}

/// All that is wanted, the most wanted first.
pub(super) fn wishes(trajectory: &Trajectory, change: &Change) -> Vec<Wish> {
    let mut wishes = Vec::new();
    for event in &trajectory.events {
        let Some(rank) = rank(trajectory, event) else {
            continue;
        };
        let late = if rank == 0 { 0.5 * PUSH_TIME } else { 0.0 };
        let step = trajectory.step_at(event.time + late);
        let active = match &event.kind {
            EventKind::Switch { to, .. } => {
                let pool = &trajectory.header.cast[event.character].controllers;
                let place = pool.iter().position(|c| c == to);
                place.map(|p| (event.character, p))
            }
            _ => None,
        };
        wishes.push(Wish { rank, step, active });
    }
    for span in commanded(trajectory) {
        wishes.extend(three(trajectory, change, &span).map(|step| Wish {
            rank: 1,
            step,
            active: None,
        }));
    }
    let props = 0..trajectory.header.props.len();
    wishes.extend(
        props
            .filter_map(|p| coming(trajectory, p))
            .map(|step| Wish {
                rank: 1,
                step,
                active: None,
            }),
    );
    wishes.sort_unstable();
    wishes
}

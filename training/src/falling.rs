//! How well a falling controller protects: a cost over pushes that nothing withstands.
//!
//! repertoire in text → rollouts → what touched first, impacts, rest → cost.

use aplomb_framework::Result;
use aplomb_framework::registry::Registry;
use aplomb_framework::sensors::{Posture, Sensors};
use aplomb_framework::simulation::Simulation;

use crate::standing::{Push, Site};

/// Impacts are averaged over this time, s (a 1 ms peak is the solver's, not the body's).
const FILTER: f64 = 0.01;
/// s after the push at which the character should be at rest.
const SETTLED: f64 = 4.0;

/// What a fall did to the character.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Landing {
    /// Whether it came down at all.
    pub fell: bool,
    /// Whether hands (forward), or hands or seat (backward), touched before head and trunk.
    pub protected: bool,
    /// Speed of the head when it first touched, m/s; 0 if it never did.
    pub head_speed: f64,
    /// Largest filtered force on the head, N.
    pub head_force: f64,
    /// Largest filtered force on trunk and root together, N.
    pub trunk_force: f64,
    /// Whether it lay or sat at rest at the end.
    pub settled: bool,
}

/// Pushes both ways, of root, trunk and head in turn, evenly over a range of impulses, N·s.
#[must_use]
pub fn pushes(low: f64, high: f64, count: usize) -> Vec<Push> {
    let step = (high - low) / (count.max(2) - 1) as f64;
    let one = |i: usize| {
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let impulse = sign * (low + step * i as f64);
        Push {
            site: [Site::Trunk, Site::Root, Site::Head][(i / 2) % 3],
            impulse,
            at: 1.0 + 0.0007 * i as f64,
            friction: [1.0, 0.8, 1.1][i % 3],
        }
    };
    (0..count).map(one).collect()
}

/// One fall.
///
/// # Errors
/// An invalid repertoire.
pub fn land(text: &str, registry: &Registry, push: Push) -> Result<Landing> {
    Ok(land_from(
        push.begin(text, registry)?,
        push.impulse > 0.0,
        SETTLED,
    ))
}

/// One fall from the moment of its push, forward or backward, watched for `longest` s.
#[must_use]
pub fn land_from(mut run: Simulation, forward: bool, longest: f64) -> Landing {
    let begun = run.time();
    let mut landing = Landing::default();
    let mut first: Option<bool> = None;
    let (mut head, mut trunk, mut head_before) = (0.0, 0.0, 0.0);
    let mix = run.world().settings().dt / FILTER;
    while run.time() < begun + longest {
        run.step();
        let now = run.sensors(0);
        let model = &now.model;
        let force = |link: usize| {
            let f = now.contacts[link].force;
            f[0].hypot(f[1])
        };
        head += mix * (force(model.head) - head);
        trunk += mix * (force(model.trunk) + force(0) - trunk);
        landing.head_force = landing.head_force.max(head);
        landing.trunk_force = landing.trunk_force.max(trunk);
        if now.contacts[model.head].touching && landing.head_speed == 0.0 {
            landing.head_speed = head_before;
        }
        let v = now.kinematics.links[model.head].com_velocity;
        head_before = v[0].hypot(v[1]);
        if first.is_none() {
            first = first_touch(now, forward);
        }
    }
    let now = run.sensors(0);
    landing.fell = !matches!(now.posture, Posture::Standing | Posture::Crouching);
    landing.protected = first.unwrap_or(true);
    landing.settled = now.com_velocity[0].hypot(now.com_velocity[1]) < 0.05;
    landing
}

/// Once hands, seat, trunk or head touch: whether that protects a fall in this direction.
fn first_touch(now: &Sensors, forward: bool) -> Option<bool> {
    let model = &now.model;
    let touching = |link: usize| now.contacts[link].touching;
    let hands = model.hands.iter().any(|h| touching(h.link));
    let vital = touching(model.head) || touching(model.trunk);
    let seat = (0..model.links.len()).any(|l| touching(l) && model.is_seat(l));
    if hands || (seat && !forward) {
        Some(!vital || hands)
    } else if vital {
        Some(false)
    } else {
        None
    }
}

/// Mean over the pushes: unprotected landings, impacts of head and trunk, unrest at the end.
///
/// # Errors
/// An invalid repertoire.
pub fn cost(text: &str, registry: &Registry, pushes: &[Push]) -> Result<f64> {
    let mut sum = 0.0;
    for push in pushes {
        let l = land(text, registry, *push)?;
        sum += if l.protected { 0.0 } else { 1.0 };
        sum += 0.3 * l.head_speed + l.head_force / 2000.0 + l.trunk_force / 5000.0;
        sum += if l.settled { 0.0 } else { 0.5 };
    }
    Ok(sum / pushes.len() as f64)
}

//! How well a falling controller protects a character that is pushed over.
//!
//! push, supervisor → rollout → what touched first, impacts, rest → cost.

use aplomb_framework::control::Supervisor;
use aplomb_framework::events::{EventKind, Reason};
use aplomb_framework::math::hypot;
use aplomb_framework::run::Simulation;
use aplomb_framework::sensing::Sensors;

use crate::exercise::bearing::Bearing;
use crate::exercise::impact::Impact;

/// s from the push within which the character should lie still.
const LONGEST: f64 = 2.6;
/// m/s; a slower centre of mass is still.
const STILL: f64 = 0.15;
/// s of stillness that end a fall.
const QUIET: f64 = 0.1;

/// What a fall did to the character.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Landing {
    /// Whether it came down at all: onto something other than feet.
    pub fell: bool,
    /// Whether hands (forward), or hands or seat (backward), touched before head and trunk, or none
    /// of them did.
    pub protected: bool,
    /// Speed of the head when it first touched, m/s; 0 if it never did.
    pub head_speed: f64,
    /// Largest filtered force on the head, N.
    pub head_force: f64,
    /// Largest filtered force on trunk and root together, N.
    pub trunk_force: f64,
    /// Part of the time that left and right moved as one.
    pub same: f64,
    /// Whether it lay or sat still in time, or had fallen to its controller's satisfaction, or never
    /// came down.
    pub settled: bool,
}

impl Landing {
    /// What it is charged: an unprotected landing most and a head that hits, the more the faster, then how
    /// hard head and trunk hit, and a little for unrest and for sides that move as one.
    #[must_use]
    pub fn cost(&self) -> f64 {
        let unprotected = if self.protected { 0.0 } else { 1.0 };
        let hit = (self.head_force / 2000.0).min(4.0) + (self.trunk_force / 5000.0).min(4.0);
        let unrest = if self.settled { 0.0 } else { 0.2 };
        let head = if self.head_speed > 0.0 {
            0.7 + 0.4 * self.head_speed
        } else {
            0.0
        };
        unprotected + head + hit + unrest + 0.2 * self.same
    }
}

/// Runs `supervisor` from a push, forward or backward, until the character lies still or the controller
/// that it came down with has succeeded: whatever touches after that belongs to getting up.
#[must_use]
pub fn land(start: &Simulation, supervisor: &Supervisor, forward: bool) -> Landing {
    let mut run = start.clone();
    run.set_supervisor(0, supervisor.clone());
    let begun = run.time();
    let dt = run.world().settings().dt;
    let mut impact = Impact::new(dt);
    let mut bearing = Bearing::new(run.sensors(0));
    let mut landing = Landing::default();
    let mut first: Option<bool> = None;
    let (mut head_before, mut quiet) = (0.0, 0.0);
    let mut seen = run.events().len();
    while run.time() < begun + LONGEST && !landing.settled {
        run.step();
        let now = run.sensors(0);
        let model = &now.model;
        impact.observe(now);
        bearing.observe(now, dt);
        landing.head_force = landing.head_force.max(impact.head);
        landing.trunk_force = landing.trunk_force.max(impact.trunk);
        if now.contacts[model.head].touching && landing.head_speed == 0.0 {
            landing.head_speed = head_before;
        }
        let v = now.kinematics.links[model.head].com_velocity;
        head_before = hypot(v[0], v[1]);
        if first.is_none() {
            first = first_touch(now, forward);
        }
        landing.fell |= now.is_down();
        let speed = hypot(now.com_velocity[0], now.com_velocity[1]);
        quiet = if landing.fell && speed < STILL {
            quiet + dt
        } else {
            0.0
        };
        let succeeded = run.events()[seen..].iter().any(|e| {
            matches!(
                &e.kind,
                EventKind::Switch {
                    reason: Reason::Succeeded,
                    ..
                }
            )
        });
        seen = run.events().len();
        landing.settled = quiet >= QUIET || landing.fell && succeeded;
    }
    landing.protected = first.unwrap_or(true);
    landing.settled |= !landing.fell;
    landing.same = if landing.fell {
        bearing.sameness()
    } else {
        0.0
    };
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::situations::Worlds;
    use crate::situations::pushes::{Pushes, Site};
    use aplomb_framework::character::Model;
    use aplomb_framework::control::repertoire;

    /// A landing of the humanoid with a shipped repertoire, backward.
    fn landing(repertoire: &str, sites: &[Site], impulse: f64) -> Landing {
        let model = Model::load("humanoid").unwrap();
        let registry = aplomb_controllers::registry();
        let supervisor = repertoire::load(repertoire, &registry, &model).unwrap();
        let pushes = Pushes {
            impulse: [impulse; 2],
            sites: sites.to_vec(),
            count: 2,
            seed: 0,
        };
        let starts = pushes.begin(&model, &supervisor, Worlds::single(1.0, 1.0));
        land(&starts.unwrap()[1], &supervisor, false)
    }

    #[test]
    fn a_fall_that_is_broken_costs_less_than_falling_limp() {
        let (broken, limp) = (
            landing("humanoid", &[Site::Trunk], 150.0),
            landing("limp", &[Site::Trunk], 150.0),
        );
        assert!(broken.fell && broken.protected, "{broken:?}");
        assert!(limp.fell && limp.settled, "{limp:?}");
        assert!(limp.head_speed > broken.head_speed, "{limp:?} {broken:?}");
        assert!(limp.cost() > broken.cost() + 0.5, "{limp:?} {broken:?}");
    }

    #[test]
    fn a_blow_that_turns_the_character_over_is_met_with_the_hands() {
        let (broken, limp) = (
            landing("humanoid", &[Site::Head], 260.0),
            landing("limp", &[Site::Head], 260.0),
        );
        assert!(broken.fell && broken.protected, "{broken:?}");
        assert!(limp.fell && limp.head_speed > 0.0, "{limp:?}");
        assert!(broken.cost() < limp.cost(), "{limp:?} {broken:?}");
    }

    #[test]
    fn who_stays_on_its_feet_is_charged_nothing() {
        let stood = landing("humanoid", &[Site::Trunk], 10.0);
        assert!(!stood.fell, "{stood:?}");
        assert_eq!(stood.cost(), 0.0);
    }
}

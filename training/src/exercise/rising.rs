//! How well a controller brings a fallen character to its goal: a cost over many starts.
//!
//! starts, supervisor → rollouts → success, time, impacts → cost.

use aplomb_framework::control::{Contract, Supervisor};
use aplomb_framework::events::{EventKind, Reason};
use aplomb_framework::math::{cos, hypot};
use aplomb_framework::run::Simulation;
use aplomb_framework::sensing::{Posture, Sensors};
use serde::{Deserialize, Serialize};

use crate::exercise::bearing::Bearing;
use crate::exercise::impact::Impact;

/// s for which the character must stand to have risen.
const STEADY: f64 = 0.3;
/// s within which the goal is to be reached.
const LONGEST: f64 = 10.0;

/// What a controller is to bring about.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Goal {
    /// Standing still, with the controllers that follow it.
    Stand,
    /// Its own post-condition, in a posture.
    Reach {
        /// The posture.
        posture: Posture,
        /// rad; upper end of the pitches that the trunk must not pass through: it tells which way
        /// round to turn. Either way if left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        barred: Option<f64>,
    },
}

/// What became of one start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rising {
    /// Whether the goal was reached.
    pub reached: bool,
    /// s until then, or until it was given up.
    pub time: f64,
    /// How near it came, 0 to 1.
    pub nearest: f64,
    /// Largest filtered force on head, N.
    pub head_force: f64,
    /// Largest filtered force on trunk and root, N.
    pub trunk_force: f64,
    /// Mean of the squared joint velocities, (rad/s)².
    pub motion: f64,
    /// The fastest that the head came to touch anything, m/s.
    pub knock: f64,
    /// m by which loaded soles slid.
    pub slid: f64,
    /// Part of the time that left and right moved as one.
    pub same: f64,
}

impl Rising {
    /// What it is charged: time, impacts, a head that knocks, needless motion, sliding soles and sides that move as one, each
    /// little, and much for a goal that is missed, the more the farther.
    #[must_use]
    pub fn cost(&self) -> f64 {
        let hurt = self.head_force / 3000.0 + self.trunk_force / 10_000.0;
        let looks = 0.3 * self.slid.min(1.0) + 0.15 * self.same + 0.2 * self.knock.min(3.0);
        let price = 0.1 * self.time + 0.1 * hurt + 0.004 * self.motion.min(50.0) + looks;
        if self.reached {
            price
        } else {
            2.0 - self.nearest + price.min(1.5)
        }
    }
}

/// Runs `supervisor` from a start, at which it is commanded to the controller with this contract, until
/// the goal is reached or any controller fails.
#[must_use]
pub fn rise(
    start: &Simulation,
    supervisor: &Supervisor,
    contract: &Contract,
    goal: Goal,
) -> Rising {
    let mut run = start.clone();
    run.set_supervisor(0, supervisor.clone());
    if let Some(command) = contract.commands.first() {
        // Its pre-condition holds: this is where it took over. Nobody answers only if the repertoire
        // lacks the controller; then the others do what they can.
        drop(run.command(0, &command.name));
    }
    let begun = run.time();
    let dt = run.world().settings().dt;
    let mut impact = Impact::new(dt);
    let (mut steady, mut kept) = (0.0, 0.0);
    let mut all = Rising {
        reached: false,
        time: LONGEST,
        nearest: 0.0,
        head_force: 0.0,
        trunk_force: 0.0,
        motion: 0.0,
        knock: 0.0,
        slid: 0.0,
        same: 0.0,
    };
    let mut bearing = Bearing::new(run.sensors(0));
    let head = run.sensors(0).model.head;
    let (mut head_speed, mut lies) = (0.0, true);
    let mut seen = run.events().len();
    while run.time() - begun < LONGEST {
        run.step();
        let now = run.sensors(0);
        impact.observe(now);
        all.head_force = all.head_force.max(impact.head);
        all.trunk_force = all.trunk_force.max(impact.trunk);
        bearing.observe(now, dt);
        let touching = now.contacts[head].touching;
        if touching && !lies {
            all.knock = all.knock.max(head_speed);
        }
        lies = touching;
        let v = now.kinematics.links[head].com_velocity;
        head_speed = hypot(v[0], v[1]);
        all.nearest = f64::max(all.nearest, nearness(now, goal));
        let name = run.actors()[0].supervisor.active().unwrap_or_default();
        match goal {
            Goal::Stand => {
                steady = if now.stands() { steady + dt } else { 0.0 };
                all.reached = steady >= STEADY;
            }
            Goal::Reach { .. } => {
                kept = if contract.postcondition.holds(now) {
                    kept + dt
                } else {
                    0.0
                };
                all.reached = kept >= contract.hold && name != contract.name;
            }
        }
        let given_up = run.events()[seen..].iter().any(|e| {
            matches!(
                &e.kind,
                EventKind::Switch {
                    reason: Reason::Failed(_),
                    ..
                }
            )
        });
        seen = run.events().len();
        if all.reached || given_up {
            break;
        }
    }
    all.time = run.time() - begun;
    all.motion = bearing.motion();
    all.slid = bearing.slid();
    all.same = bearing.sameness();
    all
}

/// How much of half a turn is done to a pitch, on the way that does not lead through the barred ones.
fn turned_round(pitch: f64, aim: f64, barred: f64) -> f64 {
    let past = |x: f64| (x - barred).rem_euclid(std::f64::consts::TAU);
    let left = (past(aim) - past(pitch)).abs();
    (1.0 - left / std::f64::consts::PI).max(0.0)
}

/// How near a situation is to the goal, 0 to 1.
fn nearness(now: &Sensors, goal: Goal) -> f64 {
    match goal {
        Goal::Stand => {
            let height = now.com_height() / now.model.standing_com()[1];
            let head = now.kinematics.links[now.model.head].com[1] - now.ground;
            let head = (head / 1.6).clamp(0.0, 1.0);
            let ([rear, front], x) = (now.soles(), now.capture_point);
            let off = (rear + 0.03 - x).max(x - front + 0.03).max(0.0);
            let over = (1.0 - off / 0.6).max(0.0);
            let weight = now.model.total_mass() * now.gravity.max(1.0);
            let load: f64 = now.feet.iter().map(|f| f.force[1]).sum();
            let load = (load / weight).min(1.0);
            let on_feet = f64::from(u8::from(now.only_feet_support()));
            (0.15 * head + over * (0.1 + 0.2 * load + on_feet * (0.25 + 0.3 * height))).min(1.0)
        }
        Goal::Reach { posture, barred } => {
            let aim = match posture {
                Posture::Supine => std::f64::consts::FRAC_PI_2,
                Posture::Prone => -std::f64::consts::FRAC_PI_2,
                _ => 0.0,
            };
            let pitch = now.trunk_pitch();
            let turned = match barred {
                Some(barred) => turned_round(pitch, aim, barred),
                None => 0.5 * (1.0 + cos(pitch - aim)),
            };
            let there = f64::from(u8::from(now.posture == posture));
            0.8 * turned + 0.2 * there
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb_framework::character::Model;
    use aplomb_framework::control::repertoire;
    use aplomb_framework::scenario::Scenario;
    use std::sync::Arc;

    #[test]
    fn what_is_barred_tells_which_way_to_turn() {
        use std::f64::consts::{FRAC_PI_2, PI};
        let barred = 0.3;
        // From the back over the shoulders to the belly.
        let done = |pitch| turned_round(pitch, -FRAC_PI_2, barred);
        assert!(done(FRAC_PI_2) < 1e-9);
        assert!(done(0.5) < 1e-9, "sitting up leads away");
        assert!((done(PI - 1e-6) - 0.5).abs() < 1e-5);
        assert!((done(-PI + 1e-6) - 0.5).abs() < 1e-5);
        assert!((done(-FRAC_PI_2) - 1.0).abs() < 1e-9);
    }

    /// A controller of a shipped repertoire, from standing upright or lying on the back.
    fn shipped(repertoire: &str, name: &str, pitch: f64) -> Rising {
        let model = Model::load("humanoid").unwrap();
        let registry = aplomb_controllers::registry();
        let supervisor = repertoire::load(repertoire, &registry, &model).unwrap();
        let mut pool = supervisor.controllers().map(|c| c.contract().clone());
        let contract = pool.find(|c| c.name == name).unwrap();
        let mut scenario = Scenario::standing("humanoid", 10.0);
        scenario.characters[0].start.pitch = pitch;
        let cast = vec![(Arc::clone(&model), supervisor.clone())];
        let mut start = Simulation::with_cast(&scenario, cast).unwrap();
        start.run(0.5);
        rise(&start, &supervisor, &contract, Goal::Stand)
    }

    #[test]
    fn standing_costs_little_and_staying_down_much() {
        let bow = shipped("humanoid", "bow", 0.0);
        // But for arms and legs that move as one.
        assert!(bow.reached && bow.cost() - 0.15 * bow.same < 0.1, "{bow:?}");
        assert!((bow.time - STEADY).abs() < 0.01, "{bow:?}");
        let rest = shipped("limp", "rest", std::f64::consts::FRAC_PI_2);
        assert!(!rest.reached && rest.nearest < 0.5, "{rest:?}");
        assert!(rest.cost() > 1.5, "{rest:?}");
    }
}

//! How well a controller brings a fallen character to its goal: a cost over many starts.
//!
//! starts, mind → rollouts → success, time, impacts → cost.

use aplomb_framework::contract::Contract;
use aplomb_framework::condition::Condition;
use aplomb_framework::trajectory::EventKind;
use aplomb_framework::sensors::{Posture, Sensors};
use aplomb_framework::simulation::Simulation;
use aplomb_framework::supervisor::Supervisor;

/// Impacts are averaged over this time, s.
const FILTER: f64 = 0.01;
/// s for which the character must stand to have risen.
const STEADY: f64 = 0.3;

/// What a controller is to bring about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// Standing still, with the controllers that follow it.
    Stand,
    /// Its own post-condition, in this posture.
    Reach(Posture),
}

impl Goal {
    /// Of a contract: standing if its post-condition is met on the feet, else the post-condition.
    #[must_use]
    pub fn of(contract: &Contract) -> Self {
        match first_posture(&contract.postcondition) {
            Some(Posture::Standing | Posture::Crouching) | None => Self::Stand,
            Some(posture) => Self::Reach(posture),
        }
    }
}

fn first_posture(condition: &Condition) -> Option<Posture> {
    match condition {
        Condition::Posture(any) => any.first().copied(),
        Condition::All(all) => all.iter().find_map(first_posture),
        _ => None,
    }
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
}

/// Runs `mind`, whose first controller is the one that is judged, from a start.
#[must_use]
pub fn rise(start: &Simulation, mind: &Supervisor, contract: &Contract, goal: Goal, longest: f64) -> Rising {
    let mut run = start.clone();
    run.set_mind(0, mind.clone());
    let begun = run.time();
    let mix = run.world().settings().dt / FILTER;
    let (mut head, mut trunk, mut steady, mut kept) = (0.0, 0.0, 0.0, 0.0);
    let mut all = Rising {
        reached: false,
        time: longest,
        nearest: 0.0,
        head_force: 0.0,
        trunk_force: 0.0,
        motion: 0.0,
    };
    let mut steps = 0.0;
    let mut seen = run.events().len();
    while run.time() - begun < longest {
        run.step();
        let now = run.sensors(0);
        let dt = run.world().settings().dt;
        let force = |link: usize| now.contacts[link].force[0].hypot(now.contacts[link].force[1]);
        head += mix * (force(now.model.head) - head);
        trunk += mix * (force(now.model.trunk) + force(0) - trunk);
        all.head_force = all.head_force.max(head);
        all.trunk_force = all.trunk_force.max(trunk);
        all.motion += now.state.rates().iter().map(|r| r * r).sum::<f64>();
        steps += 1.0;
        all.nearest = f64::max(all.nearest, nearness(now, goal));
        let name = run.actors()[0].mind.active().unwrap_or_default();
        match goal {
            Goal::Stand => {
                steady = if now.stands() { steady + dt } else { 0.0 };
                all.reached = steady >= STEADY;
            }
            Goal::Reach(_) => {
                kept = if contract.postcondition.holds(now) { kept + dt } else { 0.0 };
                all.reached = kept >= contract.hold && name != contract.name;
            }
        }
        let given_up = run.events()[seen..].iter().any(|e| {
            matches!(&e.kind, EventKind::Switch { why, .. } if why.starts_with("failed"))
        });
        seen = run.events().len();
        if all.reached || given_up {
            break;
        }
    }
    all.time = run.time() - begun;
    all.motion /= steps;
    all
}

/// How near a situation is to the goal, 0 to 1.
fn nearness(now: &Sensors, goal: Goal) -> f64 {
    match goal {
        Goal::Stand => {
            let height = now.com_height() / now.model.standing_com()[1];
            let head = now.kinematics.links[now.model.head].com[1] - now.ground;
            let head = (head / 1.6).clamp(0.0, 1.0);
            let off = now.base_of_support.map_or(1.0, |[rear, front]| {
                let x = now.capture_point;
                (rear + 0.03 - x).max(x - front + 0.03).max(0.0)
            });
            let over = (1.0 - off / 0.6).max(0.0);
            let on_feet = f64::from(u8::from(now.only_feet_support()));
            (0.15 * head + over * (0.25 + on_feet * (0.3 + 0.3 * height))).min(1.0)
        }
        Goal::Reach(posture) => {
            let aim = match posture {
                Posture::Supine => std::f64::consts::FRAC_PI_2,
                Posture::Prone => -std::f64::consts::FRAC_PI_2,
                _ => 0.0,
            };
            let turned = 0.5 * (1.0 + (now.trunk_pitch() - aim).cos());
            let there = f64::from(u8::from(now.posture == posture));
            0.8 * turned + 0.2 * there
        }
    }
}

/// Mean over the starts.
#[must_use]
pub fn cost(starts: &[Simulation], mind: &Supervisor, contract: &Contract, goal: Goal, longest: f64) -> f64 {
    let one = |start: &Simulation| {
        let r = rise(start, mind, contract, goal, longest);
        let hurt = r.head_force / 3000.0 + r.trunk_force / 10_000.0;
        let price = 0.1 * r.time + 0.1 * hurt + 0.002 * r.motion.min(50.0);
        if r.reached { price } else { 2.0 - r.nearest + price.min(0.8) }
    };
    starts.iter().map(one).sum::<f64>() / starts.len().max(1) as f64
}

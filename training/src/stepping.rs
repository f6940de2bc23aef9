//! How well a step takes pushes that balance in place does not: a cost over pushes in varied worlds.
//!
//! pushes, mind → rollouts → steady on parallel feet, time, way, bent trunk → cost.

use std::sync::Arc;

use aplomb_framework::Result;
use aplomb_framework::model::Model;
use aplomb_framework::scenario::Scenario;
use aplomb_framework::simulation::Simulation;
use aplomb_framework::supervisor::Supervisor;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::worlds::Worlds;

/// s; when the character is pushed.
const PUSH_AT: f64 = 0.5;
/// s after the push within which it is to stand.
const LONGEST: f64 = 6.0;
/// s for which it must stand.
const STEADY: f64 = 0.3;

/// Characters at the moment of a push: `count` impulses evenly over `low` to `high` N·s, either
/// way; two in three at the trunk, the others at the root, where the same impulse turns it less.
///
/// # Errors
/// A mind for another character.
pub fn pushed(
    model: &Arc<Model>,
    mind: &Supervisor,
    [low, high]: [f64; 2],
    count: usize,
    worlds: Worlds,
    seed: u64,
) -> Result<Vec<Simulation>> {
    let one = |i: usize| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(i as u64);
        let mut scenario = Scenario::standing(&model.name, LONGEST);
        scenario.settings = worlds.draw(&mut rng);
        let mut run = Simulation::with_cast(&scenario, vec![(Arc::clone(model), mind.clone())])?;
        run.run(PUSH_AT + rng.gen_range(0.0..0.2));
        let part = (i / 2) as f64 / ((count / 2).max(2) - 1) as f64;
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let link = if low >= 55.0 { [model.trunk, 0, model.head][(i / 2) % 3] } else if (i / 2) % 3 == 2 { 0 } else { model.trunk };
        run.push(0, &model.links[link].name, sign * (low + part * (high - low)))?;
        Ok(run)
    };
    (0..count).map(one).collect()
}

/// What became of one push.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepped {
    /// Whether it stood still on parallel feet in time, and never came down.
    pub stood: bool,
    /// s from the push.
    pub time: f64,
    /// m that the centre of mass was moved.
    pub way: f64,
    /// Mean of the trunk's pitch squared, rad².
    pub bent: f64,
    /// Mean of the squared joint velocities, (rad/s)².
    pub motion: f64,
}

/// Runs `mind` from a push on.
#[must_use]
pub fn step(start: &Simulation, mind: &Supervisor) -> Stepped {
    let mut run = start.clone();
    run.set_mind(0, mind.clone());
    let (begun, x) = (run.time(), run.sensors(0).com[0]);
    let dt = run.world().settings().dt;
    let mut all = Stepped {
        stood: false,
        time: LONGEST,
        way: 0.0,
        bent: 0.0,
        motion: 0.0,
    };
    let (mut steps, mut steady) = (0.0, 0.0);
    while run.time() - begun < LONGEST {
        run.step();
        let now = run.sensors(0);
        steps += 1.0;
        all.bent += now.trunk_pitch().powi(2);
        all.motion += now.state.rates().iter().map(|r| r * r).sum::<f64>();
        let down = now.contacts.iter().enumerate();
        if down.into_iter().any(|(i, c)| c.supported && !now.model.is_foot(i)) {
            break;
        }
        let feet: Vec<f64> = now
            .model
            .feet
            .iter()
            .map(|f| now.kinematics.links[f.link].origin[0])
            .collect();
        let apart = feet.iter().fold(0.0, |a: f64, x| a.max((x - feet[0]).abs()));
        steady = if now.stands() && apart < 0.06 { steady + dt } else { 0.0 };
        if steady >= STEADY {
            all.stood = true;
            break;
        }
    }
    all.time = run.time() - begun;
    all.way = (run.sensors(0).com[0] - x).abs();
    all.bent /= steps;
    all.motion /= steps;
    all
}

/// Mean over the pushes.
#[must_use]
pub fn cost(starts: &[Simulation], mind: &Supervisor) -> f64 {
    let one = |start: &Simulation| {
        let s = step(start, mind);
        if s.stood {
            0.06 * s.time + 0.2 * s.way + 0.5 * s.bent.min(1.0) + 0.003 * s.motion.min(100.0)
        } else {
            3.0 - 0.25 * s.time
        }
    };
    starts.iter().map(one).sum::<f64>() / starts.len().max(1) as f64
}

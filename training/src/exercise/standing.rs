//! How well a standing controller takes pushes: a cost over pushes around its limit.
//!
//! repertoire in text → rollouts → cost. Each push is a short rollout: 1 s of standing, the push,
//! then up to 7 s until the character has stood for a second or has come down.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Registry, repertoire};
use aplomb_framework::input::{Result, Source};
use aplomb_framework::math::square;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;

use crate::situations::pushes::Site;

/// s after a push at which the pose should be as before.
const RECOVERED: f64 = 3.5;

/// A push over 0.1 s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Where it acts.
    pub site: Site,
    /// N·s, forward positive.
    pub impulse: f64,
    /// When it begins, s.
    pub at: f64,
    /// Friction of the ground.
    pub friction: f64,
}

/// Pushes in steps of `step` N·s around the limits, a little different in time and friction so
/// that no single lucky run decides.
#[must_use]
pub fn pushes(forward: [f64; 2], backward: [f64; 2], step: f64) -> Vec<Push> {
    let mut all = Vec::new();
    for (sign, [low, high]) in [(1.0, forward), (-1.0, backward)] {
        let count = ((high - low) / step).round() as usize;
        for i in 0..=count {
            let phase = [0.0, 0.0013, 0.0029, 0.0047][i % 4];
            let friction = [1.0, 1.0, 0.9, 1.1][i % 4];
            let impulse = sign * (low + step * i as f64);
            all.push(Push {
                site: Site::Trunk,
                impulse,
                at: 1.0 + phase,
                friction,
            });
        }
    }
    all
}

impl Push {
    /// A rollout at the moment at which the push begins: the humanoid has stood until then under
    /// the repertoire in `text`.
    ///
    /// # Errors
    /// An invalid repertoire.
    fn begin(&self, text: &str, registry: &Registry) -> Result<Simulation> {
        let mut scenario = Scenario::standing("humanoid", 10.0);
        scenario.settings.friction = self.friction;
        let model = Model::load("humanoid")?;
        let supervisor = repertoire::build(&Source::new("tuned", text), None, registry, &model)?;
        let mut run = Simulation::with_cast(&scenario, vec![(Arc::clone(&model), supervisor)])?;
        run.run(self.at);
        run.push(0, self.site.link(&model), self.impulse)?;
        Ok(run)
    }
}

/// How one push went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Whether it stood at the end, and only ever under the first controller.
    pub stood: bool,
    /// s from the push until it stood for a second or came down.
    pub after: f64,
    /// Root mean square of the joints' distance from their angles before the push, 3.5 s after it,
    /// rad; 0 if it came down.
    pub slouch: f64,
    /// Part of the time that not all feet touched.
    pub lifted: f64,
    /// Mean of the squared joint velocities until then, (rad/s)².
    pub motion: f64,
}

/// One rollout.
///
/// # Errors
/// An invalid repertoire.
pub fn take(text: &str, registry: &Registry, push: Push) -> Result<Taken> {
    let mut run = push.begin(text, registry)?;
    // The push acts from the next step on: this is how it stood before.
    let quiet = run.sensors(0).com_velocity[0].abs() < 0.05;
    let (mut motion, mut steps, mut slouch, mut lifted) = (0.0, 0.0, 0.0, 0.0);
    let before: Vec<f64> = run.sensors(0).state.angles().to_vec();
    let first = run.actors()[0].supervisor.active_index();
    while run.time() < push.at + 7.0 {
        run.step();
        let now = run.sensors(0);
        motion += now.state.rates().iter().map(|r| r * r).sum::<f64>();
        steps += 1.0;
        lifted += f64::from(u8::from(!now.feet.iter().all(|f| f.touching())));
        if run.actors()[0].supervisor.active_index() != first {
            break;
        }
        if now.time < push.at + RECOVERED {
            let apart = now
                .state
                .angles()
                .iter()
                .zip(&before)
                .map(|(a, b)| square(a - b));
            slouch = (apart.sum::<f64>() / before.len() as f64).sqrt();
        } else if run.outcome(0).standing {
            break;
        }
    }
    let stood =
        run.outcome(0).standing && run.actors()[0].supervisor.active_index() == first && quiet;
    Ok(Taken {
        stood,
        slouch,
        after: run.time() - push.at,
        motion: motion / steps,
        lifted: lifted / steps,
    })
}

/// Sum over the pushes: 1 for each that is not stood (less the longer it lasted), and a little for
/// slow recovery, for a pose that is not regained, for lifted feet and for needless motion.
///
/// # Errors
/// An invalid repertoire.
pub fn cost(text: &str, registry: &Registry, pushes: &[Push]) -> Result<f64> {
    let mut sum = 0.0;
    for push in pushes {
        let taken = take(text, registry, *push)?;
        sum += if taken.stood {
            0.03 * taken.after / 7.0 + 0.002 * taken.motion.min(20.0) + 0.3 * taken.slouch.min(1.0)
        } else {
            1.0 - 0.3 * (taken.after / 7.0).min(1.0)
        };
    }
    Ok(sum)
}

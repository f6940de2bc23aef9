//! One rollout (2001 paper, "Determining pre-conditions by learning"): from a nominal start a random
//! disturbance brings the character to some state; there its features are recorded and the controller
//! takes over alone; the label is whether it succeeds: reaches its post-condition in time without failing, or,
//! if it has none, is standing when the time is up, whatever it expects of itself.
//!
//! random stream → [`Disturbed`] run → the controller alone → [`Sample`].

use aplomb_framework::control::{Condition, Contract, Controller, Registry, Supervisor};
use aplomb_framework::events::{EventKind, Reason};
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::sensing::Feature;
use aplomb_framework::world::Settings;
use rand_chacha::ChaCha8Rng;

use crate::exercise::Impact;
use crate::exercise::skill::Skill;
use crate::situations::Held;
use crate::situations::disturbance::Disturbance;
use crate::situations::disturbed::Disturbed;

/// What a rollout tells.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The features' values where the controller took over; not a number where one has none.
    pub features: Vec<f64>,
    /// Whether the controller succeeded.
    pub success: bool,
    /// Whether its hand-made pre-condition held there.
    pub manual: bool,
}

/// All that rollouts of a controller share.
#[derive(Debug, Clone)]
pub struct Trial {
    disturbed: Disturbed,
    /// The controller alone, wherever it is; lying limp when it has ended.
    alone: Supervisor,
    contract: Contract,
}

impl Trial {
    /// Of a controller in its repertoire.
    ///
    /// # Errors
    /// A controller that cannot be built.
    pub fn new(skill: &Skill, disturbance: Disturbance, registry: &Registry) -> Result<Self> {
        let mut file = skill.file.clone();
        file.contract.precondition = Condition::Always;
        // Only on command, so that it is left when it has ended.
        file.contract.weight = 0;
        if skill.contract.postcondition == Condition::Never {
            // It never gives way by itself: what it can do shows when nobody takes over from it.
            file.contract.expected = Condition::Always;
        }
        let controller = registry.build(&file, &skill.model)?;
        let limp = vec![0.0; skill.model.joint_count()];
        let idle: Box<dyn Controller> = Box::new(Held::new("idle", &skill.model, limp, 0.0));
        Ok(Self {
            disturbed: Disturbed::new(disturbance, &skill.model, &skill.supervisor)?,
            alone: Supervisor::new("alone", vec![controller, idle], "idle")?,
            contract: skill.contract.clone(),
        })
    }

    /// What is recorded where the controller takes over.
    #[must_use]
    pub fn features(&self) -> &[Feature] {
        &self.disturbed.disturbance.features
    }

    /// The rollout of a random stream.
    ///
    /// # Errors
    /// A character whose parts do not fit each other.
    pub fn sample(&self, rng: &mut ChaCha8Rng) -> Result<Sample> {
        let mut run = self.disturbed.run(Settings::default(), rng)?;
        run.set_supervisor(0, self.alone.clone());
        if let Some(command) = self.contract.commands.first() {
            run.command(0, &command.name)?;
        }
        run.step(); // it takes over with what is sensed in this step
        let now = run.sensors(0);
        let features = self.features().iter().map(|f| f.value(now)).collect();
        let manual = self.contract.precondition.holds(now);
        let success = self.succeeds(run);
        Ok(Sample {
            features,
            success,
            manual,
        })
    }

    /// Runs on until the controller has ended.
    fn succeeds(&self, mut run: Simulation) -> bool {
        let name = &self.contract.name;
        let never = self.contract.postcondition == Condition::Never;
        let mut impact = Impact::new(run.world().settings().dt);
        let end = run.time() + self.disturbed.disturbance.within;
        let mut seen = 0;
        loop {
            let ended = run.events()[seen..].iter().find_map(|e| match &e.kind {
                EventKind::Switch {
                    from: Some(from),
                    reason,
                    ..
                } if from == name => Some(*reason == Reason::Succeeded),
                _ => None,
            });
            seen = run.events().len();
            if let Some(succeeded) = ended {
                return succeeded;
            }
            if run.time() >= end {
                return never && run.outcome(0).standing;
            }
            if never && run.sensors(0).is_down() {
                return false;
            }
            run.step();
            if let Some(limit) = self.disturbed.disturbance.unharmed {
                impact.observe(run.sensors(0));
                if impact.head > limit.head || impact.trunk > limit.trunk {
                    return false;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::situations::disturbance::shipped;
    use rand::SeedableRng;

    fn trial(controller: &str) -> Trial {
        let skill = crate::exercise::skill::tests::shipped(controller);
        let source = shipped(controller).unwrap();
        let disturbance = Disturbance::parse(&source, &skill.model).unwrap();
        Trial::new(&skill, disturbance, &aplomb_controllers::registry()).unwrap()
    }

    fn sample(trial: &Trial, stream: u64) -> Sample {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        rng.set_stream(stream);
        trial.sample(&mut rng).unwrap()
    }

    #[test]
    fn a_stream_is_a_rollout() {
        let trial = trial("balance");
        let samples: Vec<Sample> = (0..6).map(|i| sample(&trial, i)).collect();
        let again: Vec<Sample> = (0..6).rev().map(|i| sample(&trial, i)).collect();
        assert!(samples.iter().eq(again.iter().rev()));
        assert!(
            samples
                .iter()
                .all(|s| s.features.iter().all(|x| x.is_finite()))
        );
        assert_ne!(samples[0].features, samples[1].features);
    }

    #[test]
    fn who_is_not_disturbed_succeeds_and_who_lies_cannot_balance() {
        let mut trial = trial("balance");
        trial.disturbed.disturbance.force.most = 0.0;
        trial.disturbed.disturbance.offset = 0.0;
        let stood = sample(&trial, 0);
        assert!(stood.success && stood.manual);
        trial.disturbed.disturbance.starts.truncate(1);
        trial.disturbed.disturbance.starts[0].pitch = 1.5;
        let lay = sample(&trial, 0);
        assert!(!lay.success && !lay.manual);
    }

    #[test]
    fn what_hurts_is_no_success() {
        let mut trial = trial("fall");
        trial.disturbed.disturbance.force.most = 800.0;
        let successes = |trial: &Trial| (0..8).filter(|i| sample(trial, *i).success).count();
        let unhurt = successes(&trial);
        let limit = trial.disturbed.disturbance.unharmed.as_mut().unwrap();
        (limit.head, limit.trunk) = (1.0, 1.0);
        // Who came down at all was touched.
        assert!(successes(&trial) < unhurt);
    }
}

//! What a controller is measured by: situations that it has to cope with, and what counts as coping.
//!
//! skill, drill → starts in random worlds; mind → rollouts in parallel → [`Score`].
//!
//! A controller that takes over from a character on its feet alone, and leaves it standing, is
//! pushed ([`stepping`]); any other is taken from where the repertoire hands over to it, in heaps on
//! the floor and in falls, to its goal ([`rising`]). The first is told from its contract: its
//! pre-condition refuses every centre of mass below 0.7 of the standing height.

use std::ops::ControlFlow;

use aplomb_framework::condition::Condition;
use aplomb_framework::contract::Contract;
use aplomb_framework::model::Model;
use aplomb_framework::simulation::Simulation;
use aplomb_framework::supervisor::Supervisor;
use aplomb_framework::{Error, Result};
use rayon::prelude::*;

use crate::rising::{self, Goal};
use crate::skill::Skill;
use crate::starts::{self, starts};
use crate::stepping::{self, Pushes};
use crate::worlds::Worlds;

/// Lowest centre of mass of whoever is on its feet, relative to the standing height.
const UPRIGHT: f64 = 0.7;
/// Part of the starts that are heaps; the others are falls.
const HEAPS: f64 = 0.5;

/// What a controller has to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// Bring a character that is down to a goal.
    Rise(Goal),
    /// Take a push.
    Push,
}

impl Task {
    /// What a contract asks for.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is nothing to measure: a controller that never ends or has always
    /// succeeded, and one that acts only on command and on its feet.
    pub fn of(contract: &Contract, model: &Model) -> Result<Self> {
        let invalid = |field: &str, problem: String, accepted: &str| {
            Err(Error::invalid(&contract.name, field, problem, accepted))
        };
        let post = &contract.postcondition;
        if matches!(post, Condition::Never | Condition::Always) {
            let accepted = "a condition that the controller brings about";
            return invalid("postcondition", post.to_string(), accepted);
        }
        let goal = Goal::of(contract);
        let upright = UPRIGHT * model.standing_com()[1];
        if goal != Goal::Stand || lowest(&contract.precondition) < upright {
            return Ok(Self::Rise(goal));
        }
        if contract.weight == 0 {
            let accepted = "above 0 for one that takes over from a standing character";
            return invalid("weight", "0, only on command".to_owned(), accepted);
        }
        Ok(Self::Push)
    }
}

/// A height of the centre of mass, m, below which a condition is sure to refuse.
fn lowest(condition: &Condition) -> f64 {
    match condition {
        Condition::Never => f64::INFINITY,
        Condition::Within { feature, min, .. } if feature.to_string() == "com_height" => *min,
        Condition::All(all) => all.iter().map(lowest).fold(f64::NEG_INFINITY, f64::max),
        Condition::Any(any) => any.iter().map(lowest).fold(f64::INFINITY, f64::min),
        _ => f64::NEG_INFINITY,
    }
}

/// How starts are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// The worlds.
    pub worlds: Worlds,
    /// Weakest and strongest push of [`Task::Push`], N·s.
    pub impulse: [f64; 2],
    /// Whether one push in three is at the root instead of the trunk.
    pub at_root: bool,
    /// How many.
    pub starts: usize,
    /// Fixes everything random.
    pub seed: u64,
}

impl Drill {
    /// What skills are trained with.
    #[must_use]
    pub fn training(starts: usize, seed: u64) -> Self {
        Self {
            worlds: Worlds::VARIED,
            impulse: [40.0, 90.0],
            at_root: true,
            starts,
            seed,
        }
    }

    /// What skills are measured with in a single world: weaker pushes, of the trunk alone.
    #[must_use]
    pub fn cell(worlds: Worlds, starts: usize, seed: u64) -> Self {
        Self {
            worlds,
            impulse: [40.0, 75.0],
            at_root: false,
            starts,
            seed,
        }
    }
}

/// How well a controller did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Mean over the starts; less is better.
    pub cost: f64,
    /// Starts from which it reached its goal.
    pub reached: usize,
}

impl Score {
    /// Of what cannot even be built.
    pub const WORST: Self = Self {
        cost: f64::INFINITY,
        reached: 0,
    };
}

/// A task with its starts.
#[derive(Debug, Clone)]
pub struct Exercise {
    contract: Contract,
    task: Task,
    starts: Vec<Simulation>,
}

impl Exercise {
    /// Makes the starts under the skill's repertoire. While they are looked for, `watch` sees how many
    /// there are so far and may end the work; then there are fewer.
    ///
    /// # Errors
    /// As [`Task::of`].
    pub fn new(
        skill: &Skill,
        drill: Drill,
        watch: impl FnMut(usize) -> ControlFlow<()>,
    ) -> Result<Self> {
        let (model, mind, contract) = (&skill.model, &skill.mind, &skill.contract);
        let task = Task::of(contract, model)?;
        let starts = match task {
            Task::Rise(_) => {
                let source = starts::Source {
                    worlds: drill.worlds,
                    heaps: HEAPS,
                    seed: drill.seed,
                };
                starts(source, drill.starts, model, contract, mind, watch)?
            }
            Task::Push => {
                let pushes = Pushes {
                    impulse: drill.impulse,
                    at_root: drill.at_root,
                    count: drill.starts,
                    seed: drill.seed,
                };
                stepping::pushed(model, mind, pushes, drill.worlds)?
            }
        };
        Ok(Self {
            contract: contract.clone(),
            task,
            starts,
        })
    }

    /// The task.
    #[must_use]
    pub fn task(&self) -> Task {
        self.task
    }

    /// How many starts there are: what was asked for, or fewer, down to none, where the repertoire
    /// seldom hands over to the controller.
    #[must_use]
    pub fn starts(&self) -> usize {
        self.starts.len()
    }

    /// How well the controller does in a repertoire.
    #[must_use]
    pub fn judge(&self, mind: &Supervisor) -> Score {
        let one = |start: &Simulation| match self.task {
            Task::Rise(goal) => {
                let rising = rising::rise(start, mind, &self.contract, goal);
                (rising.cost(), rising.reached)
            }
            Task::Push => {
                let stepped = stepping::step(start, mind);
                (stepped.cost(), stepped.stood)
            }
        };
        // In the order of the starts, so that the number of threads does not change the sum.
        let all: Vec<(f64, bool)> = self.starts.par_iter().map(one).collect();
        Score {
            cost: all.iter().map(|(cost, _)| cost).sum::<f64>() / all.len().max(1) as f64,
            reached: all.iter().filter(|(_, reached)| *reached).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skill::tests::{TUCK, skills};
    use aplomb_framework::sensors::Posture;

    fn task(contract: &str) -> std::result::Result<Task, String> {
        let mut contract: Contract = ron::from_str(contract).unwrap();
        let model = Model::load("humanoid").unwrap();
        contract.resolve(&model).unwrap();
        Task::of(&contract, &model).map_err(|e| e.to_string())
    }

    fn with(pre: &str, post: &str, weight: u32) -> std::result::Result<Task, String> {
        task(&format!(
            r#"(name: "x", weight: {weight}, precondition: {pre}, postcondition: {post})"#
        ))
    }

    #[test]
    fn the_task_follows_from_the_contract() {
        let high = r#"All([Posture([standing]), Within(feature: "com_height", min: 0.75)])"#;
        let low = r#"Any([Posture([crouching]), Within(feature: "com_height", min: 0.75)])"#;
        let stand = "All([Posture([crouching, standing])])";
        assert_eq!(with(high, stand, 7), Ok(Task::Push));
        assert_eq!(with(low, stand, 7), Ok(Task::Rise(Goal::Stand)));
        assert_eq!(with(low, stand, 0), Ok(Task::Rise(Goal::Stand)));
        let prone = Task::Rise(Goal::Reach(Posture::Prone));
        assert_eq!(with(high, "Posture([prone, sitting])", 0), Ok(prone));
        let refusals = [(high, stand, 0), (low, "Never", 1), (low, "Always", 1)];
        for (pre, post, weight) in refusals {
            let told = with(pre, post, weight).unwrap_err();
            assert!(told.contains("accepted: "), "{told}");
        }
    }

    /// Digests of the starts, and the score, on so many threads.
    fn exercised(threads: usize, text: &str) -> (Vec<String>, Score) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let (_folder, skills) = skills(text);
            let skill = Skill::find(&skills, "tuck").unwrap();
            let drill = Drill::training(3, 5);
            let exercise = Exercise::new(skill, drill, |_| ControlFlow::Continue(())).unwrap();
            let digests = exercise.starts.iter().map(Simulation::digest).collect();
            (digests, exercise.judge(&skill.mind))
        })
    }

    #[test]
    fn starts_and_scores_are_the_same_on_any_number_of_threads() {
        let (starts, score) = exercised(1, TUCK);
        assert_eq!(starts.len(), 3);
        assert_eq!(exercised(2, TUCK), (starts.clone(), score));
        assert!(score.reached > 0 && score.cost < 2.0, "{score:?}");
        // Other numbers of the controller: the same starts.
        let (same, other) = exercised(2, &TUCK.replace(r#""hip": 0.5"#, r#""hip": 0.7"#));
        assert_eq!(same, starts);
        assert_ne!(other, score);
    }
}

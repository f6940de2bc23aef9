//! What a controller is measured by: situations that it has to cope with, and what counts as coping.
//!
//! skill, drill → starts in random worlds; supervisor → rollouts in parallel → [`Score`].
//!
//! A controller of kind `fall` is for pushes that nothing withstands ([`falling`]). One that takes
//! over from a character on its feet alone, and leaves it standing, is pushed less ([`stepping`]);
//! it is told from its contract: its pre-condition refuses every centre of mass below 0.7 of the
//! standing height. Any other is taken from where the repertoire hands over to it, in heaps on the
//! floor, in falls and, where these are too few, after its own disturbance, to its goal ([`rising`]).

#[cfg(test)]
mod tests;

use std::ops::ControlFlow;

use aplomb_controllers::kinds::fall::FallSpec;
use aplomb_framework::character::Model;
use aplomb_framework::control::{Condition, Contract, Spec, Supervisor};
use aplomb_framework::input::{Error, Result};
use aplomb_framework::run::Simulation;
use rayon::prelude::*;

use crate::exercise::rising::Goal;
use crate::exercise::skill::Skill;
use crate::exercise::starts::{Starts, Wanted, starts};
use crate::exercise::{falling, rising, starts, stepping};
use crate::situations::disturbance::Disturbance;
use crate::situations::disturbed::Disturbed;
use crate::situations::pushes::{Pushes, Site, is_forward};
use crate::situations::{Worlds, disturbance};

/// Lowest centre of mass of whoever is on its feet, relative to the standing height.
const UPRIGHT: f64 = 0.7;
/// Part of the starts that are heaps; the others are falls.
const HEAPS: f64 = 0.5;
/// N·s; weakest and strongest push of a fall, and where they act.
const FALLS: [f64; 2] = [60.0, 300.0];
const EVERYWHERE: &[Site] = &[Site::Trunk, Site::Root, Site::Head];

/// What a controller has to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// Bring a character that is down to a goal.
    Rise(Goal),
    /// Take a push.
    Push,
    /// Come down well after a push.
    Fall,
}

impl Task {
    /// What a skill's kind and contract ask for.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is nothing to measure: a controller that never ends or has always
    /// succeeded, and one that acts only on command and on its feet.
    pub fn of(skill: &Skill) -> Result<Self> {
        if skill.kind() == <FallSpec as Spec>::KIND {
            return Ok(Self::Fall);
        }
        Self::by_contract(&skill.contract, &skill.model)
    }

    fn by_contract(contract: &Contract, model: &Model) -> Result<Self> {
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
    /// Where the pushes of [`Task::Push`] act, in turn.
    pub sites: &'static [Site],
    /// How many.
    pub starts: usize,
    /// They are looked for in so many situations each.
    pub patience: usize,
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
            sites: &[Site::Trunk, Site::Trunk, Site::Root],
            starts,
            patience: 10,
            seed,
        }
    }

    /// What skills are measured with in a single world: weaker pushes, of the trunk alone, and less
    /// patience with what seldom occurs.
    #[must_use]
    pub fn cell(worlds: Worlds, starts: usize, seed: u64) -> Self {
        Self {
            worlds,
            impulse: [40.0, 75.0],
            sites: &[Site::Trunk],
            starts,
            patience: 4,
            seed,
        }
    }

    fn pushes(&self) -> Pushes {
        Pushes {
            impulse: self.impulse,
            sites: self.sites,
            count: self.starts,
            seed: self.seed,
        }
    }
}

/// How well a controller did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Mean over the starts; less is better.
    pub cost: f64,
    /// Starts from which it reached its goal; falls that it broke well.
    pub reached: usize,
}

impl Score {
    /// Of what cannot even be built.
    pub const WORST: Self = Self {
        cost: f64::INFINITY,
        reached: 0,
    };
}

/// With the shipped disturbance of its name, if there is one and it fits the character.
fn wanted(skill: &Skill) -> Wanted<'_> {
    let disturbed = || {
        let source = disturbance::shipped(skill.name()).ok()?;
        let disturbance = Disturbance::parse(&source, &skill.model).ok()?;
        Disturbed::new(disturbance, &skill.model, &skill.supervisor).ok()
    };
    Wanted {
        contract: &skill.contract,
        disturbed: disturbed(),
    }
}

/// A task with its starts.
#[derive(Debug, Clone)]
pub struct Exercise {
    contract: Contract,
    task: Task,
    starts: Starts,
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
        let mut one = Self::all(&[skill], drill, watch)?;
        Ok(one.remove(0))
    }

    /// The exercises of several skills of one repertoire, as [`Self::new`] makes each, in less time.
    /// `watch` sees the starts in heaps and falls, of all together.
    ///
    /// # Errors
    /// As [`Task::of`].
    pub fn all(
        skills: &[&Skill],
        drill: Drill,
        watch: impl FnMut(usize) -> ControlFlow<()>,
    ) -> Result<Vec<Self>> {
        let task = |skill: &&Skill| Task::of(skill);
        let tasks: Vec<Task> = skills.iter().map(task).collect::<Result<_>>()?;
        let rising: Vec<Wanted> = skills
            .iter()
            .zip(&tasks)
            .filter(|(_, task)| matches!(task, Task::Rise(_)))
            .map(|(skill, _)| wanted(skill))
            .collect();
        let risen = match skills.first() {
            Some(Skill {
                model, supervisor, ..
            }) => {
                let source = starts::Source {
                    worlds: drill.worlds,
                    heaps: HEAPS,
                    patience: drill.patience,
                    seed: drill.seed,
                };
                starts(source, drill.starts, model, &rising, supervisor, watch)?
            }
            None => Vec::new(),
        };
        let mut risen = risen.into_iter();
        let one = |(skill, task): (&&Skill, Task)| {
            let pushes = match task {
                Task::Rise(_) => None,
                Task::Push => Some(drill.pushes()),
                Task::Fall => Some(Pushes {
                    impulse: FALLS,
                    sites: EVERYWHERE,
                    ..drill.pushes()
                }),
            };
            let starts = match pushes {
                Some(pushes) => Starts {
                    runs: pushes.begin(&skill.model, &skill.supervisor, drill.worlds)?,
                    own: 0,
                },
                None => risen.next().unwrap_or_default(),
            };
            Ok(Self {
                contract: skill.contract.clone(),
                task,
                starts,
            })
        };
        skills.iter().zip(tasks).map(one).collect()
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
        self.starts.runs.len()
    }

    /// How many of them begin as the controller's own rollouts do, for want of heaps and falls.
    #[must_use]
    pub fn own_starts(&self) -> usize {
        self.starts.own
    }

    /// How well the controller does in a repertoire.
    #[must_use]
    pub fn judge(&self, supervisor: &Supervisor) -> Score {
        let one = |(index, start): (usize, &Simulation)| match self.task {
            Task::Rise(goal) => {
                let rising = rising::rise(start, supervisor, &self.contract, goal);
                (rising.cost(), rising.reached)
            }
            Task::Push => {
                let stepped = stepping::step(start, supervisor);
                (stepped.cost(), stepped.stood)
            }
            Task::Fall => {
                let landing = falling::land(start, supervisor, is_forward(index));
                (landing.cost(), landing.protected)
            }
        };
        // In the order of the starts, so that the number of threads does not change the sum.
        let all: Vec<(f64, bool)> = self.starts.runs.par_iter().enumerate().map(one).collect();
        Score {
            cost: all.iter().map(|(cost, _)| cost).sum::<f64>() / all.len().max(1) as f64,
            reached: all.iter().filter(|(_, reached)| *reached).count(),
        }
    }
}

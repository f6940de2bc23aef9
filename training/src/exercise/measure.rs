//! How well a controller does its task: starts in random worlds, and rollouts from them.
//!
//! skill, drill → [`Task`] → starts; supervisor → rollouts in parallel → [`Score`].

#[cfg(test)]
mod tests;

use std::ops::ControlFlow;
use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Supervisor};
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use rayon::prelude::*;

use crate::exercise::skill::Skill;
use crate::exercise::starts::{StartSource, Starts, Wanted, starts};
use crate::exercise::task::{Blows, Task};
use crate::exercise::{falling, rising, standing, stepping};
use crate::situations::disturbance::Disturbance;
use crate::situations::disturbed::Disturbed;
use crate::situations::pushes::{Pushes, Site, is_forward};
use crate::situations::{Worlds, disturbance};

/// What starts are made for: a task may have pushes for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To search for better numbers.
    Search,
    /// To measure in a single world.
    Measure,
}

/// How starts are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// The worlds.
    pub worlds: Worlds,
    /// What they are for.
    pub purpose: Purpose,
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
            purpose: Purpose::Search,
            starts,
            patience: 10,
            seed,
        }
    }

    /// What skills are measured with in a single world: with less patience with what seldom occurs.
    #[must_use]
    pub fn cell(worlds: Worlds, starts: usize, seed: u64) -> Self {
        Self {
            worlds,
            purpose: Purpose::Measure,
            starts,
            patience: 4,
            seed,
        }
    }

    /// Characters that stand under the skill's repertoire, at the moment at which they are pushed.
    fn pushed(&self, skill: &Skill, impulse: [f64; 2], sites: &[Site]) -> Result<Begun> {
        let pushes = Pushes {
            impulse,
            sites: sites.to_vec(),
            count: self.starts,
            seed: self.seed,
        };
        let runs = pushes.begin(&skill.model, &skill.supervisor, self.worlds)?;
        Ok(Begun::Runs(Starts { runs, own: 0 }))
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

/// With the disturbance that its task declares, if that fits the character.
fn wanted<'a>(skill: &'a Skill, disturbance: Option<&String>) -> Wanted<'a> {
    let disturbed = || {
        let source = disturbance::shipped(disturbance?).ok()?;
        let disturbance = Disturbance::parse(&source, &skill.model).ok()?;
        Disturbed::new(disturbance, &skill.model, &skill.supervisor).ok()
    };
    Wanted {
        contract: &skill.contract,
        disturbed: disturbed(),
    }
}

/// Where rollouts begin.
#[derive(Debug, Clone)]
enum Begun {
    /// From these situations.
    Runs(Starts),
    /// From standing under the controller that is judged, with these pushes.
    Pushes(Vec<standing::StandingPush>),
}

/// A task with its starts.
#[derive(Debug, Clone)]
pub struct Exercise {
    contract: Contract,
    model: Arc<Model>,
    task: Task,
    begun: Begun,
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
        let mut risen = risen(skills, &tasks, drill, watch)?;
        let one = |(place, task): (usize, Task)| {
            let skill = skills[place];
            let begun = match &task {
                Task::Rise { .. } => Begun::Runs(std::mem::take(&mut risen[place])),
                Task::Step { search, measure } => {
                    let Blows { impulse, sites } = match drill.purpose {
                        Purpose::Search => search,
                        Purpose::Measure => measure,
                    };
                    drill.pushed(skill, *impulse, sites)?
                }
                Task::Fall { impulse, sites } => drill.pushed(skill, *impulse, sites)?,
                Task::Stand { forward, backward } => {
                    Begun::Pushes(standing::pushes(*forward, *backward, drill.starts))
                }
            };
            Ok(Self {
                contract: skill.contract.clone(),
                model: Arc::clone(&skill.model),
                task,
                begun,
            })
        };
        tasks.into_iter().enumerate().map(one).collect()
    }

    /// The task.
    #[must_use]
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// How many starts there are: what was asked for, or fewer, down to none, where the repertoire
    /// seldom hands over to the controller.
    #[must_use]
    pub fn starts(&self) -> usize {
        match &self.begun {
            Begun::Runs(starts) => starts.runs.len(),
            Begun::Pushes(pushes) => pushes.len(),
        }
    }

    /// How many of them begin as the controller's own rollouts do, for want of heaps and falls.
    #[must_use]
    pub fn own_starts(&self) -> usize {
        match &self.begun {
            Begun::Runs(starts) => starts.own,
            Begun::Pushes(_) => 0,
        }
    }

    /// How well the controller does in a repertoire.
    #[must_use]
    pub fn judge(&self, supervisor: &Supervisor) -> Score {
        // In the order of the starts, so that the number of threads does not change the sum.
        let all: Vec<(f64, bool)> = match &self.begun {
            Begun::Runs(starts) => {
                let all = starts.runs.par_iter().enumerate();
                all.map(|(i, start)| self.judge_one(i, start, supervisor))
                    .collect()
            }
            Begun::Pushes(pushes) => match supervisor.alone(&self.contract.name) {
                Ok(alone) => {
                    let one = |push: &standing::StandingPush| push.judge(&self.model, &alone);
                    pushes.par_iter().map(one).collect()
                }
                Err(_) => return Score::WORST,
            },
        };
        Score {
            cost: all.iter().map(|(cost, _)| cost).sum::<f64>() / all.len().max(1) as f64,
            reached: all.iter().filter(|(_, reached)| *reached).count(),
        }
    }

    fn judge_one(&self, index: usize, start: &Simulation, supervisor: &Supervisor) -> (f64, bool) {
        match &self.task {
            Task::Rise { goal, .. } => {
                let rising = rising::rise(start, supervisor, &self.contract, *goal);
                (rising.cost(), rising.reached)
            }
            Task::Fall { .. } => {
                let landing = falling::land(start, supervisor, is_forward(index));
                (landing.cost(), landing.protected)
            }
            Task::Step { .. } | Task::Stand { .. } => {
                let stepped = stepping::step(start, supervisor);
                (stepped.cost(), stepped.stood)
            }
        }
    }
}

/// The starts of those that are to rise, each at its place; none of the others. Those that begin in
/// the same heaps and falls are looked for together.
fn risen(
    skills: &[&Skill],
    tasks: &[Task],
    drill: Drill,
    mut watch: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Vec<Starts>> {
    let mut all = vec![Starts::default(); skills.len()];
    let mut groups: Vec<(StartSource, Vec<usize>)> = Vec::new();
    for (place, task) in tasks.iter().enumerate() {
        let Task::Rise { heaps, impulse, .. } = task else {
            continue;
        };
        let source = StartSource {
            worlds: drill.worlds,
            heaps: *heaps,
            impulse: *impulse,
            patience: drill.patience,
            seed: drill.seed,
        };
        match groups.iter_mut().find(|(known, _)| *known == source) {
            Some((_, places)) => places.push(place),
            None => groups.push((source, vec![place])),
        }
    }
    let mut total = 0;
    for (source, places) in groups {
        let of = |place: &usize| match &tasks[*place] {
            Task::Rise { disturbance, .. } => wanted(skills[*place], disturbance.as_ref()),
            _ => wanted(skills[*place], None),
        };
        let wanted: Vec<Wanted> = places.iter().map(of).collect();
        let Skill {
            model, supervisor, ..
        } = skills[places[0]];
        let watch = |found| watch(total + found);
        let found = starts(source, drill.starts, model, &wanted, supervisor, watch)?;
        total += found.iter().map(|s| s.runs.len()).sum::<usize>();
        for (place, starts) in places.iter().zip(found) {
            all[*place] = starts;
        }
    }
    Ok(all)
}

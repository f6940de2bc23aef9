//! Searches for better numbers of a controller of a repertoire.
//!
//! skill → exercise, dimensions → CMA-ES, scores through the journal → controller file.
//!
//! The output is written at every improvement, the journal after every generation, so that a search
//! that is ended in any way has lost one generation at most and can be gone on with: it then finds
//! what it would have found.

#[cfg(test)]
mod tests;

use std::ops::ControlFlow;
use std::path::Path;

use aplomb_controllers::kinds::balance::BalanceSpec;
use aplomb_controllers::kinds::fall::FallSpec;
use aplomb_controllers::kinds::pose::PoseSpec;
use aplomb_controllers::kinds::stance::StanceSpec;
use aplomb_controllers::kinds::step::StepSpec;
use aplomb_framework::control::{ControllerFile, Spec};
use aplomb_framework::input::{Error, Result, Source, write_atomically};

use crate::exercise::skill::Skill;
use crate::exercise::{Drill, Exercise, Score, Task};
use crate::search::cma_es::{Best, Search, minimise, population};
use crate::search::journal::{Journal, beside};
use crate::search::tune::{Tunable, at, line_of, point_of, spec_of, text_of};

/// The kinds of controllers that can be searched.
pub const KINDS: [&str; 5] = [
    <PoseSpec as Spec>::KIND,
    <StepSpec as Spec>::KIND,
    <FallSpec as Spec>::KIND,
    <BalanceSpec as Spec>::KIND,
    <StanceSpec as Spec>::KIND,
];

/// How to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchPlan<'a> {
    /// Ends with the generation that reaches this many evaluations.
    pub evaluations: usize,
    /// Starts of the exercise.
    pub starts: usize,
    /// Fixes everything random.
    pub seed: u64,
    /// Initial standard deviation, relative to the numbers' ranges.
    pub sigma: f64,
    /// Where the best controller is written.
    pub out: &'a Path,
    /// Goes on with the journal beside the output instead of beginning anew.
    pub resume: bool,
}

/// What a search has found so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundNumbers {
    /// Evaluations so far.
    pub evaluations: usize,
    /// Starts of the exercise: what was asked for, or fewer.
    pub starts: usize,
    /// How the controller did with the numbers of its file.
    pub start: Score,
    /// How the best did.
    pub best: Score,
}

/// What a search is at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SearchStage {
    /// It has made so many starts.
    Gathering(usize),
    /// It has finished the first evaluation or a generation.
    Searching(FoundNumbers),
}

/// Searches from the numbers of the skill's file. `watch` may end it at any stage. None if it was
/// ended before the first evaluation.
///
/// # Errors
/// A controller of another kind or without a task; an output that cannot be written; on resuming a
/// journal that is missing or of another search.
pub fn improve(
    skill: &Skill,
    plan: SearchPlan<'_>,
    watch: impl FnMut(SearchStage) -> ControlFlow<()>,
) -> Result<Option<FoundNumbers>> {
    check(skill)?;
    match skill.kind() {
        PoseSpec::KIND => search::<PoseSpec>(skill, plan, watch),
        StepSpec::KIND => search::<StepSpec>(skill, plan, watch),
        FallSpec::KIND => search::<FallSpec>(skill, plan, watch),
        BalanceSpec::KIND => search::<BalanceSpec>(skill, plan, watch),
        _ => search::<StanceSpec>(skill, plan, watch),
    }
}

/// Refuses a controller that cannot be searched.
///
/// # Errors
/// [`Error::Invalid`] with what is accepted.
pub fn check(skill: &Skill) -> Result<()> {
    if !KINDS.contains(&skill.kind()) {
        let (problem, accepted) = (skill.kind(), KINDS.join(", "));
        return Err(Error::invalid(skill.name(), "kind", problem, accepted));
    }
    Task::of(skill).map(|_| ())
}

fn search<T: Tunable>(
    skill: &Skill,
    plan: SearchPlan<'_>,
    mut watch: impl FnMut(SearchStage) -> ControlFlow<()>,
) -> Result<Option<FoundNumbers>> {
    let (model, contract) = (&skill.model, &skill.contract);
    let file = skill.file.parameters::<T>()?;
    let task = Task::of(skill)?;
    let search = Search {
        sigma: plan.sigma,
        population: population(file.dimensions(model).len()),
        evaluations: plan.evaluations,
        seed: plan.seed,
    };
    let (journal, base) = open(skill, &task, file, plan, search)?;
    let supervisor = skill
        .supervisor
        .with_replaced(base.clone().build(contract.clone(), model)?)?;
    let skill = Skill {
        supervisor,
        ..skill.clone()
    };
    let mut ended = false;
    let exercise = Exercise::new(&skill, Drill::training(plan.starts, plan.seed), |found| {
        let next = watch(SearchStage::Gathering(found));
        ended = next.is_break();
        next
    })?;
    if ended {
        return Ok(None);
    }
    if exercise.starts() == 0 {
        let problem = "met in none of the situations that were tried";
        let accepted = "one that heaps on the floor or falls come to under the repertoire";
        return Err(Error::invalid(
            skill.name(),
            "precondition",
            problem,
            accepted,
        ));
    }
    let measure = |point: &[f64]| {
        let built = Spec::build(at(&base, model, point), contract.clone(), model);
        let supervisor = built.and_then(|controller| skill.supervisor.with_replaced(controller));
        supervisor.map_or(Score::WORST, |supervisor| exercise.judge(&supervisor))
    };
    let start = point_of(&base, model);
    let first = measure(&start);
    if journal.known(&start).is_some_and(|known| known != first) {
        let place = beside(plan.out).display().to_string();
        let accepted =
            "one of this version of the program: its first controller now does otherwise";
        return Err(Error::invalid(
            place,
            "journal",
            "of another version",
            accepted,
        ));
    }
    journal.score(&start, || first);
    let (mut found, mut written) = (None, Ok(()));
    let mut least = f64::INFINITY;
    let cost = |point: &[f64]| journal.score(point, || measure(point)).cost;
    minimise(&start, search, cost, |evaluations, best: &Best| {
        written = journal.finish_generation();
        let so_far = FoundNumbers {
            evaluations,
            starts: exercise.starts(),
            start: first,
            best: journal.known(&best.point).unwrap_or(first),
        };
        found = Some(so_far);
        if written.is_ok() && best.cost < least {
            least = best.cost;
            let spec = at(&base, model, &best.point);
            let text = text_of(
                &skill.file.contract,
                Some(&task),
                &spec,
                &comment(&task, &plan, &so_far),
            );
            written = write_atomically(plan.out, text.as_bytes());
        }
        if written.is_err() {
            return ControlFlow::Break(());
        }
        watch(SearchStage::Searching(so_far))
    });
    written.map(|()| found)
}

/// The journal, new or gone on with, and the numbers that the search begins with.
fn open<T: Tunable>(
    skill: &Skill,
    task: &Task,
    file: T,
    plan: SearchPlan<'_>,
    search: Search,
) -> Result<(Journal, T)> {
    let header = vec![
        ("controller", skill.name().to_owned()),
        ("seed", plan.seed.to_string()),
        ("starts", plan.starts.to_string()),
        ("sigma", plan.sigma.to_string()),
        ("population", search.population.to_string()),
        ("surroundings", format!("{:016x}", skill.surroundings)),
    ];
    let path = beside(plan.out);
    let now = line_of(&skill.file.contract, Some(task), &file);
    if !plan.resume {
        return Ok((Journal::begin(&path, &header, &now)?, file));
    }
    let (journal, before) = Journal::resume(&path, &header)?;
    if before == now {
        return Ok((journal, file));
    }
    // The output may well be the controller's own file, which by now has better numbers.
    let written = Source::read(plan.out).and_then(|source| line_in::<T>(&source, task));
    if written.is_ok_and(|written| written == now) {
        let source = Source::new(path.display().to_string(), before);
        return Ok((journal, ControllerFile::parse(source)?.parameters()?));
    }
    let accepted = "the controller as it was when the search began";
    let place = path.display().to_string();
    Err(Error::invalid(place, "controller", "another", accepted))
}

fn line_in<T: Tunable>(source: &Source, task: &Task) -> Result<String> {
    let (contract, spec) = spec_of::<T>(source)?;
    Ok(line_of(&contract, Some(task), &spec))
}

/// Written over the controller.
fn comment(task: &Task, plan: &SearchPlan<'_>, found: &FoundNumbers) -> String {
    format!(
        "Optimised by CMA-ES over {}, seed {}, {} evaluations.",
        task.starts_in_words(found.starts),
        plan.seed,
        found.evaluations,
    )
}

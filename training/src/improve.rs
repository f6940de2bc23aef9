//! Searches for better numbers of a controller of a repertoire.
//!
//! skill → exercise, dimensions → CMA-ES, scores through the journal → controller file.
//!
//! The output is written at every improvement, the journal after every generation, so that a search
//! that is ended in any way has lost one generation at most and can be gone on with: it then finds
//! what it would have found.

use std::ops::ControlFlow;
use std::path::Path;

use aplomb_controllers::pose::PoseSpec;
use aplomb_controllers::step::StepSpec;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::registry::{ControllerFile, Spec};
use aplomb_framework::{Error, Result};

use crate::cma_es::{Best, Search, minimise};
use crate::exercise::{Drill, Exercise, Score, Task};
use crate::journal::{Journal, beside};
use crate::skill::Skill;
use crate::tune::{Tunable, at, line_of, point_of, spec_in, text_of};

/// The kinds of controllers that can be searched.
pub const KINDS: [&str; 2] = [<PoseSpec as Tunable>::KIND, <StepSpec as Tunable>::KIND];

/// How to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan<'a> {
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
pub struct Found {
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
pub enum Stage {
    /// It has made so many starts.
    Gathering(usize),
    /// It has finished the first evaluation or a generation.
    Searching(Found),
}

/// Searches from the numbers of the skill's file. `watch` may end it at any stage. None if it was
/// ended before the first evaluation.
///
/// # Errors
/// A controller of another kind or without a task; an output that cannot be written; on resuming a
/// journal that is missing or of another search.
pub fn improve(
    skill: &Skill,
    plan: Plan<'_>,
    watch: impl FnMut(Stage) -> ControlFlow<()>,
) -> Result<Option<Found>> {
    check(skill)?;
    if skill.kind() == <PoseSpec as Tunable>::KIND {
        search::<PoseSpec>(skill, plan, watch)
    } else {
        search::<StepSpec>(skill, plan, watch)
    }
}

/// Refuses a controller that cannot be searched.
///
/// # Errors
/// [`Error::Invalid`] with what is accepted.
pub fn check(skill: &Skill) -> Result<()> {
    if !KINDS.contains(&skill.kind()) {
        let accepted = format!("a controller of kind {}", KINDS.join(" or "));
        let problem = skill.kind();
        return Err(Error::invalid(skill.name(), "kind", problem, accepted));
    }
    Task::of(&skill.contract, &skill.model).map(|_| ())
}

fn search<T: Tunable + Spec>(
    skill: &Skill,
    plan: Plan<'_>,
    mut watch: impl FnMut(Stage) -> ControlFlow<()>,
) -> Result<Option<Found>> {
    let (model, contract) = (&skill.model, &skill.contract);
    let file = spec_in::<T>(skill.name(), &skill.file)?;
    let search = Search {
        sigma: plan.sigma,
        population: population(file.dimensions(model).len()),
        evaluations: plan.evaluations,
        seed: plan.seed,
    };
    let (journal, base) = open(skill, file, plan, search)?;
    let mind = skill
        .mind
        .with_replaced(base.clone().build(contract.clone(), model)?)?;
    let skill = Skill {
        mind,
        ..skill.clone()
    };
    let mut ended = false;
    let exercise = Exercise::new(&skill, Drill::training(plan.starts, plan.seed), |found| {
        let next = watch(Stage::Gathering(found));
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
        let mind = built.and_then(|controller| skill.mind.with_replaced(controller));
        mind.map_or(Score::WORST, |mind| exercise.judge(&mind))
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
        let so_far = Found {
            evaluations,
            starts: exercise.starts(),
            start: first,
            best: journal.known(&best.point).unwrap_or(first),
        };
        found = Some(so_far);
        if written.is_ok() && best.cost < least {
            least = best.cost;
            let spec = at(&base, model, &best.point);
            let text = text_of(&skill.file.contract, &spec, &comment(&plan, &so_far));
            written = write_atomically(plan.out, text.as_bytes());
        }
        if written.is_err() {
            return ControlFlow::Break(());
        }
        watch(Stage::Searching(so_far))
    });
    written.map(|()| found)
}

/// The journal, new or gone on with, and the numbers that the search begins with.
fn open<T: Tunable>(
    skill: &Skill,
    file: T,
    plan: Plan<'_>,
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
    let now = line_of(&skill.file.contract, &file);
    if !plan.resume {
        return Ok((Journal::begin(&path, &header, &now)?, file));
    }
    let (journal, before) = Journal::resume(&path, &header)?;
    if before == now {
        return Ok((journal, file));
    }
    // The output may well be the controller's own file, which by now has better numbers.
    let written = Source::read(plan.out).and_then(|source| line_in::<T>(&source));
    if written.is_ok_and(|written| written == now) {
        let source = Source::new(path.display().to_string(), before);
        let first: ControllerFile = source.parse()?;
        return Ok((journal, spec_in(&source.origin, &first)?));
    }
    let accepted = "the controller as it was when the search began";
    let place = path.display().to_string();
    Err(Error::invalid(place, "controller", "another", accepted))
}

fn line_in<T: Tunable>(source: &Source) -> Result<String> {
    let file: ControllerFile = source.parse()?;
    let spec = spec_in::<T>(&source.origin, &file)?;
    Ok(line_of(&file.contract, &spec))
}

/// Candidates a generation: Hansen's 4 + 3 ln n, made even.
fn population(dimensions: usize) -> usize {
    let usual = 4 + (3.0 * (dimensions.max(1) as f64).ln()) as usize;
    usual.next_multiple_of(2)
}

/// Written over the controller.
fn comment(plan: &Plan<'_>, found: &Found) -> String {
    format!(
        "Optimised by CMA-ES over {} starts in varied worlds, seed {}, {} evaluations: {} reached, cost {:.4}.",
        found.starts, plan.seed, found.evaluations, found.best.reached, found.best.cost
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skill::tests::{TUCK, skills};

    fn plan(out: &Path, evaluations: usize, resume: bool) -> Plan<'_> {
        Plan {
            evaluations,
            starts: 2,
            seed: 3,
            sigma: 0.2,
            out,
            resume,
        }
    }

    fn tuck(plan: Plan<'_>) -> Result<Option<Found>> {
        let (_folder, skills) = skills(TUCK);
        let skill = Skill::find(&skills, "tuck").unwrap();
        improve(skill, plan, |_| ControlFlow::Continue(()))
    }

    #[test]
    fn a_search_that_was_ended_goes_on_to_the_same_file() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("tuck.ron");
        let journal = beside(&out);
        let read = || {
            (
                std::fs::read(&out).unwrap(),
                std::fs::read(&journal).unwrap(),
            )
        };
        let whole = tuck(plan(&out, 18, false)).unwrap().unwrap();
        let files = read();
        assert_eq!(whole.evaluations, 25);
        assert!(whole.best.cost < whole.start.cost, "{whole:?}");
        let text = String::from_utf8(files.0.clone()).unwrap();
        let header = "// Optimised by CMA-ES over 2 starts in varied worlds, seed 3, ";
        assert!(text.starts_with(header), "{text}");
        // Ended in the middle of the second generation, before the output was written.
        let lines: Vec<usize> = files
            .1
            .iter()
            .enumerate()
            .filter(|(_, b)| **b == b'\n')
            .map(|(i, _)| i)
            .collect();
        assert_eq!(lines.len(), 6);
        std::fs::write(&journal, &files.1[..lines[3] + 20]).unwrap();
        std::fs::remove_file(&out).unwrap();
        assert_eq!(tuck(plan(&out, 18, true)).unwrap().unwrap(), whole);
        assert_eq!(read(), files);
        // Nothing is left to do; and a longer search is the same up to there.
        assert_eq!(tuck(plan(&out, 18, true)).unwrap().unwrap(), whole);
        assert_eq!(read(), files);
        tuck(plan(&out, 26, true)).unwrap();
        assert!(read().1.starts_with(&files.1) && read().1.len() > files.1.len());
        let other = Plan {
            sigma: 0.1,
            ..plan(&out, 18, true)
        };
        let told = tuck(other).unwrap_err().to_string();
        assert!(told.contains("sigma is 0.2; accepted: 0.1"), "{told}");
    }

    #[test]
    fn the_output_may_be_the_controllers_own_file() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("tuck.ron");
        tuck(plan(&out, 1, false)).unwrap();
        let repertoire = folder.path().join("repertoire.ron");
        let text = r#"(name: "x", fallback: "rest", controllers: [File("tuck.ron"), File("skills/rest.ron")])"#;
        std::fs::write(&repertoire, text).unwrap();
        let model = aplomb_framework::model::Model::load("humanoid").unwrap();
        let registry = aplomb_controllers::registry();
        let search = |evaluations, resume| {
            let all = Skill::all(repertoire.to_str().unwrap(), &registry, &model).unwrap();
            let watch = |_| ControlFlow::Continue(());
            improve(&all[0], plan(&out, evaluations, resume), watch)
        };
        let first = search(9, false).unwrap().unwrap();
        let again = search(9, true).unwrap().unwrap();
        assert_eq!(first, again);
        // Somebody else's change of it is noticed.
        let text = std::fs::read_to_string(&out).unwrap();
        std::fs::write(&out, text.replace("patience: 1", "patience: 2")).unwrap();
        let all = Skill::all(repertoire.to_str().unwrap(), &registry, &model).unwrap();
        let elsewhere = folder.path().join("else.ron");
        std::fs::copy(beside(&out), beside(&elsewhere)).unwrap();
        let told = improve(&all[0], plan(&elsewhere, 9, true), |_| {
            ControlFlow::Continue(())
        });
        let told = told.unwrap_err().to_string();
        assert!(told.contains("controller is another; accepted: "), "{told}");
    }

    #[test]
    fn starts_that_never_come_are_said_so() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("x.ron");
        let (_folder, skills) = skills(TUCK);
        let skill = Skill::find(&skills, "never").unwrap();
        let ended = improve(skill, plan(&out, 1, false), |_| ControlFlow::Break(()));
        assert_eq!(ended.unwrap(), None);
        let told = improve(skill, plan(&out, 1, false), |_| ControlFlow::Continue(()));
        let told = told.unwrap_err().to_string();
        assert!(
            told.contains("never: precondition is met in none"),
            "{told}"
        );
    }

    #[test]
    fn what_cannot_be_searched_is_refused_before_anything_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("x.ron");
        let (_folder, skills) = skills(TUCK);
        let rest = Skill::find(&skills, "rest").unwrap();
        let told = improve(rest, plan(&out, 1, false), |_| ControlFlow::Continue(()));
        let told = told.unwrap_err().to_string();
        assert_eq!(
            told,
            "rest: kind is rest; accepted: a controller of kind pose or step"
        );
        assert!(!beside(&out).exists());
    }
}

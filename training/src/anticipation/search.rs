//! CMA-ES for the trajectory of a clip (2017 paper, section 4.1).
//!
//! clip, encoding → candidates → objective → [`FoundTrajectory`]: the best trajectory, the course of the search.
//! A journal keeps the scores of finished generations, so that a search that was ended in any way goes
//! on to what it would have found.

use std::ops::ControlFlow;
use std::path::Path;

use aplomb_controllers::kinds::cmrt::Cmrt;
use aplomb_framework::input::{Error, Result};
use xxhash_rust::xxh3::xxh3_64;

use crate::anticipation::clip::Clip;
use crate::anticipation::encoding::Encoding;
use crate::anticipation::objective::{ENOUGH, averaged, successes};
use crate::exercise::Score;
use crate::search::cma_es::{Best, Search, minimise, population};
use crate::search::journal::Journal;

/// Initial standard deviation in the unit cube.
const SIGMA: f64 = 0.2;
/// Evaluations before slow convergence ends a search.
const LEAST: usize = 700;
/// Evaluations over which it is judged,
const WINDOW: usize = 100;
/// and the least improvement in them, part of the objective.
const IMPROVEMENT: f64 = 0.05;
/// So many of the last improvements are tried from perturbed starts in the end.
const TRIED: usize = 16;
/// Added to the seed for their starts, which are not those that the result is judged by.
const OTHER_STARTS: u64 = 0x5eed;
/// What an invalid candidate costs.
const INVALID: f64 = 1e3;

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryPlan {
    /// How points stand for trajectories.
    pub encoding: Encoding,
    /// Ends with the generation that reaches this many evaluations.
    pub evaluations: usize,
    /// Evaluations before slow convergence may end it; [`TrajectoryPlan::least`] by default.
    pub least: usize,
    /// Ends when the objective is below this.
    pub threshold: f64,
    /// Perturbed starts that the objective is averaged over, beside the clip's own.
    pub starts: usize,
    /// Fixes the candidates.
    pub seed: u64,
    /// Where to begin; the flat trajectory or the basis' mean if none.
    pub start: Option<Cmrt>,
}

impl TrajectoryPlan {
    /// Evaluations before slow convergence may end a search, as in the paper.
    #[must_use]
    pub fn least() -> usize {
        LEAST
    }
}

/// Where the scores are kept.
#[derive(Debug, Clone, Copy)]
pub struct Keep<'a> {
    /// The journal's file.
    pub journal: &'a Path,
    /// Goes on with it instead of beginning anew.
    pub resume: bool,
}

/// What a search has found so far.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundTrajectory {
    /// Evaluations so far.
    pub evaluations: usize,
    /// The objective without a trajectory, averaged as that of the search.
    pub flat: f64,
    /// The objective of the trajectory.
    pub objective: f64,
    /// While it is searched the best so far; in the end, of the last improvements, the best that
    /// succeeds from enough perturbed starts, or else the one that succeeds from the most.
    pub cmrt: Cmrt,
    /// (evaluations, best objective) after each generation.
    pub course: Vec<(usize, f64)>,
}

/// Searches for the trajectory of least objective. `watch` sees the best after each generation and may
/// end the search.
///
/// # Errors
/// What makes the clip invalid with its first trajectory; a journal that cannot be written, or that is
/// of another search.
pub fn search(
    clip: &Clip,
    plan: &TrajectoryPlan,
    keep: Keep<'_>,
    mut watch: impl FnMut(&FoundTrajectory) -> ControlFlow<()>,
) -> Result<FoundTrajectory> {
    let middle = || vec![0.5; plan.encoding.dimensions()];
    let known = plan.start.as_ref().and_then(|c| plan.encoding.point(c));
    let start = known.unwrap_or_else(middle);
    let first = plan.encoding.trajectory(&start);
    let seed = plan.seed.wrapping_add(OTHER_STARTS);
    let objective = |cmrt: &Cmrt| averaged(clip, Some(cmrt), plan.starts, seed);
    let flat = averaged(clip, None, plan.starts, seed)?.objective;
    let journal = open(clip, plan, keep, &first)?;
    let measure = |point: &[f64]| {
        let evaluation = objective(&plan.encoding.trajectory(point));
        Score {
            cost: evaluation.as_ref().map_or(INVALID, |e| e.objective),
            reached: usize::from(evaluation.is_ok_and(|e| e.succeeds)),
        }
    };
    let cost = |point: &[f64]| journal.score(point, || measure(point)).cost;
    let mut written = Ok(());
    let mut improvements: Vec<(f64, Cmrt)> = Vec::new();
    let search = Search {
        sigma: SIGMA,
        population: population(start.len()),
        evaluations: plan.evaluations,
        seed: plan.seed,
    };
    let mut found = FoundTrajectory {
        evaluations: 0,
        flat,
        objective: f64::INFINITY,
        cmrt: first,
        course: Vec::new(),
    };
    minimise(&start, search, cost, |evaluations, best: &Best| {
        found.evaluations = evaluations;
        found.objective = best.cost;
        found.cmrt = plan.encoding.trajectory(&best.point);
        found.course.push((evaluations, best.cost));
        if improvements.last().is_none_or(|(o, _)| best.cost < *o) {
            improvements.push((best.cost, found.cmrt.clone()));
        }
        written = journal.finish_generation();
        if written.is_err() || watch(&found).is_break() || best.cost <= plan.threshold {
            return ControlFlow::Break(());
        }
        if evaluations >= plan.least && is_slow(&found.course) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    written?;
    // A trajectory at the edge of falling may have the least objective of all.
    let mut most = None;
    for (objective, cmrt) in improvements.into_iter().rev().take(TRIED) {
        let count = successes(clip, Some(&cmrt), seed)?;
        if most.is_none_or(|m| count > m) {
            most = Some(count);
            (found.objective, found.cmrt) = (objective, cmrt);
        }
        if count >= ENOUGH {
            break;
        }
    }
    Ok(found)
}

/// The journal of this search: of this clip, its parameters, the encoding and the seed.
fn open(clip: &Clip, plan: &TrajectoryPlan, keep: Keep<'_>, first: &Cmrt) -> Result<Journal> {
    let hashed = |text: String| format!("{:016x}", xxh3_64(text.as_bytes()));
    let header = vec![
        ("clip", hashed(format!("{:?}", clip.scenario))),
        ("surroundings", format!("{:016x}", clip.skill.surroundings)),
        ("encoding", hashed(format!("{:?}", plan.encoding))),
        ("starts", plan.starts.to_string()),
        ("seed", plan.seed.to_string()),
    ];
    let line = clip.line(first);
    if !keep.resume {
        return Journal::begin(keep.journal, &header, &line);
    }
    let (journal, before) = Journal::resume(keep.journal, &header)?;
    if before != line {
        let place = keep.journal.display().to_string();
        let accepted = "the clip's controller as it was when the search began";
        return Err(Error::invalid(place, "controller", "another", accepted));
    }
    Ok(journal)
}

/// Whether the last [`WINDOW`] evaluations brought less than [`IMPROVEMENT`].
fn is_slow(course: &[(usize, f64)]) -> bool {
    let Some((evaluations, now)) = course.last() else {
        return false;
    };
    let before = course
        .iter()
        .rev()
        .find(|(e, _)| e + WINDOW <= *evaluations);
    before.is_some_and(|(_, then)| *now > (1.0 - IMPROVEMENT) * then)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_is_slow_when_a_window_brings_little() {
        let course = |last: f64| vec![(1, 9.0), (601, 2.0), (701, 2.0 - 1e-3), (801, last)];
        assert!(is_slow(&course(1.95)));
        assert!(!is_slow(&course(1.8)));
        assert!(!is_slow(&[(50, 1.0)]));
        assert!(!is_slow(&[]));
    }
}

//! Which kernel, C and γ: by cross-validation on the training set alone.
//!
//! standardised rows, labels → held-out scores of candidates → [`Choice`].
//!
//! From coarse to fine: each kernel at C = 1 and 10 and γ = 1 / features, the linear one at C = 0.3,
//! then steps along the grid from each kernel's best while that improves it. Kernels far behind are
//! left where they are: large C takes by far the longest where a kernel does not fit.
//!
//! Machines are trained by libsvm-rs, which finds the same optimum as linfa-svm five to ten times as
//! fast; 3,000 samples of 20 features take some 35 s of processor time. Candidates are measured in parallel; the same seed gives the same choice whatever the number
//! of threads.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use aplomb_framework::{Error, Result};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::libsvm_solver;
use super::machine::{Kernel, Settings, checked, prices};
use super::metrics::metrics;

/// So many parts; each is held out once.
pub const FOLDS: usize = 4;
/// Only the first so many samples of the training set take part, so that the time is bounded.
pub const MOST_SAMPLES: usize = 3_000;
/// A polynomial is preferred to a radial kernel that is better by less: it is evaluated exactly at a
/// cost that does not grow with the number of support vectors.
pub const PREFERENCE: f64 = 0.002;

/// Prices of a violated margin that are tried.
const COSTS: [f64; 6] = [0.3, 1.0, 3.0, 10.0, 30.0, 100.0];
/// Coefficients of the kernel that are tried, times the number of features.
const GAMMAS: [f64; 3] = [0.3, 1.0, 3.0];
/// Where the linear kernel begins, and every other: places in [`GAMMAS`] and [`COSTS`].
const LINEAR_STARTS: [(usize, usize); 1] = [(1, 0)];
/// See [`LINEAR_STARTS`].
const STARTS: [(usize, usize); 2] = [(1, 1), (1, 3)];
/// A kernel whose best is worse than the best of all by more is not followed further.
const FAR: f64 = 0.03;
/// Tolerance of the optimality conditions, in units of the score: ten times that of the final
/// training, which moves few scores across 0 and saves most of the time at large C.
const TOLERANCE: f64 = 1e-2;
/// Candidates that are measured before the watch is told.
const BATCH: usize = 4;

/// The best settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Kernel, C and γ.
    pub settings: Settings,
    /// Balanced accuracy over all held-out samples.
    pub balanced_accuracy: f64,
    /// Score of every sample that took part, by a machine that was not trained on it.
    pub scores: Vec<f64>,
}

/// A place of the grid: of the kernel among those allowed, in [`GAMMAS`] and in [`COSTS`].
type Place = (usize, usize, usize);

/// Chooses among the kernels' candidates by balanced accuracy over all held-out samples; of equal
/// ones the earlier in the grid: the earlier kernel, then the smaller γ and C. `watch` sees how many
/// candidates are measured of how many that are planned so far and may end the work, which then has
/// no result.
///
/// # Errors
/// [`Error::Invalid`] if the samples that take part are not finite or lack two of a class, or there
/// are no kernels.
pub fn choose(
    rows: &[Vec<f64>],
    labels: &[bool],
    kernels: &[Kernel],
    seed: u64,
    mut watch: impl FnMut(usize, usize) -> ControlFlow<()>,
) -> Result<Option<Choice>> {
    let count = rows.len().min(labels.len()).min(MOST_SAMPLES);
    let (rows, labels) = (&rows[..count], &labels[..count]);
    if kernels.is_empty() {
        let accepted = "at least one of linear, poly2, poly3, rbf";
        return Err(Error::invalid("settings", "kernels", "none", accepted));
    }
    let width = rows.first().map_or(1, Vec::len).max(1);
    let settings = |(kernel, gamma, c): Place| Settings {
        kernel: kernels[kernel],
        c: COSTS[c],
        gamma: match kernels[kernel] {
            Kernel::Linear => 1.0,
            _ => GAMMAS[gamma] / width as f64,
        },
    };
    checked(rows, labels, &settings((0, 0, 0)))?;
    let folds = folds(labels, seed);
    let mut measured: BTreeMap<Place, Choice> = BTreeMap::new();
    let mut planned: Vec<Place> = (0..kernels.len())
        .flat_map(|kernel| {
            let starts: &[(usize, usize)] = match kernels[kernel] {
                Kernel::Linear => &LINEAR_STARTS,
                _ => &STARTS,
            };
            starts.iter().map(move |(gamma, c)| (kernel, *gamma, *c))
        })
        .collect();
    while !planned.is_empty() {
        let total = measured.len() + planned.len();
        for batch in planned.chunks(BATCH) {
            let candidates: Vec<Settings> = batch.iter().map(|place| settings(*place)).collect();
            let found = measure(&candidates, rows, labels, &folds);
            measured.extend(batch.iter().copied().zip(found));
            if watch(measured.len(), total).is_break() {
                return Ok(None);
            }
        }
        planned = next(&measured, kernels);
    }
    Ok(best(measured.values()).cloned())
}

/// The greatest price that is tried with a kernel, as a place in [`COSTS`]: where the linear kernel does not fit, large
/// prices take the solver minutes and win nothing.
fn dearest(kernel: Kernel) -> usize {
    match kernel {
        Kernel::Linear => 2,
        _ => COSTS.len() - 1,
    }
}

/// The neighbours, not yet measured, of the best place of every kernel that is not far behind.
fn next(measured: &BTreeMap<Place, Choice>, kernels: &[Kernel]) -> Vec<Place> {
    let top = top(measured.values(), |_| true).map_or(0.0, |c| c.balanced_accuracy);
    let mut planned = Vec::new();
    for (index, kernel) in kernels.iter().enumerate() {
        let of_kernel = measured.iter().filter(|(place, _)| place.0 == index);
        let better = |a: &Choice, b: &Choice| b.balanced_accuracy > a.balanced_accuracy;
        let best = of_kernel.reduce(|a, b| if better(a.1, b.1) { b } else { a });
        let Some(((_, gamma, c), choice)) = best else {
            continue;
        };
        if choice.balanced_accuracy < top - FAR {
            continue;
        }
        let mut around = vec![(*gamma, c.wrapping_sub(1)), (*gamma, c + 1)];
        if *kernel != Kernel::Linear {
            around.extend([(gamma.wrapping_sub(1), *c), (gamma + 1, *c)]);
        }
        let places = around.into_iter().map(|(gamma, c)| (index, gamma, c));
        planned.extend(places.filter(|place| {
            place.1 < GAMMAS.len() && place.2 <= dearest(*kernel) && !measured.contains_key(place)
        }));
    }
    planned
}

/// The fold of every sample: as many successes in each, and as many failures, but for one.
fn folds(labels: &[bool], seed: u64) -> Vec<usize> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut folds = vec![0; labels.len()];
    for class in [true, false] {
        let mut members: Vec<usize> = (0..labels.len()).filter(|i| labels[*i] == class).collect();
        members.shuffle(&mut rng);
        for (place, sample) in members.into_iter().enumerate() {
            folds[sample] = place % FOLDS;
        }
    }
    folds
}

/// Held-out scores of some candidates, every fold of each in parallel.
fn measure(
    candidates: &[Settings],
    rows: &[Vec<f64>],
    labels: &[bool],
    folds: &[usize],
) -> Vec<Choice> {
    let pairs: Vec<(usize, usize)> = (0..candidates.len())
        .flat_map(|candidate| (0..FOLDS).map(move |fold| (candidate, fold)))
        .collect();
    let held_out: Vec<Vec<(usize, f64)>> = pairs
        .par_iter()
        .map(|(candidate, fold)| scores(&candidates[*candidate], rows, labels, folds, *fold))
        .collect();
    let of_candidate = held_out.chunks(FOLDS).zip(candidates);
    of_candidate
        .map(|(parts, settings)| {
            let mut scores = vec![0.0; rows.len()];
            for (sample, score) in parts.iter().flatten() {
                scores[*sample] = *score;
            }
            let predicted: Vec<bool> = scores.iter().map(|s| *s >= 0.0).collect();
            Choice {
                settings: *settings,
                balanced_accuracy: metrics(&predicted, labels).balanced_accuracy,
                scores,
            }
        })
        .collect()
}

/// Scores of a fold's samples by a machine trained on the others.
fn scores(
    settings: &Settings,
    rows: &[Vec<f64>],
    labels: &[bool],
    folds: &[usize],
    fold: usize,
) -> Vec<(usize, f64)> {
    let (held_out, kept): (Vec<usize>, Vec<usize>) =
        (0..rows.len()).partition(|i| folds[*i] == fold);
    let kept_rows: Vec<Vec<f64>> = kept.iter().map(|i| rows[*i].clone()).collect();
    let kept_labels: Vec<bool> = kept.iter().map(|i| labels[*i]).collect();
    let successes = kept_labels.iter().filter(|s| **s).count();
    let prices = prices(settings.c, (successes, kept.len() - successes));
    let machine = libsvm_solver::solve(&kept_rows, &kept_labels, settings, prices, TOLERANCE);
    let score = |i: usize| (i, machine.score(&rows[i]));
    held_out.into_iter().map(score).collect()
}

/// The best, or the best polynomial if only a radial kernel is better, and that by little.
fn best<'a>(measured: impl Iterator<Item = &'a Choice> + Clone) -> Option<&'a Choice> {
    let best = top(measured.clone(), |_| true)?;
    let polynomial = top(measured, |kernel| kernel != Kernel::Rbf);
    let near = |p: &&Choice| p.balanced_accuracy >= best.balanced_accuracy - PREFERENCE;
    Some(polynomial.filter(near).unwrap_or(best))
}

/// The first of the best among the allowed kernels.
fn top<'a>(
    measured: impl Iterator<Item = &'a Choice>,
    allowed: impl Fn(Kernel) -> bool,
) -> Option<&'a Choice> {
    let better = |a: &Choice, b: &Choice| b.balanced_accuracy > a.balanced_accuracy;
    let of = measured.filter(|c| allowed(c.settings.kernel));
    of.reduce(|a, b| if better(a, b) { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learning::synthetic::rings;

    fn candidate(kernel: Kernel, c: f64, balanced_accuracy: f64) -> Choice {
        Choice {
            settings: Settings {
                kernel,
                c,
                gamma: 1.0,
            },
            balanced_accuracy,
            scores: Vec::new(),
        }
    }

    #[test]
    fn folds_are_stratified_and_follow_from_the_seed() {
        let labels: Vec<bool> = (0..103).map(|i| i % 5 == 0).collect();
        let parts = folds(&labels, 3);
        assert_eq!(parts, folds(&labels, 3));
        assert_ne!(parts, folds(&labels, 4));
        for fold in 0..FOLDS {
            let count = |class: bool| {
                let of = parts.iter().zip(&labels);
                of.filter(|(f, l)| **f == fold && **l == class).count()
            };
            assert!((5..=6).contains(&count(true)), "{}", count(true));
            assert!((20..=21).contains(&count(false)), "{}", count(false));
        }
    }

    #[test]
    fn the_first_of_equals_wins_and_a_polynomial_that_is_hardly_worse_than_a_radial_kernel() {
        let measured = [
            candidate(Kernel::Linear, 1.0, 0.7),
            candidate(Kernel::Poly2, 1.0, 0.899),
            candidate(Kernel::Poly2, 3.0, 0.899),
            candidate(Kernel::Rbf, 1.0, 0.9),
        ];
        assert_eq!(best(measured.iter()), Some(&measured[1]));
        let mut clear = measured.clone();
        clear[3].balanced_accuracy = 0.95;
        assert_eq!(best(clear.iter()), Some(&clear[3]));
        assert_eq!(best(measured[3..].iter()), Some(&measured[3]));
        assert_eq!(best([].iter()), None);
    }

    #[test]
    fn steps_go_on_from_the_best_and_leave_far_kernels() {
        let kernels = [Kernel::Linear, Kernel::Poly2];
        let mut measured = BTreeMap::from([
            ((0, 1, 1), candidate(kernels[0], 1.0, 0.7)),
            ((1, 1, 1), candidate(kernels[1], 1.0, 0.9)),
            ((1, 1, 3), candidate(kernels[1], 10.0, 0.8)),
        ]);
        let around = [(1, 1, 0), (1, 1, 2), (1, 0, 1), (1, 2, 1)];
        assert_eq!(next(&measured, &kernels), around);
        for place in around {
            measured.insert(place, candidate(kernels[1], 1.0, 0.9));
        }
        // Of equals the first is the best: that of the smallest gamma.
        assert_eq!(next(&measured, &kernels), [(1, 0, 0), (1, 0, 2)]);
        measured.insert((0, 1, 1), candidate(kernels[0], 1.0, 0.88));
        assert_eq!(next(&measured, &kernels).len(), 4);
    }

    #[test]
    fn a_ball_is_found_by_a_polynomial_and_the_watch_may_end_the_search() {
        let set = rings(200, 3, 1);
        let kernels = [Kernel::Linear, Kernel::Poly2];
        let mut seen = Vec::new();
        let chosen = choose(&set.rows, &set.success, &kernels, 1, |done, of| {
            seen.push((done, of));
            ControlFlow::Continue(())
        });
        let choice = chosen.unwrap().unwrap();
        assert_eq!(choice.settings.kernel, Kernel::Poly2);
        assert!(choice.balanced_accuracy > 0.85, "{choice:?}");
        assert_eq!(choice.scores.len(), 200);
        let last = *seen.last().unwrap();
        assert!(last.0 == last.1 && last.0 < 24, "{seen:?}");
        let ended = choose(&set.rows, &set.success, &kernels, 1, |_, _| {
            ControlFlow::Break(())
        });
        assert_eq!(ended.unwrap(), None);
    }

    #[test]
    fn rare_classes_are_still_held_out() {
        let mut set = rings(60, 2, 1);
        set.success.fill(true);
        let of = |set: &crate::learning::dataset::Dataset| {
            let go = |_, _| ControlFlow::Continue(());
            choose(&set.rows, &set.success, &[Kernel::Linear], 1, go)
        };
        set.success[3] = false;
        let told = of(&set).unwrap_err().to_string();
        assert!(told.contains("59 times 1 and 1 times 0"), "{told}");
        set.success[9] = false;
        assert!(of(&set).unwrap().is_some());
    }
}

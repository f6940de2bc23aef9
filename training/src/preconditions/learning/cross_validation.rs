//! Which kernel, C and γ: by cross-validation on the training set alone.
//!
//! standardised rows, labels → held-out scores of candidates → [`Measured`].
//!
//! From coarse to fine: each kernel at C = 1 and 10 and γ = 1 / features, the radial one at γ = 10 / features
//! as well, the linear one at C = 0.3, then steps along the grid from each kernel's best while that
//! improves it. Kernels far behind are left where they are: large C takes by far the longest where a
//! kernel does not fit. This search sees only part of a large set; the best few that it found are then
//! measured on more of it.
//!
//! Machines are trained by libsvm-rs, which finds the same optimum as linfa-svm five to ten times as
//! fast. Candidates are measured in parallel; the same seed gives the same choice whatever the number
//! of threads.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use aplomb_framework::input::{Error, Result};

use super::folds::{Folded, Measured};
use super::machine::{Hyperparameters, Kernel};
use super::training::checked;

/// Only the first so many samples of the training set take part in the search, so that its time is bounded.
pub const MOST_SEARCHED: usize = 3_000;
/// So many take part in the final: more samples tell smaller differences, and a radial kernel gains more by
/// them than a polynomial.
pub const MOST_IN_FINAL: usize = 10_000;
/// So many candidates take part in the final.
const FINALISTS: usize = 6;

/// Prices of a violated margin that are tried.
const COSTS: [f64; 6] = [0.3, 1.0, 3.0, 10.0, 30.0, 100.0];
/// Coefficients of the kernel that are tried, times the number of features.
const GAMMAS: [f64; 4] = [0.3, 1.0, 3.0, 10.0];
/// Where the linear kernel begins: places in [`GAMMAS`] and [`COSTS`].
const LINEAR_STARTS: [(usize, usize); 1] = [(1, 0)];
/// Where polynomials begin.
const POLYNOMIAL_STARTS: [(usize, usize); 2] = [(1, 1), (1, 3)];
/// Where the radial kernel begins. It has a second optimum where only near neighbours count.
const RADIAL_STARTS: [(usize, usize); 3] = [(1, 1), (1, 3), (3, 1)];
/// A kernel whose best is worse than the best of all by more is not followed further.
const FAR: f64 = 0.03;
/// Candidates that are measured before the watch is told.
const BATCH: usize = 4;

/// A place of the grid: of the kernel among those allowed, in [`GAMMAS`] and in [`COSTS`].
type Place = (usize, usize, usize);

/// Chooses among the kernels' candidates by balanced accuracy over all held-out samples; of equal
/// ones the earlier in the grid: the earlier kernel, then the smaller γ and C. `watch` sees how many
/// measurements are made of how many that are planned so far and may end the work, which then has no
/// result.
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
) -> Result<Option<Measured>> {
    let grid = Grid {
        kernels,
        width: rows.first().map_or(1, Vec::len).max(1),
    };
    if kernels.is_empty() {
        let accepted = "at least one of linear, poly2, poly3, rbf";
        return Err(Error::invalid("settings", "kernels", "none", accepted));
    }
    let head = |most: usize| {
        let count = rows.len().min(labels.len()).min(most);
        (&rows[..count], &labels[..count])
    };
    let (searched, more) = (head(MOST_SEARCHED), head(MOST_IN_FINAL));
    for (rows, labels) in [searched, more] {
        checked(rows, labels, &grid.settings((0, 0, 0)))?;
    }
    let to_come = if more.0.len() > searched.0.len() {
        FINALISTS
    } else {
        0
    };
    let planned = |done, of| watch(done, of + to_come);
    let Some(measured) = search(&Folded::new(searched, seed), &grid, planned) else {
        return Ok(None);
    };
    if to_come == 0 {
        return Ok(top(&measured).cloned());
    }
    let candidates = front(&measured, FINALISTS);
    let folded = Folded::new(more, seed);
    let mut found = Vec::with_capacity(candidates.len());
    for candidate in &candidates {
        found.extend(folded.measure(&[*candidate]));
        let total = measured.len() + candidates.len();
        if watch(measured.len() + found.len(), total).is_break() {
            return Ok(None);
        }
    }
    Ok(top(&found).cloned())
}

/// Which candidates there are.
struct Grid<'a> {
    kernels: &'a [Kernel],
    /// Number of features.
    width: usize,
}

impl Grid<'_> {
    fn settings(&self, (kernel, gamma, c): Place) -> Hyperparameters {
        Hyperparameters {
            kernel: self.kernels[kernel],
            c: COSTS[c],
            gamma: match self.kernels[kernel] {
                Kernel::Linear => 1.0,
                _ => GAMMAS[gamma] / self.width as f64,
            },
        }
    }

    /// Where the search begins.
    fn starts(&self) -> Vec<Place> {
        let of_kernel = |kernel: usize| {
            let starts: &[(usize, usize)] = match self.kernels[kernel] {
                Kernel::Linear => &LINEAR_STARTS,
                Kernel::Poly2 | Kernel::Poly3 => &POLYNOMIAL_STARTS,
                Kernel::Rbf => &RADIAL_STARTS,
            };
            starts.iter().map(move |(gamma, c)| (kernel, *gamma, *c))
        };
        (0..self.kernels.len()).flat_map(of_kernel).collect()
    }
}

/// All that is measured on the way from the starts to each kernel's best, in the order of the grid.
fn search(
    folded: &Folded,
    grid: &Grid,
    mut watch: impl FnMut(usize, usize) -> ControlFlow<()>,
) -> Option<Vec<Measured>> {
    let mut measured = BTreeMap::new();
    let mut planned = grid.starts();
    while !planned.is_empty() {
        let total = measured.len() + planned.len();
        for batch in planned.chunks(BATCH) {
            let settings: Vec<Hyperparameters> = batch.iter().map(|p| grid.settings(*p)).collect();
            measured.extend(batch.iter().copied().zip(folded.measure(&settings)));
            if watch(measured.len(), total).is_break() {
                return None;
            }
        }
        planned = next(&measured, grid.kernels);
    }
    Some(measured.into_values().collect())
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
fn next(measured: &BTreeMap<Place, Measured>, kernels: &[Kernel]) -> Vec<Place> {
    let top = top(measured.values()).map_or(0.0, |c| c.balanced_accuracy);
    let mut planned = Vec::new();
    for (index, kernel) in kernels.iter().enumerate() {
        let of_kernel = measured.iter().filter(|(place, _)| place.0 == index);
        let best = of_kernel.reduce(|a, b| if better(b.1, a.1) { b } else { a });
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

/// The first of the best.
fn top<'a>(measured: impl IntoIterator<Item = &'a Measured>) -> Option<&'a Measured> {
    let measured = measured.into_iter();
    measured.reduce(|a, b| if better(b, a) { b } else { a })
}

/// Whether a is right more often than b.
fn better(a: &Measured, b: &Measured) -> bool {
    a.balanced_accuracy > b.balanced_accuracy
}

/// The best few, in the order of the grid.
fn front(measured: &[Measured], count: usize) -> Vec<Hyperparameters> {
    let mut ranked: Vec<(usize, &Measured)> = measured.iter().enumerate().collect();
    // Stable: of equal ones the earlier.
    ranked.sort_by(|a, b| b.1.balanced_accuracy.total_cmp(&a.1.balanced_accuracy));
    ranked.truncate(count);
    ranked.sort_by_key(|(place, _)| *place);
    ranked.iter().map(|(_, choice)| choice.settings).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preconditions::learning::synthetic::rings;

    fn candidate(kernel: Kernel, c: f64, balanced_accuracy: f64) -> Measured {
        Measured {
            settings: Hyperparameters {
                kernel,
                c,
                gamma: 1.0,
            },
            balanced_accuracy,
            scores: Vec::new(),
        }
    }

    #[test]
    fn the_first_of_equals_wins_and_the_best_few_go_on_in_their_order() {
        let measured = [
            candidate(Kernel::Linear, 1.0, 0.7),
            candidate(Kernel::Poly2, 1.0, 0.9),
            candidate(Kernel::Poly2, 3.0, 0.8),
            candidate(Kernel::Rbf, 1.0, 0.9),
            candidate(Kernel::Rbf, 3.0, 0.95),
        ];
        assert_eq!(top(&measured[..4]), Some(&measured[1]));
        assert_eq!(top(&[]), None);
        let chosen = front(&measured, 2);
        assert_eq!(chosen, [measured[1].settings, measured[4].settings]);
        assert_eq!(front(&measured, 9).len(), 5);
    }

    #[test]
    fn the_final_sees_more_than_the_search() {
        let set = rings(MOST_SEARCHED + 200, 2, 1);
        let mut seen = Vec::new();
        let chosen = choose(&set.rows, &set.success, &[Kernel::Poly2], 1, |done, of| {
            seen.push((done, of));
            ControlFlow::Continue(())
        });
        assert_eq!(chosen.unwrap().unwrap().scores.len(), MOST_SEARCHED + 200);
        assert!(seen.windows(2).all(|w| w[0].0 < w[1].0), "{seen:?}");
        assert_eq!(seen.last().map(|(done, of)| done == of), Some(true));
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
        let of = |set: &crate::preconditions::learning::dataset::Dataset| {
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

//! Covariance matrix adaptation (Hansen 2006) in the unit cube, through the `cmaes` crate.
//!
//! Parallel over the candidates of a generation, which are asked for in no fixed order; the same
//! seed and costs give the same candidates whatever the number of threads.

use aplomb_framework::math::{ln, square};
use std::ops::ControlFlow;

use cmaes::{CMAESOptions, DVector};

/// How long and how wide to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Initial standard deviation in the unit cube.
    pub sigma: f64,
    /// Candidates a generation.
    pub population: usize,
    /// Ends with the generation that reaches this many evaluations; the first is that of the start.
    pub evaluations: usize,
    /// Fixes the candidates.
    pub seed: u64,
}

/// Candidates a generation: Hansen's 4 + 3 ln n, made even.
#[must_use]
pub fn population(dimensions: usize) -> usize {
    let usual = 4 + (3.0 * ln(dimensions.max(1) as f64)) as usize;
    usual.next_multiple_of(2)
}

/// A point of the unit cube and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Best {
    /// Coordinates in 0..1.
    pub point: Vec<f64>,
    /// Cost.
    pub cost: f64,
}

/// Minimises `cost` over the unit cube from `start`. Candidates outside the cube are moved to its
/// face and charged for the distance. `watch` sees the evaluations so far and the best, after the
/// start and then after each generation, and may end the search.
///
/// # Panics
/// If `start` is empty.
///
/// ```
/// # use std::ops::ControlFlow;
/// # use aplomb_training::search::cma_es::{Search, minimise, population};
/// let search = Search { sigma: 0.2, population: population(2), evaluations: 300, seed: 1 };
/// let cost = |x: &[f64]| (x[0] - 0.7).powi(2) + (x[1] - 0.2).powi(2);
/// let best = minimise(&[0.5, 0.5], search, cost, |_, best| {
///     if best.cost < 1e-6 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// });
/// assert!((best.point[0] - 0.7).abs() < 0.01, "{best:?}");
/// ```
pub fn minimise(
    start: &[f64],
    search: Search,
    cost: impl Fn(&[f64]) -> f64 + Sync,
    mut watch: impl FnMut(usize, &Best) -> ControlFlow<()>,
) -> Best {
    let charged = |x: &DVector<f64>| {
        let inside: Vec<f64> = x.iter().map(|v| v.clamp(0.0, 1.0)).collect();
        let outside: f64 = x.iter().zip(&inside).map(|(a, b)| square(a - b)).sum();
        cost(&inside) + 10.0 * outside
    };
    let mut best = Best {
        point: start.to_vec(),
        cost: cost(start),
    };
    let mut evaluations = 1;
    let mut ended = watch(evaluations, &best).is_break();
    let options = CMAESOptions::new(start.to_vec(), search.sigma)
        .population_size(search.population)
        .seed(search.seed)
        .tol_fun(1e-9)
        .tol_stagnation(1000);
    let mut state = match options.build(charged) {
        Ok(state) => state,
        Err(e) => panic!("a search cannot start: {e:?}"),
    };
    while !ended && evaluations < search.evaluations {
        ended = state.next_parallel().is_some();
        evaluations = 1 + state.function_evals();
        if let Some(found) = state
            .overall_best_individual()
            .filter(|b| b.value < best.cost)
        {
            best.cost = found.value;
            best.point = found.point.iter().map(|v| v.clamp(0.0, 1.0)).collect();
        }
        ended |= watch(evaluations, &best).is_break();
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn search(threads: usize) -> Best {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let search = Search {
            sigma: 0.2,
            population: 10,
            evaluations: 1200,
            seed: 4,
        };
        let target = [0.3, 0.9, 0.55];
        let cost = |x: &[f64]| {
            x.iter()
                .zip(target)
                .map(|(a, b)| square(a - b))
                .sum::<f64>()
        };
        pool.map(|p| {
            p.install(|| minimise(&[0.5; 3], search, cost, |_, _| ControlFlow::Continue(())))
        })
        .unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn finds_a_minimum_and_the_same_one_on_any_number_of_threads() {
        let (one, two) = (search(1), search(2));
        assert!(one.cost < 1e-8, "{one:?}");
        assert_eq!(one, two);
    }

    #[test]
    fn generations_are_whole_and_the_watch_may_end_the_search() {
        let count = |evaluations: usize, most: usize| {
            let search = Search {
                sigma: 0.2,
                population: 6,
                evaluations,
                seed: 1,
            };
            let mut seen = Vec::new();
            let cost = |x: &[f64]| x[0] + x[1];
            minimise(&[0.5; 2], search, cost, |n, _| {
                seen.push(n);
                if seen.len() < most {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            });
            seen
        };
        assert_eq!(count(1, 9), [1]);
        assert_eq!(count(8, 9), [1, 7, 13]);
        assert_eq!(count(100, 2), [1, 7]);
    }
}

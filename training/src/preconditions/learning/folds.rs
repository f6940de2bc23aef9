//! Settings measured on samples that the machine was not trained on.
//!
//! standardised rows, labels → folds; settings → held-out score of every sample, [`Measured`].

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::libsvm_solver;
use super::machine::Hyperparameters;
use super::metrics::metrics_of_scores;
use super::training::prices;

/// So many parts; each is held out once.
const FOLDS: usize = 4;
/// Tolerance of the optimality conditions, in units of the score: ten times that of the final
/// training, which moves few scores across 0 and saves most of the time at large C.
const TOLERANCE: f64 = 1e-2;

/// Settings, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Kernel, C and γ.
    pub settings: Hyperparameters,
    /// Balanced accuracy over all held-out samples.
    pub balanced_accuracy: f64,
    /// Score of every sample that took part, by a machine that was not trained on it.
    pub scores: Vec<f64>,
}

/// Samples in folds, each of which is held out once.
pub(super) struct Folded<'a> {
    rows: &'a [Vec<f64>],
    labels: &'a [bool],
    folds: Vec<usize>,
}

impl<'a> Folded<'a> {
    /// Rows and their labels; the seed deals them out.
    pub(super) fn new((rows, labels): (&'a [Vec<f64>], &'a [bool]), seed: u64) -> Self {
        Self {
            rows,
            labels,
            folds: folds(labels, seed),
        }
    }

    /// Held-out scores of some candidates, every fold of each in parallel.
    pub(super) fn measure(&self, candidates: &[Hyperparameters]) -> Vec<Measured> {
        let pairs: Vec<(usize, usize)> = (0..candidates.len())
            .flat_map(|candidate| (0..FOLDS).map(move |fold| (candidate, fold)))
            .collect();
        let held_out: Vec<Vec<(usize, f64)>> = pairs
            .par_iter()
            .map(|(candidate, fold)| self.scores(&candidates[*candidate], *fold))
            .collect();
        let of_candidate = held_out.chunks(FOLDS).zip(candidates);
        of_candidate
            .map(|(parts, settings)| {
                let mut scores = vec![0.0; self.rows.len()];
                for (sample, score) in parts.iter().flatten() {
                    scores[*sample] = *score;
                }
                Measured {
                    settings: *settings,
                    balanced_accuracy: metrics_of_scores(&scores, self.labels).balanced_accuracy,
                    scores,
                }
            })
            .collect()
    }

    /// Scores of a fold's samples by a machine trained on the others.
    fn scores(&self, settings: &Hyperparameters, fold: usize) -> Vec<(usize, f64)> {
        let (held_out, kept): (Vec<usize>, Vec<usize>) =
            (0..self.rows.len()).partition(|i| self.folds[*i] == fold);
        let rows: Vec<Vec<f64>> = kept.iter().map(|i| self.rows[*i].clone()).collect();
        let labels: Vec<bool> = kept.iter().map(|i| self.labels[*i]).collect();
        let successes = labels.iter().filter(|s| **s).count();
        let prices = prices(settings.c, (successes, labels.len() - successes));
        let machine = libsvm_solver::solve(&rows, &labels, settings, prices, TOLERANCE);
        let score = |i: usize| (i, machine.score(&self.rows[i]));
        held_out.into_iter().map(score).collect()
    }
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

#[cfg(test)]
mod tests {
    use super::*;

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
}

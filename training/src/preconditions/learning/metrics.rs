//! How often predictions are right.
//!
//! predictions or scores, truth → [`Metrics`], ROC curve, log-loss.

use crate::preconditions::report::Metrics;
use aplomb_framework::math::ln;

/// The most points of a ROC curve that is kept.
const MOST_POINTS: usize = 300;
/// Probabilities are kept so far from 0 and 1 that a logarithm is finite.
const LEAST_PROBABILITY: f64 = 1e-15;

/// From as many predictions as truths. A ratio without cases is 0; balanced accuracy is that of the
/// one class if there is but one.
#[must_use]
pub fn metrics(predicted: &[bool], truth: &[bool]) -> Metrics {
    let count = |foretold: bool, came: bool| {
        let pairs = predicted.iter().zip(truth);
        pairs.filter(|pair| *pair == (&foretold, &came)).count() as u64
    };
    let (tp, fp) = (count(true, true), count(true, false));
    let (tn, fn_) = (count(false, false), count(false, true));
    let ratio = |part: u64, whole: u64| part as f64 / whole.max(1) as f64;
    let (recall, specificity) = (ratio(tp, tp + fn_), ratio(tn, tn + fp));
    let product = [tp + fp, tp + fn_, tn + fp, tn + fn_].map(|n| n as f64);
    let root = product.iter().product::<f64>().sqrt();
    let difference = tp as f64 * tn as f64 - fp as f64 * fn_ as f64;
    Metrics {
        accuracy: ratio(tp + tn, tp + fp + tn + fn_),
        balanced_accuracy: match (tp + fn_, tn + fp) {
            (0, _) => specificity,
            (_, 0) => recall,
            _ => (recall + specificity) / 2.0,
        },
        precision: ratio(tp, tp + fp),
        recall,
        mcc: if root > 0.0 { difference / root } else { 0.0 },
        true_positives: tp,
        false_positives: fp,
        true_negatives: tn,
        false_negatives: fn_,
    }
}

/// As [`metrics`], of scores that foretell a success where they are at least 0.
#[must_use]
pub fn metrics_of_scores(scores: &[f64], truth: &[bool]) -> Metrics {
    let predicted: Vec<bool> = scores.iter().map(|s| *s >= 0.0).collect();
    metrics(&predicted, truth)
}

/// The ROC curve of scores of which more means success: false and true positive rates from (0, 0) to
/// (1, 1), one point for every different score.
#[must_use]
pub fn roc(scores: &[f64], truth: &[bool]) -> Vec<[f64; 2]> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|a, b| scores[*b].total_cmp(&scores[*a]));
    let positives = truth.iter().filter(|t| **t).count().max(1) as f64;
    let negatives = truth.iter().filter(|t| !**t).count().max(1) as f64;
    let (mut foretold, mut mistaken) = (0.0, 0.0);
    let mut points = vec![[0.0, 0.0]];
    for tied in order.chunk_by(|a, b| scores[*a] == scores[*b]) {
        let right = tied.iter().filter(|i| truth[**i]).count() as f64;
        foretold += right;
        mistaken += tied.len() as f64 - right;
        points.push([mistaken / negatives, foretold / positives]);
    }
    points
}

/// Area under a ROC curve: the probability that a success has a larger score than a failure, ties
/// counting half.
#[must_use]
pub fn area(roc: &[[f64; 2]]) -> f64 {
    let trapezium = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]) / 2.0;
    roc.windows(2).map(trapezium).sum()
}

/// At most 300 of the points, evenly taken, with the first and the last.
#[must_use]
pub fn thinned(roc: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if roc.len() <= MOST_POINTS {
        return roc.to_vec();
    }
    let last = MOST_POINTS - 1;
    let point = |i: usize| roc[i * (roc.len() - 1) / last];
    (0..MOST_POINTS).map(point).collect()
}

/// Mean of −ln(probability that was given to what happened).
#[must_use]
pub fn log_loss(probability: &[f64], truth: &[bool]) -> f64 {
    let loss = |(p, success): (&f64, &bool)| {
        let given = if *success { *p } else { 1.0 - p };
        -ln(given.clamp(LEAST_PROBABILITY, 1.0))
    };
    let sum: f64 = probability.iter().zip(truth).map(loss).sum();
    sum / truth.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counted_by_hand() {
        let predicted = [true, true, true, false, false, false, false, true];
        let truth = [true, true, false, true, false, false, false, true];
        let m = metrics(&predicted, &truth);
        let counts = (m.true_positives, m.false_positives, m.true_negatives);
        assert_eq!((counts, m.false_negatives), ((3, 1, 3), 1));
        assert_eq!(m.accuracy, 0.75);
        assert_eq!((m.precision, m.recall), (0.75, 0.75));
        assert_eq!(m.balanced_accuracy, 0.75);
        assert_eq!(m.mcc, 0.5);
        // Precision and recall apart: 1 success foretold of 3, and 1 of 1 foretellings right.
        let m = metrics(&[true, false, false, false], &[true, true, true, false]);
        assert_eq!((m.precision, m.recall), (1.0, 1.0 / 3.0));
        assert_eq!(m.balanced_accuracy, (1.0 / 3.0 + 1.0) / 2.0);
        assert_eq!(metrics(&[false; 3], &[false; 3]).balanced_accuracy, 1.0);
        assert_eq!(metrics(&[false; 2], &[true, false]).mcc, 0.0);
    }

    #[test]
    fn area_counts_pairs_and_ties_half() {
        let truth = [true, false, true, false];
        let of = |scores: &[f64]| area(&roc(scores, &truth));
        assert_eq!(of(&[4.0, 1.0, 3.0, 2.0]), 1.0);
        assert_eq!(of(&[1.0, 4.0, 2.0, 3.0]), 0.0);
        assert_eq!(of(&[1.0; 4]), 0.5);
        // Of the four pairs three are right.
        assert_eq!(of(&[4.0, 3.0, 2.0, 1.0]), 0.75);
        // One tie.
        assert_eq!(of(&[4.0, 2.0, 2.0, 1.0]), 0.875);
        let points = roc(&[4.0, 2.0, 2.0, 1.0], &truth);
        assert_eq!(points, [[0.0, 0.0], [0.0, 0.5], [0.5, 1.0], [1.0, 1.0]]);
    }

    #[test]
    fn thinning_keeps_the_ends() {
        let scores: Vec<f64> = (0..5000).map(f64::from).collect();
        let truth: Vec<bool> = (0..5000).map(|i| i % 3 == 0).collect();
        let points = thinned(&roc(&scores, &truth));
        assert_eq!(points.len(), 300);
        assert_eq!((points[0], points[299]), ([0.0, 0.0], [1.0, 1.0]));
    }

    #[test]
    fn log_loss_by_hand() {
        let found = log_loss(&[0.8, 0.4], &[true, false]);
        assert!((found + (0.8_f64.ln() + 0.6_f64.ln()) / 2.0).abs() < 1e-15);
        assert!(log_loss(&[0.0, 1.0], &[true, false]).is_finite());
    }
}

//! A learned pre-condition, as it is used: features → probability of success.

use aplomb_framework::control::boundary::{Calibration, DecisionFunction};

use super::standardise::Scaling;

/// Everything that a query needs.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedPrecondition {
    /// Names of the features, in the order of a row.
    pub features: Vec<String>,
    /// What brings a row to mean 0 and deviation 1.
    pub scaling: Scaling,
    /// From a standardised row to the score.
    pub decision: DecisionFunction,
    /// From the score to a probability.
    pub calibration: Calibration,
}

impl LearnedPrecondition {
    /// Score of a row of features in their units: a success if it is at least 0.
    #[must_use]
    pub fn score(&self, row: &[f64]) -> f64 {
        self.decision.value(&self.scaling.apply(row))
    }

    /// Probability of success at a score.
    #[must_use]
    pub fn probability(&self, score: f64) -> f64 {
        self.calibration.probability(score)
    }
}

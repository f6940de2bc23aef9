//! A learned pre-condition, as it is used: features → probability of success.

use super::calibration::Calibration;
use super::machine::Machine;
use super::polynomial;
use super::standardise::Scaling;

/// Everything that a query needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Learned {
    /// Names of the features, in the order of a row.
    pub features: Vec<String>,
    /// What is taken from each, in its unit.
    pub mean: Vec<f64>,
    /// What each is then divided by, in its unit.
    pub scale: Vec<f64>,
    /// The machine on standardised rows.
    pub machine: Machine,
    /// The machine as a polynomial of standardised rows, in the order of [`Machine::collapse`];
    /// none if the kernel is radial.
    pub coefficients: Option<Vec<f64>>,
    /// Probability = 1 / (1 + exp(slope · score + offset)); below 0.
    pub slope: f64,
    /// See `slope`.
    pub offset: f64,
}

impl Learned {
    /// From its parts.
    #[must_use]
    pub fn new(
        features: &[String],
        scaling: Scaling,
        machine: Machine,
        calibration: Calibration,
    ) -> Self {
        Self {
            features: features.to_vec(),
            mean: scaling.mean,
            scale: scaling.scale,
            coefficients: machine.collapse(),
            machine,
            slope: calibration.slope,
            offset: calibration.offset,
        }
    }

    /// Score of a row of features in their units: a success if it is at least 0.
    #[must_use]
    pub fn score(&self, row: &[f64]) -> f64 {
        let statistics = self.mean.iter().zip(&self.scale);
        let standardised = |(value, (mean, scale)): (&f64, (&f64, &f64))| (value - mean) / scale;
        let z: Vec<f64> = row.iter().zip(statistics).map(standardised).collect();
        match (&self.coefficients, self.machine.kernel.degree()) {
            (Some(coefficients), Some(degree)) => polynomial::value(coefficients, degree, &z),
            _ => self.machine.score(&z),
        }
    }

    /// Probability of success at a score.
    #[must_use]
    pub fn probability(&self, score: f64) -> f64 {
        let (slope, offset) = (self.slope, self.offset);
        Calibration { slope, offset }.probability(score)
    }
}

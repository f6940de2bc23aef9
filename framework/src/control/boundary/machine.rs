//! A learned boundary between the situations that a controller copes with and those that it does
//! not: a support vector machine as data. (Faloutsos, van de Panne, Terzopoulos 2001, "Learning
//! pre-conditions"; probabilities after Platt 1999.)
//!
//! boundary file (RON) → [`Boundary`]; sensors → score → probability of success. What trains it is
//! elsewhere; here it is only evaluated, without allocation.

use std::fmt;
use std::path::Path;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use crate::control::boundary::kernel::DecisionFunction;
use crate::control::boundary::packed::MOST_FEATURES;
use crate::input::{Result, Source};
use crate::math::exp;
use crate::sensing::{Feature, Sensors};

/// The largest boundary file that is read: 32 MiB.
pub const LARGEST_BOUNDARY: u64 = 32 << 20;

/// The version of boundary files that is written.
pub const VERSION: u8 = 2;

/// A learned boundary, as data. Valid for one controller of one character.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Boundary {
    /// Of the file: 1 (also if there is none) or [`VERSION`].
    #[serde(default = "first", deserialize_with = "known")]
    pub version: u8,
    /// Where it comes from, in a sentence.
    pub provenance: String,
    /// What it was learned from, and how often it is right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figures: Option<BoundaryFigures>,
    /// Name of the controller whose successes it separates from its failures.
    pub controller: String,
    /// Name of the character that it was learned with.
    pub character: String,
    /// [`Model::digest`](crate::character::Model::digest) of that character.
    pub character_digest: String,
    /// What it looks at, 1 to [`MOST_FEATURES`], none of them twice; x below.
    pub features: Vec<Feature>,
    /// One a feature, in its unit: z = (x − mean) / scale.
    pub mean: Vec<f64>,
    /// One a feature, in its unit, above 0.
    pub scale: Vec<f64>,
    /// From the score to a probability.
    pub calibration: Calibration,
    /// From z to the score.
    pub decision: DecisionFunction,
}

/// What a boundary was learned from, and how often it is right. All but counts and constants are
/// parts of 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundaryFigures {
    /// It was trained on so many.
    pub rollouts: usize,
    /// Of the rollouts.
    pub seed: u64,
    /// Rollouts that succeeded.
    pub successes: f64,
    /// `linear`, `poly2`, `poly3` or `rbf`.
    pub kernel: String,
    /// Price of a violated margin.
    pub c: f64,
    /// Kernel coefficient.
    pub gamma: f64,
    /// Rollouts that carry the boundary.
    pub support_vectors: usize,
    /// It was tested on so many others.
    pub tested: usize,
    /// Of those, foretold rightly.
    pub accuracy: f64,
    /// Mean of the accuracies on successes and on failures.
    pub balanced_accuracy: f64,
    /// The same of the nearest neighbour.
    pub balanced_accuracy_of_nearest_neighbour: f64,
    /// The same of the hand-written precondition.
    pub balanced_accuracy_of_hand_written: f64,
}

/// Of files that tell none.
fn first() -> u8 {
    1
}

fn known<'de, D: Deserializer<'de>>(from: D) -> std::result::Result<u8, D::Error> {
    let version = u8::deserialize(from)?;
    if (1..=VERSION).contains(&version) {
        return Ok(version);
    }
    let accepted = "1 (vectors as lists) or 2 (vectors packed); learn it anew with `aplomb train preconditions`";
    Err(D::Error::custom(format!(
        "version is {version}; accepted: {accepted}"
    )))
}

/// Probability of success: 1 / (1 + exp(slope · score + offset)).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// 0 or less: a higher score is never less likely to succeed.
    pub slope: f64,
    /// 0 where a score of 0 means one half.
    pub offset: f64,
}

impl Calibration {
    /// Probability of success at a score, 0 to 1; 0 at what is not a number.
    #[must_use]
    pub fn probability(&self, score: f64) -> f64 {
        let p = 1.0 / (1.0 + exp(self.slope * score + self.offset));
        if p.is_nan() { 0.0 } else { p }
    }
}

impl Boundary {
    /// Reads a boundary file of at most [`LARGEST_BOUNDARY`] bytes.
    ///
    /// # Errors
    /// As [`Self::parse`], or an unreadable file.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Source::read_up_to(path, LARGEST_BOUNDARY)?)
    }

    /// Reads a boundary from text and checks all of it that can be checked without the character.
    ///
    /// # Errors
    /// Unknown features, wrong counts, numbers out of bounds: with file, line, column and field.
    pub fn parse(source: &Source) -> Result<Self> {
        let boundary: Self = source.parse()?;
        boundary.check().map_err(|e| source.locate(e))?;
        Ok(boundary)
    }

    /// The score of raw feature values, in the order and units of the features. 0 or more: success
    /// is expected. Not a number if a value is not a finite number or one is missing.
    #[must_use]
    pub fn score_of(&self, x: &[f64]) -> f64 {
        let mut z = [0.0; MOST_FEATURES];
        let count = self.features.len();
        let Some(z) = z.get_mut(..count).filter(|_| x.len() == count) else {
            return f64::NAN;
        };
        for (i, (mean, scale)) in self.mean.iter().zip(&self.scale).enumerate().take(count) {
            z[i] = (x[i] - mean) / scale;
            if !z[i].is_finite() {
                return f64::NAN;
            }
        }
        self.decision.value(z)
    }

    /// The score now. Not a number if any of the features is not.
    #[must_use]
    pub fn score(&self, now: &Sensors) -> f64 {
        let mut x = [0.0; MOST_FEATURES];
        let Some(x) = x.get_mut(..self.features.len()) else {
            return f64::NAN;
        };
        for (x, feature) in x.iter_mut().zip(&self.features) {
            *x = feature.value(now);
        }
        self.score_of(x)
    }

    /// Why it has no score, where it has none.
    #[must_use]
    pub fn absence(&self, now: &Sensors) -> String {
        let absent = self.features.iter().find(|f| f.value(now).is_nan());
        absent.map_or_else(
            || "its score is no number".to_owned(),
            |f| format!("{f} has no value: {}", f.absence(now)),
        )
    }

    /// As [`Calibration::probability`].
    #[must_use]
    pub fn probability(&self, score: f64) -> f64 {
        self.calibration.probability(score)
    }
}

/// Short: `svm of balance (12 features, poly2)`.
impl fmt::Display for Boundary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.features.len();
        let plural = if count == 1 { "" } else { "s" };
        write!(f, "svm of {} ({count} feature{plural}, ", self.controller)?;
        match &self.decision {
            DecisionFunction::Polynomial { degree, .. } => write!(f, "poly{degree})"),
            DecisionFunction::Gaussian { support, .. } => {
                write!(f, "gaussian of {})", support.len())
            }
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::character::Model;
    use crate::control::boundary::bounds::monomials;
    use std::sync::LazyLock;

    /// A boundary of the humanoid over these features, with z = x.
    pub(crate) fn boundary(features: &[&str], decision: DecisionFunction) -> Boundary {
        static DIGEST: LazyLock<String> =
            LazyLock::new(|| Model::load("humanoid").unwrap().digest());
        Boundary {
            version: VERSION,
            provenance: "Written by hand.".to_owned(),
            figures: None,
            controller: "balance".to_owned(),
            character: "humanoid".to_owned(),
            character_digest: DIGEST.clone(),
            features: features.iter().map(|f| f.parse().unwrap()).collect(),
            mean: vec![0.0; features.len()],
            scale: vec![1.0; features.len()],
            decision,
            calibration: Calibration {
                slope: -2.0,
                offset: 0.5,
            },
        }
    }

    pub(crate) fn polynomial(features: &[&str], coefficients: &[f64]) -> Boundary {
        let counts = |d: &u8| monomials(features.len(), *d) == coefficients.len();
        let degree = (1..=3).find(counts).unwrap();
        let coefficients = coefficients.to_vec();
        boundary(
            features,
            DecisionFunction::Polynomial {
                degree,
                coefficients,
            },
        )
    }

    const TWO: [&str; 2] = ["com_velocity_x", "angle.knee_l"];

    #[test]
    fn polynomials_are_what_they_are_by_hand() {
        // 1 + 2a + 3b at (0.5, −2)
        assert_eq!(
            polynomial(&TWO, &[1.0, 2.0, 3.0]).score_of(&[0.5, -2.0]),
            -4.0
        );
        // … + 4a² + 5ab + 6b²
        let second = polynomial(&TWO, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(second.score_of(&[0.5, -2.0]), -4.0 + 1.0 - 5.0 + 24.0);
        // … + 7a³ + 8a²b + 9ab² + 10b³
        let third = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0];
        let cubic = 7.0 / 8.0 - 4.0 + 18.0 - 80.0;
        assert_eq!(
            polynomial(&TWO, &third).score_of(&[0.5, -2.0]),
            16.0 + cubic
        );
    }

    #[test]
    fn features_are_normalised_first() {
        let mut b = polynomial(&TWO, &[1.0, 2.0, 3.0]);
        (b.mean, b.scale) = (vec![1.0, -1.0], vec![0.5, 2.0]);
        // z = ((2 − 1) / 0.5, (3 + 1) / 2) = (2, 2)
        assert_eq!(b.score_of(&[2.0, 3.0]), 11.0);
    }

    #[test]
    fn gaussians_are_what_they_are_by_hand() {
        let decision = DecisionFunction::Gaussian {
            gamma: 0.5,
            support: vec![vec![0.0, 0.0], vec![1.0, -1.0]],
            weights: vec![2.0, -1.0],
            offset: 0.25,
        };
        let b = boundary(&TWO, decision);
        let expected = 2.0 * (-0.5_f64).exp() - (-0.5_f64).exp() + 0.25;
        assert!((b.score_of(&[1.0, 0.0]) - expected).abs() < 1e-15);
        assert_eq!(b.to_string(), "svm of balance (2 features, gaussian of 2)");
    }

    #[test]
    fn scores_are_calibrated() {
        let b = polynomial(&TWO, &[1.0, 2.0, 3.0]);
        assert!((b.probability(0.25) - 0.5).abs() < 1e-15);
        assert!((b.probability(1.0) - 1.0 / (1.0 + (-1.5_f64).exp())).abs() < 1e-15);
        assert_eq!((b.probability(1e6), b.probability(-1e6)), (1.0, 0.0));
        assert_eq!(b.probability(f64::NAN), 0.0);
    }

    #[test]
    fn what_is_not_a_number_has_no_score() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        now.com_velocity[0] = 0.5;
        // Even where its coefficient is 0.
        let mut b = polynomial(&["com_velocity_x", "com_offset"], &[1.0, 2.0, 0.0]);
        b.resolve(&model).unwrap();
        assert!(b.score(&now).is_nan(), "no base of support in the air");
        let mut b = polynomial(&["com_velocity_x"], &[1.0, 2.0]);
        b.resolve(&model).unwrap();
        assert_eq!(b.score(&now), 2.0);
        assert!(b.score_of(&[f64::INFINITY]).is_nan());
        assert!(b.score_of(&[]).is_nan() && b.score_of(&[0.0; 2]).is_nan());
    }
}

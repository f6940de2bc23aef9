//! From scores to probabilities (Platt 1999; Newton's method of Lin, Lin & Weng 2007, by linfa).
//!
//! Fitted to scores of samples that the machine was not trained on: those of its own training
//! samples are too good, and so would the probabilities be.

use aplomb_framework::control::boundary::Calibration;
use aplomb_framework::input::{Error, Result};
use linfa::ParamGuard;
use linfa::composing::platt_scaling::{PlattParams, platt_newton_method};
use ndarray::Array1;

/// The calibration of these held-out scores; its slope is below 0.
///
/// # Errors
/// [`Error::Invalid`] if the scores of successes are not larger than those of failures, or no
/// fit is found.
pub fn calibrate(scores: &[f64], truth: &[bool]) -> Result<Calibration> {
    let refused = |problem: &str| {
        let accepted = "larger for successes than for failures; more samples or other features \
                        may help";
        Error::invalid("calibration", "held-out scores", problem, accepted)
    };
    // In units of their size, where Newton's method is at ease.
    let square = scores.iter().map(|s| s * s).sum::<f64>() / scores.len().max(1) as f64;
    let size = square.sqrt();
    if !size.is_normal() {
        return Err(refused("all 0, or not finite"));
    }
    let units = Array1::from_iter(scores.iter().map(|s| s / size));
    let truth = Array1::from(truth.to_vec());
    let params = PlattParams::<f64, ()>::default().check();
    let params = params.map_err(|e| refused(&e.to_string()))?;
    let (slope, offset) = platt_newton_method(units.view(), truth.view(), &params)
        .map_err(|e| refused(&format!("no basis of probabilities ({e})")))?;
    // Less than this over the range of the scores is no difference.
    if !(slope < -1e-6 && offset.is_finite()) {
        return Err(refused("no larger for successes than for failures"));
    }
    Ok(Calibration {
        slope: slope / size,
        offset,
    })
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn finds_the_sigmoid_that_labels_were_drawn_from() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for size in [1.0, 1e-3, 1e4] {
            let truth = Calibration {
                slope: -1.5 / size,
                offset: 0.7,
            };
            let scores: Vec<f64> = (0..20_000)
                .map(|_| size * rng.gen_range(-3.0..3.0))
                .collect();
            let draw = |s: &f64| rng.gen_bool(truth.probability(*s));
            let labels: Vec<bool> = scores.iter().map(draw).collect();
            let found = calibrate(&scores, &labels).unwrap();
            assert!((found.slope / truth.slope - 1.0).abs() < 0.05, "{found:?}");
            assert!((found.offset - truth.offset).abs() < 0.1, "{found:?}");
        }
    }

    #[test]
    fn separated_scores_have_finite_numbers_and_useless_ones_are_refused() {
        let scores = [-2.0, -1.0, 1.0, 2.0];
        let truth = [false, false, true, true];
        let found = calibrate(&scores, &truth).unwrap();
        assert!(found.slope < 0.0 && found.slope.is_finite());
        assert!(found.probability(2.0) > 0.5 && found.probability(-2.0) < 0.5);
        for useless in [[2.0, 1.0, -1.0, -2.0], [0.0; 4], [1.0; 4], [f64::NAN; 4]] {
            let told = calibrate(&useless, &truth).unwrap_err().to_string();
            assert!(told.contains("held-out scores"), "{told}");
        }
    }
}

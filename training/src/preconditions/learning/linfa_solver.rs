//! Training by linfa-svm: up to some thousand samples, for its dense kernel matrix.
//!
//! Its polynomial kernel is (x·y + constant)^degree, so that γ goes into the rows as √γ; its Gaussian
//! kernel divides by 1/γ. Its shrinking heuristic goes wrong and is never switched on. Its default
//! tolerance of 1e-7 costs three times the iterations of LIBSVM's 1e-3, for the same accuracy.

use aplomb_framework::input::{Error, Result};
use linfa::DatasetBase;
use linfa::traits::Fit;
use linfa_svm::Svm;
use ndarray::{Array1, Array2};

use super::machine::{Hyperparameters, Kernel, Machine};

/// Tolerance of the optimality conditions.
const TOLERANCE: f64 = 1e-3;
/// Weights below are none; linfa-svm's own bound.
const LEAST_WEIGHT: f64 = 100.0 * f64::EPSILON;

/// Trains on finite rows with both classes; prices C of successes and of failures.
pub(super) fn solve(
    rows: &[Vec<f64>],
    labels: &[bool],
    settings: &Hyperparameters,
    [success, failure]: [f64; 2],
) -> Result<Machine> {
    let refused = |reason: String| {
        let accepted = "a set and settings that linfa-svm takes";
        Error::invalid("machine", "training", reason, accepted)
    };
    let factor = match settings.kernel {
        Kernel::Poly2 | Kernel::Poly3 => settings.gamma.sqrt(),
        Kernel::Linear | Kernel::Rbf => 1.0,
    };
    let width = rows.first().map_or(0, Vec::len);
    let values = rows.iter().flatten().map(|v| v * factor).collect();
    let records = Array2::from_shape_vec((rows.len(), width), values);
    let records = records.map_err(|e| refused(e.to_string()))?;
    let set = DatasetBase::new(records, Array1::from(labels.to_vec()));
    let params = Svm::<f64, bool>::params()
        .eps(TOLERANCE)
        .pos_neg_weights(success, failure);
    let params = match settings.kernel {
        Kernel::Linear => params.linear_kernel(),
        Kernel::Poly2 => params.polynomial_kernel(1.0, 2.0),
        Kernel::Poly3 => params.polynomial_kernel(1.0, 3.0),
        Kernel::Rbf => params.gaussian_kernel(1.0 / settings.gamma),
    };
    let model = params.fit(&set).map_err(|e| refused(e.to_string()))?;
    let carrying = rows.iter().zip(&model.alpha);
    let (support, weights) = carrying
        .filter(|(_, alpha)| alpha.abs() > LEAST_WEIGHT)
        .map(|(row, alpha)| (row.clone(), *alpha))
        .unzip();
    Ok(Machine {
        kernel: settings.kernel,
        gamma: settings.gamma,
        support,
        weights,
        offset: -model.rho,
        solver: "linfa-svm",
    })
}

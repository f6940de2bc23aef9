//! Training by libsvm-rs, a port of LIBSVM (Chang & Lin 2011): a cache of kernel rows instead of the
//! whole matrix, and shrinking.

use libsvm_rs::train::svm_train;
use libsvm_rs::{KernelType, SvmNode, SvmParameter, SvmProblem, SvmType};

use super::machine::{Hyperparameters, Kernel, Machine};

/// MB of kernel rows that are kept.
const CACHE: f64 = 200.0;

/// LIBSVM's tolerance of the optimality conditions, in units of the score.
pub(super) const TOLERANCE: f64 = 1e-3;

/// Trains on finite rows with both classes; prices C of successes and of failures.
pub(super) fn solve(
    rows: &[Vec<f64>],
    labels: &[bool],
    settings: &Hyperparameters,
    [success, failure]: [f64; 2],
    tolerance: f64,
) -> Machine {
    // It would tell the terminal about every training.
    libsvm_rs::set_quiet(true);
    let label = |success: &bool| if *success { 1.0 } else { -1.0 };
    let problem = SvmProblem {
        labels: labels.iter().map(label).collect(),
        instances: rows.iter().map(|row| nodes(row)).collect(),
    };
    let parameter = SvmParameter {
        svm_type: SvmType::CSvc,
        kernel_type: match settings.kernel {
            Kernel::Linear => KernelType::Linear,
            Kernel::Poly2 | Kernel::Poly3 => KernelType::Polynomial,
            Kernel::Rbf => KernelType::Rbf,
        },
        degree: settings.kernel.degree().unwrap_or(1) as i32,
        gamma: settings.gamma,
        coef0: 1.0,
        cache_size: CACHE,
        eps: tolerance,
        c: 1.0,
        weight: vec![(1, success), (-1, failure)],
        ..SvmParameter::default()
    };
    let model = svm_train(&problem, &parameter);
    // Scores are positive for the label that it met first.
    let sign = if model.label.first() == Some(&1) {
        1.0
    } else {
        -1.0
    };
    let weights = model.sv_coef.first().map_or(&[][..], Vec::as_slice);
    Machine {
        kernel: settings.kernel,
        gamma: settings.gamma,
        support: model
            .sv_indices
            .iter()
            .map(|i| rows[i - 1].clone())
            .collect(),
        weights: weights.iter().map(|w| sign * w).collect(),
        offset: -sign * model.rho.first().copied().unwrap_or(f64::NAN),
        solver: "libsvm-rs",
    }
}

/// A row as LIBSVM has it, indices from 1.
fn nodes(row: &[f64]) -> Vec<SvmNode> {
    let node = |(i, value): (usize, &f64)| SvmNode {
        index: i as i32 + 1,
        value: *value,
    };
    row.iter().enumerate().map(node).collect()
}

//! Training of a machine: the set is checked, classes are balanced, a library solves.
//!
//! standardised rows, labels, [`Hyperparameters`] → [`Machine`].

use aplomb_framework::input::{Error, Result};

use super::machine::{Hyperparameters, Machine};
use super::{libsvm_solver, linfa_solver};

/// The most samples that linfa-svm is given: its dense kernel matrix and its time grow with the
/// square of their number.
pub const MOST_FOR_LINFA: usize = 5_000;

/// Trains a machine with linfa-svm, or with libsvm-rs above [`MOST_FOR_LINFA`] samples.
///
/// # Errors
/// [`Error::Invalid`] if the rows are not finite or differ in length, a class has fewer than two
/// samples, C or γ is not positive, or the solver finds no finite machine.
pub fn train(rows: &[Vec<f64>], labels: &[bool], settings: &Hyperparameters) -> Result<Machine> {
    let counts = checked(rows, labels, settings)?;
    let prices = prices(settings.c, counts);
    let machine = if rows.len() <= MOST_FOR_LINFA {
        linfa_solver::solve(rows, labels, settings, prices)?
    } else {
        libsvm_solver::solve(rows, labels, settings, prices, libsvm_solver::TOLERANCE)
    };
    let finite = machine.offset.is_finite() && machine.weights.iter().all(|w| w.is_finite());
    if !finite {
        let accepted = "a set that the solver can separate with finite weights";
        return Err(Error::invalid("machine", "weight", "not finite", accepted));
    }
    Ok(machine)
}

/// Prices C of successes and of failures, given how many of both there are.
pub(super) fn prices(c: f64, (successes, failures): (usize, usize)) -> [f64; 2] {
    let count = (successes + failures) as f64;
    [successes, failures].map(|k| c * count / (2.0 * k as f64))
}

/// Counts of successes and failures of a set that can be trained on.
pub(super) fn checked(
    rows: &[Vec<f64>],
    labels: &[bool],
    settings: &Hyperparameters,
) -> Result<(usize, usize)> {
    let place = "training set";
    for (field, value) in [("C", settings.c), ("gamma", settings.gamma)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(Error::invalid("settings", field, value, "above 0, finite"));
        }
    }
    let width = rows.first().map_or(0, Vec::len);
    let sound = |row: &Vec<f64>| row.len() == width && row.iter().all(|v| v.is_finite());
    if rows.len() != labels.len() || width == 0 || !rows.iter().all(sound) {
        let found = "not a finite number for every feature and a label for every row";
        return Err(Error::invalid(place, "rows", found, "rows of one length"));
    }
    let successes = labels.iter().filter(|s| **s).count();
    let failures = labels.len() - successes;
    if successes.min(failures) < 2 {
        let found = format!("{successes} times 1 and {failures} times 0");
        let accepted = "each at least twice: a boundary needs both";
        return Err(Error::invalid(place, "success", found, accepted));
    }
    Ok((successes, failures))
}

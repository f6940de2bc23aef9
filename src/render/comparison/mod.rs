//! Figures of a learned pre-condition beside its rivals, as SVG.
//!
//! [`Report`] → figures with captions: ROC curve, confusion matrices, accuracy against training
//! size, learned boundary. What a report does not have is not drawn.

mod boundary;
mod confusion;
mod field;
mod learning;
mod limits;
mod roc;

use anyhow::{Result, bail};
use aplomb_training::preconditions::report::{Metrics, Report};

/// The rivals' colours, the same in every figure.
const SVM: &str = "#0072b2";
const NEIGHBOUR: &str = "#d55e00";
const HAND_MADE: &str = "#117733";

/// A picture and what is to be said of it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// What it shows, in a few words.
    pub title: &'static str,
    /// An SVG document on white.
    pub svg: String,
    /// What one sees.
    pub caption: String,
}

/// Everything that can be drawn of a report.
///
/// # Errors
/// A curve or slice that spans nothing or whose numbers do not fit together, named by its field.
pub fn figures(report: &Report) -> Result<Vec<Figure>> {
    let mut figures = vec![roc::figure(report)?, confusion::figure(report)];
    if !report.curve.is_empty() {
        figures.push(learning::figure(report)?);
    }
    if let Some(slice) = &report.slice {
        figures.push(boundary::figure(report, slice)?);
    }
    Ok(figures)
}

/// `part` of `whole`; none of nothing.
fn share(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// Where a single answer lies in ROC space: false positive rate, true positive rate. None without
/// both classes.
fn operating_point(m: &Metrics) -> Option<[f64; 2]> {
    let failures = m.false_positives.saturating_add(m.true_negatives);
    let successes = m.true_positives.saturating_add(m.false_negatives);
    Some([
        share(m.false_positives, failures)?,
        share(m.true_positives, successes)?,
    ])
}

/// Refuses a share that is none.
fn check_share(field: &str, value: f64) -> Result<f64> {
    if !(0.0..=1.0).contains(&value) {
        bail!("{field} is {value}; accepted: 0 to 1");
    }
    Ok(value)
}

#[cfg(test)]
mod tests;

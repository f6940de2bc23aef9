//! The comparison as one JSON value.

use anyhow::Result;
use aplomb::training::preconditions::report::{Metrics, NeighbourReport, Report, SvmReport};
use serde::Serialize;

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
struct ComparedRow<'a> {
    controller: &'a str,
    train: usize,
    test: usize,
    /// Of the training set.
    positive_rate: f64,
    svm: &'a SvmReport,
    nn: &'a NeighbourReport,
    manual: &'a Metrics,
    /// Its accuracy.
    majority: f64,
}

/// A list with an entry for each report, on one line.
pub(super) fn told<'a>(reports: impl Iterator<Item = &'a Report>) -> Result<String> {
    let rows = reports.map(|r| ComparedRow {
        controller: &r.controller,
        train: r.train,
        test: r.test,
        positive_rate: r.positive_rate,
        svm: &r.svm,
        nn: &r.nn,
        manual: &r.manual,
        majority: r.majority,
    });
    let rows: Vec<ComparedRow> = rows.collect();
    Ok(serde_json::to_string(&rows)? + "\n")
}

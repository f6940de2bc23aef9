//! What the tables hold: the accuracies as the 2001 paper tells them, and everything else.
//!
//! reports → headings and cells, whatever they are written as.

use aplomb::framework::math::log10;
use aplomb::training::preconditions::report::{Metrics, Report};

use crate::cli::statistics::wilson;

/// What there is no number of.
const NONE: &str = "–";

/// Headings and rows of cells.
#[derive(Debug)]
pub(super) struct Table {
    /// What it shows.
    pub(super) title: &'static str,
    pub(super) headings: Vec<&'static str>,
    /// As many cells as headings.
    pub(super) rows: Vec<Vec<String>>,
    /// So many columns from the left are words; those after them are numbers, set to the right.
    pub(super) words: usize,
}

/// Both tables.
pub(super) fn both<'a>(reports: impl Iterator<Item = &'a Report> + Clone) -> [Table; 2] {
    [accuracies(reports.clone()), rivals(reports)]
}

/// The 2001 paper's table.
fn accuracies<'a>(reports: impl Iterator<Item = &'a Report>) -> Table {
    let row = |r: &Report| {
        vec![
            name(&r.controller),
            r.train.to_string(),
            r.test.to_string(),
            with_interval(&r.nn.metrics),
            with_interval(&r.svm.metrics),
        ]
    };
    Table {
        title: "Accuracy on the test set, with 95 % intervals",
        headings: vec![
            "controller",
            "training size",
            "test size",
            "nearest neighbour %",
            "SVM %",
        ],
        rows: reports.map(row).collect(),
        words: 1,
    }
}

/// A row for each rival of each controller.
fn rivals<'a>(reports: impl Iterator<Item = &'a Report>) -> Table {
    Table {
        title: "All that decide, on the same test set",
        headings: vec![
            "controller",
            "decides",
            "kernel",
            "accuracy %",
            "balanced %",
            "precision %",
            "recall %",
            "MCC",
            "AUC",
            "C",
            "support vectors",
            "query µs",
        ],
        rows: reports.flat_map(rows).collect(),
        words: 3,
    }
}

fn rows(r: &Report) -> [Vec<String>; 4] {
    let none = || NONE.to_owned();
    let row = |decides: &str, kernel: &str, measured: [String; 5], more: [String; 4]| {
        let words = [name(&r.controller), decides.to_owned(), name(kernel)];
        words.into_iter().chain(measured).chain(more).collect()
    };
    let svm = [
        format!("{:.3}", r.svm.auc),
        short(r.svm.c),
        r.svm.support_vectors.to_string(),
        short(r.svm.query_us),
    ];
    let nn = [none(), none(), none(), short(r.nn.query_us)];
    let hits = (r.majority * r.test as f64).round() as u64;
    let majority = percent(r.majority, wilson(hits, r.test as u64));
    [
        row("SVM", &r.svm.kernel, measured(&r.svm.metrics), svm),
        row("nearest neighbour", NONE, measured(&r.nn.metrics), nn),
        row(
            "hand-made",
            NONE,
            measured(&r.manual),
            [(); 4].map(|()| none()),
        ),
        row(
            "majority",
            NONE,
            [majority, none(), none(), none(), none()],
            [(); 4].map(|()| none()),
        ),
    ]
}

fn measured(m: &Metrics) -> [String; 5] {
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    [
        with_interval(m),
        percent(m.balanced_accuracy),
        percent(m.precision),
        percent(m.recall),
        format!("{:.3}", m.mcc),
    ]
}

/// The accuracy, and Wilson's interval from the counts.
fn with_interval(m: &Metrics) -> String {
    let right = m.true_positives.saturating_add(m.true_negatives);
    let wrong = m.false_positives.saturating_add(m.false_negatives);
    percent(m.accuracy, wilson(right, right.saturating_add(wrong)))
}

/// `97.5 (94.3 to 98.9)`.
fn percent(share: f64, interval: [f64; 2]) -> String {
    let [low, high] = interval.map(|x| 100.0 * x);
    format!("{:.1} ({low:.1} to {high:.1})", 100.0 * share)
}

/// With three digits, without needless zeros.
pub(super) fn short(value: f64) -> String {
    if !(1e-3..1e6).contains(&value.abs()) {
        return if value == 0.0 {
            "0".to_owned()
        } else {
            format!("{value:.1e}")
        };
    }
    let decimals = (2.0 - log10(value.abs()).floor()).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// A name from a file, on one line.
pub(super) fn name(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let told = [0.0, 0.25, 3.0, 12.345, 100.0, 1234.5, 1e-5, 5e7].map(short);
        let expected = ["0", "0.25", "3", "12.3", "100", "1234", "1.0e-5", "5.0e7"];
        assert_eq!(told, expected);
    }
}

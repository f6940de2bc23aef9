//! Learned pre-conditions beside the nearest neighbour and the hand-written ones.

use anyhow::Result;
use aplomb::training::situations::disturbance::is_shipped;
use serde::Deserialize;

use crate::cli::reproduce::page::{Page, percent};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;
use crate::cli::scene::CastArgs;
use crate::cli::train::skills;

pub(super) const STUDY: Study = Study {
    name: "preconditions",
    about: "support vector machines against the nearest neighbour and hand-written pre-conditions",
    takes: ["20 s", "10 minutes"],
    run,
};

/// Where the datasets go; they are not shipped.
const FOLDER: &str = "out/reproduce/preconditions";

/// What `aplomb train preconditions --json` tells of a controller.
#[derive(Debug, Deserialize)]
struct LearnedFigures {
    controller: String,
    train: usize,
    test: usize,
    test_positive_rate: f64,
    svm: Svm,
    nn: Counts,
    manual: Counts,
}

#[derive(Debug, Deserialize)]
struct Svm {
    kernel: String,
    #[serde(flatten)]
    counts: Counts,
}

/// Predictions, right and wrong, of both classes.
#[derive(Debug, Deserialize)]
struct Counts {
    balanced_accuracy: f64,
    true_positives: u64,
    false_positives: u64,
    true_negatives: u64,
    false_negatives: u64,
}

impl Counts {
    /// `90.1 ± 2.2`: percent, with 1.96 standard errors.
    fn balanced(&self) -> String {
        let variance = |right: u64, wrong: u64| {
            let n = (right + wrong).max(1) as f64;
            let p = right as f64 / n;
            p * (1.0 - p) / n
        };
        let successes = variance(self.true_positives, self.false_negatives);
        let failures = variance(self.true_negatives, self.false_positives);
        let error = 0.5 * (successes + failures).sqrt();
        format!(
            "{:.1} ± {:.1}",
            100.0 * self.balanced_accuracy,
            196.0 * error
        )
    }
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Pre-conditions",
        "Where a controller can take over: rollouts from random states, success as the label, half as many further
         rollouts to test with. Balanced accuracy, in percent, is the mean of the parts of successes and of failures
         that were foretold; 50 is guessing, ± is 1.96 standard errors of the test set. The machine's kernel and
         constants are chosen by cross-validation on the training set. *Hand-written* is the condition of the
         controller's file as it stands. The boundaries that are shipped were learned from more rollouts than these.",
    );
    let seed = work.settings.seed;
    let (samples, test) = work.size((120, 60), (1500, 750));
    let all = skills(&CastArgs::default())?;
    let all = all
        .iter()
        .map(|s| s.name().to_owned())
        .filter(|n| is_shipped(n));
    let names = work.size(vec!["balance".to_owned(), "fall".to_owned()], all.collect());
    let mut rows = Vec::new();
    for name in names {
        let found: [LearnedFigures; 1] = work.command(&format!(
            "aplomb train preconditions {name} --samples {samples} --test {test} --seed {seed} --out {FOLDER}"
        ))?;
        let [learned] = found;
        rows.push(vec![
            format!("`{}`", learned.controller),
            learned.train.to_string(),
            learned.test.to_string(),
            percent(learned.test_positive_rate),
            learned.svm.counts.balanced(),
            learned.svm.kernel,
            learned.nn.balanced(),
            learned.manual.balanced(),
        ]);
    }
    page.table(
        &[
            "controller",
            "trained on",
            "tested on",
            "succeed",
            "SVM",
            "kernel",
            "nearest neighbour",
            "hand-written",
        ],
        &rows,
    );
    Ok(page)
}

//! What is known of a learned pre-condition: how often it is right on rollouts that it was not
//! trained on, beside its rivals.
//!
//! Written as JSON beside the datasets; read by whoever compares.

use serde::{Deserialize, Serialize};

/// How often predictions were right, from the counts of both kinds of both classes.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Metrics {
    /// Part of all predictions that were right.
    pub accuracy: f64,
    /// Mean of the parts of successes and of failures that were foretold.
    pub balanced_accuracy: f64,
    /// Part of the foretold successes that came true.
    pub precision: f64,
    /// Part of the successes that were foretold.
    pub recall: f64,
    /// Matthews' correlation coefficient.
    pub mcc: f64,
    /// Successes that were foretold.
    pub true_positives: u64,
    /// Failures foretold as successes.
    pub false_positives: u64,
    /// Failures that were foretold.
    pub true_negatives: u64,
    /// Successes foretold as failures.
    pub false_negatives: u64,
}

/// The support vector machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SvmReport {
    /// `linear`, `poly2`, `poly3` or `rbf`.
    pub kernel: String,
    /// What solved it: `linfa-svm` or `libsvm-rs`.
    pub solver: String,
    /// Price of a violated margin.
    pub c: f64,
    /// Kernel coefficient on standardised features.
    pub gamma: f64,
    /// On the test set.
    #[serde(flatten)]
    pub metrics: Metrics,
    /// Area under the ROC curve of the test set.
    pub auc: f64,
    /// Mean log-loss of the calibrated probability on the test set.
    pub log_loss: f64,
    /// How many training samples carry the boundary.
    pub support_vectors: usize,
    /// s of the final training on all samples.
    pub train_s: f64,
    /// s of the choice of kernel, C and gamma by cross-validation.
    pub choice_s: f64,
    /// µs a query.
    pub query_us: f64,
}

/// The nearest neighbour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NeighbourReport {
    /// On the test set.
    #[serde(flatten)]
    pub metrics: Metrics,
    /// µs a query.
    pub query_us: f64,
}

/// Accuracy against the size of the training set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Samples trained on: the first so many of the training set.
    pub train: usize,
    /// Balanced accuracy of the machine with the kernel, C and gamma of the whole.
    pub svm: f64,
    /// Balanced accuracy of the nearest neighbour.
    pub nn: f64,
    /// s that training the machine took.
    pub train_s: f64,
}

/// The learned probability of success over two features, all others at their median in the training
/// set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slice {
    /// Feature along x and its values.
    pub x: (String, Vec<f64>),
    /// Feature along y and its values.
    pub y: (String, Vec<f64>),
    /// Probability of success; a row for every y.
    pub probability: Vec<Vec<f64>>,
    /// Some samples of the test set: x, y, success.
    pub samples: Vec<(f64, f64, bool)>,
}

/// Everything about a controller's learned pre-condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The controller.
    pub controller: String,
    /// Its character.
    pub character: String,
    /// Seed of the rollouts.
    pub seed: u64,
    /// Samples trained on.
    pub train: usize,
    /// Samples tested on.
    pub test: usize,
    /// Part of the training samples that are successes.
    pub positive_rate: f64,
    /// Part of the test samples that are successes.
    pub test_positive_rate: f64,
    /// The features, in the order of the columns.
    pub features: Vec<String>,
    /// The learned boundary.
    pub svm: SvmReport,
    /// The baseline.
    pub nn: NeighbourReport,
    /// The hand-made pre-condition on the same test set.
    pub manual: Metrics,
    /// Accuracy of always foretelling the more frequent class of the training set.
    pub majority: f64,
    /// Points of the ROC curve of the test set: false positive rate, true positive rate, from
    /// (0, 0) to (1, 1), at most some hundreds.
    pub roc: Vec<[f64; 2]>,
    /// By size of the training set; empty unless asked for.
    #[serde(default)]
    pub curve: Vec<CurvePoint>,
    /// Where the centre of mass and its velocity make the difference, if those are among the
    /// features.
    #[serde(default)]
    pub slice: Option<Slice>,
}

//! From samples to a pre-condition and to what is known of it.
//!
//! training set → choice of settings → machine → calibration → [`LearnedPrecondition`]; test set → [`Report`].

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use aplomb_framework::input::{Error, Result};
use rayon::prelude::*;

use super::calibration::calibrate;
use super::cross_validation::choose;
use super::dataset::Dataset;
use super::learned::LearnedPrecondition;
use super::machine::{Hyperparameters, Kernel};
use super::metrics::{area, log_loss, metrics, metrics_of_scores, roc, thinned};
use super::neighbour::Neighbours;
use super::slice::slice;
use super::split;
use super::standardise::Scaling;
use super::training::train as train_machine;
use crate::preconditions::report::{CurvePoint, NeighbourReport, Report, SvmReport};

/// Queries that are timed, one after another.
const TIMED: usize = 2_000;
/// Queries of the nearest neighbour that are timed.
const TIMED_NEIGHBOURS: usize = 200;

/// Whose samples they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Subject<'a> {
    /// The controller.
    pub controller: &'a str,
    /// Its character.
    pub character: &'a str,
    /// Seed of the rollouts; also fixes the folds of the cross-validation.
    pub seed: u64,
}

/// What is tried and reported.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnSettings {
    /// Kernels to choose from; see [`Kernel::allowed`].
    pub kernels: Vec<Kernel>,
    /// Sizes of training sets for the curve. Larger ones than the training set are left out, and
    /// those in which there are not two of each class.
    pub curve_sizes: Vec<usize>,
}

impl Default for LearnSettings {
    fn default() -> Self {
        Self {
            kernels: Kernel::ALL.to_vec(),
            curve_sizes: Vec::new(),
        }
    }
}

/// What is being done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Cross-validation, by candidates.
    Choice,
    /// The machine on all samples.
    Training,
    /// The test set.
    Testing,
    /// Smaller training sets, by sizes.
    Curve,
}

/// How far it is: `done` of `of` are finished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LearningProgress {
    /// What is being done.
    pub stage: Stage,
    /// Finished.
    pub done: usize,
    /// To do in this stage.
    pub of: usize,
}

/// Learns a pre-condition and measures it on the test set, beside the nearest neighbour and what the
/// hand-made pre-condition `manual` says of each test sample. `watch` sees every step and may end the
/// work, which then has no result.
///
/// All but wall-clock times follows from the arguments, whatever the number of threads.
///
/// # Errors
/// [`Error::Invalid`] if the sets cannot be learned from or compared (see [`split::check`]), if
/// `manual` has another length than the test set, if there is no kernel to choose from, or if the
/// scores do not tell successes from failures.
pub fn learn(
    subject: Subject,
    train: &Dataset,
    test: &Dataset,
    manual: &[bool],
    settings: &LearnSettings,
    mut watch: impl FnMut(LearningProgress) -> ControlFlow<()>,
) -> Result<Option<(LearnedPrecondition, Report)>> {
    split::check(train, test)?;
    if manual.len() != test.rows.len() {
        let accepted = format!("{}, one for each test sample", test.rows.len());
        let place = "hand-made pre-condition";
        return Err(Error::invalid(place, "verdicts", manual.len(), accepted));
    }
    let scaling = Scaling::of(&train.rows);
    let rows = scaling.apply_all(&train.rows);

    let clock = Instant::now();
    let chosen = choose(
        &rows,
        &train.success,
        &settings.kernels,
        subject.seed,
        |done, of| watch(progress(Stage::Choice, done, of)),
    )?;
    let Some(choice) = chosen else {
        return Ok(None);
    };
    let calibration = calibrate(&choice.scores, &train.success[..choice.scores.len()])?;
    let choice_s = clock.elapsed().as_secs_f64();

    if watch(progress(Stage::Training, 0, 1)).is_break() {
        return Ok(None);
    }
    let clock = Instant::now();
    let machine = train_machine(&rows, &train.success, &choice.settings)?;
    let train_s = clock.elapsed().as_secs_f64();
    let tested = scaling.apply_all(&test.rows);
    let learned = LearnedPrecondition {
        features: train.features.clone(),
        decision: machine.decision(),
        scaling,
        calibration,
    };

    if watch(progress(Stage::Testing, 0, 1)).is_break() {
        return Ok(None);
    }
    let scores: Vec<f64> = test.rows.par_iter().map(|r| learned.score(r)).collect();
    let roc = roc(&scores, &test.success);
    let svm = SvmReport {
        kernel: choice.settings.kernel.to_string(),
        solver: machine.solver.to_owned(),
        c: choice.settings.c,
        gamma: choice.settings.gamma,
        metrics: metrics_of_scores(&scores, &test.success),
        auc: area(&roc),
        log_loss: loss(&learned, &scores, test),
        support_vectors: machine.support.len(),
        train_s,
        choice_s,
        query_us: query_us(&learned, test),
    };
    let nn = neighbour_report(&Neighbours::new(&rows, &train.success)?, &tested, test)?;
    let mut curve = Vec::new();
    let sizes: Vec<usize> = sizes(settings, train);
    for (done, size) in sizes.iter().enumerate() {
        if watch(progress(Stage::Curve, done, sizes.len())).is_break() {
            return Ok(None);
        }
        curve.push(if *size == train.rows.len() {
            CurvePoint {
                train: *size,
                svm: svm.metrics.balanced_accuracy,
                nn: nn.metrics.balanced_accuracy,
                train_s,
            }
        } else {
            curve_point(&train.head(*size), test, &choice.settings)?
        });
    }
    let report = Report {
        controller: subject.controller.to_owned(),
        character: subject.character.to_owned(),
        seed: subject.seed,
        train: train.rows.len(),
        test: test.rows.len(),
        positive_rate: train.positive_rate(),
        test_positive_rate: test.positive_rate(),
        features: train.features.clone(),
        svm,
        nn,
        manual: metrics(manual, &test.success),
        majority: majority(train, test),
        roc: thinned(&roc),
        curve,
        slice: slice(&learned, train, test),
    };
    Ok(Some((learned, report)))
}

fn progress(stage: Stage, done: usize, of: usize) -> LearningProgress {
    LearningProgress { stage, done, of }
}

/// Mean log-loss of the calibrated probabilities of the test set.
fn loss(learned: &LearnedPrecondition, scores: &[f64], test: &Dataset) -> f64 {
    let probability: Vec<f64> = scores.iter().map(|s| learned.probability(*s)).collect();
    log_loss(&probability, &test.success)
}

/// µs that a score takes, one after another.
fn query_us(learned: &LearnedPrecondition, test: &Dataset) -> f64 {
    let timed = &test.rows[..test.rows.len().min(TIMED)];
    let clock = Instant::now();
    for row in timed {
        black_box(learned.score(black_box(row)));
    }
    micros_each(clock, timed.len())
}

/// Over the standardised rows of the test set.
fn neighbour_report(
    neighbours: &Neighbours,
    rows: &[Vec<f64>],
    test: &Dataset,
) -> Result<NeighbourReport> {
    let timed = rows.len().min(TIMED_NEIGHBOURS);
    let clock = Instant::now();
    for row in rows[..timed].chunks(1) {
        black_box(neighbours.predict(black_box(row))?);
    }
    let query_us = micros_each(clock, timed);
    Ok(NeighbourReport {
        metrics: metrics(&neighbours.predict(rows)?, &test.success),
        query_us,
    })
}

/// Trained with the settings of the whole, standardised and measured like the whole.
fn curve_point(train: &Dataset, test: &Dataset, settings: &Hyperparameters) -> Result<CurvePoint> {
    let scaling = Scaling::of(&train.rows);
    let (rows, tested) = (
        scaling.apply_all(&train.rows),
        scaling.apply_all(&test.rows),
    );
    let clock = Instant::now();
    let machine = train_machine(&rows, &train.success, settings)?;
    let train_s = clock.elapsed().as_secs_f64();
    let scores: Vec<f64> = tested.par_iter().map(|z| machine.score(z)).collect();
    let neighbours = Neighbours::new(&rows, &train.success)?;
    let nearest = metrics(&neighbours.predict(&tested)?, &test.success);
    Ok(CurvePoint {
        train: rows.len(),
        svm: metrics_of_scores(&scores, &test.success).balanced_accuracy,
        nn: nearest.balanced_accuracy,
        train_s,
    })
}

/// The sizes of the curve that can be trained on.
fn sizes(settings: &LearnSettings, train: &Dataset) -> Vec<usize> {
    let possible = |size: &usize| {
        let (successes, failures) = train.head(*size).counts();
        *size <= train.rows.len() && successes.min(failures) >= 2
    };
    let sizes = settings.curve_sizes.iter().copied();
    sizes.filter(possible).collect()
}

/// Accuracy on the test set of the training set's more frequent class.
fn majority(train: &Dataset, test: &Dataset) -> f64 {
    let rate = test.positive_rate();
    if train.positive_rate() >= 0.5 {
        rate
    } else {
        1.0 - rate
    }
}

fn micros_each(clock: Instant, count: usize) -> f64 {
    clock.elapsed().as_secs_f64() * 1e6 / count.max(1) as f64
}

#[cfg(test)]
mod tests;

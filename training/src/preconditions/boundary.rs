//! What was learned, as the file that the framework evaluates.
//!
//! learned machine, report → [`Boundary`].

use aplomb_framework::control::Boundary;
use aplomb_framework::control::boundary::{BoundaryFigures, VERSION};
use aplomb_framework::input::Result;

use crate::preconditions::learning::learned::LearnedPrecondition;
use crate::preconditions::report::Report;

const PROVENANCE: &str =
    "LearnedPrecondition by `aplomb train preconditions` from rollouts with random disturbances.";

/// The boundary of a controller of the character with this digest.
///
/// # Errors
/// A feature that the framework does not know.
pub fn boundary(learned: &LearnedPrecondition, report: &Report, digest: &str) -> Result<Boundary> {
    let svm = &report.svm;
    let figures = BoundaryFigures {
        rollouts: report.train,
        seed: report.seed,
        successes: report.positive_rate,
        kernel: svm.kernel.clone(),
        c: svm.c,
        gamma: svm.gamma,
        support_vectors: svm.support_vectors,
        tested: report.test,
        accuracy: svm.metrics.accuracy,
        balanced_accuracy: svm.metrics.balanced_accuracy,
        balanced_accuracy_of_nearest_neighbour: report.nn.metrics.balanced_accuracy,
        balanced_accuracy_of_hand_written: report.manual.balanced_accuracy,
    };
    Ok(Boundary {
        version: VERSION,
        provenance: PROVENANCE.to_owned(),
        figures: Some(figures),
        controller: report.controller.clone(),
        character: report.character.clone(),
        character_digest: digest.to_owned(),
        features: learned
            .features
            .iter()
            .map(|f| f.parse())
            .collect::<Result<_>>()?,
        mean: learned.scaling.mean.clone(),
        scale: learned.scaling.scale.clone(),
        calibration: learned.calibration,
        decision: learned.decision.clone(),
    })
}

//! What was learned, as the file that the framework evaluates.
//!
//! learned machine, report → [`Boundary`].

use aplomb_framework::control::Boundary;
use aplomb_framework::input::Result;

use crate::preconditions::learning::learned::Learned;
use crate::preconditions::report::Report;

/// The boundary of a controller of the character with this digest.
///
/// # Errors
/// A feature that the framework does not know.
pub fn boundary(learned: &Learned, report: &Report, digest: &str) -> Result<Boundary> {
    let svm = &report.svm;
    let provenance = format!(
        "{} rollouts, seed {}, {} % successes; {} kernel, C {}, gamma {:.4}, {} support vectors. On {} others: \
         {:.1} % right, {:.1} % balanced; nearest neighbour {:.1} %, by hand {:.1} % balanced.",
        report.train,
        report.seed,
        (100.0 * report.positive_rate).round(),
        svm.kernel,
        svm.c,
        svm.gamma,
        svm.support_vectors,
        report.test,
        100.0 * svm.metrics.accuracy,
        100.0 * svm.metrics.balanced_accuracy,
        100.0 * report.nn.metrics.balanced_accuracy,
        100.0 * report.manual.balanced_accuracy,
    );
    Ok(Boundary {
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
        decision: learned.decision.clone(),
        calibration: learned.calibration,
        provenance,
    })
}

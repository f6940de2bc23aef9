//! The studies, one file each. A new one is its file and its line in [`ALL`].

mod basis;
mod clips;
mod falls;
mod interpolation;
mod preconditions;
mod push_limits;
mod robustness;
mod speed;
mod trials;

use super::study::Study;

/// In the order in which they are run.
pub(super) const ALL: &[Study] = &[
    push_limits::STUDY,
    trials::STUDY,
    falls::STUDY,
    clips::STUDY,
    interpolation::STUDY,
    basis::STUDY,
    preconditions::STUDY,
    robustness::STUDY,
    speed::STUDY,
];

//! Learned boundaries between the situations that a controller copes with and those that it does not.
//!
//! boundary file → [`Boundary`]; sensors → score → probability of success.
//!
//! The file is RON text: a readable header, then the numbers. Version 2 begins with `version`,
//! `provenance` and [`BoundaryFigures`]; the vectors of a radial machine stand at its end, packed in strings
//! (`packed.rs` has their format). Version 1 had no `version`, no figures, and vectors as lists; it is
//! still read.

mod bounds;
mod kernel;
mod machine;
mod packed;

pub use bounds::monomials;
pub use kernel::DecisionFunction;
#[cfg(test)]
pub(crate) use machine::tests;
pub use machine::{Boundary, BoundaryFigures, Calibration, LARGEST_BOUNDARY, VERSION};
pub use packed::{MOST_FEATURES, MOST_SUPPORT_VECTORS};

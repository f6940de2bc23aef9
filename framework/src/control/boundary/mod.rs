//! Learned boundaries between the situations that a controller copes with and those that it does not.
//!
//! boundary file → [`Boundary`]; sensors → score → probability of success.

mod bounds;
mod kernel;
mod machine;

pub use bounds::monomials;
pub use kernel::DecisionFunction;
#[cfg(test)]
pub(crate) use machine::tests;
pub use machine::{Boundary, Calibration, LARGEST_BOUNDARY, MOST_FEATURES, MOST_SUPPORT_VECTORS};

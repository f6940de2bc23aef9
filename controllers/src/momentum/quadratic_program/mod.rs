//! A dense dual active-set solver (Goldfarb and Idnani 1983) that allocates nothing after its
//! construction.
//!
//! [`Problem`] → [`ActiveSet`] → [`Solution`].

mod constraints;
mod factor;
mod problem;
mod solver;

pub use problem::{Problem, Rows};
pub use solver::{ActiveSet, Solution};

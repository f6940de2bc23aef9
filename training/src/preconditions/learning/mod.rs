//! Pre-conditions learned from successes and failures (Faloutsos, van de Panne & Terzopoulos 2001).
//!
//! [`dataset`](dataset::Dataset) → [`standardise`] → kernel, C and γ by [`cross_validation`] over [`folds`] →
//! [`machine`] → `polynomial` where the kernel is one → probabilities by [`calibration`];
//! beside it the nearest [`neighbour`]. [`metrics`] of both on a test set. All of it:
//! [`learn`](mod@learn), from two sets that [`split`] accepts to a pre-condition ([`learned`]) and a
//! report with a [`slice`](mod@slice) of it.

pub mod calibration;
pub mod cross_validation;
pub mod dataset;
pub mod folds;
pub mod learn;
pub mod learned;
mod libsvm_solver;
mod linfa_solver;
pub mod machine;
pub mod metrics;
pub mod neighbour;
mod polynomial;
pub mod slice;
pub mod split;
pub mod standardise;
#[cfg(test)]
mod synthetic;
pub mod training;

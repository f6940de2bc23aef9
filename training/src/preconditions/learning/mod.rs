//! Pre-conditions learned from successes and failures (Faloutsos, van de Panne & Terzopoulos 2001).
//!
//! # The idea
//!
//! A controller began in many situations, and in each it succeeded or failed. A support vector machine
//! finds the boundary between the two in the space of features, as far as possible from both; on which side
//! of it a situation lies is the learned pre-condition, how far from it becomes a probability of success.
//!
//! # The way
//!
//! [`dataset`](dataset::Dataset) → [`standardise`] → kernel, C and γ by [`cross_validation`] over [`folds`] →
//! [`machine`] → `polynomial` where the kernel is one → probabilities by [`calibration`];
//! beside it the nearest [`neighbour`]. [`metrics`] of both on a test set. All of it:
//! [`learn`](mod@learn), from two sets that [`split`] accepts to a pre-condition ([`learned`]) and a
//! report with a [`slice`](mod@slice) of it.
//!
//! # The parameters
//!
//! [`LearnSettings::kernels`](learn::LearnSettings) are what is tried: a plane, a polynomial of degree 2 or 3 (as fast
//! to ask as it is small), or radial functions (the most flexible). The price of a violated margin, C, and
//! the kernel's width, γ, are found by cross-validation. Successes and failures weigh alike however many there are.
//!
//! # An example
//!
//! ```
//! # use std::ops::ControlFlow;
//! # use aplomb_training::preconditions::learning::dataset::Dataset;
//! # use aplomb_training::preconditions::learning::learn::{LearnSettings, Subject, learn};
//! # use aplomb_training::preconditions::learning::machine::Kernel;
//! # let samples = |shift: f64| {
//! #     let mut set = Dataset { features: vec!["x".into(), "y".into()], ..Dataset::default() };
//! #     for i in 0..100 {
//! #         let at = |k: i32| 0.3 * f64::from(k) - 1.5 + shift;
//! #         let (x, y) = (at(i % 10), at(i / 10));
//! #         set.rows.push(vec![x, y]);
//! #         set.success.push(x * x + y * y < 1.0);
//! #     }
//! #     set
//! # };
//! // Samples of two features; successes lie within a circle about 0.
//! let (train, test) = (samples(0.0), samples(0.1));
//! let by_hand = vec![true; test.rows.len()]; // a guess that always accepts
//! let settings = LearnSettings { kernels: Kernel::allowed("poly2")?, ..LearnSettings::default() };
//! let subject = Subject { controller: "nod", character: "humanoid", seed: 1 };
//! let watch = |_| ControlFlow::Continue(());
//! let found = learn(subject, &train, &test, &by_hand, &settings, watch)?;
//! let (learned, report) = found.expect("nobody ended it");
//! assert!(learned.score(&[0.0, 0.0]) > 0.0 && learned.score(&[1.4, 1.4]) < 0.0);
//! assert!(report.svm.metrics.balanced_accuracy > report.manual.balanced_accuracy);
//! # Ok::<(), aplomb_framework::Error>(())
//! ```

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

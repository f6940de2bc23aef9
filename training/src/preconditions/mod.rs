//! Pre-conditions learned from rollouts.
//!
//! disturbance → [`rollout`] → [`set`] (dataset with provenance) → [`learning`] → [`boundary`](mod@boundary)
//! file and [`report`].

pub mod boundary;
pub mod learning;
pub mod report;
pub mod rollout;
pub mod set;

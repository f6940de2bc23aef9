//! Rollouts that tell what a controller can really do, and sets of them.
//!
//! - [`boundary`](mod@boundary): what was learned, as the file that the framework reads
//! - [`disturbance`]: how rollouts begin, as data
//! - [`disturbed`]: a character up to where a controller takes over
//! - [`rollout`]: one rollout
//! - [`set`]: many, in parallel, resumable, as a dataset with its provenance

pub mod boundary;
pub mod disturbance;
pub mod disturbed;
mod held;
pub mod rollout;
pub mod set;

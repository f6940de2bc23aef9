//! Where rollouts begin: pushes, disturbances, worlds that the controllers do not know.
//!
//! distribution, random stream → a run up to where a controller takes over.

pub mod disturbance;
pub mod disturbed;
mod held;
pub mod pushes;
mod worlds;

pub(crate) use held::Held;
pub use worlds::Worlds;

//! What a skill is measured by, and the rollouts that measure it.
//!
//! [`skill`] → [`Task`] → starts in random worlds → rollouts → [`Score`].

pub mod falling;
mod impact;
pub mod rising;
pub mod skill;
pub mod standing;
pub mod starts;
pub mod stepping;
mod task;

pub use impact::Impact;
pub use skill::Skill;
pub use task::{Drill, Exercise, Score, Task};

//! What a skill is measured by, and the rollouts that measure it.
//!
//! [`skill`], its file's `exercise` → [`Task`] → starts in random worlds → rollouts → [`Score`].

mod bearing;
pub mod falling;
mod impact;
mod measure;
pub mod rising;
pub mod skill;
pub mod standing;
pub mod starts;
pub mod stepping;
mod task;

pub use impact::Impact;
pub use measure::{Drill, Exercise, Purpose, Score};
pub use skill::Skill;
pub use task::{Blows, Task};

//! Momentum control: linear and angular momentum, poses and swinging feet, as a quadratic program.
//! (2017 paper, section 3.)
//!
//! sensors + [`Reference`] → [`quadratic_program`] → accelerations and forces → torques.

mod control;
mod equality;
mod gains;
mod inequality;
mod objective;
pub mod quadratic_program;
mod reference;
mod upright;

pub use control::{Formulation, Momentum};
pub use gains::Gains;
pub(crate) use reference::sole_centre;
pub use reference::{Reference, Swing};
pub(crate) use upright::{GLIDE, Upright, glided};

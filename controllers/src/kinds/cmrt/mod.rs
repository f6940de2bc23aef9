//! Anticipatory balance: a task's poses, and the centre-of-mass reference trajectory (CMRT) that
//! makes it possible (2014 and 2017 papers).
//!
//! spec → `controller`: `motion` (phases, gains), `waypoint` (poses), `trajectory` (family and
//! interpolation) → `spline` → reference → momentum control.

mod controller;
mod motion;
mod spline;
mod trajectory;
mod waypoint;

pub use controller::{CmrtController, CmrtSpec};
pub use motion::{GainSchedule, MOST_POSES, Motion, PhasedPose, Timeline};
pub use spline::Spline;
pub use trajectory::{Cmrt, FARTHEST, LEAST_GAP, MOST_KNOTS, interpolated, validate};

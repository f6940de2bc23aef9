//! A protective step: the foot goes where the fall is caught, the other beside it.
//!
//! sensors → `controller` (phases) → `aim` (which foot, where to) → momentum control.

mod aim;
mod controller;
mod soles;
mod spec;

pub use controller::Step;
pub use spec::{Placement, StepSpec};

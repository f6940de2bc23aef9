//! What a controller's file usually needs: `use aplomb_framework::prelude::*;`.

pub use std::sync::Arc;

pub use crate::character::Model;
pub use crate::control::{Contract, Controller, Progress, Registry, Spec};
pub use crate::input::{Error, Result};
pub use crate::run::Simulation;
pub use crate::scenario::Scenario;
pub use crate::sensing::{Posture, Sensors};

//! What a controller's file usually needs: `use aplomb_framework::prelude::*;`.

pub use std::sync::Arc;

pub use crate::contract::Contract;
pub use crate::controller::{Controller, Progress};
pub use crate::model::Model;
pub use crate::registry::{Registry, Spec};
pub use crate::scenario::Scenario;
pub use crate::sensors::{Posture, Sensors};
pub use crate::simulation::Simulation;
pub use crate::{Error, Result};

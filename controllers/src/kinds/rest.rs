//! The fallback: accepts every state and lets go, tracking a relaxed pose with low gains, so that
//! something is always active. The 2017 paper's fall controller (section 3.1) is of this kind.
//!
//! Never fails; promises nothing.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Controller, Spec};
use aplomb_framework::input::{Result, check};
use aplomb_framework::sensing::Sensors;
use serde::{Deserialize, Serialize};

use crate::servo::Servo;
use crate::target::{NamedAngles, overlay};

/// Parameters of [`Rest`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RestSpec {
    /// Relaxed pose, rad; joints that are not named are 0.
    pub pose: NamedAngles,
    /// Stiffness relative to the character's nominal servos.
    pub stiffness: f64,
    /// Damping relative to the nominal servos.
    pub damping: f64,
}

impl Default for RestSpec {
    fn default() -> Self {
        Self {
            pose: NamedAngles::new(),
            stiffness: 0.05,
            damping: 0.3,
        }
    }
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Rest {
    contract: Contract,
    servo: Servo,
    pose: Vec<f64>,
}

impl Spec for RestSpec {
    const KIND: &'static str = "rest";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        check::within("stiffness", self.stiffness, 0.0..=1.0)?;
        check::within("damping", self.damping, 0.0..=1.0)?;
        let mut pose = vec![0.0; model.joint_count()];
        overlay(model, &self.pose, &mut pose).map_err(|e| e.inside("pose"))?;
        let servo = Servo::new(model, self.stiffness, self.damping);
        Ok(Box::new(Rest {
            contract,
            servo,
            pose,
        }))
    }
}

impl Controller for Rest {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, _: &Sensors) {}

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.servo.track(now, &self.pose, 1.0, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}

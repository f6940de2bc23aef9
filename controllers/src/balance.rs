//! Standing balance by momentum control (2017 paper, section 3): the centre of mass is kept over a
//! reference point of the base of support while a pose is tracked.
//!
//! Fails when the capture point leaves what the soles, the trunk and the arms can bring back, when
//! a push lifts both feet, or on ground that slides. Its expected performance gives up early, when
//! the capture point is beyond recall, so that falling can begin in time. Near its limit it lifts a
//! leg as a counterweight. Gains: the output of `tune` (CMA-ES over pushes at the limit), with seed
//! and cost in `skills/balance.ron`.

use std::sync::Arc;

use aplomb_framework::contract::Contract;
use aplomb_framework::controller::Controller;
use aplomb_framework::kinematics::Kinematics;
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::sensors::Sensors;
use aplomb_framework::state::State;
use aplomb_framework::{Result, simulation};
use serde::{Deserialize, Serialize};

use crate::gains::Gains;
use crate::momentum::{Formulation, Momentum, Reference};
use crate::servo::Servo;
use crate::target::{NamedAngles, bounded, overlay};

/// How fast the reference centre of mass moves, m/s.
const GLIDE: f64 = 0.3;

/// Parameters of [`Balance`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BalanceSpec {
    /// Which quadratic program.
    pub formulation: Formulation,
    /// Gains and weights.
    pub gains: Gains,
    /// Reference pose, rad; joints that are not named are 0.
    pub pose: NamedAngles,
    /// W: weights of joints within the tracking; those not named have 1.
    pub joint_weights: NamedAngles,
    /// Reference centre of mass ahead of the middle of the soles, m.
    pub com_ahead: f64,
    /// How fast the reference rises from where the centre of mass was found, m/s; at once if left
    /// out. For standing up from a crouch.
    pub climb: Option<f64>,
}

impl Default for BalanceSpec {
    fn default() -> Self {
        Self {
            formulation: Formulation::Inequality,
            gains: Gains::default(),
            pose: NamedAngles::new(),
            joint_weights: NamedAngles::new(),
            com_ahead: 0.0,
            climb: None,
        }
    }
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Balance {
    contract: Contract,
    momentum: Momentum,
    reference: Reference,
    com_ahead: f64,
    climb: Option<f64>,
    /// Height of the centre of mass in the reference pose, m.
    height: f64,
    servo: Servo,
    /// Of the last step, s.
    time: f64,
}

impl Spec for BalanceSpec {
    const KIND: &'static str = "balance";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let place = contract.name.clone();
        self.gains.validate(&place)?;
        bounded(&place, "com_ahead", self.com_ahead, -0.2, 0.2)?;
        bounded(&place, "climb", self.climb.unwrap_or(1.0), 0.01, 10.0)?;
        let mut pose = vec![0.0; model.joint_count()];
        overlay(model, &self.pose, "pose", [-7.0, 7.0], &mut pose)?;
        let mut weights = vec![1.0; model.joint_count()];
        overlay(
            model,
            &self.joint_weights,
            "joint_weights",
            [1e-3, 1e3],
            &mut weights,
        )?;
        Ok(Box::new(Balance {
            momentum: Momentum::new(model, self.formulation, self.gains, weights),
            height: com_height(model, &pose),
            reference: Reference {
                com: [0.0; 2],
                com_velocity: [0.0; 2],
                rates: vec![0.0; pose.len()],
                pose,
                pitch: 0.0,
                swing: None,
            },
            com_ahead: self.com_ahead,
            climb: self.climb,
            servo: Servo::new(model, 0.5, 1.0),
            time: 0.0,
            contract,
        }))
    }
}

/// Height of the centre of mass above the lowest point of a pose with the root upright, m.
pub(crate) fn com_height(model: &Model, pose: &[f64]) -> f64 {
    let mut state = State::standing(model);
    state.q[3..].copy_from_slice(pose);
    simulation::put_on_ground(model, &mut state, 0.0);
    let mut kinematics = Kinematics::new(model);
    kinematics.update(model, &state);
    kinematics.com[1]
}

impl Controller for Balance {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.momentum.reset();
        self.reference.com = now.com;
        if let Some([rear, front]) = now.base_of_support {
            let x = &mut self.reference.com[0];
            *x = x.clamp(rear, front.max(rear));
        }
        self.time = now.time;
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        if let Some(centre) = now.support_centre() {
            // Glides there, so that taking over from another stance is no jerk.
            let passed = (now.time - self.time).clamp(0.0, 0.1);
            let goal = centre + self.com_ahead;
            let x = self.reference.com[0];
            let step = GLIDE * passed;
            let top = now.ground + self.height;
            let y = match self.climb {
                Some(climb) => top.min(self.reference.com[1] + climb * passed),
                None => top,
            };
            self.reference.com = [x + (goal - x).clamp(-step, step), y];
        }
        self.time = now.time;
        let on_ground = now.base_of_support.is_some();
        if !(on_ground && self.momentum.torques(now, &self.reference, torques)) {
            self.servo.track(now, &self.reference.pose, 1.0, torques);
        }
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn reference_com(&self) -> Option<f64> {
        Some(self.reference.com[0])
    }
}

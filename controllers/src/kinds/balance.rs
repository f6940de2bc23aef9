//! Standing balance by momentum control (2017 paper, section 3): the centre of mass is kept over a
//! reference point of the base of support while a pose is tracked.
//!
//! Fails when the capture point leaves what the soles, the trunk and the arms can bring back, when
//! a push lifts both feet, or on ground that slides. Its expected performance gives up early, when
//! the capture point is beyond recall, so that falling can begin in time. Near its limit it lifts a
//! leg as a counterweight. Gains: the output of `tune` (CMA-ES over pushes at the limit), with seed
//! and cost in `skills/balance.ron`.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Controller, Spec};
use aplomb_framework::input::{Result, check};
use aplomb_framework::sensing::Sensors;
use serde::{Deserialize, Serialize};

use crate::idle::{Idle, IdleSpec};
use crate::momentum::{Formulation, GLIDE, Gains, Upright, glided};
use crate::target::NamedAngles;

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
    /// What it does while it only stands.
    pub idle: IdleSpec,
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
            idle: IdleSpec::default(),
        }
    }
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Balance {
    contract: Contract,
    upright: Upright,
    com_ahead: f64,
    climb: Option<f64>,
    idle: Idle,
    /// The pose without what it does while it only stands.
    pose: Vec<f64>,
}

impl BalanceSpec {
    /// Momentum control with its gains and pose.
    ///
    /// # Errors
    /// Numbers out of bounds, unknown joints.
    pub(crate) fn upright(&self, model: &Arc<Model>) -> Result<Upright> {
        let upright = Upright::new(
            model,
            self.formulation,
            self.gains.clone(),
            &self.pose,
            &self.joint_weights,
        )?;
        check::within("com_ahead", self.com_ahead, -0.2..=0.2)?;
        Ok(upright)
    }
}

impl Spec for BalanceSpec {
    const KIND: &'static str = "balance";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let upright = self.upright(model)?;
        check::within("climb", self.climb.unwrap_or(1.0), 0.01..=10.0)?;
        self.idle.check().map_err(|e| e.inside("idle"))?;
        Ok(Box::new(Balance {
            idle: Idle::new(model, &self.idle),
            pose: upright.reference.pose.clone(),
            upright,
            com_ahead: self.com_ahead,
            climb: self.climb,
            contract,
        }))
    }
}

impl Controller for Balance {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.upright.enter(now);
        if let Some([rear, front]) = now.base_of_support {
            let x = &mut self.upright.reference.com[0];
            *x = x.clamp(rear, front.max(rear));
        }
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        let passed = self.upright.passed(now);
        let pose = &mut self.upright.reference.pose;
        self.idle.pose(now, passed, &self.pose, pose);
        if let Some(centre) = now.support_centre() {
            // Glides there, so that taking over from another stance is no jerk.
            let goal = centre + self.com_ahead + self.idle.sway(now);
            let [x, y] = self.upright.reference.com;
            let step = GLIDE * passed;
            let top = now.ground + self.upright.height;
            let y = match self.climb {
                Some(climb) => top.min(y + climb * passed),
                None => top,
            };
            self.upright.reference.com = [glided(x, goal, step), y];
        }
        self.upright.act(now, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn reference_com(&self) -> Option<f64> {
        Some(self.upright.reference.com[0])
    }
}

//! Quiet standing as an inverted pendulum, after the 2001 paper ("Balancing" and the appendix): the
//! ankles place the centre of pressure, the waist bends when they run out of sole.
//!
//! p = c + k (c − c_ref) + d ċ / ω₀ is where the centre of pressure goes, kept inside the soles; the
//! ankles share its moment. Everything else is held by servos. The simplest way to stand, and the
//! example to read first.
//!
//! Fails when the capture point leaves the soles by more than bending the waist brings back. It
//! tolerates small disturbances only; `balance` takes far more. Gains: the output of
//! `tune`, with seed and cost in `skills/stance.ron`.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Controller, Spec};
use aplomb_framework::input::{Result, check};
use aplomb_framework::sensing::Sensors;
use serde::{Deserialize, Serialize};

use crate::servo::Servo;
use crate::target::{NamedAngles, joints_named, overlay};

/// Parameters of [`Stance`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StanceSpec {
    /// Pose that is held, rad; joints that are not named are 0.
    pub pose: NamedAngles,
    /// Stiffness relative to the character's nominal servos.
    pub stiffness: f64,
    /// Where the centre of mass is kept, m ahead of the middle of the soles.
    pub com_ahead: f64,
    /// k: metres of centre of pressure a metre of centre of mass.
    pub position_gain: f64,
    /// d: metres of centre of pressure a metre of ċ / ω₀.
    pub velocity_gain: f64,
    /// rad that the trunk bends a metre of capture point near the soles' ends.
    pub bend_gain: f64,
    /// m of capture point inside the soles' ends at which the bending begins.
    pub bend_margin: f64,
    /// Joint or stem of the ankles.
    pub ankle: String,
    /// Joint or stem that bends the trunk; a forward bend is negative.
    pub waist: String,
}

impl Default for StanceSpec {
    fn default() -> Self {
        Self {
            pose: NamedAngles::new(),
            stiffness: 1.0,
            com_ahead: -0.01,
            position_gain: 1.0,
            velocity_gain: 1.5,
            bend_gain: 4.0,
            bend_margin: 0.03,
            ankle: "ankle".to_owned(),
            waist: "waist".to_owned(),
        }
    }
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Stance {
    contract: Contract,
    spec: StanceSpec,
    servo: Servo,
    pose: Vec<f64>,
    target: Vec<f64>,
    /// The ankles: joint and the link of its foot.
    ankles: Vec<(usize, usize)>,
    waist: Vec<usize>,
}

impl Spec for StanceSpec {
    const KIND: &'static str = "stance";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        for (field, value, low, high) in [
            ("stiffness", self.stiffness, 0.0, 10.0),
            ("com_ahead", self.com_ahead, -0.2, 0.2),
            ("position_gain", self.position_gain, 0.0, 20.0),
            ("velocity_gain", self.velocity_gain, 0.0, 20.0),
            ("bend_gain", self.bend_gain, 0.0, 100.0),
            ("bend_margin", self.bend_margin, -0.1, 0.2),
        ] {
            check::within(field, value, low..=high)?;
        }
        let mut pose = vec![0.0; model.joint_count()];
        overlay(model, &self.pose, &mut pose).map_err(|e| e.inside("pose"))?;
        let ankles = joints_named(model, &self.ankle).map_err(|e| e.inside("ankle"))?;
        let waist = joints_named(model, &self.waist).map_err(|e| e.inside("waist"))?;
        Ok(Box::new(Stance {
            contract,
            servo: Servo::new(model, self.stiffness, 1.0),
            target: pose.clone(),
            pose,
            ankles: ankles.into_iter().map(|j| (j, j + 1)).collect(),
            waist,
            spec: self,
        }))
    }
}

impl Controller for Stance {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, _: &Sensors) {}

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        let spec = &self.spec;
        let ends = now.base_of_support;
        self.target.copy_from_slice(&self.pose);
        if let Some([rear, front]) = ends {
            let (low, high) = (rear + spec.bend_margin, front - spec.bend_margin);
            let beyond = now.capture_point - now.capture_point.clamp(low, high.max(low));
            for joint in &self.waist {
                // Falling forward, the trunk bends forward: its reaction pushes the hips back.
                self.target[*joint] -= (spec.bend_gain * beyond).clamp(-0.4, 1.2);
            }
        }
        self.servo.track(now, &self.target, 1.0, torques);
        let Some([rear, front]) = ends else { return };
        let error = now.com[0] - (0.5 * (rear + front) + spec.com_ahead);
        let drift = now.com_velocity[0] / now.pendulum_rate();
        let cop = now.com[0] + spec.position_gain * error + spec.velocity_gain * drift;
        let cop = cop.clamp(rear, front);
        let share = now.model.total_mass() * now.gravity / self.ankles.len() as f64;
        for (joint, foot) in &self.ankles {
            // The moment of the ground's force about the ankle is carried by the ankle.
            torques[*joint] = -(cop - now.kinematics.links[*foot].origin[0]) * share;
        }
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}

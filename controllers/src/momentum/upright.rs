//! What balancing and stepping share: momentum control towards a reference, and joint servos towards
//! the same pose where no foot is on the ground.
//!
//! gains, pose, weights → [`Upright`]; sensors + its reference → torques.

use std::sync::Arc;

use aplomb_framework::character::{Kinematics, Model, State, put_on_ground};
use aplomb_framework::input::Result;
use aplomb_framework::sensing::Sensors;

use crate::momentum::control::{Formulation, Momentum};
use crate::momentum::gains::Gains;
use crate::momentum::reference::Reference;
use crate::servo::Servo;
use crate::target::{NamedAngles, overlay, overlay_within};

/// How fast the reference centre of mass follows the base of support, m/s.
pub(crate) const GLIDE: f64 = 0.3;

/// A number on its way to a goal, by at most `step`.
pub(crate) fn glided(x: f64, goal: f64, step: f64) -> f64 {
    x + (goal - x).clamp(-step, step)
}

/// Momentum control with its reference.
#[derive(Debug, Clone)]
pub(crate) struct Upright {
    momentum: Momentum,
    servo: Servo,
    /// What is aimed at; whoever steers moves it.
    pub(crate) reference: Reference,
    /// Height of the centre of mass in the reference pose, m.
    pub(crate) height: f64,
    /// Of the last step, s.
    time: f64,
}

impl Upright {
    /// For a character. Joints that `pose` does not name are 0, those that `joint_weights` does not
    /// name have 1.
    ///
    /// # Errors
    /// Gains out of bounds; unknown joints, or values out of bounds.
    pub(crate) fn new(
        model: &Arc<Model>,
        formulation: Formulation,
        gains: Gains,
        pose: &NamedAngles,
        joint_weights: &NamedAngles,
    ) -> Result<Self> {
        gains.validate().map_err(|e| e.inside("gains"))?;
        let mut angles = vec![0.0; model.joint_count()];
        overlay(model, pose, &mut angles).map_err(|e| e.inside("pose"))?;
        let mut weights = vec![1.0; model.joint_count()];
        let weighted = overlay_within(model, joint_weights, 1e-3..=1e3, &mut weights);
        weighted.map_err(|e| e.inside("joint_weights"))?;
        Ok(Self {
            momentum: Momentum::new(model, formulation, gains, weights),
            servo: Servo::new(model, 0.5, 1.0),
            height: com_height(model, &angles),
            reference: Reference {
                com: [0.0; 2],
                com_velocity: [0.0; 2],
                rates: vec![0.0; angles.len()],
                accelerations: vec![0.0; angles.len()],
                pose: angles,
                pitch: 0.0,
                swing: None,
            },
            time: 0.0,
        })
    }

    /// Takes over: the reference begins at the centre of mass.
    pub(crate) fn enter(&mut self, now: &Sensors) {
        self.momentum.reset();
        self.reference.com = now.com;
        self.time = now.time;
    }

    /// Other gains from now on; they are not checked.
    pub(crate) fn set_gains(&mut self, gains: Gains) {
        self.momentum.set_gains(gains);
    }

    /// s since the last step.
    pub(crate) fn passed(&self, now: &Sensors) -> f64 {
        (now.time - self.time).clamp(0.0, 0.1)
    }

    /// Joint torques for this step, N·m.
    pub(crate) fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.time = now.time;
        let on_ground = now.base_of_support.is_some();
        if !(on_ground && self.momentum.torques(now, &self.reference, torques)) {
            self.servo.track(now, &self.reference.pose, 1.0, torques);
        }
    }
}

/// Height of the centre of mass above the lowest point of a pose with the root upright, m.
fn com_height(model: &Model, pose: &[f64]) -> f64 {
    let mut state = State::standing(model);
    state.q[3..].copy_from_slice(pose);
    put_on_ground(model, &mut state, 0.0);
    let mut kinematics = Kinematics::new(model);
    kinematics.update(model, &state);
    kinematics.com[1]
}

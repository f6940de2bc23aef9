//! Momentum control of balance: joint torques that steer linear and angular momentum while a pose
//! is tracked and the feet stay put.
//!
//! After Rabbani, van de Panne, Kry 2017, section 3, equations 1 to 10 (there after Macchietto et
//! al. 2009). Two formulations:
//! - *equality*: the paper's. minimise β_l C_l + β_h C_h + β_t C_t subject to J_s q̈ + J̇_s q̇ = a (6),
//!   then floating-base inverse dynamics: contact forces λ that carry the root (9), torques (10).
//! - *inequality*: one quadratic program over accelerations and contact forces, with the centre of
//!   pressure inside each foot, the friction cone, torque limits and joint ranges as constraints.
//!
//! L̇ is divided by the mass and Ḣ by mass × half a metre, so that the weights compare accelerations
//! and carry over between characters. J̇q̇ and the Coriolis terms, which the paper leaves out, are kept.
//!
//! sensors + [`Reference`] → quadratic program → torques. Nothing is allocated after building.

use std::sync::Arc;

use aplomb_framework::character::{Dynamics, Foot, Model, Point};
use aplomb_framework::math::sin;
use aplomb_framework::sensing::{FootContact, Sensors};
use serde::{Deserialize, Serialize};

use crate::momentum::gains::Gains;
use crate::momentum::quadratic_program::{ActiveSet, Problem};
use crate::momentum::reference::{Reference, sole_centre};

/// Which quadratic program is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Formulation {
    /// The paper's equality-constrained program and inverse dynamics.
    Equality,
    /// With contact, torque and range limits as constraints.
    Inequality,
}

/// The controller's workspace for one character.
#[derive(Debug, Clone)]
pub struct Momentum {
    pub(super) model: Arc<Model>,
    pub(super) formulation: Formulation,
    pub(super) gains: Gains,
    /// W: weight of each joint within the tracking.
    pub(super) weights: Vec<f64>,
    pub(super) dynamics: Dynamics,
    pub(super) problem: Problem,
    pub(super) solver: ActiveSet,
    /// 3 × dof a foot: x and y of its [`pivot`], angle.
    pub(super) feet: Vec<f64>,
    /// a − J̇q̇ of each foot's three rows.
    pub(super) feet_target: Vec<f64>,
    pub(super) acceleration: Vec<f64>,
    /// (f_x, f_y, moment about the [`pivot`]) a foot, N and N·m.
    pub(super) wrench: Vec<f64>,
    /// When the next solution is due, s.
    pub(super) due: f64,
    pub(super) solved: bool,
    /// The foot of the reference's swing.
    pub(super) swinging: Option<usize>,
    /// Weight of its motion.
    pub(super) swing_weight: f64,
}

impl Momentum {
    /// Workspace for a character. `weights` is W, one a joint.
    #[must_use]
    pub fn new(
        model: &Arc<Model>,
        formulation: Formulation,
        gains: Gains,
        weights: Vec<f64>,
    ) -> Self {
        let (dof, feet, joints) = (model.dof(), model.feet.len(), model.joint_count());
        let n = match formulation {
            Formulation::Equality => dof,
            Formulation::Inequality => dof + 3 * feet,
        };
        let (equalities, inequalities) = (3 + 3 * feet, 4 * feet + 4 * joints);
        Self {
            model: Arc::clone(model),
            formulation,
            gains,
            weights,
            dynamics: Dynamics::new(model),
            problem: Problem::new(n, equalities, inequalities),
            solver: ActiveSet::new(n, equalities, inequalities),
            feet: vec![0.0; 3 * dof * feet],
            feet_target: vec![0.0; 3 * feet],
            acceleration: vec![0.0; dof],
            wrench: vec![0.0; 3 * feet],
            due: f64::NEG_INFINITY,
            solved: false,
            swinging: None,
            swing_weight: 0.0,
        }
    }

    /// Forgets the last solution.
    pub fn reset(&mut self) {
        self.due = f64::NEG_INFINITY;
        self.solved = false;
    }

    /// Other gains from the next solution on; they are not checked.
    pub fn set_gains(&mut self, gains: Gains) {
        self.gains = gains;
    }

    /// Joint torques for this step, N·m. Returns whether a solution stands behind them; without
    /// one (no foot on the ground, no feasible program) the last solution's are used, or none.
    pub fn torques(&mut self, now: &Sensors, reference: &Reference, torques: &mut [f64]) -> bool {
        self.dynamics.update(&self.model, &now.state, now.gravity);
        self.swinging = reference.swing.map(|s| s.foot);
        self.swing_weight = reference.swing.map_or(0.0, |s| s.weight);
        self.feet_jacobians(now, reference);
        if now.time >= self.due - 1e-9 {
            self.due = now.time + self.gains.period;
            let outcome = match self.formulation {
                Formulation::Equality => self.solve_equality(now, reference),
                Formulation::Inequality => self.solve_inequality(now, reference),
            };
            self.solved |= outcome;
        }
        self.inverse_dynamics(torques);
        self.solved
    }

    /// u_x = M_x q̈* + h_x − J_sxᵀ λ (10); our λ is the force of the ground on the feet.
    fn inverse_dynamics(&self, torques: &mut [f64]) {
        let n = self.dynamics.dof();
        for (j, torque) in torques.iter_mut().enumerate() {
            let row = &self.dynamics.mass_matrix[(j + 3) * n..(j + 4) * n];
            let mut u = self.dynamics.bias[j + 3] + dot(row, &self.acceleration);
            for (k, w) in self.wrench.iter().enumerate() {
                u -= self.feet[k * n + j + 3] * w;
            }
            *torque = u;
        }
    }

    /// Whether a foot touches and is to carry.
    pub(super) fn carries(&self, f: usize, now: &Sensors) -> bool {
        now.feet[f].touching() && self.swinging != Some(f)
    }

    fn feet_jacobians(&mut self, now: &Sensors, reference: &Reference) {
        let n = self.dynamics.dof();
        let centre_of_touching = now.support_centre();
        for (f, foot) in self.model.feet.iter().enumerate() {
            let rows = &mut self.feet[3 * f * n..3 * (f + 1) * n];
            let contact = &now.feet[f];
            let swing = reference.swing.filter(|s| s.foot == f);
            let centre = match swing {
                Some(_) => sole_centre(foot),
                None => pivot(foot, contact),
            };
            let (position, angle) = rows.split_at_mut(2 * n);
            self.dynamics.point_jacobian(foot.link, centre, position);
            self.dynamics.angle_jacobian(foot.link, angle);
            let velocity = self.dynamics.kinematics.point_velocity(foot.link, centre);
            let bias = self.dynamics.point_bias(foot.link, centre);
            let motion = &self.dynamics.kinematics.links[foot.link];
            let d = self.gains.feet_damping;
            let stiffness = 0.25 * d * d; // critically damped
            let target = &mut self.feet_target[3 * f..3 * f + 3];
            if let Some(s) = swing {
                let p = self.dynamics.kinematics.point(foot.link, centre);
                let damping = 2.0 * s.stiffness.sqrt();
                for k in 0..2 {
                    target[k] = s.stiffness * (s.position[k] - p[k])
                        + damping * (s.velocity[k] - velocity[k])
                        - bias[k];
                }
                target[2] = s.stiffness * sin(s.angle - motion.angle) - damping * motion.rate;
                continue;
            }
            let mut pull = [0.0; 2];
            if let (false, Some(x)) = (contact.touching(), centre_of_touching) {
                let p = self.dynamics.kinematics.point(foot.link, centre);
                pull = [x - p[0], now.ground - p[1]].map(|gap| stiffness * gap);
            }
            target[0] = pull[0] - d * velocity[0] - bias[0];
            target[1] = pull[1] - d * velocity[1] - bias[1];
            // A tilted foot is brought back flat.
            target[2] = -d * motion.rate - stiffness * sin(motion.angle);
        }
    }
}

/// The point of the sole that a foot's rows are about: its centre, or the end that it stands on
/// when it is tilted, about which it turns.
pub(super) fn pivot(foot: &Foot, contact: &FootContact) -> Point {
    match (contact.heel, contact.toe) {
        (true, false) => foot.heel,
        (false, true) => foot.toe,
        _ => sole_centre(foot),
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

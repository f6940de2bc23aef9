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

mod inequality;

use std::sync::Arc;

use aplomb_framework::dynamics::Dynamics;
use aplomb_framework::model::{Foot, Model, Point};
use aplomb_framework::sensors::{FootContact, Sensors};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::gains::Gains;
use crate::quadratic_program::{ActiveSet, Outcome, Problem};

/// Which quadratic program is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Formulation {
    /// The paper's equality-constrained program and inverse dynamics.
    Equality,
    /// With contact, torque and range limits as constraints.
    Inequality,
}

/// What is aimed at.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// c_r, m, world.
    pub com: [f64; 2],
    /// ċ_r, m/s.
    pub com_velocity: [f64; 2],
    /// θ_r: joint angles, rad.
    pub pose: Vec<f64>,
    /// θ̇_r, rad/s.
    pub rates: Vec<f64>,
    /// θ̈ of (2), rad/s².
    pub accelerations: Vec<f64>,
    /// Pitch of the root, rad.
    pub pitch: f64,
    /// A foot that is not to carry but to move, if any.
    pub swing: Option<Swing>,
}

/// Where the sole of a foot is to move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Place of the foot in the model's feet.
    pub foot: usize,
    /// The middle of the sole, m, world.
    pub position: [f64; 2],
    /// m/s
    pub velocity: [f64; 2],
    /// Pitch of the sole, rad.
    pub angle: f64,
    /// Stiffness of the tracking, 1/s²; it is critically damped.
    pub stiffness: f64,
    /// Weight of the tracking in the program.
    pub weight: f64,
}

/// A lever of half a metre makes angular momentum comparable to linear.
const LEVER: f64 = 0.5;
/// Keeps the programs strictly convex.
const RIDGE: f64 = 1e-6;

/// The controller's workspace for one character.
#[derive(Debug, Clone)]
pub struct Momentum {
    model: Arc<Model>,
    formulation: Formulation,
    gains: Gains,
    /// W: weight of each joint within the tracking.
    weights: Vec<f64>,
    dynamics: Dynamics,
    problem: Problem,
    solver: ActiveSet,
    /// 3 × dof a foot: x and y of its [`pivot`], angle.
    feet: Vec<f64>,
    /// a − J̇q̇ of each foot's three rows.
    feet_target: Vec<f64>,
    acceleration: Vec<f64>,
    /// (f_x, f_y, moment about the [`pivot`]) a foot, N and N·m.
    wrench: Vec<f64>,
    /// When the next solution is due, s.
    due: f64,
    solved: bool,
    /// The foot of the reference's swing.
    swinging: Option<usize>,
    /// Weight of its motion.
    swing_weight: f64,
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
    fn carries(&self, f: usize, now: &Sensors) -> bool {
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
                target[2] = s.stiffness * (s.angle - motion.angle).sin() - damping * motion.rate;
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
            target[2] = -d * motion.rate - stiffness * motion.angle.sin();
        }
    }

    /// Rear and front end of what the carrying feet touch with, world x, m: where the centre of
    /// pressure can be. Shorter than the base of support when a foot stands on its edge.
    fn carrying_span(&self, now: &Sensors) -> Option<[f64; 2]> {
        let carrying = (0..now.feet.len()).filter(|f| self.carries(*f, now));
        let ends = carrying.filter_map(|f| now.feet[f].support);
        ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// (L̇_des, Ḣ_des) (1), with the centre of pressure of the force clamped to the support.
    fn desired_momentum(&self, now: &Sensors, reference: &Reference) -> [f64; 3] {
        let (g, m) = (&self.gains, self.model.total_mass());
        let (c, v) = (now.com, now.com_velocity);
        let lx = m * (g.kl * (reference.com[0] - c[0]) + g.dl * (reference.com_velocity[0] - v[0]));
        let ly = m
            * (g.kl_height * (reference.com[1] - c[1])
                + g.dl_height * (reference.com_velocity[1] - v[1]));
        let mut h = -g.dh * now.angular_momentum;
        if let Some([rear, front]) = self.carrying_span(now) {
            let fy = (ly + m * now.gravity).max(0.2 * m * now.gravity);
            let height = now.com_height();
            let cop = c[0] - height * lx / fy;
            let (low, high) = (rear + g.margin, front - g.margin);
            let clamped = if low < high {
                cop.clamp(low, high)
            } else {
                0.5 * (rear + front)
            };
            h += (clamped - cop) * fy;
        }
        [lx, ly, h]
    }

    /// Adds the weighted momentum and tracking objectives (3), (4), (5) to H and g.
    fn objective(&mut self, now: &Sensors, reference: &Reference) {
        let (n, dof) = (self.problem.n, self.dynamics.dof());
        let g = &self.gains;
        let m = self.model.total_mass();
        let desired = self.desired_momentum(now, reference);
        let scales = [1.0 / m, 1.0 / m, 1.0 / (m * LEVER)];
        let betas = [g.linear, g.linear, g.angular];
        self.problem.clear();
        for k in 0..3 {
            let row = &self.dynamics.centroidal_map[k * dof..(k + 1) * dof];
            let target = desired[k] - self.dynamics.centroidal_bias[k];
            let weight = betas[k] * scales[k] * scales[k];
            add_row(&mut self.problem, n, row, target, weight);
        }
        let mut track = |dof: usize, target: f64, weight: f64| {
            self.problem.h[dof * n + dof] += weight;
            self.problem.g[dof] -= weight * target;
        };
        let s = &now.state;
        let pitch = aplomb_framework::state::wrapped(reference.pitch - s.q[2]);
        track(2, g.kt * pitch - g.dt * s.qdot[2], g.tracking * g.root);
        for (j, w) in self.weights.iter().enumerate() {
            let target = g.kt * (reference.pose[j] - s.q[j + 3])
                + g.dt * (reference.rates[j] - s.qdot[j + 3])
                + reference.accelerations[j];
            track(j + 3, target, g.tracking * w);
        }
        for i in 0..n {
            self.problem.h[i * n + i] += RIDGE;
        }
    }

    fn solve_equality(&mut self, now: &Sensors, reference: &Reference) -> bool {
        let dof = self.dynamics.dof();
        self.objective(now, reference);
        for f in 0..now.feet.len() {
            if !self.carries(f, now) {
                continue;
            }
            for k in 3 * f..3 * f + 3 {
                let row = self.problem.equalities.push_row(self.feet_target[k]);
                row.copy_from_slice(&self.feet[k * dof..(k + 1) * dof]);
            }
        }
        if now.base_of_support.is_none() || self.solver.solve(&self.problem) != Outcome::Optimal {
            return false;
        }
        self.acceleration.copy_from_slice(self.solver.x());
        // (9): the least forces of the touching feet that carry the root: λ = J (JᵀJ)⁻¹ r.
        let mut carried = Vector3::zeros();
        let mut gram = Matrix3::zeros();
        for i in 0..3 {
            let row = &self.dynamics.mass_matrix[i * dof..(i + 1) * dof];
            carried[i] = dot(row, &self.acceleration) + self.dynamics.bias[i];
        }
        let root = |k: usize| {
            Vector3::new(
                self.feet[k * dof],
                self.feet[k * dof + 1],
                self.feet[k * dof + 2],
            )
        };
        let rows = |f: usize| 3 * f..3 * f + 3;
        for f in 0..now.feet.len() {
            if !self.carries(f, now) {
                continue;
            }
            for k in rows(f) {
                gram += root(k) * root(k).transpose();
            }
        }
        let Some(inverse) = gram.try_inverse() else {
            return false;
        };
        let share = inverse * carried;
        for f in 0..now.feet.len() {
            for k in rows(f) {
                let on = self.carries(f, now);
                self.wrench[k] = if on { root(k).dot(&share) } else { 0.0 };
            }
        }
        true
    }
}

/// The point of the sole that a foot's rows are about: its centre, or the end that it stands on
/// when it is tilted, about which it turns.
fn pivot(foot: &Foot, contact: &FootContact) -> Point {
    match (contact.heel, contact.toe) {
        (true, false) => foot.heel,
        (false, true) => foot.toe,
        _ => sole_centre(foot),
    }
}

/// The middle of the sole, in the foot's frame.
pub(crate) fn sole_centre(foot: &Foot) -> Point {
    [
        0.5 * (foot.heel[0] + foot.toe[0]),
        0.5 * (foot.heel[1] + foot.toe[1]),
    ]
}

/// Adds weight × (row·x − target)² / 2 to the objective.
fn add_row(problem: &mut Problem, n: usize, row: &[f64], target: f64, weight: f64) {
    for (i, a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
        let wa = weight * a;
        for (h, b) in problem.h[i * n..].iter_mut().zip(row) {
            *h += wa * b;
        }
        problem.g[i] -= wa * target;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

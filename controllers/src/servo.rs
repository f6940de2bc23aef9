//! Proportional-derivative servos at the joints: the muscles' tracking of a target pose.
//!
//! τ = s (kp (θ_target − θ) − kd θ̇), with the character's nominal kp and kd and scales s.
//!
//! Damping of a character with muscle curves is implicit: as if it acted on the rates at the end of the step,
//! which it changes itself, so that a light link does not overshoot and chatter however strongly it is damped
//! (stable PD; Tan, Liu and Turk 2011). With M as of standing upright, that is a constant matrix:
//! τ = −(K_d⁻¹ + Δt W)⁻¹ θ̇, where W is the joints' block of M⁻¹. Without curves each joint has its own damping, less where the joints of a light link damp
//! it so much that it would overshoot within a step.

use aplomb_framework::character::{Dynamics, Model, State};
use aplomb_framework::math::hypot;
use aplomb_framework::sensing::Sensors;
use nalgebra::DMatrix;

/// The step that damping is stable for, s: with one of half of it a rate dies away without changing its sign,
/// in other poses than upright too.
const STEP: f64 = 2e-3;

/// Servos of all joints.
#[derive(Debug, Clone)]
pub struct Servo {
    kp: Vec<f64>,
    /// Joint × joint, N·m·s/rad.
    kd: DMatrix<f64>,
}

impl Servo {
    /// The character's nominal gains times `stiffness` and `damping`.
    #[must_use]
    pub fn new(model: &Model, stiffness: f64, damping: f64) -> Self {
        Self {
            kp: model.joints().map(|j| stiffness * j.kp).collect(),
            kd: damping.min(1.0)
                * if model.joints().any(|j| j.muscles.have_curves()) {
                    implicit_damping(model)
                } else {
                    explicit_damping(model)
                },
        }
    }

    /// One joint's stiffness, N·m/rad.
    #[must_use]
    pub fn stiffness(&self, joint: usize) -> f64 {
        self.kp[joint]
    }

    /// Torques towards target angles (rad) at rest, N·m; `strength` scales the stiffness.
    pub fn track(&self, now: &Sensors, target: &[f64], strength: f64, torques: &mut [f64]) {
        let (angles, rates) = (now.state.angles(), now.state.rates());
        let damping = strength.sqrt().min(1.0);
        for (j, torque) in torques.iter_mut().enumerate() {
            // The matrix is symmetric: its columns, which lie together, are its rows.
            let row = self.kd.column(j);
            let braking: f64 = row
                .iter()
                .zip(rates)
                .map(|(kd, rate)| damping * kd * rate)
                .sum();
            *torque = strength * self.kp[j] * (target[j] - angles[j]) - braking;
        }
    }
}

/// Part of a link's inertia over a step of 1 ms that its joints' explicit damping may come to (2 overshoots).
const MOST_DAMPING: f64 = 1.5;

/// Nominal damping of each joint, reduced where the sum of it on a link exceeds what the link's
/// inertia about its nearest joint bears in a step.
fn explicit_damping(model: &Model) -> DMatrix<f64> {
    let mut sums = vec![0.0; model.links.len()];
    let mut levers = vec![f64::INFINITY; model.links.len()];
    for (i, joint) in model.joints().enumerate() {
        let child = i + 1;
        sums[child] += joint.kd;
        sums[joint.parent] += joint.kd;
        let apart = |link: usize, anchor: [f64; 2]| {
            let com = model.links[link].com;
            hypot(com[0] - anchor[0], com[1] - anchor[1])
        };
        levers[child] = f64::min(levers[child], apart(child, [0.0; 2]));
        levers[joint.parent] = f64::min(levers[joint.parent], apart(joint.parent, joint.anchor));
    }
    let scale = |link: usize| {
        let l = &model.links[link];
        let inertia = l.inertia + l.mass * levers[link] * levers[link];
        (MOST_DAMPING * inertia / (sums[link] * 1e-3)).min(1.0)
    };
    let joints = model.joints().enumerate();
    let reduced = joints.map(|(i, j)| j.kd * scale(i + 1).min(scale(j.parent)));
    DMatrix::from_diagonal(&reduced.collect::<Vec<_>>().into())
}

/// (K_d⁻¹ + Δt W)⁻¹ of the nominal damping.
fn implicit_damping(model: &Model) -> DMatrix<f64> {
    let (dof, joints) = (model.dof(), model.joint_count());
    let mut dynamics = Dynamics::new(model);
    dynamics.update(model, &State::standing(model), 0.0);
    let mass = DMatrix::from_row_slice(dof, dof, &dynamics.mass_matrix);
    let explicit = DMatrix::from_diagonal(&model.joints().map(|j| j.kd).collect::<Vec<_>>().into());
    // Masses and inertias are above 0, so that both have an inverse.
    let Some(mobility) = mass.try_inverse() else {
        return explicit;
    };
    let mut resistance = mobility.view((3, 3), (joints, joints)) * STEP;
    for (j, joint) in model.joints().enumerate() {
        resistance[(j, j)] += 1.0 / joint.kd;
    }
    resistance.try_inverse().unwrap_or(explicit)
}

/// Ease in, ease out: 0 at x ≤ 0, 1 at x ≥ 1, with zero slope at both ends.
#[must_use]
pub fn smoothstep(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn easing_is_monotone_between_its_ends() {
        assert_eq!(
            (smoothstep(-1.0), smoothstep(0.5), smoothstep(2.0)),
            (0.0, 0.5, 1.0)
        );
        let xs: Vec<f64> = (0..=20).map(|i| smoothstep(f64::from(i) / 20.0)).collect();
        assert!(xs.windows(2).all(|w| w[1] > w[0]));
    }

    #[test]
    fn a_servo_pulls_towards_its_target_and_brakes() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        let servo = Servo::new(&model, 1.0, 1.0);
        let (mut target, mut torques) = (vec![0.0; 12], vec![0.0; 12]);
        target[0] = 0.1;
        servo.track(&now, &target, 1.0, &mut torques);
        assert!((torques[0] - 120.0).abs() < 1e-9 && torques[1] == 0.0);
        now.state.qdot[3] = 1.0;
        servo.track(&now, &target, 1.0, &mut torques);
        let braking = 120.0 - torques[0];
        assert!(
            braking > 30.0 && braking < 60.0,
            "the pelvis bears less than the nominal 60"
        );
    }

    /// A rate that is damped alone dies away from step to step without changing its sign.
    #[test]
    fn implicit_damping_never_overshoots() {
        let model = Model::load("humanoid").unwrap();
        let damping = implicit_damping(&model);
        let mut dynamics = Dynamics::new(&model);
        dynamics.update(&model, &State::standing(&model), 0.0);
        let mass = DMatrix::from_row_slice(15, 15, &dynamics.mass_matrix);
        let mobility = mass.try_inverse().unwrap();
        let step = mobility.view((3, 3), (12, 12)) * damping * 1e-3;
        for part in step.complex_eigenvalues().iter() {
            assert!(
                part.re > 0.0 && part.re < 0.6 && part.im.abs() < 1e-9,
                "{part}"
            );
        }
    }
}

//! Proportional-derivative servos at the joints: the muscles' tracking of a target pose.
//!
//! τ = s (kp (θ_target − θ) − kd θ̇), with the character's nominal kp and kd and scales s.
//!
//! Damping acts explicitly, a step late: where the joints of a light link damp it so much that it
//! would overshoot within a step of 1 ms, they are damped less.

use aplomb_framework::character::Model;
use aplomb_framework::math::hypot;
use aplomb_framework::sensing::Sensors;

/// Servos of all joints.
#[derive(Debug, Clone)]
pub struct Servo {
    kp: Vec<f64>,
    kd: Vec<f64>,
}

impl Servo {
    /// The character's nominal gains times `stiffness` and `damping`.
    #[must_use]
    pub fn new(model: &Model, stiffness: f64, damping: f64) -> Self {
        Self {
            kp: model.joints().map(|j| stiffness * j.kp).collect(),
            kd: stable_damping(model)
                .into_iter()
                .map(|kd| damping.min(1.0) * kd)
                .collect(),
        }
    }

    /// One joint's stiffness, N·m/rad.
    #[must_use]
    pub fn stiffness(&self, joint: usize) -> f64 {
        self.kp[joint]
    }

    /// Torques towards target angles (rad) at rest, N·m; `strength` scales the stiffness.
    pub fn track(&self, now: &Sensors, target: &[f64], strength: f64, torques: &mut [f64]) {
        let joints = now.state.angles().iter().zip(now.state.rates()).zip(target);
        let gains = self.kp.iter().zip(&self.kd);
        for ((((angle, rate), target), (kp, kd)), torque) in joints.zip(gains).zip(torques) {
            *torque = strength * kp * (target - angle) - strength.sqrt().min(1.0) * kd * rate;
        }
    }
}

/// The step that explicit damping must be stable for, s.
const STEP: f64 = 1e-3;
/// Part of a link's inertia over the step that its joints' damping may come to (2 overshoots).
const MOST_DAMPING: f64 = 1.5;

/// Nominal damping of each joint, reduced where the sum of it on a link exceeds what the link's
/// inertia about its nearest joint bears in a step.
fn stable_damping(model: &Model) -> Vec<f64> {
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
        (MOST_DAMPING * inertia / (sums[link] * STEP)).min(1.0)
    };
    let joints = model.joints().enumerate();
    joints
        .map(|(i, j)| j.kd * scale(i + 1).min(scale(j.parent)))
        .collect()
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
}

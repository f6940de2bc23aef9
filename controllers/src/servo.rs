//! Proportional-derivative servos at the joints: the muscles' tracking of a target pose.
//!
//! τ = s (kp (θ_target − θ) + kd (θ̇_target − θ̇)), with the character's nominal kp and kd and
//! scales s. Damping is capped so that an explicit step of the lightest link stays stable: kd·dt
//! must stay below twice the inertia that the joint moves.

use aplomb_framework::model::Model;
use aplomb_framework::sensors::Sensors;

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
            kd: model.joints().map(|j| damping.min(1.0) * j.kd).collect(),
        }
    }

    /// Multiplies one joint's gains.
    pub fn scale_joint(&mut self, joint: usize, stiffness: f64, damping: f64) {
        self.kp[joint] *= stiffness;
        self.kd[joint] *= damping;
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
        assert!((torques[0] - 60.0).abs() < 1e-9);
    }
}

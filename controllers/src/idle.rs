//! What a body does that only stands: it sways, breathes, and its head turns to what matters.
//!
//! sensors → small changes of the centre of mass and of the pose that are aimed at. Everything follows from the
//! time and from what is sensed, so that it is the same in every run.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::input::{Result, check};
use aplomb_framework::math::{atan2, sin};
use aplomb_framework::sensing::{SensedProp, Sensors};
use serde::{Deserialize, Serialize};

/// Hz, part of the amplitude, phase: slow shifts of weight, sway, and its ripple.
const SWAY: [[f64; 3]; 4] = [
    [0.043, 0.45, 0.0],
    [0.131, 0.55, 1.0],
    [0.317, 0.3, 2.2],
    [0.743, 0.12, 0.5],
];
/// Breaths, Hz.
const BREATH: f64 = 0.26;
/// m/s; what moves faster is looked at.
const MOVING: f64 = 0.3;
/// m; what is further away is not looked at.
const FAR: f64 = 6.0;
/// The furthest that the head turns up or down, rad.
const MOST: f64 = 0.7;
/// rad/s at which the head turns.
const TURNING: f64 = 4.0;

/// How lively it stands; not at all by default.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IdleSpec {
    /// How far the centre of mass sways, m.
    pub sway: f64,
    /// How far the trunk rises and sinks with the breath, rad.
    pub breath: f64,
    /// Whether the head is kept on the horizon and turns to things that move ahead.
    pub gaze: bool,
}

impl IdleSpec {
    /// # Errors
    /// Numbers out of bounds.
    pub(crate) fn check(&self) -> Result<()> {
        check::within("sway", self.sway, 0.0..=0.05)?;
        check::within("breath", self.breath, 0.0..=0.2)
    }
}

/// For one character.
#[derive(Debug, Clone)]
pub(crate) struct Idle {
    spec: IdleSpec,
    head: usize,
    /// The head's and the trunk's joint.
    neck: Option<usize>,
    waist: Option<usize>,
    /// Where the head is turned to, rad in the world, up positive.
    look: f64,
}

impl Idle {
    pub(crate) fn new(model: &Arc<Model>, spec: &IdleSpec) -> Self {
        Self {
            spec: spec.clone(),
            head: model.head,
            neck: model.head.checked_sub(1),
            waist: model.trunk.checked_sub(1),
            look: 0.0,
        }
    }

    /// How far the centre of mass is off its place now, m.
    pub(crate) fn sway(&self, now: &Sensors) -> f64 {
        let wave = |[rate, part, phase]: [f64; 3]| part * cycle(rate, now.time, phase);
        self.spec.sway * SWAY.into_iter().map(wave).sum::<f64>()
    }

    /// Changes the pose that is aimed at: `from` is what it would be without.
    pub(crate) fn pose(&mut self, now: &Sensors, passed: f64, from: &[f64], pose: &mut [f64]) {
        let breath = self.spec.breath * cycle(BREATH, now.time, 0.0);
        if let Some(waist) = self.waist {
            pose[waist] = from[waist] + breath;
        }
        let Some(neck) = self.neck else { return };
        pose[neck] = from[neck] - breath;
        if self.spec.gaze {
            let step = TURNING * passed;
            self.look += (self.goal(now) - self.look).clamp(-step, step);
            pose[neck] = (self.look - now.trunk_pitch()).clamp(-MOST, MOST);
        }
    }

    /// Where the fastest thing ahead is, or the horizon, rad up.
    fn goal(&self, now: &Sensors) -> f64 {
        let head = now.kinematics.links[self.head].com;
        let root = now.kinematics.links[0].origin[0];
        let speed = |p: &SensedProp| p.velocity[0].abs() + p.velocity[1].abs();
        let seen = |p: &&SensedProp| speed(p) > MOVING && p.ahead > 0.0 && p.ahead < FAR;
        let fastest = now.props.iter().filter(seen);
        let fastest = fastest.max_by(|a, b| speed(a).total_cmp(&speed(b)));
        let pitch = fastest.map_or(0.0, |p| {
            let ahead = (root + p.ahead - head[0]).max(0.1);
            atan2(now.ground + p.height - head[1], ahead)
        });
        pitch.clamp(-MOST, MOST)
    }
}

/// A sine of time, −1 to 1.
fn cycle(rate: f64, time: f64, phase: f64) -> f64 {
    sin(std::f64::consts::TAU * rate * time + phase)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn idle() -> (Idle, Sensors) {
        let model = Model::load("humanoid").unwrap();
        let spec = IdleSpec {
            sway: 0.008,
            breath: 0.01,
            gaze: true,
        };
        (Idle::new(&model, &spec), Sensors::new(&model, 9.81))
    }

    #[test]
    fn it_sways_by_millimetres_around_its_place() {
        let (idle, mut now) = idle();
        let at = |t: u32| {
            now.time = f64::from(t) * 0.1;
            idle.sway(&now)
        };
        let all: Vec<f64> = (0..1200).map(at).collect();
        let mean = all.iter().sum::<f64>() / 1200.0;
        let spread = (all.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 1200.0).sqrt();
        assert!(
            mean.abs() < 1e-3 && spread > 0.003 && spread < 0.006,
            "{mean} {spread}"
        );
    }

    #[test]
    fn it_looks_at_what_comes_and_else_at_the_horizon() {
        let (mut idle, mut now) = idle();
        let neck = now.model.joint_index("neck").unwrap();
        let mut pose = vec![0.0; 12];
        idle.pose(&now, 1.0, &[0.0; 12], &mut pose);
        assert!(pose[neck].abs() < 1e-9);
        let mut ball = SensedProp::new(&"ball".into());
        (ball.ahead, ball.height, ball.velocity) = (2.0, 0.2, [-5.0, 0.0]);
        now.props.push(ball);
        idle.pose(&now, 0.01, &[0.0; 12], &mut pose);
        assert!(
            (pose[neck] + 0.04).abs() < 1e-9,
            "it turns in time: {}",
            pose[neck]
        );
        idle.pose(&now, 1.0, &[0.0; 12], &mut pose);
        assert!(pose[neck] < -0.2, "{}", pose[neck]);
    }
}

//! A motion as data: its phases, the poses that it goes through, and the gains that change while the
//! task is done (2017 paper, sections 4.1 and 6.3.2).
//!
//! [`Motion`] + the command's parameters → [`Timeline`] → phase and weight of the task at a time.

use aplomb_framework::input::{Error, Result, check};
use aplomb_framework::math::powf;
use serde::{Deserialize, Serialize};

use crate::kinds::cmrt::trajectory;
use crate::kinds::cmrt::trajectory::Cmrt;
use crate::momentum::Gains;
use crate::servo::smoothstep;
use crate::target::NamedAngles;

/// At most this many poses a motion.
pub const MOST_POSES: usize = 32;
/// s over which the task's gains come and go.
const RAMP: f64 = 0.15;

/// A pose to go to. Times count phases: 0 to 1 is the preparation, 1 to 2 the task, 2 to 3 the decay.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhasedPose {
    /// Where it begins to leave the pose before.
    pub from: f64,
    /// Where it has arrived.
    pub to: f64,
    /// Angles, rad; joints that are not named keep the last pose's.
    pub pose: NamedAngles,
    /// A foot that is off the ground from then on until the next pose has been reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lifted: Option<String>,
}

/// Factors of the gains while the task is done; they come and go gradually.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GainSchedule {
    /// Of β_t.
    pub tracking: f64,
    /// Of k_t.
    pub kt: f64,
    /// Of d_t.
    pub dt: f64,
    /// Of β_l.
    pub linear: f64,
    /// Of k_l.
    pub kl: f64,
    /// Of d_l.
    pub dl: f64,
}

impl Default for GainSchedule {
    fn default() -> Self {
        Self {
            tracking: 1.0,
            kt: 1.0,
            dt: 1.0,
            linear: 1.0,
            kl: 1.0,
            dl: 1.0,
        }
    }
}

impl GainSchedule {
    fn validate(&self) -> Result<()> {
        for (field, value) in [
            ("tracking", self.tracking),
            ("kt", self.kt),
            ("dt", self.dt),
            ("linear", self.linear),
            ("kl", self.kl),
            ("dl", self.dl),
        ] {
            check::within(field, value, 0.01..=1000.0)?;
        }
        Ok(())
    }

    /// `gains` changed by part of the schedule, 0 to 1. Changes go by equal factors, since some are
    /// of powers of ten.
    #[must_use]
    pub fn scaled(&self, gains: &Gains, part: f64) -> Gains {
        let by = |factor: f64| powf(factor, part);
        Gains {
            tracking: gains.tracking * by(self.tracking),
            kt: gains.kt * by(self.kt),
            dt: gains.dt * by(self.dt),
            linear: gains.linear * by(self.linear),
            kl: gains.kl * by(self.kl),
            dl: gains.dl * by(self.dl),
            ..gains.clone()
        }
    }
}

/// One motion of a clip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// s after the controller's beginning.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub start: f64,
    /// s of all phases together: what preparation and task leave is the decay.
    pub length: f64,
    /// s before the task in which it is anticipated.
    pub preparation: f64,
    /// s that the task takes.
    pub task: f64,
    /// The command's parameter that the task takes as long as, s, in place of `task`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timed_by: Option<String>,
    /// The command's parameter that the trajectories were learned over.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// Poses in the order of time.
    pub keys: Vec<PhasedPose>,
    /// Gains during the task.
    #[serde(default)]
    pub schedule: GainSchedule,
    /// Phases between which the hands are closed, if they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grips: Option<[f64; 2]>,
    /// The family of trajectories, in the order of the parameter; none: no anticipation.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cmrts: Vec<Cmrt>,
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl Motion {
    /// Checks every bound.
    ///
    /// # Errors
    /// Times, phases or gains out of bounds; poses out of order; what the trajectories' check
    /// refuses.
    pub fn validate(&self) -> Result<()> {
        check::within("start", self.start, 0.0..=3600.0)?;
        check::within("length", self.length, 0.1..=600.0)?;
        check::within("preparation", self.preparation, 0.0..=self.length)?;
        let rest = self.length - self.preparation;
        check::within("task", self.task, 0.01..=rest)?;
        check::count("keys", self.keys.len(), 0..=MOST_POSES, "poses")?;
        let mut before = 0.0;
        for (i, key) in self.keys.iter().enumerate() {
            let of = |e: Error| e.inside(("keys", i));
            check::within("from", key.from, before..=3.0).map_err(of)?;
            check::within("to", key.to, key.from + 1e-3..=3.0).map_err(of)?;
            before = key.to;
        }
        if let Some([from, to]) = self.grips {
            check::within(("grips", 0), from, 0.0..=3.0)?;
            check::within(("grips", 1), to, from..=3.0)?;
        }
        self.schedule.validate().map_err(|e| e.inside("schedule"))?;
        trajectory::validate(&self.cmrts).map_err(|e| e.inside("cmrts"))
    }

    /// When its phases are, if the task takes `task` s; it is shortened to leave some decay.
    #[must_use]
    pub fn timeline(&self, task: f64) -> Timeline {
        let most = self.length - self.preparation;
        Timeline {
            start: self.start,
            preparation: self.preparation,
            task: task.clamp(0.01, most),
            length: self.length,
        }
    }
}

/// When the phases of a motion are, s after the controller's beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timeline {
    start: f64,
    preparation: f64,
    task: f64,
    length: f64,
}

impl Timeline {
    /// The time at a phase, 0 to 3.
    #[must_use]
    pub fn time(&self, phase: f64) -> f64 {
        let decay = self.length - self.preparation - self.task;
        let parts = [self.preparation, self.task, decay];
        let mut time = self.start;
        for (i, part) in parts.into_iter().enumerate() {
            time += part * (phase - i as f64).clamp(0.0, 1.0);
        }
        time
    }

    /// s after the motion's own beginning.
    #[must_use]
    pub fn since(&self, time: f64) -> f64 {
        time - self.start
    }

    /// How far the task's gains are in force, 0 to 1.
    #[must_use]
    pub fn task_weight(&self, time: f64) -> f64 {
        let (begin, end) = (self.time(1.0), self.time(2.0));
        smoothstep((time - begin + RAMP) / RAMP) * (1.0 - smoothstep((time - end) / RAMP))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> Motion {
        Motion {
            start: 0.5,
            length: 2.6,
            preparation: 1.0,
            task: 0.4,
            timed_by: None,
            parameter: None,
            keys: Vec::new(),
            schedule: GainSchedule::default(),
            grips: None,
            cmrts: Vec::new(),
        }
    }

    #[test]
    fn phases_follow_each_other() {
        let t = motion().timeline(0.4);
        let times = [0.0, 0.5, 1.0, 2.0, 3.0].map(|phase| t.time(phase));
        for (found, expected) in times.into_iter().zip([0.5, 1.0, 1.5, 1.9, 3.1]) {
            assert!((found - expected).abs() < 1e-12, "{times:?}");
        }
        assert_eq!(t.task_weight(1.7), 1.0);
        assert_eq!((t.task_weight(1.0), t.task_weight(2.2)), (0.0, 0.0));
        assert!(motion().timeline(99.0).time(2.0) <= t.time(3.0));
    }

    #[test]
    fn the_schedule_comes_by_factors() {
        let schedule = GainSchedule {
            kt: 100.0,
            ..GainSchedule::default()
        };
        let gains = Gains::default();
        assert_eq!(schedule.scaled(&gains, 0.0), gains);
        assert!((schedule.scaled(&gains, 0.5).kt - 10.0 * gains.kt).abs() < 1e-9);
    }

    #[test]
    fn poses_out_of_order_are_refused() {
        let key = |from, to| PhasedPose {
            from,
            to,
            pose: NamedAngles::new(),
            lifted: None,
        };
        let mut bad = motion();
        bad.keys = vec![key(1.0, 2.0), key(1.5, 2.5)];
        let told = bad.validate().unwrap_err().to_string();
        assert!(told.contains("keys[1].from"), "{told}");
        bad.keys = vec![key(1.0, f64::NAN)];
        assert!(bad.validate().is_err());
    }
}

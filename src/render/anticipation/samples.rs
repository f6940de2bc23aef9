//! What one recorded rollout shows of a motion, from its beginning to its end.

use anyhow::Result;
use aplomb_framework::run::{Moment, Trajectory};

use super::{LearnedTrajectory, Rollout};
use crate::render::drawable;

/// Steps by which the controller may be over before its motion is.
const EARLY: usize = 3;
/// More than the middle of the base of support moves in a step while the same feet stand, m.
const JUMP: f64 = 5e-3;

/// The samples of a motion, counted from its beginning.
pub(super) struct Samples<'a> {
    recording: &'a Trajectory,
    first: usize,
    /// Number of samples.
    pub(super) len: usize,
    /// s from one to the next.
    pub(super) dt: f64,
    /// The sample at which another controller took over before the end.
    pub(super) left: Option<usize>,
}

impl<'a> Samples<'a> {
    /// # Errors
    /// A recording that cannot be drawn.
    pub(super) fn new(learned: &LearnedTrajectory<'_>, rollout: Rollout<'a>) -> Result<Self> {
        let recording = rollout.recording;
        drawable(recording, 0)?;
        let dt = recording.header.dt;
        let first = recording.step_at(learned.begin);
        let length = (learned.phases[2] / dt).round() as usize;
        let len = (recording.len() - first).min(length + 1);
        let active = |i: &usize| recording.controller(first + i, 0) == learned.controller;
        let entered = (0..len).find(active);
        let left = entered.and_then(|e| (e..len).find(|i| !active(i)));
        Ok(Self {
            recording,
            first,
            len,
            dt,
            left: left.filter(|i| i + EARLY < length),
        })
    }

    fn moment(&self, i: usize) -> Moment<'a> {
        self.recording.moment(self.first + i, 0)
    }

    /// Number of samples of the motion proper, before another controller took over.
    pub(super) fn own(&self) -> usize {
        self.left.unwrap_or(self.len)
    }

    /// s from the motion's beginning to when another controller took over, and its name.
    pub(super) fn successor(&self) -> Option<(f64, &'a str)> {
        let name = |i| self.recording.controller(self.first + i, 0);
        self.left.map(|i| (i as f64 * self.dt, name(i)))
    }

    /// Ends of the base of support from its middle, m.
    pub(super) fn sole(&self, i: usize) -> Option<[f64; 2]> {
        let [rear, front] = self.moment(i).support?.map(f64::from);
        let half = 0.5 * (front - rear);
        Some([-half, half])
    }

    /// Middle of the base of support, world x, m; NaN without support.
    fn middle(&self, i: usize) -> f64 {
        let support = self.moment(i).support;
        support.map_or(f64::NAN, |[rear, front]| {
            0.5 * (f64::from(rear) + f64::from(front))
        })
    }

    /// The error of the centre of pressure, m; NaN without contact.
    pub(super) fn cop_error(&self, i: usize) -> f64 {
        let cop = self.moment(i).cop;
        cop.map_or(f64::NAN, |x| f64::from(x) - self.middle(i))
    }

    /// The centre of mass from the middle of the base of support, m; NaN without support, and where a
    /// foot that touches or leaves moves the middle at once.
    pub(super) fn com(&self, i: usize) -> f64 {
        let middle = self.middle(i);
        let jumps = i > 0 && (middle - self.middle(i - 1)).abs() > JUMP;
        if jumps {
            f64::NAN
        } else {
            f64::from(self.moment(i).com[0]) - middle
        }
    }
}

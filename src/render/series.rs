//! The numbers of one character that are plotted over time.

use aplomb_framework::character::wrapped;
use aplomb_framework::run::Trajectory;

use super::GRAVITY;
use super::body::pose;
use super::chart::range;

/// A character's numbers as they are drawn; NaN where there are none.
pub(super) struct Series<'a> {
    trajectory: &'a Trajectory,
    character: usize,
    /// √(h/g) of the standing character, s.
    pendulum: f64,
    /// rad, against upright
    pub(super) pitch: Vec<f64>,
}

impl<'a> Series<'a> {
    pub(super) fn new(trajectory: &'a Trajectory, character: usize) -> Self {
        let model = &trajectory.models[character];
        let pitch = (0..trajectory.len()).map(|i| {
            wrapped(pose(model, trajectory.moment(i, character).q).links[model.trunk].angle)
        });
        // A turn past ±π is a gap, no line across the chart.
        let mut pitch: Vec<f64> = pitch.collect();
        for i in 1..pitch.len() {
            if (pitch[i] - pitch[i - 1]).abs() > std::f64::consts::PI {
                pitch[i - 1] = f64::NAN;
            }
        }
        Self {
            trajectory,
            character,
            pendulum: (model.standing_com()[1].max(0.0) / GRAVITY).sqrt(),
            pitch,
        }
    }

    pub(super) fn com(&self, step: usize) -> [f64; 2] {
        self.trajectory
            .moment(step, self.character)
            .com
            .map(f64::from)
    }

    pub(super) fn capture(&self, step: usize) -> f64 {
        let moment = self.trajectory.moment(step, self.character);
        f64::from(moment.com[0]) + self.pendulum * f64::from(moment.com_velocity[0])
    }

    pub(super) fn cop(&self, step: usize) -> f64 {
        self.trajectory
            .moment(step, self.character)
            .cop
            .map_or(f64::NAN, f64::from)
    }

    pub(super) fn reference(&self, step: usize) -> f64 {
        self.trajectory
            .moment(step, self.character)
            .reference
            .map_or(f64::NAN, f64::from)
    }

    pub(super) fn support(&self, step: usize) -> Option<[f64; 2]> {
        self.trajectory
            .moment(step, self.character)
            .support
            .map(|s| s.map(f64::from))
    }

    /// The capture point may leave the chart by far; it widens it by 0.3 m at most.
    pub(super) fn positions(&self, len: usize) -> [f64; 2] {
        let each = (0..len).flat_map(|i| {
            let [rear, front] = self.support(i).unwrap_or([f64::NAN; 2]);
            [self.com(i)[0], self.cop(i), self.reference(i), rear, front]
        });
        let [low, high] = range(each, 0.4);
        let captures = (0..len).map(|i| self.capture(i).clamp(low - 0.3, high + 0.3));
        range(captures.chain([low + 0.02, high - 0.02]), 0.4)
    }

    pub(super) fn heights(&self, len: usize) -> [f64; 2] {
        let [_, high] = range((0..len).map(|i| self.com(i)[1]), 0.2);
        let [low, _] = range((0..len).map(|i| self.com(i)[1]).chain([0.0]), 0.2);
        [low.clamp(-0.02, 0.0), high.max(0.5)]
    }

    pub(super) fn pitches(&self, len: usize) -> [f64; 2] {
        range((0..len).map(|i| self.pitch[i]), 0.4)
    }
}

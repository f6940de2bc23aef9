//! What the eye minds and success does not tell: loaded soles that slide, left and right that move as one,
//! restless joints.
//!
//! sensors of every step → means over a rollout → cost.

use aplomb_framework::math::square;
use aplomb_framework::sensing::Sensors;

/// N on a sole; a lighter one may slide.
const LOADED: f64 = 40.0;
/// rad that the angles of two shoulders, and of two hips, differ by when they look like two limbs.
const TWO: [(&str, f64); 2] = [("shoulder", 0.3), ("hip", 0.2)];

/// Gathered over a rollout.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bearing {
    steps: f64,
    /// m by which loaded soles have slid.
    slid: f64,
    same: f64,
    motion: f64,
    /// Joints of the right and of the left, with the difference that makes them two.
    pairs: Vec<(usize, usize, f64)>,
}

impl Bearing {
    /// Nothing has been seen yet.
    #[must_use]
    pub(crate) fn new(now: &Sensors) -> Self {
        let joint = |name: String| now.model.joint_index(&name).ok();
        let pair = |(stem, two): (&str, f64)| {
            Some((
                joint(format!("{stem}_r"))?,
                joint(format!("{stem}_l"))?,
                two,
            ))
        };
        Self {
            pairs: TWO.into_iter().filter_map(pair).collect(),
            ..Self::default()
        }
    }

    /// Takes in a step of `dt` s.
    pub(crate) fn observe(&mut self, now: &Sensors, dt: f64) {
        self.steps += 1.0;
        for (foot, contact) in now.model.feet.iter().zip(&now.feet) {
            if contact.force[1] < LOADED {
                continue;
            }
            let ends = [foot.heel, foot.toe].map(|p| now.kinematics.point(foot.link, p)[1]);
            let lower = if ends[0] < ends[1] {
                foot.heel
            } else {
                foot.toe
            };
            self.slid += dt * now.kinematics.point_velocity(foot.link, lower)[0].abs();
        }
        let angles = now.state.angles();
        let share = 1.0 / self.pairs.len().max(1) as f64;
        for (right, left, two) in &self.pairs {
            let apart = (angles[*right] - angles[*left]).abs();
            self.same += share * (1.0 - apart / two).max(0.0);
        }
        self.motion += now.state.rates().iter().map(|r| square(*r)).sum::<f64>();
    }

    /// Part of the time that left and right were one, 0 to 1.
    #[must_use]
    pub(crate) fn sameness(&self) -> f64 {
        self.same / self.steps.max(1.0)
    }

    /// m by which loaded soles have slid.
    #[must_use]
    pub(crate) fn slid(&self) -> f64 {
        self.slid
    }

    /// Mean of the squared joint rates, (rad/s)².
    #[must_use]
    pub(crate) fn motion(&self) -> f64 {
        self.motion / self.steps.max(1.0)
    }
}

//! The numbers of a step, and their bounds.

use aplomb_framework::character::Model;
use aplomb_framework::input::{Error, Result, check};
use serde::{Deserialize, Serialize};

use crate::momentum::Gains;
use crate::target::NamedAngles;

/// How a foot is put down in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Placement {
    /// s that a protective swing takes.
    pub swing_time: f64,
    /// Part of the way from the edge of the support to the predicted capture point.
    pub reach: f64,
    /// m by which the sole's middle lands beyond that.
    pub beyond: f64,
    /// Highest point of the swing, m.
    pub lift: f64,
    /// Pitch of the root while the step is under way, rad.
    pub lean: f64,
}

impl Placement {
    fn check(&self) -> Result<()> {
        check::within("swing_time", self.swing_time, 0.1..=1.0)?;
        check::within("reach", self.reach, 0.0..=3.0)?;
        check::within("beyond", self.beyond, -0.5..=0.5)?;
        check::within("lift", self.lift, 0.0..=0.5)?;
        check::within("lean", self.lean, -1.0..=1.0)
    }
}

/// Parameters of [`Step`](super::Step) in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepSpec {
    /// Gains and weights of momentum control.
    pub gains: Gains,
    /// Reference pose, rad; joints that are not named are 0.
    pub pose: NamedAngles,
    /// W: weights of joints within the tracking; those not named have 1.
    pub joint_weights: NamedAngles,
    /// Steps forward.
    pub forward: Placement,
    /// Steps backward.
    pub backward: Placement,
    /// Longest step, m.
    pub longest: f64,
    /// 1/s²
    pub swing_stiffness: f64,
    /// Weight of the swinging foot's motion.
    pub swing_weight: f64,
    /// s that the closing step takes.
    pub close_time: f64,
    /// Highest point of the closing step, m.
    pub close_lift: f64,
    /// m by which the capture point may be off the foot that carries when closing begins.
    pub close_within: f64,
    /// m by which the capture point may leave the support before the next step.
    pub margin: f64,
    /// How fast the reference centre of mass moves over the foot, m/s.
    pub glide: f64,
    /// m by which bending the trunk may extend the support.
    pub bend: f64,
    /// How fast the reference rises from where the centre of mass was found, m/s.
    pub climb: f64,
    /// rad that each arm swings a rad that its leg is behind the other.
    #[serde(default)]
    pub arm_swing: f64,
    /// s that pass before the first foot leaves: weight comes off it meanwhile.
    #[serde(default)]
    pub reaction: f64,
    /// Part of a swing in which the foot goes up before it goes anywhere.
    #[serde(default)]
    pub lifting: f64,
    /// Whether the head stays upright however the trunk bends.
    #[serde(default)]
    pub gaze: bool,
}

impl StepSpec {
    /// Checks every number but those of the gains.
    ///
    /// # Errors
    /// Numbers out of bounds; a character without two feet.
    pub(super) fn check(&self, model: &Model) -> Result<()> {
        for (field, placement) in [("forward", &self.forward), ("backward", &self.backward)] {
            placement.check().map_err(|e| e.inside(field))?;
        }
        for (field, value, low, high) in [
            ("longest", self.longest, 0.0, 3.0),
            ("swing_stiffness", self.swing_stiffness, 1.0, 1e4),
            ("swing_weight", self.swing_weight, 1e-6, 1e6),
            ("close_time", self.close_time, 0.1, 2.0),
            ("close_lift", self.close_lift, 0.0, 0.5),
            ("close_within", self.close_within, 0.0, 0.5),
            ("margin", self.margin, -0.1, 0.5),
            ("glide", self.glide, 0.01, 10.0),
            ("bend", self.bend, 0.0, 2.0),
            ("climb", self.climb, 0.01, 10.0),
            ("arm_swing", self.arm_swing, 0.0, 2.0),
            ("lifting", self.lifting, 0.0, 0.5),
            ("reaction", self.reaction, 0.0, 0.5),
        ] {
            check::within(field, value, low..=high)?;
        }
        let feet = model.feet.len();
        if feet != 2 {
            let problem = format!("for a character with {feet} feet");
            return Err(Error::refused("", problem, "one with 2"));
        }
        Ok(())
    }
}

//! What a scenario expects of a run.
//!
//! RON → [`Expectation`] → `run`, which judges it.

use serde::{Deserialize, Serialize};

use crate::control::Condition;
use crate::scenario::limits::LONGEST_RUN;
use crate::scenario::number::Number;
use crate::sensing::Posture;
use crate::world::PropMotion;

/// What a run is expected to show.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Expectation {
    /// Standing (as a run's end is judged) at the end.
    Standing {
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A controller becomes active.
    Active {
        /// Its name.
        name: String,
        /// At this time at the latest, s.
        #[serde(default = "longest")]
        before: f64,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// The character takes on a posture.
    Posture {
        /// Which.
        posture: Posture,
        /// At this time at the latest, s.
        #[serde(default = "longest")]
        before: f64,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// From the beginning nothing but feet supported the character, and at the end its centre of
    /// mass is over the base of support and slower than 0.2 m/s.
    Balanced {
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A condition holds at a time: in the first step at or after it. The end of the run is judged
    /// by its last step.
    Holds {
        /// Which.
        condition: Condition,
        /// s
        at: Number,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A condition holds at some step.
    Reaches {
        /// Which.
        condition: Condition,
        /// At this time at the latest, s.
        #[serde(default = "latest")]
        before: Number,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A prop's frame is or moves within bounds at a time, as for [`Self::Holds`].
    Prop {
        /// Its name.
        name: String,
        /// Which of its numbers.
        what: Quantity,
        /// Lowest value; no bound if left out.
        #[serde(default = "lowest")]
        min: Number,
        /// Highest value; no bound if left out.
        #[serde(default = "highest")]
        max: Number,
        /// s
        at: Number,
    },
}

/// A number of a prop's motion, world frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// m, forward.
    X,
    /// m, up.
    Y,
    /// rad, in (−π, π].
    Angle,
    /// m/s, forward.
    Vx,
    /// m/s, up.
    Vy,
}

impl Quantity {
    /// Its value and unit.
    pub(crate) fn of(self, motion: &PropMotion) -> (f64, &'static str) {
        match self {
            Self::X => (motion.position[0], "m"),
            Self::Y => (motion.position[1], "m"),
            Self::Angle => (motion.angle, "rad"),
            Self::Vx => (motion.velocity[0], "m/s"),
            Self::Vy => (motion.velocity[1], "m/s"),
        }
    }

    /// As in files and messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Angle => "angle",
            Self::Vx => "vx",
            Self::Vy => "vy",
        }
    }
}

fn longest() -> f64 {
    LONGEST_RUN
}

fn latest() -> Number {
    LONGEST_RUN.into()
}

fn lowest() -> Number {
    f64::NEG_INFINITY.into()
}

fn highest() -> Number {
    f64::INFINITY.into()
}

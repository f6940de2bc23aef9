//! What a scenario expects of a run, and whether the run has shown it.
//!
//! RON → [`Expectation`], simulation → nothing, or what is missing, in words.

use serde::Deserialize;

use crate::condition::Condition;
use crate::event::{Event, EventKind};
use crate::scenario::{LONGEST, Number};
use crate::sensors::Posture;
use crate::simulation::Simulation;
use crate::world::PropMotion;

/// What a run is expected to show.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
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
    LONGEST
}

fn latest() -> Number {
    LONGEST.into()
}

fn lowest() -> Number {
    f64::NEG_INFINITY.into()
}

fn highest() -> Number {
    f64::INFINITY.into()
}

impl Expectation {
    /// What a run has not shown, in words; none if it has.
    pub(crate) fn disappointment(&self, run: &Simulation) -> Option<String> {
        match self {
            Self::Balanced { .. }
            | Self::Holds { .. }
            | Self::Reaches { .. }
            | Self::Prop { .. } => match run.watched(self) {
                Some(watch) => watch.disappointment(run.world()),
                None => Some("an expectation that the run's own scenario has not".to_owned()),
            },
            Self::Standing { character } => (!run.outcome(*character).standing)
                .then(|| format!("character {character} does not stand at the end")),
            Self::Active {
                name,
                before,
                character,
            } => {
                let became = |e: &Event| {
                    matches!(&e.kind, EventKind::Switch { to, .. } if to == name)
                        && e.character == *character
                        && e.time <= *before
                };
                (!run.events().iter().any(became))
                    .then(|| format!("'{name}' was not active before {before} s"))
            }
            Self::Posture {
                posture,
                before,
                character,
            } => {
                let seen = run.actors()[*character].first_in(*posture);
                (seen.is_none_or(|t| t > *before))
                    .then(|| format!("not {} before {before} s", posture.name()))
            }
        }
    }
}

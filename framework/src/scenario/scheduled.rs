//! What a scenario does to its world at a time: pushes, commands, and what a person does by hand in a
//! live view.
//!
//! RON → [`ScheduledInput`] → `run`, which does it.

use serde::{Deserialize, Serialize};

use crate::character::{Model, Point};
use crate::input::Result;
use crate::scenario::limits::PUSH_DURATION;
use crate::scenario::number::Number;
use crate::scenario::props::PropEntry;
use crate::world::Dragged;

/// Something done at a time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ScheduledInput {
    /// A push at a link's centre of mass.
    Push {
        /// s
        at: Number,
        /// Name of the link.
        link: String,
        /// Horizontal impulse, N·s, forward positive.
        impulse: Number,
        /// Vertical impulse, N·s, up positive.
        #[serde(default = "none", skip_serializing_if = "is_none")]
        upward: Number,
        /// s over which it is spread evenly.
        #[serde(default = "push_duration", skip_serializing_if = "is_push_duration")]
        over: f64,
        /// Place of the character.
        #[serde(default, skip_serializing_if = "is_first")]
        character: usize,
    },
    /// A command string.
    Command {
        /// s
        at: Number,
        /// For the supervisor. `{NAME}` stands for the value of a parameter, `{-NAME}` for its
        /// negative.
        text: String,
        /// Place of the character.
        #[serde(default, skip_serializing_if = "is_first")]
        character: usize,
    },
    /// A prop appears.
    Throw {
        /// s
        at: Number,
        /// What appears, where, and how fast.
        prop: Box<PropEntry>,
    },
    /// A spring begins to drag a link or a prop, or the one that does moves on.
    Drag {
        /// s
        at: Number,
        /// What is dragged.
        what: DragTarget,
        /// Where it is held, in its own frame, m.
        point: Point,
        /// Where it is dragged to, world, m.
        to: Point,
    },
    /// The spring lets go.
    Release {
        /// s
        at: Number,
    },
    /// A setting of the world changes.
    Set {
        /// s
        at: Number,
        /// Which.
        setting: Changeable,
        /// To what.
        value: Number,
    },
}

/// What can be dragged.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum DragTarget {
    /// A link of a character.
    Link {
        /// Its name.
        name: String,
        /// Place of the character.
        #[serde(default, skip_serializing_if = "is_first")]
        character: usize,
    },
    /// A prop, by its place: those of the scenario first, then those that appear in their order.
    Prop(usize),
}

impl DragTarget {
    /// Which body of the world it is; `model` is the character's.
    ///
    /// # Errors
    /// A link that the character lacks.
    pub fn resolved(&self, model: &Model) -> Result<Dragged> {
        match self {
            Self::Link { name, character } => Ok(Dragged::Link {
                character: *character,
                link: model.link_index(name)?,
            }),
            Self::Prop(prop) => Ok(Dragged::Prop(*prop)),
        }
    }
}

/// A setting that can change during a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Changeable {
    /// Friction coefficient of the ground.
    Friction,
    /// m/s², downwards positive.
    Gravity,
}

impl Changeable {
    /// As in files and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Friction => "friction",
            Self::Gravity => "gravity",
        }
    }

    /// What it may be set to.
    pub(crate) fn accepted(self) -> std::ops::RangeInclusive<f64> {
        match self {
            Self::Friction => 0.0..=10.0,
            Self::Gravity => 0.0..=100.0,
        }
    }
}

impl ScheduledInput {
    /// A horizontal push of the first character's link at a time, s, with an impulse, N·s, spread
    /// over [`PUSH_DURATION`].
    #[must_use]
    pub fn push(at: f64, link: &str, impulse: f64) -> Self {
        Self::Push {
            at: at.into(),
            link: link.to_owned(),
            impulse: impulse.into(),
            upward: none(),
            over: PUSH_DURATION,
            character: 0,
        }
    }

    /// Place of the character that it happens to; the first of what happens to none.
    #[must_use]
    pub fn character(&self) -> usize {
        match self {
            Self::Push { character, .. }
            | Self::Command { character, .. }
            | Self::Drag {
                what: DragTarget::Link { character, .. },
                ..
            } => *character,
            Self::Throw { .. } | Self::Drag { .. } | Self::Release { .. } | Self::Set { .. } => 0,
        }
    }

    /// When, s.
    #[must_use]
    pub fn at(&self) -> &Number {
        match self {
            Self::Push { at, .. }
            | Self::Command { at, .. }
            | Self::Throw { at, .. }
            | Self::Drag { at, .. }
            | Self::Release { at }
            | Self::Set { at, .. } => at,
        }
    }
}

fn none() -> Number {
    Number::Value(0.0)
}

fn is_none(number: &Number) -> bool {
    *number == none()
}

fn push_duration() -> f64 {
    PUSH_DURATION
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_push_duration(over: &f64) -> bool {
    *over == PUSH_DURATION
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_first(character: &usize) -> bool {
    *character == 0
}

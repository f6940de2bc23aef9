//! What a controller is for, as far as others count or judge it.

use serde::{Deserialize, Serialize};

/// What a controller is for. Declared in its contract; counts and pictures go by it, never by a name.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Role {
    /// Stands in place.
    Balance,
    /// Moves a foot so as not to fall.
    Step,
    /// Breaks a fall.
    Fall,
    /// Turns over or lies down on the floor.
    Roll,
    /// Gets up, or a part of the way.
    Rise,
    /// Does what was commanded.
    Task,
    /// Holds or lets go; asks nothing of the situation.
    Rest,
    /// Nothing that others count.
    #[default]
    Other,
}

impl Role {
    /// As in files and JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Balance => "balance",
            Self::Step => "step",
            Self::Fall => "fall",
            Self::Roll => "roll",
            Self::Rise => "rise",
            Self::Task => "task",
            Self::Rest => "rest",
            Self::Other => "other",
        }
    }

    /// Whether it is the one that is assumed where none is declared.
    #[must_use]
    pub fn is_other(&self) -> bool {
        *self == Self::Other
    }
}

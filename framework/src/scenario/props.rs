//! Props and their hinges as a scenario writes them: with parameters for numbers.
//!
//! RON → [`PropEntry`], [`HingeEntry`] → `placing`.

use serde::{Deserialize, Serialize};

use crate::character::Shape;
use crate::scenario::number::Number;

/// A prop of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PropEntry {
    /// For hinges, features, expectations, messages and drawings.
    pub name: String,
    /// Its outline about its own frame. A capsule whose ends coincide is a ball.
    pub shape: Shape,
    /// kg; 0 is fixed to the world.
    pub mass: Number,
    /// Where its frame is at first, m.
    pub position: [Number; 2],
    /// rad
    #[serde(default = "none")]
    pub angle: Number,
    /// m/s
    #[serde(default = "nowhere")]
    pub velocity: [Number; 2],
    /// Friction coefficient.
    #[serde(default = "one")]
    pub friction: Number,
    /// Restitution coefficient.
    #[serde(default = "none")]
    pub restitution: Number,
    /// Force up to which a closed hand can hold it, N; 0 cannot be held.
    #[serde(default = "none")]
    pub grip: Number,
}

/// A hinge between two props, or between a prop and the world. What it joins does not collide.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HingeEntry {
    /// Name of the prop.
    pub prop: String,
    /// The hinge in its frame, m.
    #[serde(default = "nowhere")]
    pub at: [Number; 2],
    /// Name of the other prop; the world if left out.
    #[serde(default)]
    pub to: Option<String>,
    /// The hinge in the other's frame, or in the world's, m; where `at` is at first if left out.
    #[serde(default)]
    pub to_at: Option<[Number; 2]>,
    /// Force above which it breaks, N, low-pass filtered over 10 ms; never if left out.
    #[serde(default)]
    pub breaks: Option<Number>,
}

fn none() -> Number {
    Number::Value(0.0)
}

fn one() -> Number {
    Number::Value(1.0)
}

fn nowhere() -> [Number; 2] {
    [none(), none()]
}

//! A spring between a point of a body and a point of the world: the hand of somebody who drags.
//!
//! [`Pull`] → `drag`, which applies it.

use serde::{Deserialize, Serialize};

use crate::character::Point;

/// What is dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Dragged {
    /// A link of a character.
    Link {
        /// Place of the character.
        character: usize,
        /// Place of the link.
        link: usize,
    },
    /// A prop, by its place.
    Prop(usize),
}

/// A spring from a point of a body to a point of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// What is dragged.
    pub dragged: Dragged,
    /// Where it is held, in the body's frame, m.
    pub point: Point,
    /// Where it is dragged to, world, m.
    pub to: Point,
    /// Force on the body in the last step, N.
    pub force: Point,
}

impl Pull {
    /// A spring that has not pulled yet.
    #[must_use]
    pub fn new(dragged: Dragged, point: Point, to: Point) -> Self {
        Self {
            dragged,
            point,
            to,
            force: [0.0; 2],
        }
    }
}

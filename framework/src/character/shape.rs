//! Outlines of links and props.

use serde::{Deserialize, Serialize};

/// A point or vector in the plane: (x forward, y up), m.
pub type Point = [f64; 2];

/// The outline of a link, in the link's frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Shape {
    /// All points within `radius` of the segment.
    Capsule {
        /// m
        radius: f64,
        /// One end of the axis.
        from: Point,
        /// The other end.
        to: Point,
    },
    /// An upright rectangle.
    Box {
        /// Half width and half height, m.
        half: Point,
        /// Its middle.
        centre: Point,
    },
}

impl Shape {
    /// Its middle, in the frame of what it outlines, m.
    #[must_use]
    pub fn middle(&self) -> Point {
        match *self {
            Self::Capsule { from, to, .. } => [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])],
            Self::Box { centre, .. } => centre,
        }
    }
}

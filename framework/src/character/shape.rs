//! Outlines of links and props.

use serde::{Deserialize, Serialize};

use crate::input::{FieldPath, Result};

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

/// All points within `radius` of a convex polygon: what is drawn of a shape, and how far it reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Corners, counter-clockwise, m; the two ends of a stroke.
    pub corners: Vec<Point>,
    /// m
    pub radius: f64,
}

/// What a world builds of a shape.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Solid {
    /// A disc.
    Ball {
        /// m
        radius: f64,
        /// Its middle, m.
        centre: Point,
    },
    /// All points within `radius` of the segment.
    Capsule {
        /// m
        radius: f64,
        /// The ends of the segment, m.
        ends: [Point; 2],
    },
    /// An upright rectangle.
    Cuboid {
        /// Half width and half height, m.
        half: Point,
        /// Its middle, m.
        centre: Point,
    },
    /// A convex polygon with round corners: what any further shape can be built of.
    Polygon(Outline),
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

    /// Its outline in the frame of what it outlines.
    #[must_use]
    pub fn outline(&self) -> Outline {
        match *self {
            Self::Capsule { radius, from, to } => Outline {
                corners: vec![from, to],
                radius,
            },
            Self::Box { half, centre } => {
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                let corner = |[x, y]: Point| [centre[0] + x * half[0], centre[1] + y * half[1]];
                Outline {
                    corners: corners.map(corner).to_vec(),
                    radius: 0.0,
                }
            }
        }
    }

    /// What a world builds of it.
    #[must_use]
    pub fn solid(&self) -> Solid {
        match *self {
            Self::Capsule { radius, from, to } if from == to => Solid::Ball {
                radius,
                centre: from,
            },
            Self::Capsule { radius, from, to } => Solid::Capsule {
                radius,
                ends: [from, to],
            },
            Self::Box { half, centre } => Solid::Cuboid { half, centre },
        }
    }

    /// Half of its width and of its height, m.
    #[must_use]
    pub fn reach(&self) -> Point {
        match *self {
            Self::Capsule { radius, from, to } => {
                [0, 1].map(|k| radius + 0.5 * (to[k] - from[k]).abs())
            }
            Self::Box { half, .. } => half,
        }
    }

    /// The point of its middle line or inside that is nearest to a point, and half of its thickness, m.
    #[must_use]
    pub fn nearest(&self, to: Point) -> (Point, f64) {
        match *self {
            Self::Capsule {
                radius,
                from,
                to: end,
            } => {
                let d = [end[0] - from[0], end[1] - from[1]];
                let along = (to[0] - from[0]) * d[0] + (to[1] - from[1]) * d[1];
                let t = (along / (d[0] * d[0] + d[1] * d[1]).max(1e-12)).clamp(0.0, 1.0);
                ([from[0] + t * d[0], from[1] + t * d[1]], radius)
            }
            Self::Box { half, centre } => {
                let inside = |k: usize| to[k].clamp(centre[k] - half[k], centre[k] + half[k]);
                ([inside(0), inside(1)], half[0].min(half[1]))
            }
        }
    }

    /// Which shape it is and all its numbers, for digests.
    pub(crate) fn numbers(&self) -> (usize, Vec<f64>) {
        match *self {
            Self::Capsule { radius, from, to } => (0, [&[radius][..], &from, &to].concat()),
            Self::Box { half, centre } => (1, [half, centre].concat()),
        }
    }

    /// Visits its lengths and its points, each with the way to it, until a visit fails.
    ///
    /// # Errors
    /// The visit's.
    pub(crate) fn check(
        &self,
        mut length: impl FnMut(FieldPath, f64) -> Result<()>,
        mut point: impl FnMut(&str, Point) -> Result<()>,
    ) -> Result<()> {
        match *self {
            Self::Capsule { radius, from, to } => {
                length("radius".into(), radius)?;
                point("from", from)?;
                point("to", to)
            }
            Self::Box { half, centre } => {
                length(("half", 0).into(), half[0])?;
                length(("half", 1).into(), half[1])?;
                point("centre", centre)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_reach_as_far_as_the_shape() {
        let capsule = Shape::Capsule {
            radius: 0.1,
            from: [0.0, -0.2],
            to: [0.0, 0.4],
        };
        let plate = Shape::Box {
            half: [0.3, 0.2],
            centre: [1.0, 0.0],
        };
        for shape in [capsule, plate] {
            let Outline { corners, radius } = shape.outline();
            let (middle, reach) = (shape.middle(), shape.reach());
            for k in [0, 1] {
                let highest = corners
                    .iter()
                    .map(|c| c[k] + radius)
                    .fold(f64::MIN, f64::max);
                assert!(
                    (highest - (middle[k] + reach[k])).abs() < 1e-12,
                    "{shape:?}"
                );
            }
        }
        assert_eq!(capsule.nearest([5.0, 0.3]), ([0.0, 0.3], 0.1));
        assert_eq!(plate.nearest([5.0, 0.1]), ([1.3, 0.1], 0.2));
    }
}

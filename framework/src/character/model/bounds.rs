//! Bounds that links and joints share.

use crate::character::shape::Point;
use crate::input::{FieldPath, Result, check};

/// The largest mass, inertia, torque or gain.
pub(super) const MOST: f64 = 1e6;
/// The furthest a point may be from its frame's origin, m.
const FURTHEST: f64 = 100.0;

pub(super) fn point(field: impl Into<FieldPath>, p: Point) -> Result<()> {
    check::point(p, FURTHEST).map_err(|e| e.inside(field))
}

//! Where muscles end: beyond its joint's range none pulls further.
//!
//! orientations of a link and its parent → whether the joint is beyond either end.

use rapier2d::prelude::Rotation;

use crate::character::{Link, Point};
use crate::math::sin_cos;

/// rad beyond its range from which a joint's muscles pull it no further.
const GIVES: f64 = 0.006;

/// Where a link's muscles pull no further, as cosines and sines of its joint's angle.
pub(super) fn ends(link: &Link) -> [Point; 2] {
    let Some(joint) = &link.joint else {
        return [[1.0, 0.0]; 2];
    };
    let [low, high] = joint.range;
    [low - GIVES, high + GIVES].map(|end| {
        let (sin, cos) = sin_cos(end);
        [cos, sin]
    })
}

/// Whether a joint is below its lower end or above its upper one, by less than π/3.
pub(super) fn beyond(child: &Rotation, parent: &Rotation, ends: &[Point; 2]) -> [bool; 2] {
    let [c, s, pc, ps] = [child.cos(), child.sin(), parent.cos(), parent.sin()].map(f64::from);
    let (cos, sin) = (c * pc + s * ps, s * pc - c * ps);
    // Cosine and sine of the angle from an end.
    let from = |[x, y]: Point| (cos * x + sin * y, sin * x - cos * y);
    let [(near_low, low), (near_high, high)] = ends.map(from);
    [near_low > 0.5 && low < 0.0, near_high > 0.5 && high > 0.0]
}

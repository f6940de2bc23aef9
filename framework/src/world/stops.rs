//! Stops of hinges exist for the engine only while a joint is near one: most of the time none is.
//!
//! poses and rates of links → which hinges have their limits on, and which muscles have come to their end.

use rapier2d::prelude::*;

use crate::character::{Link, Point};
use crate::math::sin_cos;
use crate::world::body::Body;

/// rad from a stop within which it is there.
const NEAR: f64 = 0.1;
/// s; further away the faster the joint turns.
const AHEAD: f64 = 0.005;
/// rad beyond its range from which a joint's muscles pull it no further.
const GIVES: f64 = 0.006;

/// Where a link's muscles end to pull, as cosines and sines of its joint's angle.
pub(super) fn stops(link: &Link) -> [Point; 2] {
    let Some(joint) = &link.joint else {
        return [[1.0, 0.0]; 2];
    };
    let [low, high] = joint.range;
    [low - GIVES, high + GIVES].map(|stop| {
        let (sin, cos) = sin_cos(stop);
        [cos, sin]
    })
}

/// Whether a joint is below its lower stop or above its upper one, by less than π/3.
pub(super) fn beyond(child: &Rotation, parent: &Rotation, stops: &[Point; 2]) -> [bool; 2] {
    let [c, s, pc, ps] = [child.cos(), child.sin(), parent.cos(), parent.sin()].map(f64::from);
    let (cos, sin) = (c * pc + s * ps, s * pc - c * ps);
    // Cosine and sine of the angle from a stop.
    let from = |[x, y]: Point| (cos * x + sin * y, sin * x - cos * y);
    let [(near_low, low), (near_high, high)] = stops.map(from);
    [near_low > 0.5 && low < 0.0, near_high > 0.5 && high > 0.0]
}

impl Body {
    /// Takes the limits of hinges away that cannot be met in the next step, and puts back those that can.
    /// A world that never calls it has all of them all the time, which is slower.
    pub fn set_stops(&self, bodies: &RigidBodySet, joints: &mut ImpulseJointSet) {
        for (turn, rate, range, handle) in self.hinges(bodies) {
            let reach = NEAR + AHEAD * rate.abs();
            let near = turn - range[0] < reach || range[1] - turn < reach;
            // Only on a change: to take a joint in order to write makes the engine prepare it anew.
            let has = |j: &ImpulseJoint| j.data.limit_axes.contains(JointAxesMask::ANG_X);
            if joints.get(handle).is_some_and(|j| has(j) != near)
                && let Some(joint) = joints.get_mut(handle, false)
            {
                joint.data.limit_axes.set(JointAxesMask::ANG_X, near);
            }
        }
    }
}

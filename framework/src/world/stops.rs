//! Stops of hinges exist for the engine only while a joint is near one: most of the time none is.
//!
//! poses and rates of links → which hinges have their limits on.

use rapier2d::prelude::*;

use crate::world::body::Body;

/// rad from a stop within which it is there.
const NEAR: f64 = 0.1;
/// s; further away the faster the joint turns.
const AHEAD: f64 = 0.005;

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

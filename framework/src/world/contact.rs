//! Points of contact of a collider, seen from it.
//!
//! engine's contact pairs → [`ContactPoint`]s → sensing, gripping.

use rapier2d::geometry::ContactPair;
use rapier2d::prelude::*;

/// A gap below which a link touches, m.
const TOUCHING: f32 = 3e-3;

/// One point of contact of a collider.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactPoint {
    /// World, m.
    pub(crate) at: [f64; 2],
    /// In the frame of the collider's body, m.
    pub(crate) in_body: [f64; 2],
    /// On the collider, N.
    pub(crate) force: [f64; 2],
    /// Upward part of the contact's normal on the collider.
    pub(crate) normal_up: f32,
    /// m; negative if it overlaps.
    pub(crate) gap: f32,
}

impl ContactPoint {
    /// Whether it touches: the gap is below 3 mm, or there is any force.
    pub(crate) fn touches(&self) -> bool {
        self.gap <= TOUCHING || self.force != [0.0; 2]
    }
}

/// The collider of a pair that is not this one.
pub(crate) fn other(pair: &ContactPair, than: ColliderHandle) -> ColliderHandle {
    if pair.collider1 == than {
        pair.collider2
    } else {
        pair.collider1
    }
}

/// Visits every contact point of a pair, seen from one of its colliders.
pub(crate) fn each_point(
    pair: &ContactPair,
    of: ColliderHandle,
    colliders: &ColliderSet,
    dt: f64,
    mut visit: impl FnMut(ContactPoint),
) {
    let first = pair.collider1 == of;
    let sign = if first { -1.0 } else { 1.0 };
    let collider = &colliders[of];
    for manifold in pair.solver_manifolds() {
        let n = manifold.data.normal;
        let t = Vector::new(-n.y, n.x);
        for point in &manifold.points {
            let local = if first {
                point.local_p1
            } else {
                point.local_p2
            };
            let at = collider.position().transform_point(local);
            let force = n * point.data.impulse + t * point.data.tangent_impulse[0];
            let over = f64::from(sign) / dt;
            let in_body = collider
                .position_wrt_parent()
                .map_or(local, |p| p.transform_point(local));
            visit(ContactPoint {
                at: [f64::from(at.x), f64::from(at.y)],
                in_body: [f64::from(in_body.x), f64::from(in_body.y)],
                force: [f64::from(force.x) * over, f64::from(force.y) * over],
                normal_up: sign * n.y,
                gap: point.dist,
            });
        }
    }
}

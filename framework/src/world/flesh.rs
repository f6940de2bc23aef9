//! Where a character's own limbs meet: trunk and head against the legs, soft as flesh.
//!
//! poses and velocities of two links → overlap of their outlines → forces on both, equal and opposite.
//!
//! Arms pass beside trunk and legs, and one leg beside the other: in the plane that is where they are.

use rapier2d::prelude::*;

use crate::character::{Flesh, Model, Point, Shape, Solid};
use crate::math::{hypot, square};
use crate::world::vector::vector;

/// Part more force a m/s of approach; less when they part, down to nothing.
const DAMPING: f64 = 2.0;
/// Greatest stiffness relative to a pair's reduced mass, 1/s²: stiffer springs would not be stable in steps of
/// 1 ms.
const STIFFEST: f64 = 1e5;
/// m a step by which limbs that were placed within each other are pressed apart.
const PARTING: f64 = 2e-4;

/// A stretch that flesh surrounds: its ends in the link's frame, and the radius, m.
#[derive(Debug, Clone, Copy)]
struct Limb {
    link: usize,
    ends: [Point; 2],
    radius: f64,
}

/// Trunk or head, and a part of a leg.
#[derive(Debug, Clone)]
struct Meeting {
    limbs: [Limb; 2],
    /// Overlap without force, m: where it was placed within itself. It only shrinks, so that such a start
    /// does no blow.
    spared: f64,
    /// Overlap beyond which the force grows no more, m.
    deepest: f64,
}

/// The pairs of one character's links that meet.
#[derive(Debug, Clone)]
pub(super) struct Meetings {
    pairs: Vec<Meeting>,
    flesh: Flesh,
}

/// An outline as a stretch with a radius; none for polygons.
fn limb(link: usize, shape: &Shape) -> Option<Limb> {
    let (ends, radius) = match shape.solid() {
        Solid::Ball { radius, centre } => ([centre; 2], radius),
        Solid::Capsule { radius, ends } => (ends, radius),
        Solid::Cuboid { half, centre } => {
            let radius = half[0].min(half[1]);
            let along = half.map(|h| h - radius);
            let end = |sign: f64| [centre[0] + sign * along[0], centre[1] + sign * along[1]];
            ([end(-1.0), end(1.0)], radius)
        }
        Solid::Polygon(_) => return None,
    };
    Some(Limb { link, ends, radius })
}

impl Meetings {
    /// Of a character that was just placed; none of one without flesh.
    pub(super) fn new(model: &Model) -> Option<Self> {
        let flesh = model.flesh?;
        let of = |link: usize| limb(link, &model.links[link].shape);
        let parent = |link: usize| model.links[link].joint.as_ref().map(|j| j.parent);
        let mut pairs = Vec::new();
        for foot in &model.feet {
            let mut leg = foot.link;
            // Up to the link that hangs on the root.
            while let Some(above) = parent(leg) {
                for upper in [model.trunk, model.head] {
                    let apart = upper != above && upper != leg && parent(upper) != Some(leg);
                    if let (true, Some(a), Some(b)) = (apart, of(upper), of(leg)) {
                        let [m, n] = [upper, leg].map(|link| model.links[link].mass);
                        pairs.push(Meeting {
                            limbs: [a, b],
                            spared: f64::INFINITY,
                            deepest: deepest(flesh, STIFFEST * m * n / (m + n)),
                        });
                    }
                }
                if above == 0 {
                    break;
                }
                leg = above;
            }
        }
        Some(Self { pairs, flesh })
    }

    /// Adds the forces of this step to the links' bodies. Allocates nothing.
    pub(super) fn press(&mut self, links: &[RigidBodyHandle], bodies: &mut RigidBodySet) {
        for pair in &mut self.pairs {
            let [a, b] = &pair.limbs;
            let (upper, leg) = (&bodies[links[a.link]], &bodies[links[b.link]]);
            let Some((normal, at, overlap)) = overlap(a, upper, b, leg) else {
                pair.spared = 0.0;
                continue;
            };
            pair.spared = (pair.spared - PARTING).clamp(0.0, overlap);
            let overlap = (overlap - pair.spared).min(pair.deepest);
            let velocity = |body: &RigidBody| {
                let arm = at - body.position() * body.local_center_of_mass();
                body.linvel() + body.angvel() * Vector::new(-arm.y, arm.x)
            };
            let parting = f64::from(normal.dot(velocity(upper) - velocity(leg)));
            let pressed = square(overlap / self.flesh.gives);
            let spring = self.flesh.stiffness * overlap * (1.0 + pressed * pressed * pressed);
            let force = normal * (spring * (1.0 - DAMPING * parting).max(0.0)) as f32;
            for (link, force) in [(a.link, force), (b.link, -force)] {
                let body = &mut bodies[links[link]];
                let arm = at - body.position() * body.local_center_of_mass();
                body.add_force(force, false);
                body.add_torque(arm.perp_dot(force), false);
            }
        }
    }
}

/// Overlap at which the spring k d (1 + (d/g)⁶) is as stiff as `most`, N/m; its stiffness is k (1 + 7 (d/g)⁶).
fn deepest(flesh: Flesh, most: f64) -> f64 {
    let sixth = ((most / flesh.stiffness - 1.0) / 7.0).max(0.0);
    flesh.gives * libm::cbrt(sixth.sqrt())
}

/// Direction from the second to the first, where they meet, world, and by how much they overlap, m.
fn overlap(
    a: &Limb,
    upper: &RigidBody,
    b: &Limb,
    leg: &RigidBody,
) -> Option<(Vector, Vector, f64)> {
    let place = |limb: &Limb, body: &RigidBody| {
        let ends = limb.ends.map(|end| body.position() * vector(end));
        ends.map(|p| [f64::from(p.x), f64::from(p.y)])
    };
    let (a_ends, b_ends) = (place(a, upper), place(b, leg));
    let reach = a.radius + b.radius;
    // Far apart, as mostly: nothing else is computed.
    for k in 0..2 {
        let [a0, a1] = [
            a_ends[0][k].min(a_ends[1][k]),
            a_ends[0][k].max(a_ends[1][k]),
        ];
        let [b0, b1] = [
            b_ends[0][k].min(b_ends[1][k]),
            b_ends[0][k].max(b_ends[1][k]),
        ];
        if a0 - b1 > reach || b0 - a1 > reach {
            return None;
        }
    }
    let (p, q) = nearest(a_ends, b_ends);
    let gap = [p[0] - q[0], p[1] - q[1]];
    let distance = hypot(gap[0], gap[1]);
    if distance >= reach {
        return None;
    }
    let normal = if distance > 1e-4 {
        gap.map(|g| g / distance)
    } else {
        // One runs across the other: they part the way their middles lie.
        let middle = |e: [Point; 2], k: usize| 0.5 * (e[0][k] + e[1][k]);
        let way = [0, 1].map(|k| middle(a_ends, k) - middle(b_ends, k));
        let length = hypot(way[0], way[1]);
        if length < 1e-9 {
            return None;
        }
        way.map(|w| w / length)
    };
    // In the middle of the overlap.
    let depth = reach - distance;
    let inside = b.radius - 0.5 * depth;
    let at = [q[0] + inside * normal[0], q[1] + inside * normal[1]];
    Some((vector(normal), vector(at), depth))
}

/// The points of two stretches that are nearest to each other.
fn nearest(a: [Point; 2], b: [Point; 2]) -> (Point, Point) {
    let less = |p: Point, q: Point| [p[0] - q[0], p[1] - q[1]];
    let dot = |p: Point, q: Point| p[0] * q[0] + p[1] * q[1];
    let (u, v, w) = (less(a[1], a[0]), less(b[1], b[0]), less(a[0], b[0]));
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w));
    let safe = |x: f64| x.max(1e-12);
    let determinant = uu * vv - uv * uv;
    // On the first stretch, then the nearest on the second, then again on the first.
    let s = if determinant > 1e-12 {
        ((uv * vw - vv * uw) / determinant).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let t = ((uv * s + vw) / safe(vv)).clamp(0.0, 1.0);
    let s = ((uv * t - uw) / safe(uu)).clamp(0.0, 1.0);
    let on = |e: [Point; 2], d: Point, x: f64| [e[0][0] + x * d[0], e[0][1] + x * d[1]];
    (on(a, u, s), on(b, v, t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use crate::character::{Joint, State};
    use crate::world::{Settings, World};

    /// The model in a pose, `angle` of each joint, in a world without weight or ground near.
    fn afloat(angle: impl Fn(&Joint) -> f64) -> (Arc<Model>, World, State) {
        let model = Model::load("humanoid").unwrap();
        let mut world = World::new(Settings {
            gravity: 0.0,
            ..Settings::default()
        });
        let mut state = State::standing(&model);
        state.q[1] += 1.0;
        for (q, joint) in state.q[3..].iter_mut().zip(model.joints()) {
            *q = angle(joint);
        }
        world.spawn(&model, &state);
        (model, world, state)
    }

    #[test]
    fn the_nearest_points_of_two_stretches() {
        let near = |a, b, p: Point, q: Point| {
            let (x, y) = nearest(a, b);
            let off = hypot(x[0] - p[0], x[1] - p[1]) + hypot(y[0] - q[0], y[1] - q[1]);
            assert!(off < 1e-9, "{x:?} {y:?}");
        };
        let level = [[0.0, 0.0], [1.0, 0.0]];
        near(level, [[0.5, 1.0], [0.5, 2.0]], [0.5, 0.0], [0.5, 1.0]);
        near(level, [[2.0, 1.0], [3.0, 1.0]], [1.0, 0.0], [2.0, 1.0]);
        near(level, [[0.5, -1.0], [0.5, 1.0]], [0.5, 0.0], [0.5, 0.0]);
        near(level, [[-1.0, 1.0]; 2], [0.0, 0.0], [-1.0, 1.0]);
    }

    #[test]
    fn trunk_and_head_meet_thighs_shanks_and_feet() {
        let model = Model::load("humanoid").unwrap();
        assert_eq!(Meetings::new(&model).unwrap().pairs.len(), 12);
        let mut without = (*model).clone();
        without.flesh = None;
        assert!(Meetings::new(&without).is_none());
    }

    /// Folded by all its strength, its trunk rests on its thighs; nothing moves the whole.
    #[test]
    fn who_folds_up_is_stopped_by_its_thighs() {
        let (model, mut world, _) = afloat(|_| 0.0);
        let torques: Vec<f64> = model
            .joints()
            .map(|j| match &j.name[..2] {
                "hi" => 200.0,
                "wa" => -200.0,
                _ => 0.0,
            })
            .collect();
        let mut deepest = 0.0f64;
        for _ in 0..1500 {
            world.sense(0);
            world.actuate(0, &torques);
            world.step();
            let body = &world.characters()[0].body;
            for pair in &Meetings::new(&model).unwrap().pairs {
                let [a, b] = &pair.limbs;
                let [upper, leg] = [a, b].map(|l| &world.bodies[body.link(l.link)]);
                if let Some((_, _, depth)) = overlap(a, upper, b, leg) {
                    deepest = deepest.max(depth);
                }
            }
        }
        let now = world.sense(0);
        assert!(deepest > 0.01 && deepest < 0.06, "{deepest} m");
        let drift = hypot(now.com_velocity[0], now.com_velocity[1]);
        assert!(drift < 1e-2, "{drift} m/s");
    }

    /// Placed within itself, it is pressed apart without being thrown.
    #[test]
    fn who_begins_within_itself_parts_without_a_blow() {
        let (model, mut world, state) = afloat(|joint| match &joint.name[..2] {
            "hi" => joint.range[1],
            "wa" => joint.range[0],
            _ => 0.0,
        });
        let limp = vec![0.0; model.joint_count()];
        let mut fastest = 0.0f64;
        for _ in 0..1000 {
            world.sense(0);
            world.actuate(0, &limp);
            world.step();
            let now = world.sense(0);
            fastest = now
                .state
                .rates()
                .iter()
                .fold(fastest, |a, r| a.max(r.abs()));
        }
        let now = world.sense(0);
        let turned = now.state.angles().iter().zip(&state.q[3..]);
        let most = turned.fold(0.0f64, |a, (now, then)| a.max((now - then).abs()));
        assert!(most > 0.05 && fastest < 15.0, "{most} rad, {fastest} rad/s");
    }
}

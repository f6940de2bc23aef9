//! Where every link is and how it moves: forward kinematics of a planar tree, with the centre of
//! mass, its velocity and the angular momentum about it.
//!
//! [`State`] → [`Kinematics`] → sensors, dynamics, controllers. One pass, no allocation.

use crate::character::model::Model;
use crate::character::shape::{Point, Shape};
use crate::character::state::State;
use crate::math::sin_cos;

/// Pose and velocity of one link, world frame.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LinkMotion {
    /// The link frame's origin (its joint), m.
    pub origin: Point,
    /// Velocity of the origin, m/s.
    pub origin_velocity: Point,
    /// Absolute angle, rad, counter-clockwise.
    pub angle: f64,
    /// Its cosine and sine.
    pub turn: [f64; 2],
    /// Angular velocity, rad/s.
    pub rate: f64,
    /// Centre of mass, m.
    pub com: Point,
    /// Velocity of the centre of mass, m/s.
    pub com_velocity: Point,
}

/// Motion of all links and of the whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Kinematics {
    /// One a link, in the model's order.
    pub links: Vec<LinkMotion>,
    /// Centre of mass c of the character, m.
    pub com: Point,
    /// ċ, m/s.
    pub com_velocity: Point,
    /// H: angular momentum about c, kg·m²/s, counter-clockwise.
    pub angular_momentum: f64,
}

/// `v` turned by a link's angle.
#[inline]
pub(crate) fn turned(turn: [f64; 2], v: Point) -> Point {
    [
        turn[0] * v[0] - turn[1] * v[1],
        turn[1] * v[0] + turn[0] * v[1],
    ]
}

impl Kinematics {
    /// Room for the model's links; all zero until the first [`Self::update`].
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self {
            links: vec![LinkMotion::default(); model.links.len()],
            com: [0.0; 2],
            com_velocity: [0.0; 2],
            angular_momentum: 0.0,
        }
    }

    /// Recomputes everything from the state.
    pub fn update(&mut self, model: &Model, state: &State) {
        let (q, qdot) = (&state.q, &state.qdot);
        let mut first_moment = [0.0; 2];
        let mut momentum = [0.0; 2];
        for (i, link) in model.links.iter().enumerate() {
            let (origin, origin_velocity, angle, rate) = match &link.joint {
                None => ([q[0], q[1]], [qdot[0], qdot[1]], q[2], qdot[2]),
                Some(joint) => {
                    let parent = &self.links[joint.parent];
                    let arm = turned(parent.turn, joint.anchor);
                    (
                        [parent.origin[0] + arm[0], parent.origin[1] + arm[1]],
                        [
                            parent.origin_velocity[0] - parent.rate * arm[1],
                            parent.origin_velocity[1] + parent.rate * arm[0],
                        ],
                        parent.angle + q[i + 2],
                        parent.rate + qdot[i + 2],
                    )
                }
            };
            let (sin, cos) = sin_cos(angle);
            let turn = [cos, sin];
            let arm = turned(turn, link.com);
            let com = [origin[0] + arm[0], origin[1] + arm[1]];
            let com_velocity = [
                origin_velocity[0] - rate * arm[1],
                origin_velocity[1] + rate * arm[0],
            ];
            for k in 0..2 {
                first_moment[k] += link.mass * com[k];
                momentum[k] += link.mass * com_velocity[k];
            }
            self.links[i] = LinkMotion {
                origin,
                origin_velocity,
                angle,
                turn,
                rate,
                com,
                com_velocity,
            };
        }
        let m = model.total_mass().max(f64::MIN_POSITIVE);
        self.com = [first_moment[0] / m, first_moment[1] / m];
        self.com_velocity = [momentum[0] / m, momentum[1] / m];
        self.angular_momentum = 0.0;
        for (link, motion) in model.links.iter().zip(&self.links) {
            let arm = [motion.com[0] - self.com[0], motion.com[1] - self.com[1]];
            let v = [
                motion.com_velocity[0] - self.com_velocity[0],
                motion.com_velocity[1] - self.com_velocity[1],
            ];
            self.angular_momentum +=
                link.inertia * motion.rate + link.mass * (arm[0] * v[1] - arm[1] * v[0]);
        }
    }

    /// World position of a point of a link, m.
    #[must_use]
    pub fn point(&self, link: usize, local: Point) -> Point {
        let motion = &self.links[link];
        let arm = turned(motion.turn, local);
        [motion.origin[0] + arm[0], motion.origin[1] + arm[1]]
    }

    /// Velocity of a point of a link, m/s.
    #[must_use]
    pub fn point_velocity(&self, link: usize, local: Point) -> Point {
        let motion = &self.links[link];
        let arm = turned(motion.turn, local);
        [
            motion.origin_velocity[0] - motion.rate * arm[1],
            motion.origin_velocity[1] + motion.rate * arm[0],
        ]
    }
}

/// Moves the root up or down until the character's lowest point is `lift` m above y = 0.
pub fn put_on_ground(model: &Model, state: &mut State, lift: f64) {
    let mut kinematics = Kinematics::new(model);
    kinematics.update(model, state);
    let mut lowest = f64::INFINITY;
    for (i, link) in model.links.iter().enumerate() {
        match link.shape {
            Shape::Capsule { radius, from, to } => {
                for end in [from, to] {
                    lowest = lowest.min(kinematics.point(i, end)[1] - radius);
                }
            }
            Shape::Box { half, centre } => {
                for corner in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                    let p = [
                        centre[0] + corner[0] * half[0],
                        centre[1] + corner[1] * half[1],
                    ];
                    lowest = lowest.min(kinematics.point(i, p)[1]);
                }
            }
        }
    }
    state.q[1] += lift - lowest;
}

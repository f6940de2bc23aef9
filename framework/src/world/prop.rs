//! Things in the world that are no characters, and the hinges between them.
//!
//! scenario → [`Prop`], [`Hinge`] → world, recording.

use std::sync::Arc;

use rapier2d::prelude::*;
use serde::{Deserialize, Serialize};

use crate::character::{Point, Shape, turned};
use crate::world::collider::outline;
use crate::world::vector::vector;

/// A thing in the world that is no character.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Prop {
    /// For messages and drawings.
    pub name: String,
    /// Its outline about its own frame. A capsule whose ends coincide is a ball.
    pub shape: Shape,
    /// kg; 0 is fixed to the world.
    pub mass: f64,
    /// Where its frame is at first, m.
    pub position: Point,
    /// rad
    pub angle: f64,
    /// m/s
    pub velocity: Point,
    /// Friction coefficient.
    pub friction: f64,
    /// Restitution coefficient.
    pub restitution: f64,
    /// Force up to which a hand can hold it, N; 0 cannot be held.
    pub grip: f64,
}

/// A hinge between two props, or between a prop and the world. What it joins does not collide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// Place of the prop.
    pub prop: usize,
    /// The hinge in the prop's frame, m.
    pub at: Point,
    /// Place of the other prop; none is the world.
    pub to: Option<usize>,
    /// The hinge in the other's frame, or in the world's, m.
    pub to_at: Point,
    /// Force at which it breaks, N, low-pass filtered over 10 ms; infinite: never.
    pub breaks: f64,
}

/// Where a prop's frame is and how it moves, world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PropMotion {
    /// m
    pub position: Point,
    /// rad, in (−π, π]
    pub angle: f64,
    /// m/s
    pub velocity: Point,
}

/// A prop in the engine.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub(crate) prop: Prop,
    /// The prop's name, for those who sense it.
    pub(crate) name: Arc<str>,
    pub(crate) body: RigidBodyHandle,
    pub(crate) collider: ColliderHandle,
}

impl Placed {
    /// Puts a prop into the engine's sets.
    pub(crate) fn new(prop: &Prop, bodies: &mut RigidBodySet, colliders: &mut ColliderSet) -> Self {
        let builder = if prop.mass > 0.0 {
            RigidBodyBuilder::dynamic()
        } else {
            RigidBodyBuilder::fixed()
        };
        let rigid = builder
            .pose(Pose::new(vector(prop.position), prop.angle as f32))
            .linvel(vector(prop.velocity))
            .can_sleep(false);
        let body = bodies.insert(rigid);
        let collider = outline(&prop.shape)
            .mass(prop.mass.max(0.0) as f32)
            .friction(prop.friction as f32)
            .restitution(prop.restitution as f32);
        Self {
            prop: prop.clone(),
            name: prop.name.as_str().into(),
            body,
            collider: colliders.insert_with_parent(collider, body, bodies),
        }
    }

    /// Its frame now.
    pub(crate) fn motion(&self, bodies: &RigidBodySet) -> PropMotion {
        let body = &bodies[self.body];
        let (at, turn) = (body.translation(), body.rotation());
        // The engine's velocity is that of the centre of mass, the middle of the outline.
        let arm = turned(
            [turn.cos(), turn.sin()].map(f64::from),
            self.prop.shape.middle(),
        );
        let (v, rate) = (body.linvel(), f64::from(body.angvel()));
        PropMotion {
            position: [f64::from(at.x), f64::from(at.y)],
            angle: f64::from(turn.angle()),
            velocity: [
                f64::from(v.x) + rate * arm[1],
                f64::from(v.y) - rate * arm[0],
            ],
        }
    }
}

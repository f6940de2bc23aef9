//! A hinge of the engine that gives way above a force: between props, or between a hand and a prop.

use rapier2d::prelude::*;

use crate::math::hypot;
use crate::world::settings::Settings;

/// Time constant of the low-pass filter through which a load is judged, s.
const FILTER: f64 = 0.01;

/// What is joined: two bodies, each with the hinge in its own frame.
pub(crate) type Ends = [(RigidBodyHandle, Vector); 2];

/// A hinge between two bodies, which then do not collide.
#[derive(Debug, Clone)]
pub(crate) struct Fastening {
    joint: ImpulseJointHandle,
    /// N; infinite: it never gives way.
    strength: f64,
    /// Filtered force of the hinge, N, in the frame of the first body.
    load: [f64; 2],
}

impl Fastening {
    /// Joins two bodies. A hinge that can break is given this softness, so that its load rises
    /// over several steps; without, it is as stiff as a character's.
    pub(crate) fn new(
        joints: &mut ImpulseJointSet,
        [(first, at), (second, to)]: Ends,
        strength: f64,
        softness: Option<SpringCoefficients<f32>>,
    ) -> Self {
        let mut hinge = RevoluteJointBuilder::new()
            .local_anchor1(at)
            .local_anchor2(to)
            .contacts_enabled(false);
        if let Some(softness) = softness {
            hinge = hinge.softness(softness);
        }
        Self {
            joint: joints.insert(first, second, hinge, true),
            strength,
            load: [0.0; 2],
        }
    }

    /// Takes note of the last step's load; whether the hinge still holds. One that does not is to
    /// be [undone](Self::undo).
    pub(crate) fn bears(&mut self, joints: &ImpulseJointSet, settings: &Settings) -> bool {
        if self.strength == f64::INFINITY {
            return true;
        }
        let Some(joint) = joints.get(self.joint) else {
            return false;
        };
        // The engine tells the impulse of its last substep.
        let over = settings.dt / settings.iterations as f64;
        let share = settings.dt / (FILTER + settings.dt);
        for (load, impulse) in self
            .load
            .iter_mut()
            .zip([joint.impulses[0], joint.impulses[1]])
        {
            *load += share * (f64::from(impulse) / over - *load);
        }
        hypot(self.load[0], self.load[1]) <= self.strength
    }

    /// Takes the hinge out of the engine.
    pub(crate) fn undo(self, joints: &mut ImpulseJointSet) {
        joints.remove(self.joint, true);
    }
}

/// A hinge that holds, and the places of the props that it joins.
#[derive(Debug, Clone)]
pub(super) struct Joined {
    pub(super) prop: usize,
    /// None is the world.
    pub(super) to: Option<usize>,
    pub(super) fastening: Fastening,
}

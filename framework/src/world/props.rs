//! Props of a world: hinged, held, sensed.
//!
//! [`Prop`], [`Hinge`], closed hands → engine; engine → poses, what characters sense of them.

use rapier2d::prelude::*;

use crate::events::EventKind;
use crate::sensing::SensedProp;
use crate::world::engine::World;
use crate::world::fastening::{Fastening, Joined};
use crate::world::grip::Touched;
use crate::world::prop::{Hinge, Placed, Prop, PropMotion};
use crate::world::vector::vector;

/// Natural frequency of a prop's hinge that can break, Hz: stiff, but slow enough for its load to
/// be seen.
const BREAKABLE: f32 = 120.0;

impl World {
    /// Adds a prop; returns its place in [`Self::prop_poses`].
    pub fn add_prop(&mut self, prop: &Prop) -> usize {
        let placed = Placed::new(prop, &mut self.bodies, &mut self.colliders);
        self.props.push(placed);
        self.props.len() - 1
    }

    /// Hinges a prop to another or to the world; returns the hinge's place for
    /// [`Self::hinge_holds`].
    ///
    /// # Panics
    /// If there are no such props.
    pub fn add_hinge(&mut self, hinge: &Hinge) -> usize {
        let other = match hinge.to {
            Some(other) => self.props[other].body,
            None => *self
                .anchor
                .get_or_insert_with(|| self.bodies.insert(RigidBodyBuilder::fixed())),
        };
        let ends = [
            (other, vector(hinge.to_at)),
            (self.props[hinge.prop].body, vector(hinge.at)),
        ];
        let softness = SpringCoefficients::new(BREAKABLE, 1.0);
        let softness = hinge.breaks.is_finite().then_some(softness);
        let joints = &mut self.impulse_joints;
        let fastening = Fastening::new(joints, ends, hinge.breaks, softness);
        self.hinges.push(Some(Joined {
            prop: hinge.prop,
            to: hinge.to,
            fastening,
        }));
        self.hinges.len() - 1
    }

    /// Whether a hinge of props has not broken.
    #[must_use]
    pub fn hinge_holds(&self, hinge: usize) -> bool {
        self.hinges[hinge].is_some()
    }

    /// Closes or opens a character's hands. While they are closed, they take what can be held and
    /// touches them; when they open, they let go.
    pub fn grip(&mut self, character: usize, closed: bool) {
        self.grips[character].close(closed, &mut self.impulse_joints);
    }

    /// Whether a character holds a prop.
    #[must_use]
    pub fn holds(&self, character: usize, prop: usize) -> bool {
        self.grips[character].holds(prop)
    }

    /// The props.
    pub fn props(&self) -> impl Iterator<Item = &Prop> {
        self.props.iter().map(|p| &p.prop)
    }

    /// (x, y, angle) of every prop, m and rad, in single precision as in the engine.
    pub fn prop_poses(&self) -> impl Iterator<Item = [f32; 3]> {
        self.props.iter().map(|p| {
            let body = &self.bodies[p.body];
            let at = body.translation();
            [at.x, at.y, body.rotation().angle()]
        })
    }

    /// Where a prop is and how it moves.
    #[must_use]
    pub fn prop_motion(&self, prop: usize) -> PropMotion {
        self.props[prop].motion(&self.bodies)
    }

    /// Brings what a character knows of the props up to date. Allocates only if there are more or
    /// fewer than there were.
    pub(super) fn sense_props(&mut self, character: usize) {
        let sensors = &mut self.characters[character].sensors;
        if sensors.props.len() != self.props.len() {
            let sensed = self.props.iter().map(|p| SensedProp::new(&p.name));
            sensors.props = sensed.collect();
        }
        let grips = &self.grips[character];
        let (x, ground) = (sensors.state.q[0], sensors.ground);
        for (i, (sensed, placed)) in sensors.props.iter_mut().zip(&self.props).enumerate() {
            let motion = placed.motion(&self.bodies);
            sensed.ahead = motion.position[0] - x;
            sensed.height = motion.position[1] - ground;
            sensed.velocity = motion.velocity;
            sensed.held = grips.holds(i);
        }
    }

    /// Closed hands take what they touch.
    pub(super) fn take_hold(&mut self) {
        let touched = Touched {
            bodies: &self.bodies,
            colliders: &self.colliders,
            narrow_phase: &self.narrow_phase,
        };
        let joints = &mut self.impulse_joints;
        for (i, (character, grips)) in self.characters.iter().zip(&mut self.grips).enumerate() {
            let (body, props) = (&character.body, &self.props);
            let events = &mut self.events;
            grips.take(body, props, self.steps, &touched, joints, |link, prop| {
                let link = body.model().links[link].name.clone();
                let prop = props[prop].prop.name.clone();
                events.push((i, EventKind::Grasped { link, prop }));
            });
        }
    }

    /// What the last step has overloaded slips or breaks.
    pub(super) fn give_way(&mut self) {
        let joints = &mut self.impulse_joints;
        for (i, (character, grips)) in self.characters.iter().zip(&mut self.grips).enumerate() {
            let (body, props) = (&character.body, &self.props);
            let events = &mut self.events;
            grips.slip(body, self.steps, joints, &self.settings, |link, prop| {
                let link = body.model().links[link].name.clone();
                let prop = props[prop].prop.name.clone();
                events.push((i, EventKind::Slipped { link, prop }));
            });
        }
        for hinge in &mut self.hinges {
            let overloaded = |h: &mut Joined| !h.fastening.bears(joints, &self.settings);
            if let Some(broken) = hinge.take_if(overloaded) {
                let name = |prop: usize| self.props[prop].prop.name.clone();
                let kind = EventKind::Broke {
                    prop: name(broken.prop),
                    from: broken.to.map(name),
                };
                self.events.push((0, kind));
                broken.fastening.undo(joints);
            }
        }
    }
}

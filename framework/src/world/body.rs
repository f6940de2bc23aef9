//! A character in rapier sets that anybody owns and steps: spawn, sense, actuate.
//!
//! [`Model`] + [`State`] → rigid bodies, colliders and hinges; after each step of their owner
//! → [`Sensors`]; before each step torques → hinges. With `world.rs` and its parts the only file that names
//! the engine. The engine's numbers are single precision; sensed states are rounded to it, so that a
//! recorded state is the sensed state, bit for bit.

use std::sync::Arc;

use rapier2d::prelude::*;

use crate::character::{Joint, Kinematics, Model, Point, State, turned, wrapped};
use crate::math::{hypot, sin_cos};
use crate::sensing::{FootContact, LinkContact, Sensors};
use crate::world::collider::outline;
use crate::world::contact::{each_point, other};
use crate::world::ends::{beyond, ends};
use crate::world::flesh::Meetings;
use crate::world::vector::vector;

/// A contact within this distance of a knee's hinge is the knee's, m.
const KNEE: f64 = 0.1;
/// A contact supports a link if its normal on the link points up by at least this.
const SUPPORTING: f32 = 0.5;
/// Friction of a character's skin. The smaller coefficient of a contact counts, so that in
/// practice the ground's or prop's does.
const SKIN_FRICTION: f32 = 2.0;

/// A character's bodies, colliders and hinges in rapier sets.
///
/// The whole loop, with a world that is stepped, is in `examples/embed.rs`.
///
/// ```
/// # use aplomb_framework::rapier2d::prelude::{ColliderSet, ImpulseJointSet, RigidBodySet};
/// # use aplomb_framework::{Model, character::State, world::Body};
/// let (mut bodies, mut colliders) = (RigidBodySet::new(), ColliderSet::new());
/// let mut joints = ImpulseJointSet::new();
/// let model = Model::load("humanoid")?;
/// let start = State::standing(&model);
/// let mut body = Body::spawn(&model, &start, 0, &mut bodies, &mut colliders, &mut joints);
/// assert_eq!((bodies.len(), joints.len()), (model.links.len(), model.joint_count()));
/// // Each step: the engine's step, body.sense, a supervisor's act, and
/// body.actuate(&mut bodies, &vec![0.0; model.joint_count()]);
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Body {
    model: Arc<Model>,
    links: Vec<RigidBodyHandle>,
    colliders: Vec<ColliderHandle>,
    joints: Vec<ImpulseJointHandle>,
    /// See [`Model::knee`], one a link.
    knees: Vec<Option<Point>>,
    meetings: Option<Meetings>,
    /// Where each link's muscles pull no further.
    ends: Vec<[Point; 2]>,
}

/// Rounded to the engine's precision.
fn rounded(x: f64) -> f64 {
    f64::from(x as f32)
}

impl Body {
    /// Adds the character to the sets in the given state. Links of one character pass through
    /// each other; `layer` (0 to 15) tells characters in one world apart.
    ///
    /// The hinges are impulse joints with limits; the links never sleep.
    pub fn spawn(
        model: &Arc<Model>,
        state: &State,
        layer: u8,
        bodies: &mut RigidBodySet,
        colliders: &mut ColliderSet,
        joints: &mut ImpulseJointSet,
    ) -> Self {
        let mut kinematics = Kinematics::new(model);
        kinematics.update(model, state);
        let own = Group::from_bits_truncate(1 << (layer % 16));
        let groups = InteractionGroups::new(own, own.complement(), InteractionTestMode::And);
        let mut body = Self {
            model: Arc::clone(model),
            links: Vec::with_capacity(model.links.len()),
            colliders: Vec::with_capacity(model.links.len()),
            joints: Vec::with_capacity(model.joint_count()),
            knees: (0..model.links.len()).map(|l| model.knee(l)).collect(),
            meetings: Meetings::new(model),
            ends: model.links.iter().map(ends).collect(),
        };
        for (link, motion) in model.links.iter().zip(&kinematics.links) {
            let rigid = RigidBodyBuilder::dynamic()
                .pose(Pose::new(vector(motion.origin), motion.angle as f32))
                .linvel(vector(motion.com_velocity))
                .angvel(motion.rate as f32)
                .can_sleep(false)
                .additional_mass_properties(MassProperties::new(
                    vector(link.com),
                    link.mass as f32,
                    link.inertia as f32,
                ));
            let handle = bodies.insert(rigid);
            let collider = outline(&link.shape)
                .density(0.0)
                .friction(SKIN_FRICTION)
                .friction_combine_rule(CoefficientCombineRule::Min)
                .collision_groups(groups);
            body.colliders
                .push(colliders.insert_with_parent(collider, handle, bodies));
            if let Some(joint) = &link.joint {
                let hinge = RevoluteJointBuilder::new()
                    .local_anchor1(vector(joint.anchor))
                    .local_anchor2(Vector::ZERO)
                    .limits([joint.range[0] as f32, joint.range[1] as f32])
                    .contacts_enabled(false);
                body.joints
                    .push(joints.insert(body.links[joint.parent], handle, hinge, true));
            }
            body.links.push(handle);
        }
        body
    }

    /// The character.
    #[must_use]
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// The rigid body of a link.
    #[must_use]
    pub fn link(&self, link: usize) -> RigidBodyHandle {
        self.links[link]
    }

    /// The collider of a link.
    pub(crate) fn collider(&self, link: usize) -> ColliderHandle {
        self.colliders[link]
    }

    /// Reads the state and the contacts after a step of `dt` s (or before the first one).
    /// `time` and `gravity` (downwards positive) are the owner's. Allocates nothing.
    pub fn sense(
        &self,
        bodies: &RigidBodySet,
        colliders: &ColliderSet,
        narrow_phase: &NarrowPhase,
        dt: f64,
        sensors: &mut Sensors,
    ) {
        self.sense_state(bodies, &mut sensors.state);
        let mut lowest = f64::INFINITY;
        sensors.feet.fill(FootContact::default());
        for (i, collider) in self.colliders.iter().enumerate() {
            let foot = self.model.feet.iter().position(|f| f.link == i);
            let middle = foot.map_or(0.0, |f| {
                let f = &self.model.feet[f];
                0.5 * (f.heel[0] + f.toe[0])
            });
            let mut contact = LinkContact::default();
            let knee = self.knees[i];
            let mut sole = FootContact::default();
            let mut moment = 0.0;
            let (mut middle_of, mut load) = ([0.0; 2], 0.0);
            for pair in narrow_phase.contact_pairs_with(*collider) {
                // A ball in the air bears no hand.
                let thing = other(pair, *collider);
                let bears = foot.is_some() || self.bears(thing, bodies, colliders, narrow_phase);
                each_point(pair, *collider, colliders, dt, |p| {
                    if !p.touches() {
                        return;
                    }
                    contact.touching = true;
                    contact.force[0] += p.force[0];
                    contact.force[1] += p.force[1];
                    let size = p.force[0].abs() + p.force[1].abs();
                    load += size;
                    middle_of[0] += size * p.at[0];
                    middle_of[1] += size * p.at[1];
                    if p.normal_up < SUPPORTING || !bears {
                        return;
                    }
                    let at_knee = knee
                        .is_some_and(|k| hypot(p.in_body[0] - k[0], p.in_body[1] - k[1]) < KNEE);
                    contact.knee = at_knee && (contact.knee || !contact.supported);
                    contact.supported = true;
                    lowest = lowest.min(p.at[1]);
                    let [rear, front] = sole.support.unwrap_or([p.at[0], p.at[0]]);
                    sole.support = Some([rear.min(p.at[0]), front.max(p.at[0])]);
                    sole.heel |= p.in_body[0] < middle;
                    sole.toe |= p.in_body[0] >= middle;
                    sole.force[0] += p.force[0];
                    sole.force[1] += p.force[1];
                    moment += p.force[1] * p.at[0];
                });
            }
            contact.at = (load > 1.0).then(|| middle_of.map(|m| m / load));
            sensors.contacts[i] = contact;
            if let Some(foot) = foot {
                sole.cop = (sole.force[1] > 1.0).then(|| moment / sole.force[1]);
                sensors.feet[foot] = sole;
            }
        }
        if lowest.is_finite() {
            sensors.ground = lowest;
        }
        sensors.derive();
    }

    /// Whether a thing could carry a link: it is fixed, or touches something besides this character.
    fn bears(
        &self,
        thing: ColliderHandle,
        bodies: &RigidBodySet,
        colliders: &ColliderSet,
        narrow_phase: &NarrowPhase,
    ) -> bool {
        let body = colliders[thing].parent().map(|b| &bodies[b]);
        if !body.is_some_and(RigidBody::is_dynamic) {
            return true;
        }
        let mut pairs = narrow_phase.contact_pairs_with(thing);
        pairs.any(|pair| {
            pair.has_any_active_contact() && !self.colliders.contains(&other(pair, thing))
        })
    }

    fn sense_state(&self, bodies: &RigidBodySet, state: &mut State) {
        let root = &bodies[self.links[0]];
        let angle = f64::from(root.rotation().angle());
        let origin = root.translation();
        let (v, w) = (root.linvel(), f64::from(root.angvel()));
        // The engine's own world centre of mass is not yet known before the first step.
        let (sin, cos) = sin_cos(angle);
        let arm = turned([cos, sin], self.model.links[0].com);
        state.q[0] = f64::from(origin.x);
        state.q[1] = f64::from(origin.y);
        state.q[2] = angle;
        state.qdot[0] = rounded(f64::from(v.x) + w * arm[1]);
        state.qdot[1] = rounded(f64::from(v.y) - w * arm[0]);
        state.qdot[2] = w;
        for (i, link) in self.model.links.iter().enumerate() {
            let Some(joint) = &link.joint else { continue };
            let (turn, rate) = self.turn(i, joint, bodies);
            state.q[i + 2] = rounded(turn);
            state.qdot[i + 2] = rounded(rate);
        }
    }

    /// Angle and rate of a link's joint, rad and rad/s.
    fn turn(&self, link: usize, joint: &Joint, bodies: &RigidBodySet) -> (f64, f64) {
        let (child, parent) = (&bodies[self.links[link]], &bodies[self.links[joint.parent]]);
        let turn = f64::from(child.rotation().angle()) - f64::from(parent.rotation().angle());
        // The range may reach beyond ±π: take the turn nearest to its middle.
        let middle = 0.5 * (joint.range[0] + joint.range[1]);
        let rate = f64::from(child.angvel()) - f64::from(parent.angvel());
        (middle + wrapped(turn - middle), rate)
    }

    /// Angle, rate, range and hinge of each joint.
    pub(super) fn hinges(
        &self,
        bodies: &RigidBodySet,
    ) -> impl Iterator<Item = (f64, f64, [f64; 2], ImpulseJointHandle)> {
        let joints = self.model.joints().enumerate().zip(&self.joints);
        joints.map(|((j, joint), handle)| {
            let (turn, rate) = self.turn(j + 1, joint, bodies);
            (turn, rate, joint.range, *handle)
        })
    }

    /// Applies joint torques (N·m, model order) for the next step, in place of the last step's,
    /// clamped to the muscles, which pull no joint further beyond its range than it gives. What is not a
    /// number counts as 0. Returns nothing to the root: every torque acts on a link and, reversed, on its
    /// parent. Where trunk and legs overlap they are pressed apart: call it once a step. Replaces all forces and torques on the links: add others afterwards.
    pub fn actuate(&mut self, bodies: &mut RigidBodySet, torques: &[f64]) {
        for handle in &self.links {
            bodies[*handle].reset_torques(false);
        }
        if let Some(meetings) = &mut self.meetings {
            for handle in &self.links {
                bodies[*handle].reset_forces(false);
            }
            meetings.press(&self.links, bodies);
        }
        for ((i, link), torque) in self.model.links.iter().enumerate().skip(1).zip(torques) {
            let Some(joint) = &link.joint else { continue };
            let torque = if torque.is_nan() { 0.0 } else { *torque };
            let (child, parent) = (&bodies[self.links[i]], &bodies[self.links[joint.parent]]);
            let rate = f64::from(child.angvel()) - f64::from(parent.angvel());
            let [mut least, mut greatest] = joint.muscles.range(rate);
            let [below, above] = beyond(child.rotation(), parent.rotation(), &self.ends[i]);
            if below {
                least = 0.0;
            }
            if above {
                greatest = 0.0;
            }
            let torque = torque.clamp(least, greatest) as f32;
            bodies[self.links[i]].add_torque(torque, false);
            bodies[self.links[joint.parent]].add_torque(-torque, false);
        }
    }
}

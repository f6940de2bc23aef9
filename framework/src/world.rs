//! Our own owner of rapier sets: ground, characters, props, pushes, stepping, cloning.
//!
//! A clone continues bit for bit like its original.

use std::sync::Arc;

use rapier2d::prelude::*;

use crate::body::{Body, vector};
use crate::fastening::Fastening;
use crate::grips::Grips;
use crate::model::{Model, Point};
use crate::prop::Placed;
pub use crate::prop::{Hinge, Prop, PropMotion};
use crate::sensed_prop::SensedProp;
use crate::sensors::Sensors;
pub use crate::settings::{Settings, integration_parameters};
use crate::state::State;

/// Natural frequency of a prop's hinge that can break, Hz: stiff, but slow enough for its load to
/// be seen.
const BREAKABLE: f32 = 120.0;

/// A character in the world with what it senses.
#[derive(Debug, Clone)]
pub struct Character {
    /// Its links in the engine.
    pub body: Body,
    /// As of the last [`World::sense`].
    pub sensors: Sensors,
}

#[derive(Debug, Clone)]
struct Push {
    handle: RigidBodyHandle,
    force: Vector,
    steps: u32,
}

/// Level ground at y = 0, characters and props, under rapier2d.
pub struct World {
    settings: Settings,
    steps: u64,
    characters: Vec<Character>,
    /// One a character.
    grips: Vec<Grips>,
    props: Vec<Placed>,
    /// Those that have broken are gone.
    hinges: Vec<Option<Fastening>>,
    /// What props are hinged to that hang in the world, once there are any.
    anchor: Option<RigidBodyHandle>,
    pushes: Vec<Push>,
    parameters: IntegrationParameters,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

impl std::fmt::Debug for World {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("World")
            .field("settings", &self.settings)
            .field("steps", &self.steps)
            .field("characters", &self.characters.len())
            .field("props", &self.props.len())
            .finish_non_exhaustive()
    }
}

impl Clone for World {
    fn clone(&self) -> Self {
        Self {
            settings: self.settings,
            steps: self.steps,
            characters: self.characters.clone(),
            grips: self.grips.clone(),
            props: self.props.clone(),
            hinges: self.hinges.clone(),
            anchor: self.anchor,
            pushes: self.pushes.clone(),
            parameters: self.parameters,
            pipeline: PhysicsPipeline::new(), // a workspace, without memory between steps
            islands: self.islands.clone(),
            broad_phase: self.broad_phase.clone(),
            narrow_phase: self.narrow_phase.clone(),
            bodies: self.bodies.clone(),
            colliders: self.colliders.clone(),
            impulse_joints: self.impulse_joints.clone(),
            multibody_joints: self.multibody_joints.clone(),
            soft_bodies: self.soft_bodies.clone(),
            ccd: self.ccd.clone(),
        }
    }
}

impl World {
    /// Level ground and nothing on it.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        let mut colliders = ColliderSet::new();
        colliders.insert(
            ColliderBuilder::new(SharedShape::halfspace(Vector::Y))
                .friction(settings.friction as f32),
        );
        Self {
            settings,
            steps: 0,
            characters: Vec::new(),
            grips: Vec::new(),
            props: Vec::new(),
            hinges: Vec::new(),
            anchor: None,
            pushes: Vec::new(),
            parameters: integration_parameters(&settings),
            pipeline: PhysicsPipeline::new(),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders,
            impulse_joints: ImpulseJointSet::new(),
            multibody_joints: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
        }
    }

    /// Physical settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// s since the world began.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.settings.dt
    }

    /// Adds a character in a state, as strong and heavy as the settings have it; returns its place
    /// in [`Self::characters`].
    pub fn spawn(&mut self, model: &Arc<Model>, state: &State) -> usize {
        let layer = self.characters.len() as u8;
        let varied = model.varied(self.settings.torque, self.settings.mass);
        let body = Body::spawn(
            &varied,
            state,
            layer,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
        );
        let sensors = Sensors::new(&varied, self.settings.gravity);
        self.characters.push(Character { body, sensors });
        self.grips.push(Grips::new(model));
        self.characters.len() - 1
    }

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
        self.hinges.push(Some(fastening));
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

    /// Characters with what they sensed last.
    #[must_use]
    pub fn characters(&self) -> &[Character] {
        &self.characters
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

    /// Pushes a link at its centre of mass with an impulse (N·s, world frame) spread evenly over
    /// `duration` s, from the next step on.
    pub fn push(&mut self, character: usize, link: usize, impulse: Point, duration: f64) {
        let steps = (duration / self.settings.dt).round().max(1.0) as u32;
        let over = f64::from(steps) * self.settings.dt;
        self.pushes.push(Push {
            handle: self.characters[character].body.link(link),
            force: vector([impulse[0] / over, impulse[1] / over]),
            steps,
        });
    }

    /// Finds contacts without moving anything: for sensing before the first step.
    pub fn detect_contacts(&mut self) {
        // On copies of what the engine marks as seen: the first step must still find the bodies
        // new, or it never wakes them.
        CollisionPipeline::new().step(
            self.parameters.prediction_distance(),
            &mut self.islands.clone(),
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies.clone(),
            &mut self.colliders,
            &(),
            &(),
        );
        // The search has taken note of bodies that are new without enlisting them for the next
        // step: left so, what nobody touches would hang in the air for ever.
        self.bodies.iter_mut().for_each(drop);
    }

    /// Brings a character's sensors up to date and returns them.
    pub fn sense(&mut self, character: usize) -> &Sensors {
        let time = self.time();
        let Character { body, sensors } = &mut self.characters[character];
        sensors.time = time;
        body.sense(
            &self.bodies,
            &self.colliders,
            &self.narrow_phase,
            self.settings.dt,
            sensors,
        );
        if sensors.props.len() != self.props.len() {
            sensors.props = self
                .props
                .iter()
                .map(|p| SensedProp::new(&p.name))
                .collect();
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
        sensors
    }

    /// Sets a character's joint torques for the next step, N·m in the model's order.
    pub fn actuate(&mut self, character: usize, torques: &[f64]) {
        self.characters[character]
            .body
            .actuate(&mut self.bodies, torques);
    }

    /// One step of `dt`.
    pub fn step(&mut self) {
        self.take_hold();
        for push in &self.pushes {
            self.bodies[push.handle].add_force(push.force, false);
        }
        self.pipeline.step(
            Vector::new(0.0, -self.settings.gravity as f32),
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
        for push in &mut self.pushes {
            self.bodies[push.handle].reset_forces(false);
            push.steps -= 1;
        }
        self.pushes.retain(|p| p.steps > 0);
        self.steps += 1;
        self.give_way();
    }

    /// Closed hands take what they touch.
    fn take_hold(&mut self) {
        for (character, grips) in self.characters.iter().zip(&mut self.grips) {
            grips.take(
                &character.body,
                &self.props,
                self.steps,
                &self.bodies,
                &self.colliders,
                &self.narrow_phase,
                &mut self.impulse_joints,
            );
        }
    }

    /// What the last step has overloaded slips or breaks.
    fn give_way(&mut self) {
        let joints = &mut self.impulse_joints;
        for grips in &mut self.grips {
            grips.slip(self.steps, joints, &self.settings);
        }
        for hinge in &mut self.hinges {
            let overloaded = |h: &mut Fastening| !h.bears(joints, &self.settings);
            if let Some(broken) = hinge.take_if(overloaded) {
                broken.undo(joints);
            }
        }
    }
}

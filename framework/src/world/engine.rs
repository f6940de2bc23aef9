//! Our own owner of rapier sets: ground, characters, props, pushes, stepping, cloning.
//!
//! A clone continues bit for bit like its original.

use std::sync::Arc;

use rapier2d::prelude::*;

use crate::character::{Model, Point, State};
use crate::events::EventKind;
use crate::sensing::Sensors;
use crate::world::body::Body;
use crate::world::fastening::Joined;
use crate::world::grip::Grips;
use crate::world::prop::Placed;
use crate::world::pull::Pull;
use crate::world::settings::{Settings, integration_parameters};
use crate::world::vector::vector;

/// A character in the world with what it senses.
#[derive(Debug, Clone)]
pub struct Character {
    /// Its links in the engine.
    pub body: Body,
    /// As of the last [`World::sense`].
    pub sensors: Sensors,
}

#[derive(Debug, Clone)]
pub(super) struct ConstantForce {
    handle: RigidBodyHandle,
    force: Vector,
    steps: u32,
}

/// Level ground at y = 0, characters and props, under rapier2d.
///
/// ```
/// # use aplomb_framework::{Model, character::State, world::{Settings, World}};
/// let model = Model::load("humanoid")?;
/// let mut world = World::new(Settings::default());
/// let it = world.spawn(&model, &State::standing(&model));
/// let torques = vec![0.0; model.joint_count()]; // N·m
/// for _ in 0..500 {
///     world.sense(it); // a controller would now act
///     world.actuate(it, &torques);
///     world.step();
/// }
/// assert!(world.sense(it).com[1] < model.standing_com()[1]); // without torques it sinks
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
pub struct World {
    pub(super) settings: Settings,
    pub(super) steps: u64,
    pub(super) characters: Vec<Character>,
    /// One a character.
    pub(super) grips: Vec<Grips>,
    pub(super) props: Vec<Placed>,
    /// Those that have broken are gone.
    pub(super) hinges: Vec<Option<Joined>>,
    /// What props are hinged to that hang in the world, once there are any.
    pub(super) anchor: Option<RigidBodyHandle>,
    pub(super) pushes: Vec<ConstantForce>,
    pub(super) pull: Option<Pull>,
    /// The ground's.
    pub(super) ground: ColliderHandle,
    pub(super) parameters: IntegrationParameters,
    pub(super) pipeline: PhysicsPipeline,
    pub(super) islands: IslandManager,
    pub(super) broad_phase: BroadPhaseBvh,
    pub(super) narrow_phase: NarrowPhase,
    pub(super) bodies: RigidBodySet,
    pub(super) colliders: ColliderSet,
    pub(super) impulse_joints: ImpulseJointSet,
    pub(super) multibody_joints: MultibodyJointSet,
    pub(super) soft_bodies: SoftBodySet,
    pub(super) ccd: CCDSolver,
    /// What has happened since it was last asked, each with the character.
    pub(super) events: Vec<(usize, EventKind)>,
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
            pull: self.pull,
            ground: self.ground,
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
            events: self.events.clone(),
        }
    }
}

impl World {
    /// Level ground and nothing on it.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        let mut colliders = ColliderSet::new();
        let ground = colliders.insert(
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
            pull: None,
            ground,
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
            events: Vec::new(),
        }
    }

    /// Physical settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes gravity, m/s², downwards positive.
    pub fn set_gravity(&mut self, gravity: f64) {
        self.settings.gravity = gravity;
        for character in &mut self.characters {
            character.sensors.gravity = gravity;
        }
    }

    /// Changes the friction coefficient of the ground.
    pub fn set_friction(&mut self, friction: f64) {
        self.settings.friction = friction;
        self.colliders[self.ground].set_friction(friction as f32);
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

    /// Characters with what they sensed last.
    #[must_use]
    pub fn characters(&self) -> &[Character] {
        &self.characters
    }

    /// Pushes a link at its centre of mass with an impulse (N·s, world frame) spread evenly over
    /// `duration` s, from the next step on.
    pub fn push(&mut self, character: usize, link: usize, impulse: Point, duration: f64) {
        let steps = (duration / self.settings.dt).round().max(1.0) as u32;
        let over = f64::from(steps) * self.settings.dt;
        self.pushes.push(ConstantForce {
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
        self.sense_props(character);
        &self.characters[character].sensors
    }

    /// Sets a character's joint torques for the next step, N·m in the model's order.
    pub fn actuate(&mut self, character: usize, torques: &[f64]) {
        self.characters[character]
            .body
            .actuate(&mut self.bodies, torques);
    }

    /// What hands and hinges have done since it was last asked, each with the place of the character
    /// (of hinges between props: 0).
    pub fn take_events(&mut self) -> Vec<(usize, EventKind)> {
        std::mem::take(&mut self.events)
    }

    /// One step of `dt`.
    pub fn step(&mut self) {
        self.take_hold();
        for push in &self.pushes {
            self.bodies[push.handle].add_force(push.force, false);
        }
        self.drag();
        for character in &self.characters {
            character
                .body
                .set_stops(&self.bodies, &mut self.impulse_joints);
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
        self.undo_drag();
        self.steps += 1;
        self.give_way();
    }
}

//! One run: world, supervisors, timed pushes and commands, events, digest, recording.
//!
//! scenario → [`Simulation`] → events, [`Outcome`], trajectory. The same loop serves the program,
//! rollouts, tests and drawings. A clone continues bit for bit.

use std::sync::Arc;

use crate::character::Model;
use crate::control::{Controller, Registry, Supervisor, repertoire};
use crate::events::Event;
use crate::input::{Error, Result};
use crate::run::actor::{Actor, Outcome};
use crate::run::schedule::{Input, Schedule, TimedInput};
use crate::run::start::start_state;
use crate::run::trajectory::{Cast, Digest, Header, Trajectory, push_character};
use crate::run::watch::Watch;
use crate::scenario::{Scenario, ScheduledInput};
use crate::sensing::Sensors;
use crate::world::{Prop, World};

/// One step of the whole loop for one character: sense, think, actuate. Returns what was sensed.
/// The world is stepped by the caller, once for all characters.
pub fn tick<'a>(
    world: &'a mut World,
    character: usize,
    supervisor: &mut dyn Controller,
    torques: &mut [f64],
) -> &'a Sensors {
    let now = world.sense(character);
    supervisor.act(now, torques);
    world.actuate(character, torques);
    world.grip(character, supervisor.grips());
    &world.characters()[character].sensors
}

/// A run in progress.
///
/// ```
/// # use aplomb_framework::prelude::*;
/// # use aplomb_framework::Supervisor;
/// # #[derive(Debug, Clone)]
/// # struct Limp(Contract);
/// # impl Controller for Limp {
/// #     fn contract(&self) -> &Contract { &self.0 }
/// #     fn enter(&mut self, _: &Sensors) {}
/// #     fn act(&mut self, _: &Sensors, torques: &mut [f64]) { torques.fill(0.0); }
/// #     fn clone_box(&self) -> Box<dyn Controller> { Box::new(self.clone()) }
/// # }
/// # let contract = ron::from_str(r#"(name: "limp", weight: 1, precondition: Always)"#)?;
/// # let limp: Box<dyn Controller> = Box::new(Limp(contract)); // no torques
/// // `limp` is a controller; with a registry of controllers `Simulation::new` reads repertoires.
/// let (model, scenario) = (Model::load("humanoid")?, Scenario::standing("humanoid", 1.0));
/// let supervisor = Supervisor::new("faint", vec![limp], "limp")?;
/// let mut simulation = Simulation::with_cast(&scenario, vec![(model, supervisor)])?;
/// simulation.run(0.3);
/// simulation.push(0, "torso", 10.0)?; // N·s
/// simulation.run(0.7);
/// assert!(!simulation.outcome(0).standing);
/// assert_eq!(simulation.events()[0].time, 0.0); // `limp` becomes active
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(super) world: World,
    pub(super) actors: Vec<Actor>,
    schedule: Schedule,
    pub(super) events: Vec<Event>,
    digest: Digest,
    row: Vec<f32>,
    recording: Option<Trajectory>,
    pub(super) watches: Vec<Watch>,
}

impl Simulation {
    /// Puts the scenario's characters and props into a world.
    ///
    /// # Errors
    /// Unreadable or invalid characters and repertoires; links, joints or commands that they lack.
    pub fn new(scenario: &Scenario, registry: &Registry) -> Result<Self> {
        Self::with_cast(scenario, Self::cast(scenario, registry)?)
    }

    /// The characters that a scenario names and the supervisors of their repertoires, as
    /// [`Self::with_cast`] takes them.
    ///
    /// # Errors
    /// Unreadable or invalid characters and repertoires.
    pub fn cast(scenario: &Scenario, registry: &Registry) -> Result<Vec<(Arc<Model>, Supervisor)>> {
        let mut cast = Vec::with_capacity(scenario.characters.len());
        for (i, role) in scenario.characters.iter().enumerate() {
            let of = |field| move |e: Error| e.inside(field).inside(("characters", i));
            let model = Model::load(&role.character);
            let model = model.map_err(|e| scenario.locate(of("character")(e)))?;
            let supervisor = repertoire::load(role.repertoire(&model), registry, &model);
            let supervisor = supervisor.map_err(|e| scenario.locate(of("repertoire")(e)))?;
            cast.push((model, supervisor));
        }
        Ok(cast)
    }

    /// The same with characters and supervisors that were built elsewhere, one pair a character of the
    /// scenario.
    ///
    /// # Errors
    /// Another number of characters; joints, links or commands that they lack.
    pub fn with_cast(scenario: &Scenario, cast: Vec<(Arc<Model>, Supervisor)>) -> Result<Self> {
        if cast.len() != scenario.characters.len() {
            return Err(Error::invalid(
                &scenario.name,
                "characters",
                cast.len(),
                format!(
                    "one supervisor for each of the {}",
                    scenario.characters.len()
                ),
            ));
        }
        let mut world = World::new(scenario.settings);
        let mut actors = Vec::with_capacity(cast.len());
        let at =
            |list: &'static str, i: usize| move |e: Error| scenario.locate(e.inside((list, i)));
        let roles = scenario.characters.iter().enumerate();
        for ((i, role), (model, supervisor)) in roles.zip(cast) {
            let start = start_state(&model, &role.start).map_err(|e| e.inside("start"));
            world.spawn(&model, &start.map_err(at("characters", i))?);
            actors.push(Actor::new(supervisor, &model));
        }
        for (i, prop) in scenario.props.iter().enumerate() {
            world.add_prop(&scenario.prop(prop).map_err(at("props", i))?);
        }
        for (i, hinge) in scenario.joints.iter().enumerate() {
            world.add_hinge(&scenario.hinge(hinge).map_err(at("joints", i))?);
        }
        world.detect_contacts();
        for character in 0..actors.len() {
            world.sense(character);
        }
        let mut simulation = Self {
            world,
            actors,
            schedule: Schedule::default(),
            events: Vec::new(),
            digest: Digest::default(),
            row: Vec::new(),
            recording: None,
            watches: Vec::new(),
        };
        for (i, expectation) in scenario.expect.iter().enumerate() {
            let watch = Watch::new(expectation, scenario, &simulation.world);
            simulation.watches.extend(watch.map_err(at("expect", i))?);
        }
        for (i, event) in scenario.events.iter().enumerate() {
            let scheduled = simulation.schedule(scenario, event);
            scheduled.map_err(at("events", i))?;
        }
        Ok(simulation)
    }

    /// Adds a push or a command to what will happen.
    ///
    /// # Errors
    /// An unknown link, a malformed command or one that nobody answers to: by the way from the event.
    pub fn schedule(&mut self, scenario: &Scenario, event: &ScheduledInput) -> Result<()> {
        let character = event.character();
        let supervisor = &self.actors[character].supervisor;
        let timed = TimedInput::new(event, scenario, self.model(character), supervisor)?;
        self.schedule.add(timed);
        Ok(())
    }

    /// Starts recording every step from here on.
    pub fn record(&mut self, scenario: &str, seed: u64) {
        self.record_with(scenario, seed, Vec::new());
    }

    /// The same for a run in which more props will appear than are scheduled: each with its time, s.
    pub fn record_with(&mut self, scenario: &str, seed: u64, more: Vec<(f64, Prop)>) {
        let scheduled = self
            .schedule
            .props()
            .map(|(time, prop)| (time, prop.clone()));
        let mut later: Vec<(f64, Prop)> = scheduled.chain(more).collect();
        later.sort_by(|a, b| a.0.total_cmp(&b.0));
        let later = later.into_iter().map(|(_, prop)| prop);
        let cast = (0..self.actors.len()).map(|i| Cast {
            model: self.model(i).source.clone(),
            controllers: self.controllers(i),
        });
        let header = Header {
            scenario: scenario.to_owned(),
            seed,
            dt: self.world.settings().dt,
            cast: cast.collect(),
            props: self.world.props().cloned().chain(later).collect(),
        };
        let models = (0..self.actors.len())
            .map(|i| Arc::clone(self.model(i)))
            .collect();
        self.recording = Some(Trajectory::new(header, models));
    }

    /// The recording so far, with all events.
    #[must_use]
    pub fn recording(&self) -> Option<Trajectory> {
        self.recording.clone().map(|mut t| {
            t.events = self.events.clone();
            t
        })
    }

    /// The recording with all events, of a run that goes no further.
    #[must_use]
    pub fn into_recording(self) -> Option<Trajectory> {
        let mut recording = self.recording?;
        recording.events = self.events;
        Some(recording)
    }

    fn controllers(&self, character: usize) -> Vec<String> {
        let pool = self.actors[character].supervisor.controllers();
        pool.map(|c| c.contract().name.clone()).collect()
    }

    pub(super) fn model(&self, character: usize) -> &Arc<Model> {
        self.world.characters()[character].body.model()
    }

    /// The world.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The characters' supervisors.
    #[must_use]
    pub fn actors(&self) -> &[Actor] {
        &self.actors
    }

    /// Gives a character another supervisor, which takes over in the next step.
    pub fn set_supervisor(&mut self, character: usize, supervisor: Supervisor) {
        self.actors[character].supervisor = supervisor;
    }

    /// What a character sensed in the last step.
    #[must_use]
    pub fn sensors(&self, character: usize) -> &Sensors {
        &self.world.characters()[character].sensors
    }

    /// All that happened so far.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Takes out what has happened so far, for those who keep it themselves: a run that goes on for
    /// long then holds little. A recording and expectations see only what is left.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Hash of every step's state so far.
    #[must_use]
    pub fn digest(&self) -> String {
        self.digest.text()
    }

    /// s since the run began.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Runs for a duration, s.
    pub fn run(&mut self, duration: f64) {
        let steps = (duration / self.world.settings().dt).round() as u64;
        for _ in 0..steps {
            self.step();
        }
    }

    /// One step: what is due happens, every character senses and thinks, the world moves.
    pub fn step(&mut self) {
        let due = self.world.time() + 0.5 * self.world.settings().dt;
        while let Some(TimedInput {
            character, input, ..
        }) = self.schedule.next_before(due)
        {
            match input {
                Input::Push {
                    link,
                    impulse,
                    over,
                } => self.do_push(character, link, impulse, over),
                // A refusal is in the events.
                Input::Command(text) => drop(self.command(character, &text)),
                Input::Throw(prop) => self.throw(&prop),
                Input::Drag(pull) => self.drag(pull),
                Input::Release => self.release(),
                Input::Set(setting, value) => self.change(setting, value),
            }
        }
        self.row.clear();
        for (i, actor) in self.actors.iter_mut().enumerate() {
            let now = tick(
                &mut self.world,
                i,
                &mut actor.supervisor,
                &mut actor.torques,
            );
            let active = actor.supervisor.active_index().unwrap_or(0);
            push_character(&mut self.row, now, actor.supervisor.reference_com(), active);
            actor.observe(i, now, &mut self.events);
        }
        self.row.extend(self.world.prop_poses().flatten());
        self.digest.row(&self.row);
        if let Some(recording) = &mut self.recording {
            recording.push_beginning(&self.row);
        }
        for watch in &mut self.watches {
            watch.observe(&self.world);
        }
        self.world.step();
        let time = self.world.time();
        for (character, kind) in self.world.take_events() {
            self.events.push(Event {
                time,
                character,
                kind,
            });
        }
    }

    /// How a character has ended.
    #[must_use]
    pub fn outcome(&self, character: usize) -> Outcome {
        self.actors[character].outcome(self.sensors(character))
    }
}

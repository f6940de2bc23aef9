//! One run: world, minds, timed pushes and commands, events, digest, recording.
//!
//! scenario → [`Simulation`] → events, [`Outcome`], trajectory. The same loop serves the program,
//! rollouts, tests and drawings. A clone continues bit for bit.

use std::sync::Arc;

use crate::controller::Controller;
use crate::error::{Error, Result};
use crate::kinematics::Kinematics;
use crate::model::{Model, Shape};
use crate::registry::Registry;
use crate::repertoire;
use crate::scenario::{Expectation, Happening, Scenario, Start};
use crate::sensors::{Posture, Sensors};
use crate::state::State;
use crate::supervisor::{Decision, Supervisor, Why};
use crate::trajectory::{Cast, Digest, Event, EventKind, Header, Trajectory, push_character};
use crate::world::World;

/// s for which a character must stand to be called standing.
const STANDING_FOR: f64 = 1.0;

/// One step of the whole loop for one character: sense, think, actuate. Returns what was sensed.
/// The world is stepped by the caller, once for all characters.
pub fn tick<'a>(
    world: &'a mut World,
    character: usize,
    mind: &mut dyn Controller,
    torques: &mut [f64],
) -> &'a Sensors {
    let now = world.sense(character);
    mind.act(now, torques);
    world.actuate(character, torques);
    &world.characters()[character].sensors
}

/// A character's mind and what is known of its run so far.
#[derive(Debug, Clone)]
pub struct Actor {
    /// The supervisor of its repertoire.
    pub mind: Supervisor,
    /// As of the last step, N·m.
    pub torques: Vec<f64>,
    /// Largest torque of each joint so far, as applied, N·m.
    pub peak_torque: Vec<f64>,
    /// Since when it has stood without a break, s.
    standing_since: Option<f64>,
    /// Whether it is down: something other than feet has touched since it last stood.
    down: bool,
    posture_seen: [Option<f64>; 8],
}

/// How a run ended for one character.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Stood for the last second: only feet on the ground, the centre of mass above 0.9 of its
    /// standing height, over the base of support, slower than 0.1 m/s.
    pub standing: bool,
    /// The active controller.
    pub active: String,
    /// Posture.
    pub posture: Posture,
    /// Centre of mass, m.
    pub com: [f64; 2],
    /// Its velocity, m/s.
    pub com_velocity: [f64; 2],
}

#[derive(Debug, Clone)]
enum Deed {
    Push {
        link: usize,
        impulse: f64,
        over: f64,
    },
    Command(String),
}

#[derive(Debug, Clone)]
struct Timed {
    time: f64,
    character: usize,
    deed: Deed,
}

/// A run in progress.
#[derive(Debug, Clone)]
pub struct Simulation {
    world: World,
    actors: Vec<Actor>,
    /// By time, the next last.
    schedule: Vec<Timed>,
    events: Vec<Event>,
    digest: Digest,
    row: Vec<f32>,
    recording: Option<Trajectory>,
}

impl Simulation {
    /// Puts the scenario's characters and props into a world.
    ///
    /// # Errors
    /// Unreadable or invalid characters and repertoires; links, joints or commands that they lack.
    pub fn new(scenario: &Scenario, registry: &Registry) -> Result<Self> {
        let mut minds = Vec::with_capacity(scenario.characters.len());
        for role in &scenario.characters {
            let model = Model::load(&role.character)?;
            let repertoire = role.repertoire.as_deref().unwrap_or(&model.name);
            minds.push(repertoire::load(repertoire, registry, &model)?);
        }
        Self::with_minds(scenario, minds)
    }

    /// The same with minds that were built elsewhere, one a character of the scenario; characters
    /// without one are left out.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_minds(scenario: &Scenario, minds: Vec<Supervisor>) -> Result<Self> {
        let mut world = World::new(scenario.settings);
        let mut actors = Vec::with_capacity(minds.len());
        for (role, mind) in scenario.characters.iter().zip(minds) {
            let model = Model::load(&role.character)?;
            world.spawn(&model, &start_state(&model, &role.start)?);
            actors.push(Actor::new(mind, &model));
        }
        for prop in &scenario.props {
            world.add_prop(prop);
        }
        world.detect_contacts();
        let mut simulation = Self {
            world,
            actors,
            schedule: Vec::new(),
            events: Vec::new(),
            digest: Digest::default(),
            row: Vec::new(),
            recording: None,
        };
        for event in &scenario.events {
            simulation.schedule(scenario, event)?;
        }
        Ok(simulation)
    }

    /// Adds a push or a command to what will happen.
    ///
    /// # Errors
    /// An unknown link, a malformed command or one that nobody answers to.
    pub fn schedule(&mut self, scenario: &Scenario, event: &Happening) -> Result<()> {
        let timed = match event {
            Happening::Push {
                at,
                link,
                impulse,
                over,
                character,
            } => Timed {
                time: scenario.number(at)?,
                character: *character,
                deed: Deed::Push {
                    link: self.model(*character).link_index(link)?,
                    impulse: scenario.number(impulse)?,
                    over: *over,
                },
            },
            Happening::Command {
                at,
                text,
                character,
            } => {
                // A trial on a clone: commands that nobody answers to are found before the run.
                self.actors[*character].mind.clone().command(text)?;
                Timed {
                    time: scenario.number(at)?,
                    character: *character,
                    deed: Deed::Command(text.clone()),
                }
            }
        };
        // Before its equals, which are then taken from the end first: first scheduled, first done.
        let place = self.schedule.partition_point(|t| t.time > timed.time);
        self.schedule.insert(place, timed);
        Ok(())
    }

    /// Pushes a character's link now: horizontal impulse in N·s over 0.1 s.
    ///
    /// # Errors
    /// An unknown link, or an impulse that is not finite.
    pub fn push(&mut self, character: usize, link: &str, impulse: f64) -> Result<()> {
        let link = self.model(character).link_index(link)?;
        if !impulse.is_finite() {
            return Err(Error::Invalid {
                place: "push".to_owned(),
                field: "impulse".to_owned(),
                problem: impulse.to_string(),
                accepted: "a finite number of N·s".to_owned(),
            });
        }
        self.do_push(character, link, impulse, 0.1);
        Ok(())
    }

    /// Gives a character a command now.
    ///
    /// # Errors
    /// A malformed command, or one that nobody answers to, with the nearest name.
    pub fn command(&mut self, character: usize, text: &str) -> Result<()> {
        let time = self.world.time();
        self.actors[character].mind.command(text).inspect_err(|e| {
            let kind = EventKind::Command {
                text: text.to_owned(),
                accepted: false,
            };
            self.events.push(Event {
                time,
                character,
                kind,
            });
            let kind = EventKind::Refused {
                command: text.to_owned(),
                controller: None,
                clause: e.to_string(),
                value: None,
            };
            self.events.push(Event {
                time,
                character,
                kind,
            });
        })
    }

    /// Starts recording every step from here on.
    pub fn record(&mut self, scenario: &str, seed: u64) {
        let cast = (0..self.actors.len()).map(|i| Cast {
            model: self.model(i).source.clone(),
            controllers: self.controllers(i),
        });
        let header = Header {
            scenario: scenario.to_owned(),
            seed,
            dt: self.world.settings().dt,
            cast: cast.collect(),
            props: self.world.props().cloned().collect(),
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

    fn controllers(&self, character: usize) -> Vec<String> {
        let pool = self.actors[character].mind.controllers();
        pool.map(|c| c.contract().name.clone()).collect()
    }

    fn model(&self, character: usize) -> &Arc<Model> {
        self.world.characters()[character].body.model()
    }

    /// The world.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The characters' minds.
    #[must_use]
    pub fn actors(&self) -> &[Actor] {
        &self.actors
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
        while self.schedule.last().is_some_and(|t| t.time < due) {
            let Some(timed) = self.schedule.pop() else {
                break;
            };
            match timed.deed {
                Deed::Push {
                    link,
                    impulse,
                    over,
                } => {
                    self.do_push(timed.character, link, impulse, over);
                }
                // A refusal is in the events.
                Deed::Command(text) => drop(self.command(timed.character, &text)),
            }
        }
        self.row.clear();
        for (i, actor) in self.actors.iter_mut().enumerate() {
            let now = tick(&mut self.world, i, &mut actor.mind, &mut actor.torques);
            let active = actor.mind.active_index().unwrap_or(0);
            push_character(&mut self.row, now, actor.mind.reference_com(), active);
            actor.observe(i, now, &mut self.events);
        }
        self.row.extend(self.world.prop_poses().flatten());
        self.digest.row(&self.row);
        if let Some(recording) = &mut self.recording {
            recording.push_row(&self.row);
        }
        self.world.step();
    }

    fn do_push(&mut self, character: usize, link: usize, impulse: f64, over: f64) {
        let name = self.model(character).links[link].name.clone();
        self.world.push(character, link, [impulse, 0.0], over);
        let kind = EventKind::Push {
            link: name,
            impulse: [impulse, 0.0],
        };
        self.events.push(Event {
            time: self.world.time(),
            character,
            kind,
        });
    }

    /// How a character has ended.
    #[must_use]
    pub fn outcome(&self, character: usize) -> Outcome {
        let (actor, now) = (&self.actors[character], self.sensors(character));
        let since = actor.standing_since;
        Outcome {
            standing: since.is_some_and(|t| now.time - t >= STANDING_FOR - 1e-9),
            active: actor.mind.active().unwrap_or_default().to_owned(),
            posture: now.posture,
            com: now.com,
            com_velocity: now.com_velocity,
        }
    }

    /// The first expectation of a scenario that the run did not meet, in words.
    #[must_use]
    pub fn disappointment(&self, expectations: &[Expectation]) -> Option<String> {
        expectations.iter().find_map(|e| match e {
            Expectation::Standing { character } => (!self.outcome(*character).standing)
                .then(|| format!("character {character} does not stand at the end")),
            Expectation::Active {
                name,
                before,
                character,
            } => {
                let became = |e: &Event| {
                    matches!(&e.kind, EventKind::Switch { to, .. } if to == name)
                        && e.character == *character
                        && e.time <= *before
                };
                (!self.events.iter().any(became))
                    .then(|| format!("'{name}' was not active before {before} s"))
            }
            Expectation::Posture {
                posture,
                before,
                character,
            } => {
                let seen = self.actors[*character].posture_seen[*posture as usize];
                (seen.is_none_or(|t| t > *before))
                    .then(|| format!("not {} before {before} s", posture.name()))
            }
        })
    }
}

impl Actor {
    fn new(mind: Supervisor, model: &Model) -> Self {
        Self {
            mind,
            torques: vec![0.0; model.joint_count()],
            peak_torque: vec![0.0; model.joint_count()],
            standing_since: None,
            down: false,
            posture_seen: [None; 8],
        }
    }

    /// Notes what the step showed.
    fn observe(&mut self, character: usize, now: &Sensors, events: &mut Vec<Event>) {
        for ((peak, torque), joint) in self
            .peak_torque
            .iter_mut()
            .zip(&self.torques)
            .zip(now.model.joints())
        {
            *peak = peak.max(torque.abs().min(joint.torque));
        }
        self.posture_seen[now.posture as usize].get_or_insert(now.time);
        let time = now.time;
        for decision in self.mind.take_decisions() {
            if let Decision::Refused { command, .. } = &decision {
                let kind = EventKind::Command {
                    text: command.clone(),
                    accepted: false,
                };
                events.push(Event {
                    time,
                    character,
                    kind,
                });
            }
            events.push(Event {
                time,
                character,
                kind: kind_of(decision),
            });
        }
        if now.stands() {
            self.standing_since.get_or_insert(time);
        } else {
            self.standing_since = None;
        }
        let lying = matches!(
            now.posture,
            Posture::Sitting
                | Posture::Supine
                | Posture::Prone
                | Posture::Kneeling
                | Posture::HandsAndFeet
        );
        if lying && !self.down {
            self.down = true;
            events.push(Event {
                time,
                character,
                kind: EventKind::Fell,
            });
        } else if self.down
            && self
                .standing_since
                .is_some_and(|t| time - t >= STANDING_FOR)
        {
            self.down = false;
            events.push(Event {
                time,
                character,
                kind: EventKind::Stood,
            });
        }
    }
}

fn kind_of(decision: Decision) -> EventKind {
    match decision {
        Decision::Switch {
            from,
            to,
            why,
            bids,
            ..
        } => {
            let why = match why {
                Why::Start => "start".to_owned(),
                Why::Succeeded => "succeeded".to_owned(),
                Why::Command => "command".to_owned(),
                Why::Failed(reason) => format!("failed: {reason}"),
            };
            EventKind::Switch {
                from,
                to,
                why,
                bids,
            }
        }
        Decision::Obeyed { command, .. } => EventKind::Command {
            text: command,
            accepted: true,
        },
        Decision::Refused {
            command,
            controller,
            clause,
            value,
            ..
        } => EventKind::Refused {
            command,
            controller: Some(controller),
            clause,
            value,
        },
    }
}

/// The state in which a character of a scenario begins: its lowest point `lift` above the ground.
///
/// # Errors
/// An unknown joint.
pub fn start_state(model: &Model, start: &Start) -> Result<State> {
    let mut state = State::standing(model);
    for (joint, angle) in &start.angles {
        state.q[3 + model.joint_index(joint)?] = *angle;
    }
    state.q[0] = start.x;
    state.q[2] = start.pitch;
    put_on_ground(model, &mut state, start.lift);
    Ok(state)
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

//! A live run: what watchers ask for is done between its steps.
//!
//! [`Request`]s, seconds → [`Session`] → simulation, events.

use aplomb_framework::control::{Registry, Supervisor};
use aplomb_framework::events::Event;
use aplomb_framework::input::{Error, Result, Source};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::PUSH_DURATION;
use aplomb_framework::scenario::{
    Changeable, DragTarget, LONGEST_RUN, MOST_INPUTS, ScheduledInput,
};

use crate::live::frame::View;
use crate::live::history::{Deed, History};
use crate::live::request::{Body, Request, Thrown};
use crate::live::scene::{Scene, SceneNames};

/// s that a run may lag behind before it gives up catching up.
const LAG: f64 = 0.1;
/// The most steps that are done at once, so that requests are heard.
const AT_ONCE: u64 = 200;
/// Weight of the newest measurement of the pace.
const NEWEST: f64 = 0.1;

/// What a request has changed, for watchers to be told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Changed {
    /// Nothing that is not in the next frame.
    Nothing,
    /// The scene: everything is told anew.
    Scene,
}

/// A run that is watched and touched.
///
/// ```
/// use aplomb::live::{Request, SceneNames, Session, View};
///
/// let mut session = Session::new(SceneNames::default())?; // the humanoid, standing
/// let mut view = View::default();
/// session.ask(&mut view, Request::parse(r#"{"do":"push","link":"torso","impulse":[60,0]}"#)?)?;
/// for _ in 0..60 {
///     session.advance(1.0 / 60.0); // s
/// }
/// assert!(session.frame(&view).contains(r#""n":1000,"#));
/// assert!(session.events().iter().any(|e| e.kind.name() == "switch"));
/// session.ask(&mut view, Request::Seek { step: 10 })?; // back in time
/// assert!(session.is_past() && session.is_paused());
/// # Ok::<(), aplomb::framework::Error>(())
/// ```
#[derive(Debug)]
pub struct Session {
    pub(super) registry: Registry,
    pub(super) scene: Scene,
    /// What the scene was made of, as far as it has names.
    pub(super) names: SceneNames,
    pub(super) history: History,
    pub(super) now: Simulation,
    pub(super) step: u64,
    pub(super) end: u64,
    /// Whether what was done at this step is still to be repeated.
    again: bool,
    pub(super) events: Vec<Event>,
    /// How many of them came before this step.
    seen: usize,
    /// Counts scenes.
    pub(super) generation: u64,
    /// Counts cuts of the list of events.
    pub(super) cuts: u64,
    pub(super) paused: bool,
    pub(super) speed: f64,
    /// s of simulated time that are still to be done.
    owed: f64,
    /// Simulated seconds a second, and steps a second, lately.
    pub(super) pace: [f64; 2],
}

impl Session {
    /// Begins with a scene.
    ///
    /// # Errors
    /// Unknown names, unreadable or invalid files.
    pub fn new(names: SceneNames) -> Result<Self> {
        let registry = aplomb_controllers::registry();
        let scene = names.scene(&registry)?;
        Self::with(scene, names, registry)
    }

    /// Begins with a scene that was built elsewhere.
    ///
    /// # Errors
    /// Links, joints or commands that its characters lack.
    pub fn with(scene: Scene, names: SceneNames, registry: Registry) -> Result<Self> {
        let now = scene.begin()?;
        Ok(Self {
            history: History::new(&now),
            registry,
            scene,
            names,
            now,
            step: 0,
            end: 0,
            again: false,
            events: Vec::new(),
            seen: 0,
            generation: 0,
            cuts: 0,
            paused: false,
            speed: 1.0,
            owed: 0.0,
            pace: [0.0; 2],
        })
    }

    /// The run as it is now.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.now
    }

    /// What was done, and snapshots.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// All that has happened up to the last step that was run.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Steps since the beginning.
    #[must_use]
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Whether later steps have been run already.
    #[must_use]
    pub fn is_past(&self) -> bool {
        self.step < self.end
    }

    /// Whether it waits.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    fn dt(&self) -> f64 {
        self.now.world().settings().dt
    }

    /// Lets `seconds` of the watchers' time pass. What a slow computer cannot keep up with is left
    /// out: the pace then falls below the speed. Returns how many steps were done.
    pub fn advance(&mut self, seconds: f64) -> u64 {
        let (dt, before) = (self.dt(), self.step);
        if !self.paused {
            self.owed = (self.owed + seconds * self.speed).min(LAG.max(seconds * self.speed));
            let due = ((self.owed / dt + 1e-6) as u64).min(AT_ONCE);
            for _ in 0..due {
                self.forward();
            }
            self.owed -= due as f64 * dt;
        }
        let done = self.step - before;
        if seconds > 0.0 {
            let measured = [done as f64 * dt / seconds, done as f64 / seconds];
            for (pace, measured) in self.pace.iter_mut().zip(measured) {
                *pace += NEWEST * (measured - *pace);
            }
        }
        done
    }

    /// One step; in the past what was done then is done again.
    fn forward(&mut self) {
        if self.step as f64 * self.dt() >= LONGEST_RUN {
            self.paused = true;
            return;
        }
        if self.again || self.step < self.end {
            self.history
                .repeat(&mut self.now, &self.scene.scenario, self.step);
            self.again = false;
        }
        self.now.step();
        self.step += 1;
        let events = self.now.take_events();
        let known = self.step <= self.end;
        self.seen += events.len();
        if !known {
            self.events.extend(events);
            self.end = self.step;
            self.history.remember(&self.now, self.step, self.seen);
        }
    }

    /// Does what is asked for. `view` is the watcher's.
    ///
    /// # Errors
    /// What cannot be done, and why; nothing has changed then.
    pub fn ask(&mut self, view: &mut View, request: Request) -> Result<()> {
        let changed = self.answer(view, request)?;
        if changed == Changed::Scene {
            self.generation += 1;
        }
        Ok(())
    }

    fn answer(&mut self, view: &mut View, request: Request) -> Result<Changed> {
        match request {
            Request::Play => self.paused = false,
            Request::Pause => self.paused = true,
            Request::Step { steps } => {
                self.paused = true;
                for _ in 0..steps {
                    self.forward();
                }
            }
            Request::Speed { factor } => self.speed = factor,
            Request::Seek { step } => self.seek(step),
            Request::Branch => self.branch(),
            Request::Push {
                character,
                link,
                impulse: [impulse, upward],
            } => self.act(ScheduledInput::Push {
                at: self.at(),
                link,
                impulse: impulse.into(),
                upward: upward.into(),
                over: PUSH_DURATION,
                character: self.existing(character)?,
            })?,
            Request::Command { character, text } => self.act(ScheduledInput::Command {
                at: self.at(),
                text,
                character: self.existing(character)?,
            })?,
            Request::Drag { body, point, to } => {
                let what = self.target(&body)?;
                let at = self.at();
                self.act(ScheduledInput::Drag {
                    at,
                    what,
                    point,
                    to,
                })?;
            }
            Request::Release => self.act(ScheduledInput::Release { at: self.at() })?,
            Request::Throw(thrown) => self.throw(&thrown)?,
            Request::Set { name, value } => return self.set(&name, value),
            Request::Reset => {
                self.begin(self.scene.clone())?;
                return Ok(Changed::Scene);
            }
            Request::Load {
                scenario,
                character,
                repertoire,
            } => {
                let names = SceneNames {
                    scenario,
                    character,
                    repertoire,
                };
                names.check_shipped(&self.registry)?;
                let scene = names.scene(&self.registry)?;
                self.begin(scene)?;
                self.names = names;
                return Ok(Changed::Scene);
            }
            Request::Open { name, text } => {
                let scene = self.scene.with(&Source::new(name, text), &self.registry)?;
                self.begin(scene)?;
                return Ok(Changed::Scene);
            }
            Request::Watch { features } => view.watch(&features, &self.now)?,
            Request::Inspect {
                character,
                controller,
            } => {
                let character = self.existing(character)?;
                let pool = self.now.actors()[character].supervisor.controllers();
                view.inspect = controller
                    .filter(|c| *c < pool.count())
                    .map(|c| (character, c));
            }
        }
        Ok(Changed::Nothing)
    }

    /// Now, as the time of an input.
    fn at(&self) -> aplomb_framework::scenario::Number {
        (self.step as f64 * self.dt()).into()
    }

    fn existing(&self, character: usize) -> Result<usize> {
        if character < self.now.actors().len() {
            return Ok(character);
        }
        let accepted = format!("below {}", self.now.actors().len());
        Err(Error::refused("character", character, accepted))
    }

    fn act(&mut self, input: ScheduledInput) -> Result<()> {
        if self.history.inputs() >= MOST_INPUTS - self.scene.scenario.events.len() {
            let accepted = "fewer inputs; reset to begin anew";
            return Err(Error::refused("inputs", MOST_INPUTS, accepted));
        }
        if self.is_past() {
            self.branch();
        }
        let deed = Deed::Input(input);
        self.history
            .act(&mut self.now, &self.scene.scenario, self.step, deed)
    }

    fn target(&self, body: &Body) -> Result<DragTarget> {
        match (&body.link, &body.prop) {
            (Some(name), None) => Ok(DragTarget::Link {
                name: name.clone(),
                character: self.existing(body.character)?,
            }),
            (None, Some(name)) => {
                let props: Vec<&str> = self.now.world().props().map(|p| p.name.as_str()).collect();
                let place = props.iter().position(|p| p == name);
                let place = place.ok_or_else(|| Error::unknown("prop", name, props))?;
                Ok(DragTarget::Prop(place))
            }
            _ => Err(Error::refused(
                "drag",
                "of nothing or of two",
                "a link or a prop",
            )),
        }
    }

    fn throw(&mut self, thrown: &Thrown) -> Result<()> {
        let kind = thrown.kind();
        let taken: Vec<&str> = self.now.world().props().map(|p| p.name.as_str()).collect();
        let free = |name: &String| !taken.contains(&name.as_str());
        let mut names =
            std::iter::once(kind.to_owned()).chain((2..).map(|n| format!("{kind}_{n}")));
        let name = names.find(free).unwrap_or_default();
        let at = self.at();
        let prop = thrown.prop(name);
        self.act(ScheduledInput::Throw { at, prop })
    }

    fn set(&mut self, name: &str, value: f64) -> Result<Changed> {
        // The scenario's own bounds, also for what takes effect at once.
        let mut changed = self.scene.clone();
        changed.scenario.set(name, value)?;
        let setting = match name {
            "friction" => Changeable::Friction,
            "gravity" => Changeable::Gravity,
            _ => {
                self.begin(changed)?;
                return Ok(Changed::Scene);
            }
        };
        if self.scene.scenario.parameters.contains_key(name) {
            self.begin(changed)?;
            return Ok(Changed::Scene);
        }
        let (at, value) = (self.at(), value.into());
        self.act(ScheduledInput::Set { at, setting, value })?;
        Ok(Changed::Nothing)
    }

    /// Goes to a step that has been run, and waits there.
    fn seek(&mut self, step: u64) {
        self.paused = true;
        self.owed = 0.0;
        let step = step.min(self.end);
        if step == self.step {
            return;
        }
        let (now, seen) = self.history.at(&self.scene.scenario, step);
        (self.now, self.step, self.seen, self.again) = (now, step, seen, true);
    }

    /// Forgets what came after this step.
    fn branch(&mut self) {
        if !self.is_past() {
            return;
        }
        self.history.cut(self.step);
        self.events.truncate(self.seen);
        (self.end, self.again) = (self.step, false);
        self.cuts += 1;
    }

    /// Begins with another scene; keeps pace and pause.
    pub(super) fn begin(&mut self, scene: Scene) -> Result<()> {
        let names = std::mem::take(&mut self.names);
        let begun = Self::with(scene, names.clone(), self.registry.clone());
        match begun {
            Ok(begun) => {
                let (paused, speed) = (self.paused, self.speed);
                let (generation, cuts) = (self.generation, self.cuts + 1);
                *self = Self {
                    paused,
                    speed,
                    generation,
                    cuts,
                    ..begun
                };
                Ok(())
            }
            Err(e) => {
                self.names = names;
                Err(e)
            }
        }
    }

    /// Another scene in the place of this one.
    ///
    /// # Errors
    /// As [`Self::with`]; the old one then stays.
    pub fn replace(&mut self, scene: Scene) -> Result<()> {
        self.begin(scene)?;
        self.generation += 1;
        Ok(())
    }

    /// Gives a character another supervisor in the running pool: the active controller stays if the
    /// new pool has one of its name, and those that `same` names keep their state.
    pub fn renew(&mut self, character: usize, new: &Supervisor, same: &dyn Fn(&str) -> bool) {
        if self.is_past() {
            self.branch();
        }
        let old = &self.now.actors()[character].supervisor;
        let renewed = old.renewed(new, self.now.sensors(character), same);
        let deed = Deed::Supervisor(character, Box::new(renewed));
        let acted = self
            .history
            .act(&mut self.now, &self.scene.scenario, self.step, deed);
        debug_assert!(acted.is_ok(), "a supervisor is always taken");
        self.scene.cast[character].1 = new.clone();
        self.generation += 1;
    }
}

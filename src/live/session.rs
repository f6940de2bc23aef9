//! A live run: its steps at the watchers' pace, back in time, and on from there.
//!
//! scene, seconds that pass → [`Session`] → simulation, events.

use aplomb_framework::control::{Registry, Supervisor};
use aplomb_framework::events::Event;
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::LONGEST_RUN;

use crate::live::history::{Deed, History};
use crate::live::scene::{LiveScene, SceneNames};

/// s that a run may lag behind before it gives up catching up.
const LAG: f64 = 0.1;
/// The most steps that are done at once, so that requests are heard.
const AT_ONCE: u64 = 200;
/// Weight of the newest measurement of the pace.
const NEWEST: f64 = 0.1;

/// A run that is watched and touched.
///
/// ```
/// use aplomb::live::{Request, SceneNames, Session, View};
///
/// let mut session = Session::new(&SceneNames::default())?; // the humanoid, standing
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
    pub(super) scene: LiveScene,
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
    pub fn new(names: &SceneNames) -> Result<Self> {
        let registry = aplomb_controllers::registry();
        let scene = names.scene(&registry)?;
        Self::with(scene, registry)
    }

    /// Begins with a scene that was built elsewhere.
    ///
    /// # Errors
    /// Links, joints or commands that its characters lack.
    pub fn with(scene: LiveScene, registry: Registry) -> Result<Self> {
        let now = scene.begin()?;
        Ok(Self {
            history: History::new(&now),
            registry,
            scene,
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

    /// Whether it has lasted as long as any run may.
    pub(super) fn is_over(&self) -> bool {
        self.step as f64 * self.dt() >= LONGEST_RUN
    }

    pub(super) fn dt(&self) -> f64 {
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
    pub(super) fn forward(&mut self) {
        if self.is_over() {
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

    /// Goes to a step that has been run, and waits there.
    pub(super) fn seek(&mut self, step: u64) {
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
    pub(super) fn branch(&mut self) {
        if !self.is_past() {
            return;
        }
        self.history.cut(self.step);
        self.events.truncate(self.seen);
        (self.end, self.again) = (self.step, false);
        self.cuts += 1;
    }

    /// Begins with another scene; keeps pace and pause. Watchers are told everything anew.
    ///
    /// # Errors
    /// As [`Self::with`]; the old scene then stays.
    pub fn begin(&mut self, scene: LiveScene) -> Result<()> {
        let begun = Self::with(scene, self.registry.clone())?;
        *self = Self {
            paused: self.paused,
            speed: self.speed,
            generation: self.generation + 1,
            cuts: self.cuts + 1,
            ..begun
        };
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

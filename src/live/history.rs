//! What was done in a live run, and what it takes to go back to any step of it.
//!
//! simulation, inputs → [`History`] → the simulation at any step, replayed from the nearest
//! snapshot. A clone of a simulation continues bit for bit, and so does a replay.

use aplomb_framework::control::Supervisor;
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::{Scenario, ScheduledInput};

/// Snapshots a second of simulated time, as long as they are young.
const SNAPSHOTS: f64 = 4.0;
/// s for which every snapshot is kept.
const YOUNG: f64 = 60.0;
/// Of the older ones, one in so many seconds is kept.
const OLD_EVERY: f64 = 5.0;
/// At most so many older ones; beyond, every other one goes.
const MOST_OLD: usize = 120;

/// Something that was done to the run.
#[derive(Debug, Clone)]
pub(super) enum Deed {
    /// By a watcher.
    Input(ScheduledInput),
    /// A file changed: a character has another supervisor.
    Supervisor(usize, Box<Supervisor>),
}

#[derive(Debug, Clone)]
struct Snapshot {
    step: u64,
    simulation: Simulation,
    /// Events before it.
    events: usize,
}

/// The inputs of a run with their steps, and snapshots of it.
#[derive(Debug, Clone)]
pub struct History {
    deeds: Vec<(u64, Deed)>,
    /// By step; the first is the beginning.
    snapshots: Vec<Snapshot>,
    dt: f64,
}

impl History {
    /// Of a run that has not begun.
    #[must_use]
    pub fn new(beginning: &Simulation) -> Self {
        let snapshot = Snapshot {
            step: 0,
            simulation: beginning.clone(),
            events: 0,
        };
        Self {
            deeds: Vec::new(),
            snapshots: vec![snapshot],
            dt: beginning.world().settings().dt,
        }
    }

    /// How many inputs there were.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.deeds.len()
    }

    /// Inputs of watchers, in their order.
    pub(super) fn scheduled(&self) -> impl Iterator<Item = &ScheduledInput> {
        self.deeds.iter().filter_map(|(_, deed)| match deed {
            Deed::Input(input) => Some(input),
            Deed::Supervisor(..) => None,
        })
    }

    /// Whether files changed during the run.
    pub(super) fn reloaded(&self) -> bool {
        let reload = |(_, d): &(u64, Deed)| matches!(d, Deed::Supervisor(..));
        self.deeds.iter().any(reload)
    }

    /// The run before its first step.
    pub(super) fn beginning(&self) -> &Simulation {
        &self.snapshots[0].simulation
    }

    /// Does a deed now, before the step, and keeps it in mind.
    ///
    /// # Errors
    /// What cannot be done; it is then not kept.
    pub(super) fn act(
        &mut self,
        run: &mut Simulation,
        scenario: &Scenario,
        step: u64,
        deed: Deed,
    ) -> Result<()> {
        apply(run, scenario, &deed)?;
        self.deeds.push((step, deed));
        Ok(())
    }

    /// Does again what was done before this step.
    pub(super) fn repeat(&self, run: &mut Simulation, scenario: &Scenario, step: u64) {
        let from = self.deeds.partition_point(|(at, _)| *at < step);
        for (_, deed) in self.deeds[from..].iter().take_while(|(at, _)| *at == step) {
            // It was possible the first time.
            drop(apply(run, scenario, deed));
        }
    }

    /// The drag or release before this step, if there was one.
    pub(super) fn drag_at(&self, step: u64) -> Option<&ScheduledInput> {
        let here = self.deeds.iter().rev().take_while(|(at, _)| *at >= step);
        let mut inputs = here.filter_map(|(at, deed)| match deed {
            Deed::Input(input) if *at == step => Some(input),
            _ => None,
        });
        let drags = |input: &&ScheduledInput| {
            matches!(
                input,
                ScheduledInput::Drag { .. } | ScheduledInput::Release { .. }
            )
        };
        inputs.find(drags)
    }

    /// Takes a snapshot if one is due at this step.
    pub(super) fn remember(&mut self, run: &Simulation, step: u64, events: usize) {
        let every = (1.0 / (SNAPSHOTS * self.dt)).round().max(1.0) as u64;
        let newest = self.snapshots.last().map_or(0, |s| s.step);
        if step <= newest || !step.is_multiple_of(every) {
            return;
        }
        self.snapshots.push(Snapshot {
            step,
            simulation: run.clone(),
            events,
        });
        self.thin(step);
    }

    /// Drops snapshots that are old and close to others; the beginning stays.
    fn thin(&mut self, now: u64) {
        let steps = |seconds: f64| (seconds / self.dt).round().max(1.0) as u64;
        let (young, old_every) = (now.saturating_sub(steps(YOUNG)), steps(OLD_EVERY));
        self.snapshots
            .retain(|s| s.step >= young || s.step.is_multiple_of(old_every));
        let old = self.snapshots.partition_point(|s| s.step < young);
        if old > MOST_OLD {
            let mut place = 0;
            self.snapshots.retain(|_| {
                place += 1;
                place == 1 || place > old || place % 2 == 1
            });
        }
    }

    /// The run at a step, and how many events came before it.
    pub(super) fn at(&self, scenario: &Scenario, step: u64) -> (Simulation, usize) {
        let after = self.snapshots.partition_point(|s| s.step <= step);
        let nearest = &self.snapshots[after - 1];
        let mut run = nearest.simulation.clone();
        let mut events = nearest.events;
        for at in nearest.step..step {
            self.repeat(&mut run, scenario, at);
            run.step();
            events += run.take_events().len();
        }
        (run, events)
    }

    /// Forgets what came after a step.
    pub(super) fn cut(&mut self, step: u64) {
        self.deeds.retain(|(at, _)| *at < step);
        self.snapshots.retain(|s| s.step <= step);
    }

    /// The same inputs, with the beginning alone.
    pub(super) fn without_snapshots(&self) -> Self {
        Self {
            deeds: self.deeds.clone(),
            snapshots: self.snapshots[..1].to_vec(),
            dt: self.dt,
        }
    }

    /// How many snapshots there are.
    #[must_use]
    pub fn snapshots(&self) -> usize {
        self.snapshots.len()
    }
}

fn apply(run: &mut Simulation, scenario: &Scenario, deed: &Deed) -> Result<()> {
    match deed {
        Deed::Input(input) => run.schedule(scenario, input),
        Deed::Supervisor(character, supervisor) => {
            run.set_supervisor(*character, Supervisor::clone(supervisor));
            Ok(())
        }
    }
}

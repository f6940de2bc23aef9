//! What the trials have in common, and one trial: draw, simulate, watch.
//!
//! seed, index → disturbance → [`Simulation`] → [`FinishedTrial`].

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Result;
use aplomb::framework::character::Model;
use aplomb::framework::control::Registry;
use aplomb::framework::events::{Event, EventKind};
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::{Scenario, ScheduledInput};
use aplomb::training::situations::Worlds;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::falls::{FallRecord, FallWatch};

/// s; when trials are pushed.
const PUSH_AT: f64 = 1.0;
/// Gap under a heap before it drops, m.
const DROP: f64 = 0.02;
/// A trial's own world, relative to the scenario's.
const WORLDS: Worlds = Worlds::VARIED;
/// Steps between two looks at whether to stop.
const PATIENCE: u64 = 500;

/// How trials are disturbed.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrialStart {
    /// Weakest and strongest push either way, N·s.
    pub(super) impulse: [f64; 2],
    /// Largest offset of a joint, rad.
    pub(super) max_angle: f64,
    /// Starts as a heap on the floor.
    pub(super) fallen: bool,
    /// Each in a world of its own.
    pub(super) vary: bool,
}

/// What the trials have in common.
#[derive(Debug)]
pub(super) struct TrialPlan {
    /// Before it is disturbed.
    pub(super) scenario: Scenario,
    pub(super) disturbance: TrialStart,
    registry: Registry,
    model: Arc<Model>,
    pool: Vec<String>,
}

/// One trial before it runs.
#[derive(Debug)]
pub(super) struct Staged {
    index: u64,
    /// Disturbed.
    pub(super) scenario: Scenario,
    push: Option<(String, f64)>,
    pub(super) simulation: Simulation,
}

/// What became of one trial.
#[derive(Debug)]
pub(super) struct FinishedTrial {
    pub(super) index: u64,
    /// Link and horizontal impulse, N·s.
    pub(super) push: Option<(String, f64)>,
    pub(super) standing: bool,
    pub(super) posture: &'static str,
    /// The controller that is active at the end.
    pub(super) active: String,
    /// From the first fall, or of a heap from the start, to standing, s.
    pub(super) time_to_stand: Option<f64>,
    /// Of the first character.
    pub(super) events: Vec<Event>,
    pub(super) falls: Vec<FallRecord>,
    pub(super) steps: u64,
    /// [`Simulation::digest`].
    pub(super) digest: String,
}

impl FinishedTrial {
    /// In words.
    pub(super) fn disturbance(&self) -> String {
        match &self.push {
            Some((link, impulse)) => format!("{link} {impulse:+.2} N·s"),
            None => "no push".to_owned(),
        }
    }
}

impl TrialPlan {
    /// Also builds one simulation, so that bad input shows before the trials begin.
    pub(super) fn new(
        scenario: Scenario,
        registry: Registry,
        disturbance: TrialStart,
    ) -> Result<Self> {
        let simulation = Simulation::new(&scenario, &registry)?;
        let model = Arc::clone(simulation.world().characters()[0].body.model());
        let pool = simulation.actors()[0].supervisor.controllers();
        let pool = pool.map(|c| c.contract().name.clone()).collect();
        Ok(Self {
            scenario,
            disturbance,
            registry,
            model,
            pool,
        })
    }

    /// Names of the first character's controllers.
    pub(super) fn pool(&self) -> &[String] {
        &self.pool
    }

    /// s
    pub(super) fn dt(&self) -> f64 {
        self.scenario.settings.dt
    }

    /// The scenario of trial `index`, disturbed, and its push. What is drawn for the push does not
    /// depend on the other disturbances, and nothing on whether the world varies, which is drawn
    /// last.
    fn draw(&self, index: u64) -> (Scenario, Option<(String, f64)>) {
        let mut rng = ChaCha8Rng::seed_from_u64(self.scenario.seed);
        rng.set_stream(index);
        let mut scenario = self.scenario.clone();
        let push = self.draw_push(&mut rng);
        if let Some((link, impulse)) = &push {
            scenario
                .events
                .push(ScheduledInput::push(PUSH_AT, link, *impulse));
        }
        let TrialStart {
            max_angle,
            fallen,
            vary,
            ..
        } = self.disturbance;
        let start = &mut scenario.characters[0].start;
        for joint in self.model.joints() {
            let part = rng.gen_range(-1.0..1.0);
            let [low, high] = joint.range;
            if fallen {
                let angle = 0.5 * (low + high) + 0.5 * part * (high - low);
                start.angles.insert(joint.name.clone(), angle);
            } else if max_angle > 0.0 {
                let angle = start.angles.entry(joint.name.clone()).or_insert(0.0);
                *angle = (*angle + part * max_angle).clamp(low, high);
            }
        }
        if fallen {
            start.pitch = rng.gen_range(-std::f64::consts::PI..std::f64::consts::PI);
            start.lift = DROP;
        }
        if vary {
            let world = &mut scenario.settings;
            for (setting, [least, most]) in [
                (&mut world.friction, WORLDS.friction),
                (&mut world.torque, WORLDS.torque),
                (&mut world.mass, WORLDS.mass),
            ] {
                *setting *= rng.gen_range(least..most);
            }
        }
        (scenario, push)
    }

    fn draw_push(&self, rng: &mut ChaCha8Rng) -> Option<(String, f64)> {
        let model = &self.model;
        let links = [0, model.trunk, model.head];
        let link = &model.links[links[rng.gen_range(0..links.len())]];
        let part: f64 = rng.gen_range(-1.0..1.0);
        let [least, most] = self.disturbance.impulse;
        let impulse = (least + part.abs() * (most - least)).copysign(part);
        (most > 0.0).then(|| (link.name.clone(), impulse))
    }

    /// Trial `index`, ready to run.
    pub(super) fn stage(&self, index: u64) -> Result<Staged> {
        let (scenario, push) = self.draw(index);
        let simulation = Simulation::new(&scenario, &self.registry)?;
        Ok(Staged {
            index,
            scenario,
            push,
            simulation,
        })
    }

    /// Runs trial `index`; none if it was stopped.
    pub(super) fn run(&self, index: u64, stop: &AtomicBool) -> Result<Option<FinishedTrial>> {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        Ok(self.watch(&mut self.stage(index)?, stop))
    }

    /// Runs a trial that is ready; none if it was stopped.
    pub(super) fn watch(&self, staged: &mut Staged, stop: &AtomicBool) -> Option<FinishedTrial> {
        let simulation = &mut staged.simulation;
        let push = staged.push.clone();
        let steps = (staged.scenario.duration / self.dt()).round() as u64;
        let pushed = push.as_ref().map_or(0.0, |p| p.1);
        let mut watch = FallWatch::new(&self.model, pushed, self.disturbance.fallen, self.dt());
        let mut seen = simulation.events().len();
        for step in 0..steps {
            if step.is_multiple_of(PATIENCE) && stop.load(Ordering::Relaxed) {
                return None;
            }
            simulation.step();
            let events = simulation.events();
            let fresh = events[seen..].iter().filter(|e| e.character == 0);
            watch.observe(simulation.sensors(0), fresh.map(|e| &e.kind));
            seen = events.len();
        }
        let outcome = simulation.outcome(0);
        let (falls, time_to_stand) = watch.finish();
        let of_first = |e: &&Event| e.character == 0 && !matches!(e.kind, EventKind::Push { .. });
        Some(FinishedTrial {
            index: staged.index,
            push,
            standing: outcome.standing,
            posture: outcome.posture.name(),
            active: outcome.active,
            time_to_stand,
            events: simulation
                .events()
                .iter()
                .filter(of_first)
                .cloned()
                .collect(),
            falls,
            steps,
            digest: simulation.digest(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(fallen: bool, vary: bool) -> TrialPlan {
        let scenario = Scenario::standing("humanoid", 1.0);
        let disturbance = TrialStart {
            impulse: [10.0, 60.0],
            max_angle: if fallen { 0.0 } else { 0.1 },
            fallen,
            vary,
        };
        TrialPlan::new(scenario, aplomb::controllers::registry(), disturbance).unwrap()
    }

    #[test]
    fn a_world_of_its_own_changes_neither_push_nor_start() {
        for fallen in [false, true] {
            let (same, own) = (plan(fallen, false), plan(fallen, true));
            for index in 0..50 {
                let ((mut a, push_a), (b, push_b)) = (same.draw(index), own.draw(index));
                assert_eq!(push_a, push_b);
                assert_eq!(a.settings, same.scenario.settings);
                assert_ne!(a.settings, b.settings);
                a.settings = b.settings;
                assert_eq!(a, b);
            }
        }
    }

    #[test]
    fn worlds_vary_within_their_bounds_and_about_the_scenario() {
        let mut plan = plan(false, true);
        plan.scenario.settings.torque = 0.5;
        let worlds: Vec<_> = (0..200).map(|i| plan.draw(i).0.settings).collect();
        let assert_spread = |value: &dyn Fn(usize) -> f64, [least, most]: [f64; 2]| {
            let values = (0..worlds.len()).map(value);
            let [low, high] = values.fold([f64::INFINITY, 0.0], |[l, h], v| [v.min(l), v.max(h)]);
            let margin = 0.05 * (most - least);
            assert!(least <= low && low < least + margin, "{low}");
            assert!(most - margin < high && high <= most, "{high}");
        };
        assert_spread(&|i| worlds[i].friction, WORLDS.friction);
        assert_spread(&|i| worlds[i].torque, WORLDS.torque.map(|t| 0.5 * t));
        assert_spread(&|i| worlds[i].mass, WORLDS.mass);
    }
}

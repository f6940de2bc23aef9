//! How well a trajectory does in a clip: the centre of pressure's distance from the middle of the
//! base of support, with what is charged for a task that is not done (2017 paper, section 4.1).
//!
//! clip, trajectory → rollout → [`Evaluation`].

use aplomb_controllers::kinds::cmrt::Cmrt;
use aplomb_framework::character::Model;
use aplomb_framework::control::Supervisor;
use aplomb_framework::input::Result;
use aplomb_framework::math::square;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use crate::anticipation::clip::Clip;

/// Charged for a pose that is missed, a radian (root of the mean square over joints and time).
const TRACKING: f64 = 2.0;
/// Charged for a fall, and as much again if it is at once.
const FALL: f64 = 10.0;
/// Charged for all expectations together if none is met.
const MISSED: f64 = 5.0;

/// Perturbed starts by which success is judged, and how many have to succeed.
pub const PERTURBED: usize = 20;
/// See [`PERTURBED`].
pub const ENOUGH: usize = 18;
/// Their joints' largest offset, rad: 0.5°.
const OFFSET: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Their largest velocity, m/s.
const VELOCITY: f64 = 0.002;

/// What one rollout showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evaluation {
    /// Least is best.
    pub objective: f64,
    /// √Σ e² over the steps of 1 ms of the motion with a foot on the ground; e in m.
    pub cop_norm: f64,
    /// Root of the mean square of the joints' distance from the reference pose from the task on,
    /// rad.
    pub tracking: f64,
    /// Whether the controller came to its end and every expectation of the scenario was met.
    pub succeeds: bool,
}

/// A trajectory's rollout, and how often it succeeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Judged {
    /// Of the unperturbed start.
    pub objective: f64,
    /// See [`Evaluation::cop_norm`].
    pub cop_norm: f64,
    /// See [`Evaluation::tracking`].
    pub tracking: f64,
    /// Whether enough starts succeed.
    pub succeeds: bool,
    /// Of the perturbed starts.
    pub successes: usize,
    /// Perturbed starts.
    pub starts: usize,
}

impl Judged {
    /// Judges a trajectory, or none; the seed fixes the starts.
    ///
    /// # Errors
    /// As [`evaluate`].
    pub fn new(clip: &Clip, cmrt: Option<&Cmrt>, seed: u64) -> Result<Self> {
        let evaluation = evaluate(clip, cmrt)?;
        let successes = successes(clip, cmrt, seed)?;
        Ok(Self {
            objective: evaluation.objective,
            cop_norm: evaluation.cop_norm,
            tracking: evaluation.tracking,
            succeeds: successes >= ENOUGH,
            successes,
            starts: PERTURBED,
        })
    }
}

/// Runs the clip along a trajectory, or none.
///
/// # Errors
/// What makes a scenario or repertoire invalid.
pub fn evaluate(clip: &Clip, cmrt: Option<&Cmrt>) -> Result<Evaluation> {
    let supervisor = clip.supervisor(cmrt.cloned())?;
    rollout(clip, &clip.scenario, supervisor, None)
}

/// The objective, averaged over the clip's own start and so many perturbed ones: what is found on the
/// edge of falling is then found out.
///
/// # Errors
/// As [`evaluate`].
pub fn averaged(clip: &Clip, cmrt: Option<&Cmrt>, starts: usize, seed: u64) -> Result<Evaluation> {
    let supervisor = clip.supervisor(cmrt.cloned())?;
    let mut own = rollout(clip, &clip.scenario, supervisor.clone(), None)?;
    let mut sum = own.objective;
    for i in 0..starts {
        let further = perturbed(clip, supervisor.clone(), seed, i)?;
        sum += further.objective;
        own.succeeds &= further.succeeds;
    }
    own.objective = sum / (starts + 1) as f64;
    Ok(own)
}

/// From how many of [`PERTURBED`] slightly different starts the clip succeeds.
///
/// # Errors
/// As [`evaluate`].
pub fn successes(clip: &Clip, cmrt: Option<&Cmrt>, seed: u64) -> Result<usize> {
    let supervisor = clip.supervisor(cmrt.cloned())?;
    let one = |i: usize| perturbed(clip, supervisor.clone(), seed, i).map(|e| e.succeeds);
    let all: Result<Vec<bool>> = (0..PERTURBED).into_par_iter().map(one).collect();
    Ok(all?.into_iter().filter(|s| *s).count())
}

/// A rollout from the perturbed start of this number.
fn perturbed(clip: &Clip, supervisor: Supervisor, seed: u64, number: usize) -> Result<Evaluation> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number as u64 + 1);
    let mut scenario = clip.scenario.clone();
    perturb(&mut scenario, clip.model(), &mut random);
    let velocity = random.gen_range(-VELOCITY..=VELOCITY);
    rollout(clip, &scenario, supervisor, Some(velocity))
}

/// Offsets of all joints of the first character's start.
fn perturb(scenario: &mut Scenario, model: &Model, random: &mut ChaCha8Rng) {
    let start = &mut scenario.characters[0].start;
    for joint in model.joints() {
        let angle = start.angles.entry(joint.name.clone()).or_insert(0.0);
        let offset = random.gen_range(-OFFSET..=OFFSET);
        *angle = (*angle + offset).clamp(joint.range[0], joint.range[1]);
    }
}

/// What a rollout has summed up so far.
#[derive(Debug, Default)]
struct Sums {
    cop: f64,
    tracking: f64,
    tracked: usize,
}

/// One rollout; it ends early when the controller has been left before its end.
fn rollout(
    clip: &Clip,
    scenario: &Scenario,
    supervisor: Supervisor,
    velocity: Option<f64>,
) -> Result<Evaluation> {
    let cast = vec![(std::sync::Arc::clone(clip.model()), supervisor)];
    let mut run = Simulation::with_cast(scenario, cast)?;
    if let Some(velocity) = velocity {
        let root = clip.model().links[0].name.clone();
        let impulse = velocity * clip.model().total_mass();
        run.shove(0, &root, [impulse, 0.0], scenario.settings.dt)?;
    }
    let name = &clip.contract().name;
    let controller = clip.controller();
    let ([begin, end], task) = (clip.window(), clip.task());
    // What follows a motion that is not the last does not count.
    let last = if clip.goes_on() {
        end
    } else {
        scenario.duration
    };
    let dt = scenario.settings.dt;
    let mut pose = vec![0.0; clip.model().joint_count()];
    let mut sums = Sums::default();
    let mut fell = None;
    while run.time() + 0.5 * dt < last {
        run.step();
        let now = run.sensors(0);
        let since = now.time - clip.at;
        if since < 0.0 || now.time > end {
            continue;
        }
        // Also before the motion: what is lost then cannot be won.
        let active = run.actors()[0].supervisor.active();
        if now.is_down() || (active != Some(name) && now.time < end - 2.0 * dt) {
            fell = Some(now.time);
            break;
        }
        if now.time < begin {
            continue;
        }
        // Without a foot on the ground there is no centre of pressure: left out, as in the paper.
        if let (Some(p), Some(s)) = (now.cop, now.support_centre()) {
            sums.cop += square(p - s);
        }
        if now.time >= task {
            controller.pose_at(since, &mut pose);
            let off = |(a, b): (&f64, &f64)| square(a - b);
            let squares: f64 = now.state.angles().iter().zip(&pose).map(off).sum();
            sums.tracking += squares / pose.len() as f64;
            sums.tracked += 1;
        }
    }
    let expected = if clip.goes_on() {
        &[]
    } else {
        scenario.expect.as_slice()
    };
    let unmet = expected
        .iter()
        .filter(|e| run.unmet(std::slice::from_ref(e)).is_some())
        .count();
    let tracking = (sums.tracking / sums.tracked.max(1) as f64).sqrt();
    // The paper's norm is over steps of 1 ms.
    let cop_norm = (sums.cop * dt / 1e-3).sqrt();
    let missed = MISSED * unmet as f64 / expected.len().max(1) as f64;
    let objective = match fell {
        // What has not been lived to see is no gain.
        Some(t) => FALL * (2.0 - ((t - begin) / (end - begin)).clamp(0.0, 1.0)) + MISSED,
        None => cop_norm + TRACKING * tracking + missed,
    };
    Ok(Evaluation {
        objective,
        cop_norm,
        tracking,
        succeeds: fell.is_none() && unmet == 0,
    })
}

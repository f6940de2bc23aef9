//! Situations in which a controller takes over: heaps on the floor and falls, in randomised worlds;
//! where these seldom lead to it, those that its own rollouts begin with.
//!
//! seed, index → random heap, push or disturbance → rollout under the repertoire until the controller
//! takes over → [`Simulation`] to be cloned for every candidate.
//!
//! Starts do not depend on the controller's own numbers, only on its contract and the others'. One
//! rollout serves any number of controllers.

use std::ops::ControlFlow;
use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Supervisor};
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::situations::Worlds;
use crate::situations::disturbed::Disturbed;

/// s for which a start is waited for.
const LONGEST: f64 = 7.0;
/// Gap under a heap before it drops, m.
const DROP: f64 = 0.02;
/// So many without a single start are enough to give up.
const HOPELESS: usize = 96;
/// s; when characters are pushed.
const PUSH_AT: f64 = 0.3;
/// Random stream of the first of a controller's own situations.
const OWN: u64 = 1 << 32;
/// So many of these for each start that is missing.
const OWN_PATIENCE: usize = 10;

/// Where starts come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartSource {
    /// The worlds.
    pub worlds: Worlds,
    /// Part of the starts that begin as heaps; the others are pushed over.
    pub heaps: f64,
    /// Weakest and strongest of these pushes, N·s.
    pub impulse: [f64; 2],
    /// Starts are looked for in so many heaps and falls for each that is asked for.
    pub patience: usize,
    /// Fixes everything random.
    pub seed: u64,
}

/// A controller that starts are wanted for.
#[derive(Debug)]
pub struct Wanted<'a> {
    /// Its contract.
    pub contract: &'a Contract,
    /// How its own rollouts begin, if that is known.
    pub disturbed: Option<Disturbed>,
}

/// The starts of a controller.
#[derive(Debug, Clone, Default)]
pub struct Starts {
    /// All, those of heaps and falls first.
    pub runs: Vec<Simulation>,
    /// How many begin as its own rollouts do.
    pub own: usize,
}

/// For each controller the first `count` starts, by index, in which the repertoire hands over to it,
/// or, if it acts only on command, in which its pre-condition holds. Where that is too rare in heaps
/// and falls, the others begin as the controller's own rollouts do, up to where its pre-condition
/// holds and it could be commanded; there are fewer where that is not known or does not help.
/// `watch` sees how many there are so far, of all controllers, and may end the work.
///
/// # Errors
/// A supervisor for another character.
pub fn starts(
    source: StartSource,
    count: usize,
    model: &Arc<Model>,
    wanted: &[Wanted],
    before: &Supervisor,
    mut watch: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Vec<Starts>> {
    let everyone: Vec<&Contract> = wanted.iter().map(|w| w.contract).collect();
    let begin = |rng: &mut ChaCha8Rng| heap_or_push(source, rng, model, before);
    let common = Streams {
        seed: source.seed,
        first: 0,
        patience: source.patience,
    };
    let found = search(common, count, &everyone, begin, &mut watch)?;
    let mut total = found.iter().map(Vec::len).sum::<usize>();
    let mut all: Vec<Starts> = found
        .into_iter()
        .map(|runs| Starts { runs, own: 0 })
        .collect();
    let own_streams = Streams {
        seed: source.seed,
        first: OWN,
        patience: OWN_PATIENCE,
    };
    for (one, starts) in wanted.iter().zip(&mut all) {
        let before_it = starts.runs.len();
        let missing = count - before_it;
        if let Some(disturbed) = &one.disturbed
            && missing > 0
            && watch(total).is_continue()
        {
            let begin = |rng: &mut ChaCha8Rng| {
                let mut run = disturbed.run(source.worlds.draw(rng), rng)?;
                run.set_supervisor(0, before.clone());
                Ok(run)
            };
            let mut watch = |found| watch(total + found);
            let commanded = Contract {
                weight: 0,
                ..one.contract.clone()
            };
            let found = search(own_streams, missing, &[&commanded], begin, &mut watch)?;
            starts.runs.extend(found.into_iter().flatten());
            starts.own = starts.runs.len() - before_it;
            total += starts.own;
        }
    }
    Ok(all)
}

/// Which situations are looked through.
#[derive(Clone, Copy)]
struct Streams {
    seed: u64,
    /// Random stream of the first.
    first: u64,
    /// So many for each start that is asked for.
    patience: usize,
}

/// Looks through situations for `count` starts of each contract.
fn search(
    Streams {
        seed,
        first,
        patience,
    }: Streams,
    count: usize,
    contracts: &[&Contract],
    begin: impl Fn(&mut ChaCha8Rng) -> Result<Simulation> + Sync,
    watch: &mut impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Vec<Vec<Simulation>>> {
    let mut found: Vec<Vec<Simulation>> = vec![Vec::with_capacity(count); contracts.len()];
    let mut next = 0;
    let most = (patience * count).max(HOPELESS);
    // In batches of fixed size, so that the number of threads changes nothing.
    let size = count.clamp(8, 32);
    while next < most {
        let hopeful = |starts: &Vec<Simulation>| next < HOPELESS || !starts.is_empty();
        let missing: Vec<usize> = (0..contracts.len())
            .filter(|c| found[*c].len() < count && hopeful(&found[*c]))
            .collect();
        if missing.is_empty() {
            break;
        }
        let wanted: Vec<&Contract> = missing.iter().map(|c| contracts[*c]).collect();
        let batch: Vec<Vec<Option<Simulation>>> = (next..next + size)
            .into_par_iter()
            .map(|i| {
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                rng.set_stream(first + i as u64);
                Ok(handed_over(begin(&mut rng)?, &wanted))
            })
            .collect::<Result<_>>()?;
        for starts in batch {
            for (c, start) in missing.iter().zip(starts) {
                found[*c].extend(start);
            }
        }
        found.iter_mut().for_each(|starts| starts.truncate(count));
        next += size;
        if watch(found.iter().map(Vec::len).sum()).is_break() {
            break;
        }
    }
    Ok(found)
}

/// A character that falls in a heap or is pushed over.
fn heap_or_push(
    source: StartSource,
    rng: &mut ChaCha8Rng,
    model: &Arc<Model>,
    before: &Supervisor,
) -> Result<Simulation> {
    let mut scenario = Scenario::standing(&model.name, LONGEST);
    scenario.settings = source.worlds.draw(rng);
    let heap = rng.gen_range(0.0..1.0) < source.heaps;
    if heap {
        let start = &mut scenario.characters[0].start;
        for joint in model.joints() {
            let [low, high] = joint.range;
            start
                .angles
                .insert(joint.name.clone(), rng.gen_range(low..high));
        }
        start.pitch = rng.gen_range(-std::f64::consts::PI..std::f64::consts::PI);
        start.lift = DROP;
    }
    let mut run = Simulation::with_cast(&scenario, vec![(Arc::clone(model), before.clone())])?;
    if !heap {
        run.run(PUSH_AT);
        let link = [0, model.trunk, model.head][rng.gen_range(0..3)];
        let impulse = rng.gen_range(source.impulse[0]..source.impulse[1]);
        let sign = if rng.gen_range(0..2) == 0 { 1.0 } else { -1.0 };
        run.push(0, &model.links[link].name, sign * impulse)?;
    }
    Ok(run)
}

/// One situation, up to where each of the contracts' controllers takes over in it.
fn handed_over(begun: Simulation, contracts: &[&Contract]) -> Vec<Option<Simulation>> {
    let mut run = begun.clone();
    let mut taken: Vec<Option<u32>> = vec![None; contracts.len()];
    let mut steps = 0;
    while run.time() < LONGEST && taken.iter().any(Option::is_none) {
        run.step();
        for (contract, taken) in contracts.iter().zip(&mut taken) {
            if taken.is_none() && takes_over(contract, &run) {
                *taken = Some(steps);
            }
        }
        steps += 1;
    }
    // Up to the step in which it took over, so that what it did in it does not matter.
    let mut starts = vec![None; contracts.len()];
    let steps = taken.iter().flatten().max().map_or(0, |last| last + 1);
    let mut again = begun;
    for step in 0..steps {
        for (start, taken) in starts.iter_mut().zip(&taken) {
            if *taken == Some(step) {
                *start = Some(again.clone());
            }
        }
        again.step();
    }
    starts
}

fn takes_over(contract: &Contract, run: &Simulation) -> bool {
    run.actors()[0].supervisor.active() == Some(&contract.name)
        || contract.weight == 0 && contract.precondition.holds(run.sensors(0))
}

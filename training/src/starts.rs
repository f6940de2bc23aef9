//! Situations in which a controller takes over: heaps on the floor and falls, in randomised worlds.
//!
//! seed, index → random heap or push → rollout under the repertoire until the controller takes over
//! → [`Simulation`] to be cloned for every candidate.
//!
//! Starts do not depend on the controller's own numbers, only on its contract and the others'. One
//! rollout serves any number of controllers.

use std::ops::ControlFlow;
use std::sync::Arc;

use aplomb_framework::Result;
use aplomb_framework::contract::Contract;
use aplomb_framework::model::Model;
use aplomb_framework::scenario::Scenario;
use aplomb_framework::simulation::Simulation;
use aplomb_framework::supervisor::Supervisor;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::worlds::Worlds;

/// s for which a start is waited for.
const LONGEST: f64 = 7.0;
/// Gap under a heap before it drops, m.
const DROP: f64 = 0.02;
/// N·s; pushes that nobody withstands.
const PUSHES: [f64; 2] = [70.0, 260.0];
/// So many without a single start are enough to give up.
const HOPELESS: usize = 96;
/// s; when characters are pushed.
const PUSH_AT: f64 = 0.3;

/// Where starts come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// The worlds.
    pub worlds: Worlds,
    /// Part of the starts that begin as heaps; the others are pushed over.
    pub heaps: f64,
    /// Starts are looked for in so many situations for each that is asked for.
    pub patience: usize,
    /// Fixes everything random.
    pub seed: u64,
}

/// For each contract the first `count` starts, by index, in which the repertoire hands over to the
/// controller with this contract, or, if it acts only on command, in which its pre-condition holds.
/// There are fewer where that is too rare. `watch` sees how many there are so far, of all contracts,
/// and may end the work.
///
/// # Errors
/// A mind for another character.
pub fn starts(
    source: Source,
    count: usize,
    model: &Arc<Model>,
    contracts: &[&Contract],
    before: &Supervisor,
    mut watch: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Vec<Vec<Simulation>>> {
    let mut found: Vec<Vec<Simulation>> = vec![Vec::with_capacity(count); contracts.len()];
    let mut next = 0;
    let most = (source.patience * count).max(HOPELESS);
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
            .map(|i| situation(source, i as u64, model, &wanted, before))
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

/// One situation, up to where each of the contracts' controllers takes over in it.
fn situation(
    source: Source,
    index: u64,
    model: &Arc<Model>,
    contracts: &[&Contract],
    before: &Supervisor,
) -> Result<Vec<Option<Simulation>>> {
    let mut rng = ChaCha8Rng::seed_from_u64(source.seed);
    rng.set_stream(index);
    let mut scenario = Scenario::standing(&model.name, LONGEST);
    scenario.settings = source.worlds.draw(&mut rng);
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
        let impulse = rng.gen_range(PUSHES[0]..PUSHES[1]);
        let sign = if rng.gen_range(0..2) == 0 { 1.0 } else { -1.0 };
        run.push(0, &model.links[link].name, sign * impulse)?;
    }
    let begun = run.clone();
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
    Ok(starts)
}

fn takes_over(contract: &Contract, run: &Simulation) -> bool {
    run.actors()[0].mind.active() == Some(&contract.name)
        || contract.weight == 0 && contract.precondition.holds(run.sensors(0))
}

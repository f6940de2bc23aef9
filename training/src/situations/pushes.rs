//! Pushes of a character that stands: where they act, and a row of them in random worlds.
//!
//! pushes, supervisor, worlds → [`Simulation`]s at the moment at which the character is pushed.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::Supervisor;
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::situations::worlds::Worlds;

/// s; when the character is pushed.
const PUSH_AT: f64 = 0.5;

/// Where a push acts: on the centre of mass of a link that every character has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Site {
    /// The root link, the humanoid's pelvis, where an impulse turns the character least.
    Root,
    /// The trunk.
    Trunk,
    /// The head.
    Head,
}

impl Site {
    /// The link's name.
    #[must_use]
    pub fn link(self, model: &Model) -> &str {
        let link = match self {
            Self::Root => 0,
            Self::Trunk => model.trunk,
            Self::Head => model.head,
        };
        &model.links[link].name
    }
}

/// Pushes in pairs, forward and backward, one pair after the other stronger.
#[derive(Debug, Clone, PartialEq)]
pub struct Pushes {
    /// Weakest and strongest, N·s; even steps between.
    pub impulse: [f64; 2],
    /// Where the pairs act, in turn; at the trunk if there is none.
    pub sites: Vec<Site>,
    /// How many.
    pub count: usize,
    /// Fixes worlds and moments.
    pub seed: u64,
}

/// Whether the push of this index goes forward.
#[must_use]
pub fn is_forward(index: usize) -> bool {
    index.is_multiple_of(2)
}

impl Pushes {
    /// Characters that have stood under `supervisor`, at the moment at which they are pushed.
    ///
    /// # Errors
    /// A supervisor for another character.
    pub fn begin(
        &self,
        model: &Arc<Model>,
        supervisor: &Supervisor,
        worlds: Worlds,
    ) -> Result<Vec<Simulation>> {
        let one = |i: usize| {
            let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
            rng.set_stream(i as u64);
            let mut scenario = Scenario::standing(&model.name, 1.0);
            scenario.settings = worlds.draw(&mut rng);
            let cast = vec![(Arc::clone(model), supervisor.clone())];
            let mut run = Simulation::with_cast(&scenario, cast)?;
            run.run(PUSH_AT + rng.gen_range(0.0..0.2));
            let (site, impulse) = self.push(i);
            run.push(0, site.link(model), impulse)?;
            Ok(run)
        };
        (0..self.count).into_par_iter().map(one).collect()
    }

    /// Site and impulse (N·s, forward positive) of a push.
    fn push(&self, index: usize) -> (Site, f64) {
        let (pair, pairs) = (index / 2, self.count.div_ceil(2).max(2));
        let part = pair as f64 / (pairs - 1) as f64;
        let sign = if is_forward(index) { 1.0 } else { -1.0 };
        let [low, high] = self.impulse;
        let site = self.sites.get(pair % self.sites.len().max(1));
        (
            *site.unwrap_or(&Site::Trunk),
            sign * (low + part * (high - low)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_go_both_ways_evenly_over_the_impulses_and_the_sites() {
        let pushes = Pushes {
            impulse: [60.0, 120.0],
            sites: vec![Site::Trunk, Site::Head],
            count: 8,
            seed: 0,
        };
        let all: Vec<(Site, f64)> = (0..8).map(|i| pushes.push(i)).collect();
        let one = |site, impulse: f64| [(site, impulse), (site, -impulse)];
        let expected = [
            one(Site::Trunk, 60.0),
            one(Site::Head, 80.0),
            one(Site::Trunk, 100.0),
            one(Site::Head, 120.0),
        ];
        assert_eq!(all, expected.concat());
    }
}

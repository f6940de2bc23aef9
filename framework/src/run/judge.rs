//! Whether a run has met the expectations of its scenario.
//!
//! watches, events, ends → nothing, or the first expectation that is unmet, in words.

use crate::events::{Event, EventKind};
use crate::run::simulation::Simulation;
use crate::scenario::Expectation;

impl Simulation {
    /// Whether the run has met all of these expectations of its scenario.
    #[must_use]
    pub fn met(&self, expectations: &[Expectation]) -> bool {
        self.unmet(expectations).is_none()
    }

    /// The first expectation of a scenario that the run did not meet, in words.
    #[must_use]
    pub fn unmet(&self, expectations: &[Expectation]) -> Option<String> {
        expectations.iter().find_map(|e| self.unmet_one(e))
    }

    /// What the run has not shown of an expectation, in words; none if it has.
    fn unmet_one(&self, expectation: &Expectation) -> Option<String> {
        match expectation {
            Expectation::Balanced { .. }
            | Expectation::Holds { .. }
            | Expectation::Reaches { .. }
            | Expectation::Prop { .. } => {
                match self.watches.iter().find(|w| w.expectation == *expectation) {
                    Some(watch) => watch.unmet(&self.world),
                    None => Some("an expectation that the run's own scenario has not".to_owned()),
                }
            }
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
                let seen = self.actors[*character].first_in(*posture);
                (seen.is_none_or(|t| t > *before))
                    .then(|| format!("not {} before {before} s", posture.name()))
            }
        }
    }
}

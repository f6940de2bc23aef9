//! Whether a run shows what its scenario expects of it.
//!
//! [`Expectation`], simulation → nothing, or what is missing, in words.

use crate::event::{Event, EventKind};
use crate::scenario::Expectation;
use crate::simulation::Simulation;

impl Expectation {
    /// What a run has not shown, in words; none if it has.
    pub(crate) fn disappointment(&self, run: &Simulation) -> Option<String> {
        match self {
            Self::Standing { character } => (!run.outcome(*character).standing)
                .then(|| format!("character {character} does not stand at the end")),
            Self::Active {
                name,
                before,
                character,
            } => {
                let became = |e: &Event| {
                    matches!(&e.kind, EventKind::Switch { to, .. } if to == name)
                        && e.character == *character
                        && e.time <= *before
                };
                (!run.events().iter().any(became))
                    .then(|| format!("'{name}' was not active before {before} s"))
            }
            Self::Posture {
                posture,
                before,
                character,
            } => {
                let seen = run.actors()[*character].first_in(*posture);
                (seen.is_none_or(|t| t > *before))
                    .then(|| format!("not {} before {before} s", posture.name()))
            }
        }
    }
}

//! Where a scenario was read from.
//!
//! [`Source`] → line and column of a value that is refused later.

use std::fmt;
use std::sync::Arc;

use crate::input::{Error, Source};

/// The text that a scenario was read from, for messages alone: it is no part of what the scenario
/// says. Two scenarios that say the same are equal wherever they were read, and print alike.
#[derive(Clone, Default)]
pub struct Origin(Arc<Source>);

impl Origin {
    pub(super) fn new(source: &Source) -> Self {
        Self(Arc::new(source.clone()))
    }

    /// Whether the scenario was not read from a text.
    #[must_use]
    pub fn is_nowhere(&self) -> bool {
        self.0.text.is_empty()
    }

    /// The refusal with its line and column; with `name` if there is no text.
    pub(super) fn locate(&self, error: Error, name: &str) -> Error {
        if self.is_nowhere() {
            return error.at(name);
        }
        self.0.locate(error)
    }
}

impl PartialEq for Origin {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("…")
    }
}

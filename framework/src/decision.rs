//! How a supervisor explains itself: the bids, and what was decided why.
//!
//! supervisor → [`Decision`] → events.

use serde::{Deserialize, Serialize};

/// Why control changed hands.
#[derive(Debug, Clone, PartialEq)]
pub enum Why {
    /// Nothing was active yet.
    Start,
    /// The former controller reached its post-condition.
    Succeeded,
    /// The former controller failed; the clause or reason.
    Failed(String),
    /// A command called.
    Command,
}

/// What one controller said in an arbitration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bid {
    /// Its name.
    pub controller: String,
    /// Its suitability; 0 if it refused.
    pub suitability: u32,
    /// Why it bid 0.
    pub refusal: Option<String>,
}

/// What a supervisor decided, with the time in s.
#[derive(Debug, Clone, PartialEq)]
pub enum Decision {
    /// Control changed hands.
    Switch {
        /// s
        time: f64,
        /// The former controller; none at the start.
        from: Option<String>,
        /// The new one.
        to: String,
        /// Why.
        why: Why,
        /// What each controller of the pool said.
        bids: Vec<Bid>,
    },
    /// A commanded controller's pre-condition does not hold.
    Refused {
        /// s
        time: f64,
        /// The command.
        command: String,
        /// The controller that answers to it.
        controller: String,
        /// The clause that refused.
        clause: String,
        /// The value that it refused.
        value: Option<f64>,
    },
    /// The command called its controller.
    Obeyed {
        /// s
        time: f64,
        /// The command.
        command: String,
    },
}

//! What happens in a run: pushes, commands, switches, refusals, falls.
//!
//! simulation, actors → [`Event`] → trajectory, timelines, counts.

use serde::{Deserialize, Serialize};

use crate::decision::Bid;

/// Something that happened, with the time in s and the character it happened to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// s
    pub time: f64,
    /// Place among the world's characters.
    pub character: usize,
    /// What.
    pub kind: EventKind,
}

/// The kinds of events.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum EventKind {
    /// A push began.
    Push {
        /// The link that is pushed.
        link: String,
        /// N·s
        impulse: [f64; 2],
    },
    /// A command was given.
    Command {
        /// As given.
        text: String,
        /// Whether a controller answers to it and took it up.
        accepted: bool,
    },
    /// Control changed hands.
    Switch {
        /// The former controller.
        from: Option<String>,
        /// The new one.
        to: String,
        /// `start`, `succeeded`, `command`, or `failed: REASON`.
        why: String,
        /// What each controller of the pool said.
        bids: Vec<Bid>,
    },
    /// A command was refused.
    Refused {
        /// The command.
        command: String,
        /// The controller that answers to it, if one does.
        controller: Option<String>,
        /// The clause that refused, or what is wrong with the command.
        clause: String,
        /// The value that it refused.
        value: Option<f64>,
    },
    /// Something other than feet supports it, for the first time since it stood or the run began.
    Fell,
    /// Standing again, after a fall.
    Stood,
}

//! What happens in a run, as data: one vocabulary for supervisor, world, recording, JSON and pictures.
//!
//! supervisor, world, run → [`Event`] → recording, reports, pictures.

mod bid;
mod event;
mod role;
mod unmet;

pub use bid::{Bid, Refusal};
pub use event::{Event, EventKind, Reason};
pub use role::Role;
pub use unmet::{Found, Unmet};

#[cfg(test)]
mod tests;

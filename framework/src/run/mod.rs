//! A run: the loop of sensing, control and physics, its events, expectations, digest and recording.
//!
//! scenario → [`Simulation`] → events, [`Outcome`], [`Trajectory`].

mod actor;

mod export;
mod inputs;
mod judge;
mod recording;
mod schedule;
mod simulation;
mod start;
mod trajectory;
mod watch;

pub use actor::{Actor, Outcome, STANDING_FOR};
pub use export::{Datum, Export};
pub use simulation::{Simulation, tick};
pub use start::start_state;
pub use trajectory::{Cast, Digest, Header, Moment, Trajectory, push_character, row_width};

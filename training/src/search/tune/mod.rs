//! Which numbers of a controller file are searched, kind by kind.
//!
//! controller file ↔ point of the unit cube.

mod balance;
mod fall;
mod layout;
mod numbers;
mod pose;
mod stance;
mod step;

pub use numbers::*;

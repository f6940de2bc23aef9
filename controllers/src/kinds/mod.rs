//! The kinds of controllers: one kind, one file or folder.
//!
//! spec (RON) + contract + model → a controller; sensors → torques.

pub mod balance;
pub mod cmrt;
pub mod fall;
pub mod pose;
pub mod rest;
pub mod stance;
pub mod step;

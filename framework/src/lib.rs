//! The framework of Aplomb: characters, their dynamics and bodies, sensors, the controller
//! contract and the supervisor.
//!
//! # Units, frames, signs
//!
//! SI and radians everywhere. World frame: x forward, y up. Angles are counter-clockwise positive;
//! a joint's angle is child minus parent; all 0 is upright with arms hanging and feet flat,
//! pointing to +x. Hence: pitch + leans back; waist and neck − bend forward; shoulder + arm
//! forward; elbow + flexes; hip + flexes; knee − flexes; ankle + lifts the toes. A link's frame
//! lies at its joint, with axes as the world's when all angles are 0.
//!
//! # Data flow
//!
//! - character file → [`model`] → [`body`] in a [`world`]
//! - body → [`state`] → [`kinematics`] → [`sensors`] → [`feature`] → [`condition`]
//! - boundary file → [`boundary`], a learned region → [`condition`]
//! - conditions → [`contract`] → [`controller`] → [`supervisor`] → torques → body
//! - state → [`dynamics`] → controllers that need M, h, A and Jacobians
//! - files → [`registry`] → [`repertoire`] → supervisor; text → [`command`] → supervisor
//! - [`scenario`] → [`simulation`] → [`trajectory`]
//!
//! Files whose items are found elsewhere: `model_file`, `model_tree`, `model_digest` (in [`model`]),
//! `vocabulary` ([`feature`]), `boundary_bounds`, `boundary_decision` ([`boundary`]), `pool`,
//! `decision` ([`supervisor`]), `scenario_bounds`, `scenario_number`, `scenario_props`,
//! `expectation` ([`scenario`]), `start`, `schedule`, `actor`, `watch` ([`simulation`]), `event`,
//! `trajectory_file` ([`trajectory`]), `settings`, `prop`, `fastening`, `grips` ([`world`]),
//! `contact` ([`body`]), `sensed_prop` ([`sensors`]).

mod actor;
pub mod body;
pub mod boundary;
mod boundary_bounds;
mod boundary_decision;
pub mod command;
pub mod condition;
mod contact;
pub mod contract;
pub mod controller;
mod decision;
pub mod dynamics;
pub mod error;
mod event;
mod expectation;
mod fastening;
pub mod feature;
pub mod file;
mod grips;
pub mod kinematics;
pub mod model;
mod model_digest;
mod model_file;
mod model_tree;
mod pool;
pub mod prelude;
mod prop;
pub mod registry;
pub mod repertoire;
pub mod scenario;
mod scenario_bounds;
mod scenario_number;
mod scenario_props;
mod schedule;
mod sensed_prop;
pub mod sensors;
mod settings;
pub mod simulation;
mod start;
pub mod state;
pub mod supervisor;
pub mod trajectory;
mod trajectory_file;
mod vocabulary;
mod watch;
pub mod world;

pub use error::{Error, Result};

/// The engine, for those who own the sets that a [`body::Body`] lives in.
pub use rapier2d;

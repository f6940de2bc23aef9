//! The framework of Aplomb: characters, their dynamics and bodies, sensors, the controller
//! contract, the supervisor, and runs.
//!
//! # Units, frames, signs
//!
//! SI and radians everywhere. World frame: x forward, y up. Angles are counter-clockwise positive;
//! a joint's angle is child minus parent; all 0 is upright with arms hanging and feet flat,
//! pointing to +x. Hence: pitch + leans back; waist and neck − bend forward; shoulder + arm
//! forward; elbow + flexes; hip + flexes; knee − flexes; ankle + lifts the toes. A link's frame
//! lies at its joint, with axes as the world's when all angles are 0.
//!
//! # Folders
//!
//! Each depends only on those above it in this list.
//!
//! | folder | data in → data out |
//! |---|---|
//! | [`math`] | numbers → numbers, with the same bits everywhere |
//! | [`input`] | path → text, or an error with its place |
//! | [`events`] | what happens in a run |
//! | [`character`] | character file → model; state → kinematics, dynamics |
//! | [`sensing`] | state, contacts → sensors → features |
//! | [`world`] | models, props, torques → motion, contacts; the physics engine |
//! | [`control`] | files → controllers → supervisor; sensors → bids → torques |
//! | [`scenario`] | scenario file → who takes part, what is done, what is expected |
//! | [`run`] | scenario → simulation → events, recording |

#![cfg_attr(
    test,
    allow(
        clippy::disallowed_methods,
        reason = "tests compare with the standard library's functions"
    )
)]

pub mod character;
pub mod control;
pub mod events;
pub mod input;
pub mod math;
pub mod prelude;
pub mod run;
pub mod scenario;
pub mod sensing;
pub mod world;

pub use character::Model;
pub use control::{Condition, Contract, Controller, Progress, Registry, Spec, Supervisor};
pub use input::{Error, Result};
pub use run::Simulation;
pub use scenario::Scenario;
pub use sensing::Sensors;

/// The engine, for those who own the sets that a [`world::Body`] lives in.
pub use rapier2d;

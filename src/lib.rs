//! Aplomb: composable controllers for physically simulated planar characters. They balance, step,
//! fall, roll, rise and anticipate.
//!
//! This is the facade: [`framework`] (characters, world, sensors, contracts, supervisor),
//! [`controllers`] (the motor skills), [`training`] (optimisation of their numbers), [`scenarios`]
//! (the shipped ones), [`mod@figure`] (what characters look like), [`live`] (runs that are watched and
//! touched) and [`mod@render`] (pictures of recorded runs). SI units and radians
//! everywhere; frames and signs are those of [`framework`].
//!
//! The feature `program`, on by default, is what the command-line program needs: [`training`],
//! [`mod@render`], the server of [`live`]. A game or a page does without:
//! `aplomb = { default-features = false }`.
//!
//! # The pipeline
//!
//! ```
//! use aplomb::framework::scenario::Scenario;
//! use aplomb::framework::run::Simulation;
//!
//! // A character with its repertoire: scenario → simulation.
//! let scenario = Scenario::standing("humanoid", 3.0);
//! let registry = aplomb::controllers::registry();
//! let mut simulation = Simulation::new(&scenario, &registry)?;
//!
//! // A light push on the chest, from behind, after 0.5 s.
//! simulation.run(0.5);
//! simulation.push(0, "torso", 10.0)?;
//! simulation.run(2.5);
//!
//! // What became of it.
//! let outcome = simulation.outcome(0);
//! assert!(outcome.standing, "{outcome:?}");
//! assert_eq!(outcome.active, "balance");
//! # Ok::<(), aplomb::framework::Error>(())
//! ```

pub use aplomb_controllers as controllers;
pub use aplomb_framework as framework;
#[cfg(feature = "program")]
pub use aplomb_training as training;

pub mod figure;
pub mod live;
#[cfg(feature = "program")]
#[allow(
    clippy::disallowed_methods,
    reason = "pictures may differ in a last bit; digests do not depend on them"
)]
pub mod render;
pub mod scenarios;
pub mod table;

//! The trait that every motor skill implements, and the supervisor too, so that composites are
//! controllers.

use std::fmt::Debug;

use crate::control::command::Command;
use crate::control::contract::{Contract, Progress};
use crate::events::EventKind;
use crate::input::Result;
use crate::sensing::Sensors;

/// A motor skill. What it does depends on itself and on `now` only: no clock, no global state, no
/// random numbers. Two clones that see the same do the same, bit for bit.
///
/// Only [`contract`](Self::contract), [`enter`](Self::enter), [`act`](Self::act) and
/// [`clone_box`](Self::clone_box) have to be written.
///
/// ```
/// use aplomb_framework::prelude::*;
///
/// #[derive(Debug, Clone)]
/// struct Limp(Contract);
///
/// impl Controller for Limp {
///     fn contract(&self) -> &Contract { &self.0 }
///     fn enter(&mut self, _: &Sensors) {} // nothing to forget
///     fn act(&mut self, _: &Sensors, torques: &mut [f64]) { torques.fill(0.0); }
///     fn clone_box(&self) -> Box<dyn Controller> { Box::new(self.clone()) }
/// }
/// # let contract = ron::from_str(r#"(name: "limp", weight: 1, precondition: Always)"#)?;
/// # let model = Model::load("humanoid")?;
/// # let mut torques = vec![1.0; model.joint_count()];
/// # Limp(contract).act(&Sensors::new(&model, 9.81), &mut torques);
/// # assert!(torques.iter().all(|t| *t == 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Controller: Debug + Send + Sync {
    /// What it promises.
    fn contract(&self) -> &Contract;

    /// Takes over: forgets any earlier activation.
    fn enter(&mut self, now: &Sensors);

    /// One step's joint torques, N·m, in the order of [`crate::character::Model::joints`]; positive
    /// counter-clockwise on the child. Cannot fail; torques beyond the muscles are clamped by the
    /// body.
    fn act(&mut self, now: &Sensors, torques: &mut [f64]);

    /// A clone, as a box.
    fn clone_box(&self) -> Box<dyn Controller>;

    /// The bid for control: weight × pre-condition, or × probability of success if the contract
    /// is confident. What is not a finite number above 0 is no bid.
    fn suitability(&self, now: &Sensors) -> f64 {
        self.contract().suitability(now)
    }

    /// How it is getting on, `elapsed` s after [`enter`](Self::enter). `kept` is for how many
    /// seconds the post-condition has held without a break; none if it does not hold.
    fn progress(&self, now: &Sensors, elapsed: f64, kept: Option<f64>) -> Progress {
        self.contract().progress(now, elapsed, kept)
    }

    /// Takes a command that it answers to, before it is entered for it. Returns whether it answers
    /// to it.
    ///
    /// # Errors
    /// The command's name is known but a parameter is not, or is out of its range.
    fn obey(&mut self, command: &Command) -> Result<bool> {
        self.contract().answers(command)
    }

    /// The centre of mass that it aims at, world x, m, if it aims at one; for recordings.
    fn reference_com(&self) -> Option<f64> {
        None
    }

    /// Whether its hands are closed: they then hold what can be held and touches them, and let go
    /// of it when they open. Asked after each [`act`](Self::act).
    fn grips(&self) -> bool {
        false
    }

    /// What has happened in it since it was last asked, each with its time, s; only composites have
    /// anything to tell.
    fn take_events(&mut self) -> Vec<(f64, EventKind)> {
        Vec::new()
    }
}

impl Clone for Box<dyn Controller> {
    fn clone(&self) -> Self {
        self.clone_box()
    }
}

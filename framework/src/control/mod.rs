//! Controllers and who arbitrates between them: conditions, contracts, the trait, the supervisor.
//!
//! files → [`Registry`], [`repertoire`] → [`Supervisor`]; sensors → bids → the active controller →
//! torques.

pub mod boundary;
mod command;
mod condition;
mod contract;
mod controller;

mod pool;
mod registry;
pub mod repertoire;
mod supervisor;

pub use boundary::Boundary;
pub use command::{Answer, Command, LONGEST_COMMAND, Parameter};
pub use condition::{Condition, Failure};
pub use contract::{Contract, Progress};
pub use controller::Controller;

pub use registry::{ControllerFile, Registry, Spec};
pub use supervisor::{DWELL, RECOVERY, Supervisor};

//! A character as data, and its motion: links, joints, muscles; state, kinematics, dynamics.
//!
//! character file → [`Model`]; [`State`] → [`Kinematics`], [`Dynamics`] → sensing, world, controllers.

mod dynamics;
mod kinematics;
mod model;
mod muscle;
mod shape;
mod state;

pub use dynamics::Dynamics;
pub(crate) use kinematics::turned;
pub use kinematics::{Kinematics, LinkMotion, put_on_ground};
pub use model::{Flesh, Foot, Hand, Joint, Link, MOST_LINKS, Model};
pub use muscle::{Muscle, Muscles};
pub use shape::{Outline, Point, Shape, Solid};
pub use state::{State, wrapped};

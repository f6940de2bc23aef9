//! Bodies, contacts, props, hands that hold: the physics. The only folder that names the engine.
//!
//! models, props, torques → [`World`] → sensors.

mod body;
mod collider;
mod contact;
mod drag;
mod ends;
mod engine;
mod fastening;
mod flesh;
mod grip;
mod prop;
mod props;
mod pull;
mod settings;
mod stops;
mod vector;

pub use body::Body;
pub use engine::{Character, World};
pub use prop::{Hinge, Prop, PropMotion};
pub use pull::{Dragged, Pull};
pub use settings::{Settings, integration_parameters};

//! What a character senses of itself and of the world, and the names that conditions, datasets and
//! plots know it by.
//!
//! state, contacts → [`Sensors`] → [`Feature`]s.

mod feature;
mod sensed_prop;
mod sensors;
mod vocabulary;

pub use feature::Feature;
pub use sensed_prop::SensedProp;
pub use sensors::{FootContact, LinkContact, Posture, Sensors};

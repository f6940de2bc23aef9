//! Things about a character, as it senses them.
//!
//! world → [`SensedProp`]s → features, controllers.

use std::sync::Arc;

use crate::character::Point;

/// A prop as a character senses it. Its frame is meant: the middle of most props.
#[derive(Debug, Clone, PartialEq)]
pub struct SensedProp {
    /// As in the scenario.
    pub name: Arc<str>,
    /// World x ahead of the root's origin, m.
    pub ahead: f64,
    /// Above the surface that the character last touched, m.
    pub height: f64,
    /// World frame, m/s.
    pub velocity: Point,
    /// Whether a hand of this character holds it.
    pub held: bool,
}

impl SensedProp {
    /// A prop of which nothing but the name is known yet.
    #[must_use]
    pub fn new(name: &Arc<str>) -> Self {
        Self {
            name: Arc::clone(name),
            ahead: 0.0,
            height: 0.0,
            velocity: [0.0; 2],
            held: false,
        }
    }
}

/// A number about one prop that features name, as `NAME.PROP`.
#[derive(Debug)]
pub(crate) struct PropScalar {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) value: fn(&SensedProp) -> f64,
}

/// The vocabulary about props.
pub(crate) const PROP_SCALARS: &[PropScalar] = &[
    PropScalar {
        name: "prop_ahead",
        unit: "m",
        value: |p| p.ahead,
    },
    PropScalar {
        name: "prop_height",
        unit: "m",
        value: |p| p.height,
    },
    PropScalar {
        name: "prop_velocity",
        unit: "m/s",
        value: |p| p.velocity[0],
    },
    PropScalar {
        name: "prop_held",
        unit: "1",
        value: |p| f64::from(u8::from(p.held)),
    },
];

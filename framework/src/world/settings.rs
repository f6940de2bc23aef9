//! Physical settings of a world and what the engine makes of them.

use rapier2d::prelude::{IntegrationParameters, SpringCoefficients};
use serde::{Deserialize, Serialize};

/// Physical settings of a world, the same for all controllers.
///
/// The defaults are chosen by measurement: `ARCHITECTURE.md`, "Contact settings".
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Step, s.
    pub dt: f64,
    /// m/s², downwards positive.
    pub gravity: f64,
    /// Friction coefficient of the ground.
    pub friction: f64,
    /// Natural frequency of contacts, Hz.
    pub contact_frequency: f64,
    /// Damping ratio of contacts.
    pub contact_damping: f64,
    /// Solver iterations a step.
    pub iterations: usize,
    /// Largest torques of all muscles, relative to the character's. Controllers plan with the
    /// character's own.
    pub torque: f64,
    /// Mass and inertia of all links, relative to the character's. Momentum control plans with the
    /// character's own.
    pub mass: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dt: 1e-3,
            gravity: 9.81,
            friction: 1.0,
            contact_frequency: 240.0,
            contact_damping: 10.0,
            iterations: 2,
            torque: 1.0,
            mass: 1.0,
        }
    }
}

/// The engine's parameters for our settings: stiff contacts, recomputed every step.
#[must_use]
pub fn integration_parameters(settings: &Settings) -> IntegrationParameters {
    let softness = SpringCoefficients::new(
        settings.contact_frequency as f32,
        settings.contact_damping as f32,
    );
    IntegrationParameters {
        dt: settings.dt as f32,
        contact_softness: softness,
        static_contact_softness: softness,
        num_solver_iterations: settings.iterations,
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}

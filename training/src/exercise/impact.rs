//! How hard head and trunk are hit, as the body feels it rather than the solver.
//!
//! contact forces of every step → forces, low-pass filtered.

use aplomb_framework::math::hypot;
use aplomb_framework::sensing::Sensors;

/// s over which forces are averaged: a peak of one step is the solver's, not the body's.
const FILTER: f64 = 0.01;

/// Filtered forces of one character.
#[derive(Debug, Clone, Copy)]
pub struct Impact {
    mix: f64,
    /// On the head, N.
    pub head: f64,
    /// On trunk and root together, N.
    pub trunk: f64,
}

impl Impact {
    /// Nothing has hit it yet; steps of `dt` s.
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self {
            mix: dt / FILTER,
            head: 0.0,
            trunk: 0.0,
        }
    }

    /// Takes in a step.
    pub fn observe(&mut self, now: &Sensors) {
        let model = &now.model;
        let force = |link: usize| {
            let [x, y] = now.contacts[link].force;
            hypot(x, y)
        };
        // A character may be all trunk: its root then bears no second force.
        let root = if model.trunk == 0 { 0.0 } else { force(0) };
        self.head += self.mix * (force(model.head) - self.head);
        self.trunk += self.mix * (force(model.trunk) + root - self.trunk);
    }
}

//! Servos that hold a pose, whatever happens: who acts while a character is disturbed.
//!
//! target angles, strength → torques.

use aplomb_controllers::servo::Servo;
use aplomb_framework::character::Model;
use aplomb_framework::control::{Condition, Contract, Controller};
use aplomb_framework::events::Role;
use aplomb_framework::sensing::Sensors;

/// Servos on all joints; at strength 0 the character is limp.
#[derive(Debug, Clone)]
pub(crate) struct Held {
    contract: Contract,
    servo: Servo,
    target: Vec<f64>,
    strength: f64,
}

impl Held {
    /// Holds target angles, rad, one for each joint.
    pub(crate) fn new(name: &str, model: &Model, target: Vec<f64>, strength: f64) -> Self {
        Self {
            contract: everywhere(name),
            servo: Servo::new(model, 1.0, 1.0),
            target,
            strength,
        }
    }
}

/// A contract that accepts every state and never ends.
fn everywhere(name: &str) -> Contract {
    Contract {
        name: name.to_owned(),
        role: Role::Rest,
        weight: 1,
        precondition: Condition::Always,
        postcondition: Condition::Never,
        expected: Condition::Always,
        hold: 0.0,
        patience: f64::INFINITY,
        stalls: f64::INFINITY,
        commands: Vec::new(),
        confident: false,
    }
}

impl Controller for Held {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, _: &Sensors) {}

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.servo.track(now, &self.target, self.strength, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}

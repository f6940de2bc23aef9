//! Deliberately broken controllers, and sensors to show them.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use aplomb_framework::character::Model;
use aplomb_framework::control::{Command, Condition, Contract, Controller, Registry, Spec};
use aplomb_framework::events::Role;
use aplomb_framework::input::Result;
use aplomb_framework::sensing::Sensors;
use serde::Deserialize;

/// A controller that keeps whatever its contract says and sets all torques to one number. Broken
/// ones promise what they cannot: `expected: Never` fails at once, `postcondition: Always` succeeds
/// at once, a torque of NaN is none.
#[derive(Debug, Clone)]
pub(crate) struct Puppet {
    contract: Contract,
    torque: f64,
    /// Whether its hands are closed.
    grips: bool,
    /// Its bid, whatever its contract says.
    bid: Option<f64>,
    entered: Arc<AtomicUsize>,
    obeyed: Arc<AtomicUsize>,
}

/// In files: `kind: "puppet"`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct PuppetSpec {
    torque: f64,
    grips: bool,
}

impl Puppet {
    /// One that bids `weight` where `precondition` holds and then stays.
    pub(crate) fn new(name: &str, weight: u32, precondition: Condition) -> Self {
        let mut contract = Contract {
            name: name.to_owned(),
            role: Role::Other,
            weight,
            precondition,
            confident: false,
            postcondition: Condition::Never,
            expected: Condition::Always,
            hold: 0.0,
            patience: f64::INFINITY,
            stalls: f64::INFINITY,
            commands: Vec::new(),
        };
        contract.resolve(&Model::load("humanoid").unwrap()).unwrap();
        Self {
            contract,
            torque: 0.0,
            grips: false,
            bid: None,
            entered: Arc::default(),
            obeyed: Arc::default(),
        }
    }

    pub(crate) fn that_fails_at_once(mut self) -> Self {
        self.contract.expected = Condition::Never;
        self
    }

    pub(crate) fn that_succeeds_at_once(mut self) -> Self {
        self.contract.postcondition = Condition::Always;
        self
    }

    pub(crate) fn with_hold(mut self, hold: f64, postcondition: Condition) -> Self {
        self.contract.hold = hold;
        self.contract.postcondition = postcondition;
        self
    }

    pub(crate) fn with_patience(mut self, patience: f64) -> Self {
        self.contract.patience = patience;
        self
    }

    pub(crate) fn with_torque(mut self, torque: f64) -> Self {
        self.torque = torque;
        self
    }

    pub(crate) fn that_bids(mut self, bid: f64) -> Self {
        self.bid = Some(bid);
        self
    }

    /// How often it, or a clone, was entered.
    pub(crate) fn entries(&self) -> impl Fn() -> usize + use<> {
        let entered = Arc::clone(&self.entered);
        move || entered.load(Ordering::Relaxed)
    }

    /// How often it, or a clone, took a command.
    pub(crate) fn obediences(&self) -> impl Fn() -> usize + use<> {
        let obeyed = Arc::clone(&self.obeyed);
        move || obeyed.load(Ordering::Relaxed)
    }

    pub(crate) fn boxed(self) -> Box<dyn Controller> {
        Box::new(self)
    }
}

impl Spec for PuppetSpec {
    const KIND: &'static str = "puppet";

    fn build(self, contract: Contract, _: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let (torque, grips) = (self.torque, self.grips);
        let (entered, obeyed) = (Arc::default(), Arc::default());
        Ok(Box::new(Puppet {
            contract,
            torque,
            grips,
            bid: None,
            entered,
            obeyed,
        }))
    }
}

impl Controller for Puppet {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn suitability(&self, now: &Sensors) -> f64 {
        self.bid.unwrap_or_else(|| self.contract.suitability(now))
    }

    fn enter(&mut self, _: &Sensors) {
        self.entered.fetch_add(1, Ordering::Relaxed);
    }

    fn act(&mut self, _: &Sensors, torques: &mut [f64]) {
        torques.fill(self.torque);
    }

    fn grips(&self) -> bool {
        self.grips
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn obey(&mut self, command: &Command) -> Result<bool> {
        let Some(answer) = self.contract.answer(command) else {
            return Ok(false);
        };
        answer.check(command)?;
        self.obeyed.fetch_add(1, Ordering::Relaxed);
        Ok(true)
    }
}

/// Knows puppets only.
pub(crate) fn registry() -> Registry {
    Registry::new().with::<PuppetSpec>()
}

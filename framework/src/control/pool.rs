//! The pool of a supervisor: its members' bids, what makes it valid, and the contract of the whole.
//!
//! controllers → fallback's place and the pool's contract; sensors → bids, with reasons.

use crate::control::condition::Condition;
use crate::control::contract::Contract;
use crate::control::controller::Controller;
use crate::events::{Bid, Refusal, Role};
use crate::input::{Error, FieldPath, Result};
use crate::sensing::Sensors;

/// A controller of a pool.
#[derive(Debug, Clone)]
pub(crate) struct Member {
    pub(crate) controller: Box<dyn Controller>,
    /// Until this time it bids 0, because it has failed.
    pub(crate) recovers_at: f64,
}

impl Member {
    pub(crate) fn new(controller: Box<dyn Controller>) -> Self {
        Self {
            controller,
            recovers_at: f64::NEG_INFINITY,
        }
    }

    /// Its suitability now; 0 instead of what is no finite number above 0.
    pub(crate) fn bid(&self, now: &Sensors) -> f64 {
        if now.time < self.recovers_at {
            return 0.0;
        }
        let suitability = self.controller.suitability(now);
        if suitability.is_finite() && suitability > 0.0 {
            suitability
        } else {
            0.0
        }
    }

    /// Its bid with its name and, if it bids 0, why.
    pub(crate) fn explain(&self, now: &Sensors) -> Bid {
        let suitability = self.bid(now);
        let contract = self.controller.contract();
        let refusal = (suitability == 0.0).then(|| {
            if contract.weight == 0 {
                Refusal::OnCommandOnly
            } else if now.time < self.recovers_at {
                Refusal::Recovering
            } else {
                let failure = contract.precondition.first_failure(now);
                failure.map_or(Refusal::Declines, |f| Refusal::Precondition(f.unmet()))
            }
        });
        Bid {
            controller: contract.name.clone(),
            suitability,
            refusal,
        }
    }
}

/// The fallback's place in a pool.
///
/// # Errors
/// [`Error::Invalid`] if a name occurs twice, or the fallback is missing, has weight 0, or does not
/// accept every state.
pub(crate) fn fallback(pool: &[Box<dyn Controller>], fallback: &str) -> Result<usize> {
    for (i, c) in pool.iter().enumerate() {
        let twin = pool[..i]
            .iter()
            .any(|o| o.contract().name == c.contract().name);
        if twin {
            let problem = format!("'{}' a second time", c.contract().name);
            let accepted = "a name of its own for each controller";
            return Err(Error::refused("contract.name", problem, accepted)
                .inside(FieldPath::inner())
                .inside(("controllers", i)));
        }
    }
    let place = pool
        .iter()
        .position(|c| c.contract().name == fallback)
        .ok_or_else(|| {
            let names = pool.iter().map(|c| c.contract().name.as_str());
            Error::unknown("controller of the pool", fallback, names).inside("fallback")
        })?;
    let last = pool[place].contract();
    if last.precondition != Condition::Always
        || last.expected != Condition::Always
        || last.weight == 0
    {
        let problem = format!("'{fallback}', which does not accept every state");
        let accepted =
            "a controller with weight above 0 and pre-condition and expected performance Always";
        return Err(Error::refused("fallback", problem, accepted));
    }
    Ok(place)
}

/// What a pool promises as a whole: to accept what any of its controllers accepts, and never to end.
pub(crate) fn contract(name: &str, pool: &[Box<dyn Controller>]) -> Contract {
    let preconditions = pool.iter().map(|c| c.contract().precondition.clone());
    Contract {
        name: name.to_owned(),
        role: Role::Other,
        weight: pool.iter().map(|c| c.contract().weight).max().unwrap_or(0),
        precondition: Condition::Any(preconditions.collect()),
        confident: false,
        postcondition: Condition::Never,
        expected: Condition::Always,
        hold: 0.0,
        patience: f64::INFINITY,
        stalls: f64::INFINITY,
        commands: pool
            .iter()
            .flat_map(|c| c.contract().commands.clone())
            .collect(),
    }
}

//! Polls a pool of controllers, arbitrates by suitability, delegates, and explains itself.
//! (Faloutsos, van de Panne, Terzopoulos 2001, "Controller composition framework" and its figure of one step.)
//!
//! sensors → poll pre-conditions → the active controller → torques. A supervisor is itself a
//! controller, so pools nest.
//!
//! Rules:
//! - The active controller stays until it succeeds, fails, or a command calls another.
//! - A controller that failed bids 0 for [`RECOVERY`] s, and one that succeeded has been active for
//!   at least [`DWELL`] s: two controllers cannot alternate every few steps.
//! - The incumbent of a lost or won arbitration is not entered again.
//! - A command raises its controller above the weights, never over a failed pre-condition.
//! - Polling has no side effect. Ties go to the earlier in the repertoire.
//! - One controller, the fallback, accepts every state, so that something is always active.

use crate::control::command::Command;
use crate::control::contract::{Contract, Progress};
use crate::control::controller::Controller;
use crate::control::pool;
use crate::control::pool::Member;
use crate::events::{Bid, EventKind, Reason, Unmet};
use crate::input::{Error, Result};
use crate::sensing::Sensors;

/// s for which a controller that has just failed is not chosen again.
pub const RECOVERY: f64 = 0.25;
/// s for which a controller is active before its success is acted on.
pub const DWELL: f64 = 0.05;

/// The active controller and its activation.
#[derive(Debug, Clone, Copy)]
struct Active {
    member: usize,
    since: f64,
    /// Since when its post-condition has held.
    reached: Option<f64>,
    /// Since when the character has kept still.
    still: Option<f64>,
}

/// For how many seconds something has held without a break; `since` is when it began to.
fn lasting(since: &mut Option<f64>, holds: bool, time: f64) -> Option<f64> {
    if holds {
        Some(time - *since.get_or_insert(time))
    } else {
        *since = None;
        None
    }
}

/// A pool of controllers under one contract.
///
/// ```
/// # use aplomb_framework::prelude::*;
/// # use aplomb_framework::Supervisor;
/// # #[derive(Debug, Clone)]
/// # struct Limp(Contract);
/// # impl Controller for Limp {
/// #     fn contract(&self) -> &Contract { &self.0 }
/// #     fn enter(&mut self, _: &Sensors) {}
/// #     fn act(&mut self, _: &Sensors, torques: &mut [f64]) { torques.fill(0.0); }
/// #     fn clone_box(&self) -> Box<dyn Controller> { Box::new(self.clone()) }
/// # }
/// # let contract = ron::from_str(r#"(name: "limp", weight: 1, precondition: Always)"#)?;
/// # let limp: Box<dyn Controller> = Box::new(Limp(contract)); // no torques
/// // `limp` is a controller that accepts every state.
/// let mut supervisor = Supervisor::new("faint", vec![limp], "limp")?;
/// let model = Model::load("humanoid")?;
/// let (now, mut torques) = (Sensors::new(&model, 9.81), vec![0.0; model.joint_count()]);
/// assert_eq!(supervisor.active(), None);
/// supervisor.act(&now, &mut torques);
/// assert_eq!(supervisor.active(), Some("limp"));
/// assert!(supervisor.command("dance").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Supervisor {
    contract: Contract,
    pool: Vec<Member>,
    fallback: usize,
    active: Option<Active>,
    /// Commands of this step, in order, each with the member that answers to it.
    pending: Vec<(usize, Command)>,
    events: Vec<(f64, EventKind)>,
}

impl Supervisor {
    /// A pool in the order in which ties are broken. `fallback` names the controller that accepts
    /// every state.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the pool is empty, a name occurs twice, or the fallback is missing,
    /// has weight 0, or does not accept every state.
    pub fn new(name: &str, pool: Vec<Box<dyn Controller>>, fallback: &str) -> Result<Self> {
        let place = pool::fallback(&pool, fallback).map_err(|e| e.at(name))?;
        Ok(Self {
            contract: pool::contract(name, &pool),
            pool: pool.into_iter().map(Member::new).collect(),
            fallback: place,
            active: None,
            pending: Vec::new(),
            events: Vec::new(),
        })
    }

    /// The same pool with another controller in the place of the one with its name.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is none with its name; what makes a pool invalid.
    pub fn with_replaced(&self, controller: Box<dyn Controller>) -> Result<Self> {
        let name = &controller.contract().name;
        let place = self
            .pool
            .iter()
            .position(|m| m.controller.contract().name == *name);
        let Some(place) = place else {
            let known = self.controllers().map(|c| c.contract().name.as_str());
            return Err(Error::unknown("controller", name, known));
        };
        let mut pool: Vec<_> = self.pool.iter().map(|m| m.controller.clone()).collect();
        pool[place] = controller;
        let fallback = self.name(self.fallback).to_owned();
        Self::new(&self.contract.name, pool, &fallback)
    }

    /// The same pool with one controller more, or another in the place of the one with its name.
    ///
    /// # Errors
    /// What makes a pool invalid.
    pub fn with(&self, controller: Box<dyn Controller>) -> Result<Self> {
        let name = &controller.contract().name;
        if self.controllers().any(|c| c.contract().name == *name) {
            return self.with_replaced(controller);
        }
        let mut pool: Vec<_> = self.pool.iter().map(|m| m.controller.clone()).collect();
        pool.push(controller);
        let fallback = self.name(self.fallback).to_owned();
        Self::new(&self.contract.name, pool, &fallback)
    }

    /// Another pool in the place of this one while it runs. The active controller stays active if
    /// the new pool has one of its name; those that `same` names go on in their state, the others
    /// begin afresh.
    #[must_use]
    pub fn renewed(&self, new: &Self, now: &Sensors, same: &dyn Fn(&str) -> bool) -> Self {
        let mut renewed = new.clone();
        renewed.active = None;
        for (place, member) in renewed.pool.iter_mut().enumerate() {
            let name = member.controller.contract().name.clone();
            let mut old = self.pool.iter().enumerate();
            let named = |(_, m): &(usize, &Member)| m.controller.contract().name == name;
            let Some((was, old)) = old.find(named) else {
                continue;
            };
            let active = self.active.filter(|a| a.member == was);
            if same(&name) {
                *member = old.clone();
            } else if active.is_some() {
                member.controller.enter(now);
            }
            if let Some(active) = active {
                let member = place;
                renewed.active = Some(Active { member, ..active });
            }
        }
        renewed
    }

    /// The pool of one controller and the fallback.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is none of this name.
    pub fn alone(&self, name: &str) -> Result<Self> {
        let known = || self.controllers().map(|c| c.contract().name.as_str());
        if !known().any(|n| n == name) {
            return Err(Error::unknown("controller", name, known()));
        }
        let fallback = self.name(self.fallback).to_owned();
        let kept = |c: &&dyn Controller| [name, &fallback].contains(&c.contract().name.as_str());
        let pool = self.controllers().filter(kept).map(Controller::clone_box);
        Self::new(&self.contract.name, pool.collect(), &fallback)
    }

    /// The pool.
    pub fn controllers(&self) -> impl Iterator<Item = &dyn Controller> {
        self.pool.iter().map(|m| &*m.controller)
    }

    /// Name of the active controller; none before the first step.
    #[must_use]
    pub fn active(&self) -> Option<&str> {
        self.active.map(|a| self.name(a.member))
    }

    /// Place of the active controller in the pool.
    #[must_use]
    pub fn active_index(&self) -> Option<usize> {
        self.active.map(|a| a.member)
    }

    /// For how many seconds the active controller has been so; none before the first step.
    #[must_use]
    pub fn active_for(&self, now: &Sensors) -> Option<f64> {
        self.active.map(|a| now.time - a.since)
    }

    fn name(&self, member: usize) -> &str {
        &self.pool[member].controller.contract().name
    }

    /// Parses a command string and hands it to the controller that answers to it. It takes effect
    /// in the next step, where the controller's pre-condition decides.
    ///
    /// # Errors
    /// A malformed command, or one that nobody answers to, with the nearest name.
    pub fn command(&mut self, text: &str) -> Result<()> {
        let command: Command = text.parse()?;
        if self.obey(&command)? {
            Ok(())
        } else {
            let known = self.contract.commands.iter().map(|a| a.name.as_str());
            Err(Error::unknown("command", &command.name, known))
        }
    }

    /// What each controller would say now.
    #[must_use]
    pub fn bids(&self, now: &Sensors) -> Vec<Bid> {
        self.pool.iter().map(|m| m.explain(now)).collect()
    }

    /// The member with the highest bid, the earliest of equals; the fallback if all bid 0.
    #[must_use]
    pub fn arbitrate(&self, now: &Sensors) -> usize {
        let mut best = (self.fallback, 0.0);
        for (i, m) in self.pool.iter().enumerate() {
            let bid = m.bid(now);
            if bid > best.1 {
                best = (i, bid);
            }
        }
        best.0
    }

    /// Judges the active controller; returns why there should be an arbitration.
    fn judge(&mut self, now: &Sensors) -> Option<Reason> {
        let Some(active) = &mut self.active else {
            return Some(Reason::Start);
        };
        let controller = &self.pool[active.member].controller;
        let contract = controller.contract();
        let elapsed = now.time - active.since;
        let kept = lasting(
            &mut active.reached,
            contract.postcondition.holds(now),
            now.time,
        );
        let still = contract.stalls.is_finite() && now.is_still();
        let still = lasting(&mut active.still, still, now.time);
        let progress = match controller.progress(now, elapsed, kept) {
            Progress::Running if still.is_some_and(|s| s >= contract.stalls) => {
                Progress::Failed(contract.stalled())
            }
            progress => progress,
        };
        match progress {
            Progress::Running => None,
            Progress::Succeeded if elapsed < DWELL => None,
            Progress::Succeeded => Some(Reason::Succeeded),
            Progress::Failed(unmet) => {
                self.pool[active.member].recovers_at = now.time + RECOVERY;
                Some(Reason::Failed(unmet))
            }
        }
    }

    fn switch(&mut self, now: &Sensors, member: usize, reason: Reason) {
        let contract = self.pool[member].controller.contract();
        let kind = EventKind::Switch {
            from: self.active().map(str::to_owned),
            to: contract.name.clone(),
            role: contract.role,
            reason,
            bids: self.bids(now),
        };
        self.events.push((now.time, kind));
        self.active = Some(Active {
            member,
            since: now.time,
            reached: None,
            still: None,
        });
        self.pool[member].controller.enter(now);
    }

    /// Calls the commanded controller if its pre-condition holds, else reports the refusing clause.
    fn follow(&mut self, now: &Sensors, member: usize, command: &Command) {
        let controller = &mut self.pool[member].controller;
        let refusal = match controller.contract().precondition.first_failure(now) {
            Some(failure) => Some(failure.unmet()),
            None => match controller.obey(command) {
                Ok(true) => None,
                Ok(false) => Some(Unmet::plain("declines")),
                Err(e) => Some(Unmet::plain(e.to_string())),
            },
        };
        let text = command.to_string();
        let accepted = refusal.is_none();
        let given = EventKind::Command {
            text: text.clone(),
            accepted,
        };
        self.events.push((now.time, given));
        if let Some(unmet) = refusal {
            let refused = EventKind::Refused {
                command: text,
                controller: Some(self.name(member).to_owned()),
                unmet,
            };
            self.events.push((now.time, refused));
        } else {
            self.switch(now, member, Reason::Command);
        }
    }
}

impl Controller for Supervisor {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, _: &Sensors) {
        self.active = None;
        for m in &mut self.pool {
            m.recovers_at = f64::NEG_INFINITY;
        }
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        for (member, command) in std::mem::take(&mut self.pending) {
            self.follow(now, member, &command);
        }
        if let Some(reason) = self.judge(now) {
            let best = self.arbitrate(now);
            if self.active.is_none_or(|a| a.member != best) {
                self.switch(now, best, reason);
            }
        }
        torques.fill(0.0);
        if let Some(active) = self.active {
            self.pool[active.member].controller.act(now, torques);
        }
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    /// Takes note of the command for the next step. The member that answers to it hears of it only
    /// if its pre-condition then holds: a refused command leaves no trace.
    fn obey(&mut self, command: &Command) -> Result<bool> {
        for (i, m) in self.pool.iter().enumerate() {
            if let Some(answer) = m.controller.contract().answer(command) {
                answer.check(command)?;
                self.pending.push((i, command.clone()));
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn reference_com(&self) -> Option<f64> {
        self.active
            .and_then(|a| self.pool[a.member].controller.reference_com())
    }

    fn grips(&self) -> bool {
        self.active
            .is_some_and(|a| self.pool[a.member].controller.grips())
    }

    fn take_events(&mut self) -> Vec<(f64, EventKind)> {
        let mut all = std::mem::take(&mut self.events);
        for m in &mut self.pool {
            all.append(&mut m.controller.take_events());
        }
        all
    }
}

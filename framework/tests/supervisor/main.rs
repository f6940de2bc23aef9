//! The supervisor's rules, with controllers that break theirs.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

#[path = "../common/mod.rs"]
mod common;

mod commands;
mod pools;
mod turns;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Condition, Controller, Supervisor};
use aplomb_framework::events::EventKind;
use aplomb_framework::sensing::Sensors;
use common::Puppet;

const DT: f64 = 1e-3;

/// Where the forward velocity is at most `most`.
fn slower_than(most: f64) -> Condition {
    Condition::Within {
        feature: "com_velocity_x".parse().unwrap(),
        min: f64::NEG_INFINITY,
        max: most,
    }
}

fn fallback() -> Puppet {
    Puppet::new("rest", 1, Condition::Always).that_succeeds_at_once()
}

fn supervisor(pool: Vec<Puppet>) -> Supervisor {
    let pool = pool.into_iter().map(Puppet::boxed).collect();
    Supervisor::new("pool", pool, "rest").unwrap()
}

fn sensors() -> Sensors {
    Sensors::new(&Model::load("humanoid").unwrap(), 9.81)
}

/// Steps with a velocity that depends on time; returns what happened, with its time.
fn steps(
    supervisor: &mut Supervisor,
    count: u32,
    velocity: impl Fn(f64) -> f64,
) -> Vec<(f64, EventKind)> {
    let mut now = sensors();
    let mut torques = vec![0.0; now.model.joint_count()];
    for step in 0..count {
        now.time = f64::from(step) * DT;
        now.com_velocity[0] = velocity(now.time);
        supervisor.act(&now, &mut torques);
        assert!(supervisor.active().is_some(), "something is always active");
    }
    supervisor.take_events()
}

/// (time, from, to) of all switches.
fn switches(events: &[(f64, EventKind)]) -> Vec<(f64, Option<&str>, &str)> {
    let mut switches = Vec::new();
    for (time, kind) in events {
        if let EventKind::Switch { from, to, .. } = kind {
            switches.push((*time, from.as_deref(), &**to));
        }
    }
    switches
}

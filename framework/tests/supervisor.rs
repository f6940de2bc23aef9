//! The supervisor's rules, with controllers that break theirs.
#![allow(clippy::unwrap_used)]

mod common;

use aplomb_framework::condition::Condition;
use aplomb_framework::controller::Controller;
use aplomb_framework::file::Source;
use aplomb_framework::model::Model;
use aplomb_framework::repertoire;
use aplomb_framework::sensors::Sensors;
use aplomb_framework::simulation::tick;
use aplomb_framework::state::State;
use aplomb_framework::supervisor::{DWELL, Decision, RECOVERY, Supervisor, Why};
use aplomb_framework::world::{Settings, World};
use common::{Puppet, registry};
use proptest::prelude::*;

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

/// Steps with a velocity that depends on time; returns all decisions.
fn steps(mind: &mut Supervisor, count: u32, velocity: impl Fn(f64) -> f64) -> Vec<Decision> {
    let mut now = sensors();
    let mut torques = vec![0.0; now.model.joint_count()];
    for step in 0..count {
        now.time = f64::from(step) * DT;
        now.com_velocity[0] = velocity(now.time);
        mind.act(&now, &mut torques);
        assert!(mind.active().is_some(), "something is always active");
    }
    mind.take_decisions()
}

/// (time, from, to) of all switches.
fn switches(decisions: &[Decision]) -> Vec<(f64, Option<&str>, &str)> {
    let of = |d| match d {
        &Decision::Switch {
            time,
            ref from,
            ref to,
            ..
        } => Some((time, from.as_deref(), &**to)),
        _ => None,
    };
    decisions.iter().filter_map(of).collect()
}

#[test]
fn what_fails_at_once_gets_a_turn_once_a_recovery_time() {
    let [a, b] = ["a", "b"].map(|n| Puppet::new(n, 10, Condition::Always).that_fails_at_once());
    let rest = fallback();
    let entries = [a.entries(), b.entries(), rest.entries()];
    let mut mind = supervisor(vec![a, b, rest]);
    let decisions = steps(&mut mind, 2000, |_| 0.0);
    let most = (2.0 / RECOVERY) as usize + 1;
    for entered in entries {
        let entered = entered();
        assert!(
            entered >= most - 2 && entered <= most,
            "{entered} entries in 2 s"
        );
    }
    let all = switches(&decisions);
    for name in ["a", "b"] {
        let turns: Vec<f64> = all.iter().filter(|s| s.2 == name).map(|s| s.0).collect();
        assert!(
            turns.windows(2).all(|t| t[1] - t[0] >= RECOVERY - 1e-9),
            "{turns:?}"
        );
    }
    let why = |d: &Decision| matches!(d, Decision::Switch { why: Why::Failed(r), .. } if r == "expected never");
    assert!(decisions.iter().any(why), "the failing clause is told");
}

#[test]
fn what_succeeds_at_once_stays_for_the_dwelling_time() {
    // `a` hands over to `b` and back as the velocity swings every step.
    let a = Puppet::new("a", 10, slower_than(0.0)).that_succeeds_at_once();
    let b = Puppet::new("b", 9, Condition::Always).that_succeeds_at_once();
    let mut mind = supervisor(vec![a, b, fallback()]);
    let decisions = steps(&mut mind, 2000, |t| (3000.0 * t).sin());
    let times: Vec<f64> = switches(&decisions).iter().map(|s| s.0).collect();
    assert!(times.len() > 10, "they do alternate: {}", times.len());
    assert!(
        times.windows(2).all(|t| t[1] - t[0] >= DWELL - 1e-9),
        "{times:?}"
    );
}

#[test]
fn a_success_that_wins_again_is_not_entered_again() {
    let a = Puppet::new("a", 10, Condition::Always).that_succeeds_at_once();
    let entries = a.entries();
    let mut mind = supervisor(vec![a, fallback()]);
    let decisions = steps(&mut mind, 1000, |_| 0.0);
    assert_eq!((entries(), switches(&decisions).len()), (1, 1));
}

#[test]
fn a_hold_must_last_without_a_break() {
    let faster = Condition::Not(Box::new(slower_than(0.0)));
    let a = Puppet::new("a", 10, faster).with_hold(0.2, slower_than(0.0));
    let mut mind = supervisor(vec![a, fallback()]);
    // The post-condition holds from 0.1 s to 0.25 s, and from 0.5 s on.
    let holds = |t: f64| (0.1..0.25).contains(&t) || t >= 0.5;
    let decisions = steps(&mut mind, 2000, |t| if holds(t) { -1.0 } else { 1.0 });
    let all = switches(&decisions);
    assert_eq!((all.len(), all[1].2), (2, "rest"), "{all:?}");
    assert!((all[1].0 - 0.7).abs() < 1.5 * DT, "{all:?}");
}

#[test]
fn patience_ends_in_failure() {
    let a = Puppet::new("a", 10, Condition::Always).with_patience(0.3);
    let mut mind = supervisor(vec![a, fallback()]);
    let decisions = steps(&mut mind, 500, |_| 0.0);
    let all = switches(&decisions);
    assert_eq!(all[1].2, "rest");
    assert!((all[1].0 - 0.3).abs() < 2.0 * DT, "{all:?}");
}

#[test]
fn ties_go_to_the_earlier() {
    let pool = ["c", "a", "b"].map(|n| Puppet::new(n, 7, Condition::Always));
    let mind = supervisor(pool.into_iter().chain([fallback()]).collect());
    assert_eq!(mind.arbitrate(&sensors()), 0);
}

#[test]
fn no_command_overrides_a_failed_precondition() {
    let run = Puppet::new(
        "run",
        0,
        Condition::All(vec![Condition::Always, slower_than(0.5)]),
    );
    let (entries, obediences) = (run.entries(), run.obediences());
    let mut mind = supervisor(vec![run, fallback()]);
    let (mut now, mut torques) = (sensors(), vec![0.0; 12]);
    now.com_velocity[0] = 0.75;
    mind.command("run").unwrap();
    mind.act(&now, &mut torques);
    assert_eq!(mind.active(), Some("rest"));
    let refused = Decision::Refused {
        time: 0.0,
        command: "run".to_owned(),
        controller: "run".to_owned(),
        clause: "com_velocity_x ≤ 0.5 (is 0.750)".to_owned(),
        value: Some(0.75),
    };
    assert!(mind.take_decisions().contains(&refused));
    assert_eq!(
        (entries(), obediences()),
        (0, 0),
        "a refused command leaves no trace"
    );
    // The refusal is final: the command isn't kept for better times.
    now.com_velocity[0] = 0.0;
    now.time = DT;
    mind.act(&now, &mut torques);
    assert_eq!((mind.active(), entries()), (Some("rest"), 0));
    mind.command("run").unwrap();
    mind.act(&now, &mut torques);
    assert_eq!(
        (mind.active(), entries(), obediences()),
        (Some("run"), 1, 1)
    );
}

#[test]
fn an_unknown_command_is_refused_with_the_nearest() {
    let mut mind = supervisor(vec![
        Puppet::new("step_forward", 3, Condition::Always),
        fallback(),
    ]);
    let refusal = mind.command("step_foward").unwrap_err().to_string();
    assert_eq!(
        refusal,
        "unknown command 'step_foward' (did you mean 'step_forward'?); known: step_forward, rest"
    );
    assert!(
        mind.command("step_forward length=1")
            .unwrap_err()
            .to_string()
            .contains("takes no parameters")
    );
    assert!(mind.command("").is_err());
}

#[test]
fn several_commands_in_one_step_are_all_answered_in_order() {
    let pool = vec![
        Puppet::new("a", 0, Condition::Always),
        Puppet::new("b", 0, slower_than(-1.0)),
        Puppet::new("c", 0, Condition::Always),
        fallback(),
    ];
    let mut mind = supervisor(pool);
    for text in ["a", "b", "c", "a", "c"] {
        mind.command(text).unwrap();
    }
    mind.act(&sensors(), &mut [0.0; 12]);
    let told = |d: &Decision| match d {
        Decision::Obeyed { command, .. } => Some(format!("{command} obeyed")),
        Decision::Refused { command, .. } => Some(format!("{command} refused")),
        Decision::Switch { .. } => None,
    };
    let answers: Vec<String> = mind.take_decisions().iter().filter_map(told).collect();
    assert_eq!(
        answers,
        ["a obeyed", "b refused", "c obeyed", "a obeyed", "c obeyed"]
    );
    assert_eq!(mind.active(), Some("c"));
}

#[test]
fn a_supervisor_is_a_member_like_any_other() {
    let inner = || {
        let pool = vec![
            Puppet::new("slow", 5, slower_than(0.5)).with_torque(1.0),
            Puppet::new("hop", 0, Condition::Always).with_torque(2.0),
            Puppet::new("still", 1, Condition::Always).with_torque(3.0),
        ];
        let pool = pool.into_iter().map(Puppet::boxed).collect();
        Supervisor::new("inner", pool, "still").unwrap()
    };
    let pool: Vec<Box<dyn Controller>> = vec![Box::new(inner()), fallback().boxed()];
    let mut mind = Supervisor::new("outer", pool, "rest").unwrap();
    let (now, mut torques) = (sensors(), vec![0.0; 12]);
    mind.act(&now, &mut torques);
    assert_eq!((mind.active(), torques[0]), (Some("inner"), 1.0));
    let decisions = mind.take_decisions();
    let all: Vec<&str> = switches(&decisions).iter().map(|s| s.2).collect();
    assert_eq!(all, ["inner", "slow"]);
    mind.command("hop").unwrap();
    mind.act(&now, &mut torques);
    assert_eq!((mind.active(), torques[0]), (Some("inner"), 2.0));
    let clone = mind.clone_box();
    assert_eq!(clone.contract(), mind.contract());
    assert!(
        mind.command("hopp")
            .unwrap_err()
            .to_string()
            .contains("'hop'")
    );
}

/// A command that an outer supervisor refuses must not come into force when the inner one is
/// next entered.
#[test]
fn a_refused_command_is_not_carried_out_later() {
    let hop = Puppet::new("hop", 2, slower_than(0.5)).with_torque(2.0);
    let slow = Puppet::new("slow", 5, slower_than(0.4)).with_torque(1.0);
    let rest = Puppet::new("still", 1, Condition::Always).with_torque(3.0);
    let pool = vec![slow.boxed(), hop.boxed(), rest.boxed()];
    let inner = Supervisor::new("inner", pool, "still").unwrap();
    // The inner pool behind a gate of its own.
    let gated = Gated::new(inner, slower_than(0.5));
    let pool: Vec<Box<dyn Controller>> = vec![Box::new(gated), fallback().boxed()];
    let mut mind = Supervisor::new("outer", pool, "rest").unwrap();
    let (mut now, mut torques) = (sensors(), vec![0.0; 12]);
    now.com_velocity[0] = 0.9;
    mind.act(&now, &mut torques);
    mind.command("hop").unwrap();
    now.time = DT;
    mind.act(&now, &mut torques);
    let refused = |d: &Decision| matches!(d, Decision::Refused { .. });
    assert!(mind.take_decisions().iter().any(refused));
    now.com_velocity[0] = 0.0;
    for step in 2..200 {
        now.time = f64::from(step) * DT;
        mind.act(&now, &mut torques);
    }
    assert_eq!(
        torques[0],
        1.0,
        "`slow` has won; nobody hops: {:?}",
        mind.take_decisions()
    );
}

/// A controller behind a pre-condition of its own.
#[derive(Debug, Clone)]
struct Gated {
    contract: aplomb_framework::contract::Contract,
    inner: Supervisor,
}

impl Gated {
    fn new(inner: Supervisor, precondition: Condition) -> Self {
        let mut contract = inner.contract().clone();
        contract.precondition = precondition;
        Self { contract, inner }
    }
}

impl Controller for Gated {
    fn contract(&self) -> &aplomb_framework::contract::Contract {
        &self.contract
    }
    fn enter(&mut self, now: &Sensors) {
        self.inner.enter(now);
    }
    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.inner.act(now, torques);
    }
    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
    fn obey(
        &mut self,
        command: &aplomb_framework::command::Command,
    ) -> aplomb_framework::Result<bool> {
        self.inner.obey(command)
    }
}

#[test]
fn torques_that_are_no_numbers_move_nothing() {
    let model = Model::load("humanoid").unwrap();
    let end = |torque: f64| {
        let mut world = World::new(Settings::default());
        world.spawn(&model, &State::standing(&model));
        let mut mind = supervisor(vec![
            Puppet::new("a", 5, Condition::Always).with_torque(torque),
            fallback(),
        ]);
        let mut torques = vec![0.0; 12];
        for _ in 0..300 {
            tick(&mut world, 0, &mut mind, &mut torques);
            world.step();
        }
        world.sense(0).state.clone()
    };
    let state = end(f64::NAN);
    assert!(state.q.iter().chain(&state.qdot).all(|x| x.is_finite()));
    assert_eq!(state, end(0.0));
}

#[test]
fn a_pool_without_a_valid_fallback_is_refused() {
    let model = Model::load("humanoid").unwrap();
    let refusal = |fallback: &str, contract: &str| {
        let text = format!(
            "(\n  name: \"p\",\n  fallback: \"{fallback}\",\n  controllers: [\n    \
             Here((kind: \"puppet\", contract: (name: \"rest\", {contract}))),\n  ],\n)"
        );
        let source = Source::new("p.ron", text);
        repertoire::build(&source, None, &registry(), &model).map_err(|e| e.to_string())
    };
    let fine = "weight: 1, precondition: Always";
    assert!(refusal("rest", fine).is_ok());
    assert_eq!(
        refusal("rset", fine).unwrap_err(),
        "p.ron:3: fallback is 'rset'; accepted: a controller of the pool: rest"
    );
    for contract in [
        "weight: 0, precondition: Always",
        "weight: 1, precondition: Not(Never)",
        "weight: 1, precondition: Posture([standing])",
        "weight: 1, precondition: Always, expected: Posture([standing])",
    ] {
        let text = refusal("rest", contract).unwrap_err();
        assert!(
            text.starts_with("p.ron:3: fallback is 'rest', which does not accept"),
            "{text}"
        );
    }
    let twice = Supervisor::new("p", vec![fallback().boxed(), fallback().boxed()], "rest");
    assert!(
        twice
            .unwrap_err()
            .to_string()
            .contains("'rest' a second time")
    );
    assert!(Supervisor::new("p", Vec::new(), "rest").is_err());
}

/// A member of a random pool: weight, highest velocity of its pre-condition, manner.
fn any_member() -> impl Strategy<Value = (u32, Option<f64>, u8)> {
    (0..4_u32, prop::option::of(-1.0..1.0_f64), 0..3_u8)
}

fn pool_of(members: &[(u32, Option<f64>, u8)]) -> Vec<Puppet> {
    let member = |(i, (weight, most, manner)): (usize, &(u32, Option<f64>, u8))| {
        let precondition = most.map_or(Condition::Always, slower_than);
        let puppet = Puppet::new(&format!("m{i}"), *weight, precondition);
        match manner {
            0 => puppet,
            1 => puppet.that_fails_at_once(),
            _ => puppet.that_succeeds_at_once(),
        }
    };
    members
        .iter()
        .enumerate()
        .map(member)
        .chain([fallback()])
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_highest_bid_wins_and_zero_never_does(
        members in prop::collection::vec(any_member(), 0..9),
        velocity in -1.2..1.2_f64,
    ) {
        let mind = supervisor(pool_of(&members));
        let mut now = sensors();
        now.com_velocity[0] = velocity;
        // Independently: the weight where the bound holds.
        let mut bids: Vec<u32> = members
            .iter()
            .map(|(weight, most, _)| if most.is_none_or(|m| velocity <= m) { *weight } else { 0 })
            .collect();
        bids.push(1);
        let highest = *bids.iter().max().unwrap();
        let winner = mind.arbitrate(&now);
        prop_assert!(bids[winner] > 0);
        prop_assert_eq!(winner, bids.iter().position(|b| *b == highest).unwrap());
        for (bid, expected) in mind.bids(&now).iter().zip(&bids) {
            prop_assert_eq!(bid.suitability, *expected);
            prop_assert_eq!(bid.refusal.is_some(), *expected == 0);
        }
        // Polling has no side effect.
        prop_assert_eq!(mind.arbitrate(&now), winner);
        prop_assert_eq!(mind.active(), None);
    }

    #[test]
    fn control_never_alternates_faster_than_the_rules_say(
        members in prop::collection::vec(any_member(), 1..6),
        pace in 0.5..500.0_f64,
    ) {
        let mut mind = supervisor(pool_of(&members));
        let decisions = steps(&mut mind, 1200, |t| (pace * t).sin());
        let mut since = 0.0;
        let mut failed_at = std::collections::BTreeMap::new();
        for decision in &decisions {
            let Decision::Switch { time, from, to, why, bids } = decision else {
                return Err(TestCaseError::fail("no command was given"));
            };
            prop_assert_ne!(from.as_deref(), Some(&**to), "no incumbent is entered again");
            match why {
                Why::Succeeded => prop_assert!(time - since >= DWELL - 1e-9),
                Why::Failed(_) => {
                    failed_at.insert(from.clone().unwrap(), *time);
                }
                Why::Start => prop_assert_eq!(*time, 0.0),
                Why::Command => prop_assert!(false),
            }
            if let Some(failed) = failed_at.get(to) {
                prop_assert!(time - failed >= RECOVERY - 1e-9, "{} recovers", to);
            }
            let bid = |name: &str| bids.iter().find(|b| b.controller == name).unwrap().suitability;
            let highest = bids.iter().map(|b| b.suitability).max().unwrap();
            prop_assert!(bid(to) == highest && highest > 0, "{} of {}", bid(to), highest);
            since = *time;
        }
    }
}

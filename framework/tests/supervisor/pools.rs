//! Pools: bad ones, random ones.

use aplomb_framework::character::{Model, State};
use aplomb_framework::control::{Condition, DWELL, RECOVERY, Supervisor, repertoire};
use aplomb_framework::events::{EventKind, Reason, Refusal};
use aplomb_framework::input::Source;
use aplomb_framework::run::tick;
use aplomb_framework::world::{Settings, World};
use proptest::prelude::*;

use super::common::{Puppet, registry};
use super::{fallback, sensors, slower_than, steps, supervisor};

#[test]
fn torques_that_are_no_numbers_move_nothing() {
    let model = Model::load("humanoid").unwrap();
    let end = |torque: f64| {
        let mut world = World::new(Settings::default());
        world.spawn(&model, &State::standing(&model));
        let mut supervisor = supervisor(vec![
            Puppet::new("a", 5, Condition::Always).with_torque(torque),
            fallback(),
        ]);
        let mut torques = vec![0.0; 12];
        for _ in 0..300 {
            tick(&mut world, 0, &mut supervisor, &mut torques);
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
        "p.ron:3:13: fallback is 'rset' (did you mean 'rest'?); accepted: a controller of the pool: rest"
    );
    for contract in [
        "weight: 0, precondition: Always",
        "weight: 1, precondition: Not(Never)",
        "weight: 1, precondition: Posture([standing])",
        "weight: 1, precondition: Always, expected: Posture([standing])",
    ] {
        let text = refusal("rest", contract).unwrap_err();
        assert!(
            text.starts_with("p.ron:3:13: fallback is 'rest', which does not accept"),
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

#[test]
fn what_is_no_number_or_below_zero_never_wins() {
    let now = sensors();
    for bid in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -3.0, -0.0] {
        let broken = Puppet::new("a", 5, Condition::Always).that_bids(bid);
        let supervisor = supervisor(vec![broken, fallback()]);
        assert_eq!(supervisor.arbitrate(&now), 1, "{bid}");
        let told = supervisor.bids(&now).remove(0);
        assert_eq!(told.suitability, 0.0);
        assert_eq!(told.refusal, Some(Refusal::Declines), "{bid}");
    }
    let bids = [("a", 2.25), ("b", 2.5), ("c", 2.5)];
    let pool = bids.map(|(name, bid)| Puppet::new(name, 5, Condition::Always).that_bids(bid));
    let supervisor = supervisor(pool.into_iter().chain([fallback()]).collect());
    assert_eq!(supervisor.arbitrate(&now), 1, "the earlier of the highest");
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
        let supervisor = supervisor(pool_of(&members));
        let mut now = sensors();
        now.com_velocity[0] = velocity;
        // Independently: the weight where the bound holds.
        let mut bids: Vec<u32> = members
            .iter()
            .map(|(weight, most, _)| if most.is_none_or(|m| velocity <= m) { *weight } else { 0 })
            .collect();
        bids.push(1);
        let highest = *bids.iter().max().unwrap();
        let winner = supervisor.arbitrate(&now);
        prop_assert!(bids[winner] > 0);
        prop_assert_eq!(winner, bids.iter().position(|b| *b == highest).unwrap());
        for (bid, expected) in supervisor.bids(&now).iter().zip(&bids) {
            prop_assert_eq!(bid.suitability, f64::from(*expected));
            prop_assert_eq!(bid.refusal.is_some(), *expected == 0);
        }
        // Polling has no side effect.
        prop_assert_eq!(supervisor.arbitrate(&now), winner);
        prop_assert_eq!(supervisor.active(), None);
    }

    #[test]
    fn control_never_alternates_faster_than_the_rules_say(
        members in prop::collection::vec(any_member(), 1..6),
        pace in 0.5..500.0_f64,
    ) {
        let mut supervisor = supervisor(pool_of(&members));
        let events = steps(&mut supervisor, 1200, |t| (pace * t).sin());
        let mut since = 0.0;
        let mut failed_at = std::collections::BTreeMap::new();
        for (time, kind) in &events {
            let EventKind::Switch { from, to, reason, bids, .. } = kind else {
                return Err(TestCaseError::fail("no command was given"));
            };
            prop_assert_ne!(from.as_deref(), Some(&**to), "no incumbent is entered again");
            match reason {
                Reason::Succeeded => prop_assert!(time - since >= DWELL - 1e-9),
                Reason::Failed(_) => {
                    failed_at.insert(from.clone().unwrap(), *time);
                }
                Reason::Start => prop_assert_eq!(*time, 0.0),
                Reason::Command => prop_assert!(false),
            }
            if let Some(failed) = failed_at.get(to) {
                prop_assert!(time - failed >= RECOVERY - 1e-9, "{} recovers", to);
            }
            let bid = |name: &str| bids.iter().find(|b| b.controller == name).unwrap().suitability;
            let highest = bids.iter().map(|b| b.suitability).fold(0.0, f64::max);
            prop_assert!(bid(to) == highest && highest > 0.0, "{} of {}", bid(to), highest);
            since = *time;
        }
    }
}

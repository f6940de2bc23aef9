//! Who has control, and for how long.

use aplomb_framework::control::{Condition, DWELL, RECOVERY};
use aplomb_framework::events::{EventKind, Reason, Unmet};

use super::common::Puppet;
use super::{DT, fallback, sensors, slower_than, steps, supervisor, switches};

#[test]
fn what_fails_at_once_gets_a_turn_once_a_recovery_time() {
    let [a, b] = ["a", "b"].map(|n| Puppet::new(n, 10, Condition::Always).that_fails_at_once());
    let rest = fallback();
    let entries = [a.entries(), b.entries(), rest.entries()];
    let mut supervisor = supervisor(vec![a, b, rest]);
    let decisions = steps(&mut supervisor, 2000, |_| 0.0);
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
    let failed = Reason::Failed(Unmet::plain("expected never"));
    let why =
        |kind: &EventKind| matches!(kind, EventKind::Switch { reason, .. } if *reason == failed);
    assert!(
        decisions.iter().any(|(_, kind)| why(kind)),
        "the failing clause is told"
    );
}

#[test]
fn what_succeeds_at_once_stays_for_the_dwelling_time() {
    // `a` hands over to `b` and back as the velocity swings every step.
    let a = Puppet::new("a", 10, slower_than(0.0)).that_succeeds_at_once();
    let b = Puppet::new("b", 9, Condition::Always).that_succeeds_at_once();
    let mut supervisor = supervisor(vec![a, b, fallback()]);
    let decisions = steps(&mut supervisor, 2000, |t| (3000.0 * t).sin());
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
    let mut supervisor = supervisor(vec![a, fallback()]);
    let decisions = steps(&mut supervisor, 1000, |_| 0.0);
    assert_eq!((entries(), switches(&decisions).len()), (1, 1));
}

#[test]
fn a_hold_must_last_without_a_break() {
    let faster = Condition::Not(Box::new(slower_than(0.0)));
    let a = Puppet::new("a", 10, faster).with_hold(0.2, slower_than(0.0));
    let mut supervisor = supervisor(vec![a, fallback()]);
    // The post-condition holds from 0.1 s to 0.25 s, and from 0.5 s on.
    let holds = |t: f64| (0.1..0.25).contains(&t) || t >= 0.5;
    let decisions = steps(&mut supervisor, 2000, |t| if holds(t) { -1.0 } else { 1.0 });
    let all = switches(&decisions);
    assert_eq!((all.len(), all[1].2), (2, "rest"), "{all:?}");
    assert!((all[1].0 - 0.7).abs() < 1.5 * DT, "{all:?}");
}

#[test]
fn patience_ends_in_failure() {
    let a = Puppet::new("a", 10, Condition::Always).with_patience(0.3);
    let mut supervisor = supervisor(vec![a, fallback()]);
    let decisions = steps(&mut supervisor, 500, |_| 0.0);
    let all = switches(&decisions);
    assert_eq!(all[1].2, "rest");
    assert!((all[1].0 - 0.3).abs() < 2.0 * DT, "{all:?}");
}

#[test]
fn ties_go_to_the_earlier() {
    let pool = ["c", "a", "b"].map(|n| Puppet::new(n, 7, Condition::Always));
    let supervisor = supervisor(pool.into_iter().chain([fallback()]).collect());
    assert_eq!(supervisor.arbitrate(&sensors()), 0);
}

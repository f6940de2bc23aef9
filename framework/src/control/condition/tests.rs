use super::*;
use crate::character::Model;
use crate::control::boundary::DecisionFunction;
use crate::control::boundary::tests::{boundary, polynomial};
use proptest::prelude::*;

fn within(feature: &str, min: f64, max: f64) -> Condition {
    Condition::Within {
        feature: feature.parse().unwrap(),
        min,
        max,
    }
}

#[test]
fn the_first_clause_that_fails_is_told_with_its_value() {
    let mut now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
    now.com_velocity[0] = 0.7;
    let c = Condition::All(vec![
        within("com_height", 0.9, 1.1),
        Condition::Any(vec![within("com_velocity_x", -0.3, 0.3), Condition::Never]),
        within("com_velocity_x", -0.5, 0.5),
    ]);
    let refusal = c.first_failure(&now).unwrap();
    let told = "com_velocity_x in -0.3..0.3 (is 0.700) or never";
    assert_eq!(refusal.to_string(), told);
    assert_eq!(refusal.expected().to_string(), format!("expected {told}"));
    let not = Condition::Not(Box::new(within("com_velocity_x", -0.5, 1.0)));
    let told = "not com_velocity_x in -0.5..1 (is 0.700)";
    assert_eq!(not.first_failure(&now).unwrap().to_string(), told);
    let c = Condition::All(vec![within("com_velocity_x", -0.5, 0.5)]);
    let refusal = c.first_failure(&now).unwrap();
    assert_eq!(refusal.value, Some(0.7));
    assert_eq!(
        refusal.to_string(),
        "com_velocity_x in -0.5..0.5 (is 0.700)"
    );
}

#[test]
fn what_is_not_a_number_lies_in_no_bounds() {
    let now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
    assert!(!within("com_offset", f64::NEG_INFINITY, f64::INFINITY).holds(&now));
}

fn slower_than_one() -> Condition {
    Condition::Svm(Arc::new(polynomial(&["com_velocity_x"], &[1.0, -1.0])))
}

#[test]
fn a_learned_boundary_refuses_with_its_score() {
    let model = Model::load("humanoid").unwrap();
    let mut now = Sensors::new(&model, 9.81);
    let mut c = Condition::All(vec![
        Condition::Posture(vec![now.posture]),
        slower_than_one(),
    ]);
    c.resolve(&model).unwrap();
    now.com_velocity[0] = 1.0;
    assert!(c.holds(&now), "0 is within");
    now.com_velocity[0] = 1.3125;
    assert_eq!(
        c.first_failure(&now).unwrap().to_string(),
        "svm of balance (1 feature, poly1) (is -0.312)"
    );
    now.com_velocity[0] = f64::NAN;
    assert!(!c.holds(&now));
}

#[test]
fn probabilities_of_what_has_to_hold_are_multiplied() {
    let model = Model::load("humanoid").unwrap();
    let mut now = Sensors::new(&model, 9.81);
    now.com_velocity[0] = 0.25;
    let one = 1.0 / (1.0 + (-2.0 * 0.75 + 0.5_f64).exp());
    let learned = slower_than_one;
    for (c, is_learned, probability) in [
        (learned(), true, one),
        (
            Condition::All(vec![learned(), Condition::Always, learned()]),
            true,
            one * one,
        ),
        (Condition::Any(vec![learned()]), true, 1.0),
        (Condition::Not(Box::new(learned())), true, 1.0),
        (Condition::All(vec![Condition::Always]), false, 1.0),
        (within("com_height", 0.0, 1.0), false, 1.0),
    ] {
        assert_eq!(c.is_learned(), is_learned, "{c}");
        assert!((c.probability(&now) - probability).abs() < 1e-15, "{c}");
    }
}

#[test]
fn unordered_bounds_are_refused() {
    let model = Model::load("humanoid").unwrap();
    assert!(within("com_height", 1.0, 0.0).resolve(&model).is_err());
    assert!(within("com_height", f64::NAN, 0.0).resolve(&model).is_err());
}

fn any_boundary() -> impl Strategy<Value = Boundary> {
    let numbers = |n| prop::collection::vec(-1e3..1e3_f64, n);
    let features = ["com_velocity_x", "angle.knee_l"];
    let quadratic = numbers(6).prop_map(move |c| polynomial(&features, &c));
    let gaussian = (1e-3..10.0_f64, numbers(7)).prop_map(move |(gamma, n)| {
        let decision = DecisionFunction::Gaussian {
            gamma,
            support: vec![n[..2].to_vec(), n[2..4].to_vec()],
            weights: n[4..6].to_vec(),
            offset: n[6],
        };
        boundary(&features, decision)
    });
    prop_oneof![quadratic, gaussian]
}

fn any_condition() -> impl Strategy<Value = Condition> {
    let leaf = prop_oneof![
        Just(Condition::Always),
        Just(Condition::Never),
        Just(Condition::Posture(vec![Posture::Prone, Posture::Airborne])),
        (-1e3..1e3_f64, 0.0..1e3_f64).prop_map(|(a, w)| within("com_velocity_x", a, a + w)),
        (-1e3..1e3_f64).prop_map(|a| within("angle.knee_l", a, f64::INFINITY)),
        any_boundary().prop_map(|b| Condition::Svm(Arc::new(b))),
    ];
    leaf.prop_recursive(4, 24, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(Condition::All),
            prop::collection::vec(inner.clone(), 0..4).prop_map(Condition::Any),
            inner.prop_map(|c| Condition::Not(Box::new(c))),
        ]
    })
}

proptest! {
    #[test]
    fn conditions_round_trip_as_text(c in any_condition()) {
        let text = ron::to_string(&c).unwrap();
        prop_assert_eq!(ron::from_str::<Condition>(&text).unwrap(), c);
    }

    #[test]
    fn a_condition_and_its_negation_never_agree(c in any_condition(), v in -2e3..2e3_f64) {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        now.com_velocity[0] = v;
        let mut c = c;
        c.resolve(&model).unwrap();
        prop_assert_ne!(c.holds(&now), Condition::Not(Box::new(c.clone())).holds(&now));
    }
}

//! What a scenario can expect of its run, met and missed.

use super::{SCENARIO, changed, simulation};

/// What the run of the scenario with this expectation has not shown, after `duration` s.
fn missed(expectation: &str, duration: f64) -> Option<String> {
    let text = changed(
        SCENARIO,
        "expect: [Active(name: \"wave\")]",
        &format!("expect: [{expectation}]"),
    );
    let scenario = aplomb_framework::scenario::Scenario::parse(
        &aplomb_framework::input::Source::new("shove.ron", text.as_str()),
    )
    .unwrap();
    let mut run = simulation(&text).unwrap();
    run.run(duration);
    let missed = run.unmet(&scenario.expect);
    assert_eq!(run.met(&scenario.expect), missed.is_none());
    let clone = run.clone();
    assert_eq!(clone.unmet(&scenario.expect), missed);
    missed
}

#[test]
fn what_is_shown_is_met_and_what_is_not_is_told() {
    // Limp, and pushed from the front with 30 N·s at 0.1 s; the crate falls from 0.5 m to 0.2 m.
    for (expectation, found) in [
        ("Balanced()", Some("character 0 is not balanced: its")),
        (
            "Holds(condition: Within(feature: \"com_velocity_x\", max: -0.2), at: 0.25)",
            None,
        ),
        (
            "Holds(condition: Within(feature: \"com_velocity_x\", min: -0.1), at: 0.25)",
            Some("character 0 at 0.25 s: not com_velocity_x ≥ -0.1 (is -0."),
        ),
        (
            "Holds(condition: Within(feature: \"angle.knee_r\", max: 0.1), at: 0)",
            None,
        ),
        ("Holds(condition: Always, at: 0.6)", None),
        (
            "Holds(condition: Always, at: 0.7)",
            Some("the run ended at 0.600 s, before something expected at 0.7 s"),
        ),
        (
            "Reaches(condition: Within(feature: \"prop_height.crate\", max: 0.21))",
            None,
        ),
        (
            "Reaches(condition: Within(feature: \"prop_height.crate\", max: 0.21), before: 0.3)",
            None,
        ),
        (
            "Reaches(condition: Within(feature: \"prop_height.crate\", max: 0.21), before: 0.1)",
            Some("until 0.100 s: never prop_height.crate ≤ 0.21; in the end not"),
        ),
        (
            "Reaches(condition: Within(feature: \"prop_held.crate\", min: 1))",
            Some("(is 0.000)"),
        ),
        (
            "Prop(name: \"crate\", what: y, min: 0.19, max: 0.21, at: 0.6)",
            None,
        ),
        (
            "Prop(name: \"crate\", what: vy, max: -1.9, min: -2, at: 0.2)",
            None,
        ),
        (
            "Prop(name: \"crate\", what: x, max: \"impulse\", at: 0.1)",
            None,
        ),
        (
            "Prop(name: \"crate\", what: y, min: 0.4, at: 0.6)",
            Some("y of 'crate' at 0.6 s is 0.200 m; expected: 0.4 to inf"),
        ),
        (
            "Prop(name: \"crate\", what: angle, max: -1, at: 0.1)",
            Some("angle of 'crate' at 0.1 s is 0.000 rad"),
        ),
    ] {
        let told = missed(expectation, 0.6);
        match (&told, found) {
            (None, None) => {}
            (Some(told), Some(found)) if told.contains(found) => {}
            _ => panic!("{expectation}: {found:?} expected, got {told:?}"),
        }
    }
}

#[test]
fn who_stands_at_the_beginning_is_balanced() {
    assert_eq!(missed("Balanced()", 0.01), None);
    let moving = missed("Balanced()", 0.2).unwrap();
    assert!(
        moving.contains("moves at") && moving.contains("below 0.2 m/s"),
        "{moving}"
    );
}

#[test]
fn bad_expectations_are_refused() {
    for (expectation, message) in [
        ("Balanced(character: 1)", "expect[0].character is 1"),
        ("Holds(condition: Always)", "'at'"),
        ("Holds(condition: Always, at: -1)", "expect[0].at is -1"),
        (
            "Holds(condition: Always, at: \"when\")",
            "shove.ron:16:43: expect[0].at is 'when'; accepted: a parameter: impulse",
        ),
        (
            "Holds(condition: Within(feature: \"angle.nee_r\"), at: 0)",
            "expect[0].condition.feature is 'nee_r' (did you mean 'knee_r'?); accepted: a joint: ",
        ),
        (
            "Reaches(condition: Not(Within(feature: \"prop_ahead.crat\")))",
            "did you mean 'crate'",
        ),
        (
            "Reaches(condition: Always, before: 1e9)",
            "expect[0].before is 1000000000",
        ),
        (
            "Prop(name: \"crat\", what: x, at: 0)",
            "did you mean 'crate'",
        ),
        ("Prop(name: \"crate\", what: z, at: 0)", "'z'"),
        (
            "Prop(name: \"crate\", what: x, at: 0, min: 1, max: 0)",
            "expect[0].max is 0",
        ),
        (
            "Prop(name: \"crate\", what: x, at: 0, min: NaN)",
            "expect[0].min is NaN",
        ),
    ] {
        let text = changed(
            SCENARIO,
            "expect: [Active(name: \"wave\")]",
            &format!("expect: [{expectation}]"),
        );
        let refusal = simulation(&text).unwrap_err().to_string();
        assert!(refusal.contains(message), "{expectation}: {refusal}");
    }
}

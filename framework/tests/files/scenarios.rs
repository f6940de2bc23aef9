//! Scenarios.

use aplomb_framework::scenario::MOST_ENTRIES;

use super::{
    REPERTOIRE, SCENARIO, changed, check_refusal, line_of, refusal_of_repertoire, simulation,
};

#[test]
fn bad_scenarios_name_line_and_remedy() {
    for (from, to, line, message) in [
        (
            "duration: 0.6",
            "duration: 1e9",
            "duration",
            "0.001 to 3600",
        ),
        (
            "duration: 0.6",
            "duration: NaN",
            "duration",
            "NaN; accepted: 0.001 to 3600",
        ),
        (
            "duration: 0.6",
            "duration: inf",
            "duration",
            "0.001 to 3600",
        ),
        ("duration: 0.6", "duration: \"long\"", "duration", "float"),
        (
            "duration: 0.6",
            "durration: 0.6",
            "durration",
            "'durration'",
        ),
        ("dt: 0.001", "dt: 0.0", "dt: 0.0", "settings.dt is 0"),
        (
            "friction: 0.9",
            "friction: -0.9",
            "friction",
            "settings.friction is -0.9",
        ),
        (
            "friction: 0.9",
            "iterations: 0",
            "iterations",
            "settings.iterations is 0",
        ),
        ("lift: 0.001", "lift: -1.0", "lift", "start.lift is -1"),
        (
            "\"knee_r\": -0.1",
            "\"knee_r\": 11.0",
            "knee_r",
            "angles.knee_r is 11",
        ),
        ("mass: 4.0", "mass: -4.0", "crate", "mass is -4"),
        (
            "position: (0.6, 0.5)",
            "position: (NaN, 0.5)",
            "crate",
            "props[0].position[0] is NaN",
        ),
        (
            "half: (0.2, 0.2)",
            "half: (0.2, 0.0)",
            "half",
            "props[0].shape.half[1] is 0",
        ),
        ("at: 0.1", "at: -0.1", "at: -0.1", "at is -0.1"),
        (
            "at: 0.1",
            "at: true",
            "at: true",
            "a number or the name of a parameter",
        ),
        (
            "impulse: \"-impulse\"",
            "impulse: 1e6",
            "impulse: 1e6",
            "impulse is 1000000",
        ),
        (
            "\"wave\")]",
            "\"wave\", character: 3)]",
            "character: 3",
            "character is 3",
        ),
        ("30.0", "NaN", "NaN", "parameters.impulse.default is NaN"),
        ("seed: 7", "seed: -7", "seed", "out of bounds"),
    ] {
        let text = changed(SCENARIO, from, to);
        let refusal = simulation(&text).unwrap_err().to_string();
        let place = line_of("shove.ron", &text, line);
        check_refusal(&refusal, &place, message, to);
    }
}

#[test]
fn names_that_a_scenario_gets_wrong_are_refused_with_the_nearest() {
    for (from, to, message) in [
        ("\"-impulse\"", "\"-impluse\"", "did you mean 'impulse'"),
        ("\"torso\"", "\"tosro\"", "did you mean 'torso'"),
        ("text: \"wave\"", "text: \"wvae\"", "did you mean 'wave'"),
        ("text: \"wave\"", "text: \"wave x\"", "no key=value"),
        (
            "\"knee_r\": -0.1",
            "\"knee_x\": -0.1",
            "did you mean 'knee_",
        ),
        (
            "character: \"humanoid\"",
            "character: \"humanoit\"",
            "characters known by name: humanoid",
        ),
        (
            "Some(\"pair\")",
            "Some(\"pear\")",
            "'pear', which cannot be read",
        ),
    ] {
        let text = changed(SCENARIO, from, to);
        let refusal = simulation(&text).unwrap_err().to_string();
        check_refusal(&refusal, &line_of("shove.ron", &text, to), message, to);
    }
}

#[test]
fn floods_are_refused() {
    let prop =
        "(name: \"c\", shape: Box(half: (0.2, 0.2), centre: (0, 0)), mass: 4.0, position: (0, 5)),";
    let text = changed(
        SCENARIO,
        "props: [",
        &format!("props: [{}", prop.repeat(MOST_ENTRIES)),
    );
    let refusal = simulation(&text).unwrap_err().to_string();
    assert!(
        refusal.contains("props is a list of 1001; accepted: at most 1000"),
        "{refusal}"
    );
    let text = format!("({}", "(".repeat(100_000));
    assert!(
        simulation(&text).is_err(),
        "deep nesting is no stack overflow"
    );
    let never = "Not(".repeat(50_000);
    let text = changed(REPERTOIRE, "Within(", &format!("{never}Within("));
    assert!(refusal_of_repertoire(&text).starts_with("pair.ron:"));
}

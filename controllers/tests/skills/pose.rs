//! Pose control as data.

use aplomb_controllers::registry;
use aplomb_framework::control::repertoire;
use aplomb_framework::events::Reason;
use aplomb_framework::input::Source;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;

use super::{humanoid, switches};

/// Lifts an arm, in these states.
fn waves(states: &str) -> Simulation {
    let text = format!(
        r#"(name: "waving", fallback: "rest", controllers: [
            Here((
                kind: "pose",
                contract: (
                    name: "wave", weight: 5, precondition: Always,
                    postcondition: Within(feature: "angle.shoulder_r", min: 0.3),
                ),
                spec: (states: [{states}]),
            )),
            File("skills/rest.ron"),
        ])"#
    );
    let model = humanoid();
    let source = Source::new("waving", text);
    let supervisor = repertoire::build(&source, None, &registry(), &model).unwrap();
    let scenario = Scenario::standing("humanoid", 1.0);
    let mut run = Simulation::with_cast(&scenario, vec![(model, supervisor)]).unwrap();
    run.run(0.8);
    run
}

#[test]
fn a_state_that_ends_short_of_what_it_expects_fails_and_says_so() {
    let high = r#"Within(feature: "angle.shoulder_r", min: 2.0)"#;
    for (first, second, after) in [(high, "Always", 0), ("Always", high, 1)] {
        let run = waves(&format!(
            r#"(pose: {{"shoulder_r": 0.2}}, duration: 0.3, expects: {first}),
            (name: "up", pose: {{"shoulder_r": 0.6}}, duration: 0.3, expects: {second})"#
        ));
        let (time, _, reason) = switches(&run)[1];
        let Reason::Failed(unmet) = reason else {
            panic!("{reason}");
        };
        let state = ["state 0", "'up'"][after as usize];
        let clause = format!("after {state}: expected angle.shoulder_r ≥ 2");
        assert_eq!(unmet.clause, clause);
        assert!(unmet.value().is_some_and(|v| v < 2.0), "{unmet}");
        let due = 0.3 * f64::from(after + 1);
        assert!((time - due).abs() < 0.005, "{time}");
    }
}

#[test]
fn a_state_leads_elsewhere_when_its_condition_holds_than_when_its_time_is_up() {
    // The first state ends at once, or never before its time; the second lifts the arm.
    for (until, lifted) in [("Always", false), ("Never", true)] {
        let run = waves(&format!(
            r#"(duration: 0.1, until: {until}, then: "end"),
            (pose: {{"shoulder_r": 0.6}}, duration: 1.0)"#
        ));
        let shoulder = humanoid().joint_index("shoulder_r").unwrap();
        let angle = run.sensors(0).state.angles()[shoulder];
        assert_eq!(angle > 0.3, lifted, "{angle}");
    }
}

/// A pose controller's states and named conditions, or why they are refused.
fn built(states: &str, conditions: &str) -> Result<(), String> {
    let text = format!(
        r#"(kind: "pose", contract: (name: "x", weight: 1, precondition: Always),
            spec: (states: [{states}], conditions: {{{conditions}}}))"#
    );
    crate::built(&text).map(drop)
}

#[test]
fn states_and_conditions_are_referred_to_by_name() {
    let fine = r#"(name: "a", duration: 1, until: Not(Named("up")), then: "end"), (duration: 1, next: "a")"#;
    let up = r#""up": Posture([standing])"#;
    assert_eq!(built(fine, up), Ok(()));
    let refusals = [
        (
            r#"(name: "lift", duration: 1, next: "lfit")"#,
            "did you mean 'lift'?",
        ),
        (
            r#"(name: "a", duration: 1), (name: "a", duration: 1)"#,
            "states[1].name is 'a'",
        ),
        (r#"(name: "end", duration: 1)"#, "not 'end'"),
        (
            r#"(duration: 1, expects: Named("pu"))"#,
            "mine.ron:2:52: spec.states[0].expects is 'pu'; accepted: a condition: up",
        ),
        (r#"(duration: 1, next: 0)"#, "mine.ron:"),
    ];
    for (states, why) in refusals {
        let told = built(states, up).unwrap_err();
        assert!(told.contains(why), "{states}: {told}");
    }
}

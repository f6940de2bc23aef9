//! Protective steps.

use aplomb_controllers::registry;
use aplomb_framework::events::EventKind;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;

use super::{built, shipped, switches};

/// m; soles that are no farther apart are parallel.
const PARALLEL: f64 = 0.06;

/// The humanoid, 6 s after a push of its chest, on ground of this friction.
fn pushed(impulse: f64) -> Simulation {
    let scenario = Scenario::standing("humanoid", 7.0);
    let mut run = Simulation::new(&scenario, &registry()).unwrap();
    run.run(1.0);
    run.push(0, "torso", impulse).unwrap();
    run.run(6.0);
    run
}

#[test]
fn a_push_that_balance_does_not_take_ends_on_parallel_feet_after_a_step() {
    for impulse in [65.0, -65.0] {
        let run = pushed(impulse);
        let told = switches(&run);
        assert!(told.iter().any(|s| s.1 == "protective_step"), "{told:?}");
        assert!(told.iter().all(|s| s.1 != "fall"), "{told:?}");
        let fell = |kind: &EventKind| matches!(kind, EventKind::Fell);
        assert!(!run.events().iter().any(|e| fell(&e.kind)), "{impulse} N·s");
        assert!(run.outcome(0).standing, "{impulse} N·s: {told:?}");
        let now = run.sensors(0);
        let [a, b] = [0, 1].map(|foot| {
            let link = now.model.feet[foot].link;
            now.kinematics.links[link].origin[0]
        });
        assert!((a - b).abs() < PARALLEL, "{impulse} N·s: {a} {b}");
        // Away from where it stood, the way it was pushed.
        assert!(0.5 * (a + b) * impulse.signum() > 0.1, "{a} {b}");
    }
}

#[test]
fn feet_that_stand_apart_are_closed_by_a_step() {
    let mut scenario = Scenario::standing("humanoid", 6.0);
    let apart = [
        ("hip_r", 0.15),
        ("ankle_r", -0.15),
        ("hip_l", -0.15),
        ("ankle_l", 0.15),
    ];
    let start = &mut scenario.characters[0].start;
    start
        .angles
        .extend(apart.map(|(joint, angle)| (joint.to_owned(), angle)));
    let mut run = Simulation::new(&scenario, &registry()).unwrap();
    run.run(6.0);
    let told = switches(&run);
    assert_eq!(told[0].1, "protective_step", "{told:?}");
    assert!(run.outcome(0).standing, "{told:?}");
    assert!(run.sensors(0).feet_apart() < PARALLEL, "{told:?}");
}

#[test]
fn numbers_out_of_bounds_are_refused_with_their_field_and_the_bounds() {
    let text = shipped("skills/protective_step.ron");
    let begins = |field: &str| text.find(&format!(" {field}: ")).unwrap() + field.len() + 3;
    let with = |field: &str, value: &str| {
        let number = begins(field);
        let length = text[number..].find(',').unwrap();
        format!("{}{value}{}", &text[..number], &text[number + length..])
    };
    assert!(built(&with("glide", "0.5")).is_ok());
    for (field, value, accepted) in [
        ("longest", "-0.1", "0 to 3"),
        ("swing_weight", "0.0", "0.000001 to 1000000"),
        ("close_time", "NaN", "0.1 to 2"),
        ("bend", "inf", "0 to 2"),
        ("swing_time", "9.0", "0.1 to 1"),
    ] {
        let told = built(&with(field, value)).unwrap_err();
        let before = &text[..begins(field)];
        let (line, column) = (
            before.lines().count(),
            before.lines().last().unwrap().len() + 1,
        );
        let place = format!("mine.ron:{line}:{column}: spec.");
        assert!(told.starts_with(&place), "{place} expected: {told}");
        let problem = format!("{field} is {}", value.trim_end_matches(".0"));
        assert!(told.contains(&problem), "{told}");
        assert!(told.ends_with(&format!("; accepted: {accepted}")), "{told}");
    }
    let told = built(&with("glide", "1, gild: 2")).unwrap_err();
    assert!(told.contains("gild"), "{told}");
}

//! One balance, with the same gains, for every shipped character.

use aplomb_controllers::registry;
use aplomb_framework::character::Model;
use aplomb_framework::control::repertoire;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::{Scenario, ScheduledInput};

use super::built;

#[test]
fn every_character_stands_and_takes_a_push() {
    for (name, _) in Model::built_in() {
        let model = Model::load(name).unwrap();
        for direction in [-1.0, 1.0] {
            let mut scenario = Scenario::standing(name, 5.0);
            // Over 0.1 s, to a third of a metre a second.
            let impulse = direction * 0.33 * model.total_mass();
            scenario
                .events
                .push(ScheduledInput::push(1.0, "torso", impulse));
            let supervisor = repertoire::load(name, &registry(), &model).unwrap();
            let cast = vec![(model.clone(), supervisor)];
            let mut run = Simulation::with_cast(&scenario, cast).unwrap();
            while run.time() < scenario.duration {
                run.step();
                assert!(!run.sensors(0).is_down(), "{name}: {impulse} N·s");
            }
            let speed = run.sensors(0).com_velocity;
            let still = speed[0].hypot(speed[1]) < 0.01;
            assert!(still && run.outcome(0).standing, "{name}: {speed:?}");
        }
    }
}

#[test]
fn a_motion_may_begin_with_a_pose_of_its_own() {
    let file = |begin: &str| {
        format!(
            r#"(kind: "cmrt", contract: (name: "x", weight: 1, precondition: Always), spec: (
            begin: {begin}, motions: [(length: 2.0, preparation: 1.0, task: 0.5, keys: [])]))"#
        )
    };
    assert!(built(&file(r#"{"shoulder": 1.2}"#)).is_ok());
    let told = built(&file(r#"{"shoulders": 1.2}"#)).err().unwrap();
    assert!(told.contains("'shoulders'"), "{told}");
    let told = built(&file(r#"{"shoulder": 9.0}"#)).err().unwrap();
    assert!(told.contains("-7 to 7"), "{told}");
}

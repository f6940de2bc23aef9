//! The same seed gives the same run, bit for bit: twice, on a clone, over any number of threads,
//! and read back from a recording.

#![allow(clippy::unwrap_used)]

use aplomb::framework::input::Source;
use aplomb::framework::run::{Simulation, Trajectory};
use aplomb::framework::scenario::{Scenario, ScheduledInput};
use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;

/// s; the character is falling and touches the ground with more than its feet.
const IN_CONTACT: f64 = 1.2;
const END: f64 = 2.5;

/// A hard push from the front.
fn fall() -> Simulation {
    let mut scenario = Scenario::standing("humanoid", END);
    scenario
        .events
        .push(ScheduledInput::push(0.3, "torso", -150.0));
    Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap()
}

#[test]
fn two_runs_have_one_digest() {
    let digest = || {
        let mut simulation = fall();
        simulation.run(END);
        simulation.digest()
    };
    assert_eq!(digest(), digest());
}

#[test]
fn a_clone_in_mid_contact_continues_like_its_original() {
    let mut original = fall();
    original.run(IN_CONTACT);
    let touching = original.sensors(0).contacts.iter().filter(|c| c.touching);
    assert!(touching.count() > 0 && !original.sensors(0).only_feet_support());
    let mut clone = original.clone();
    original.run(END - IN_CONTACT);
    clone.run(END - IN_CONTACT);
    assert_eq!(original.digest(), clone.digest());
    assert_eq!(original.events(), clone.events());
    assert_eq!(original.outcome(0), clone.outcome(0));
}

#[test]
fn a_recording_read_back_has_the_digest_and_events_of_its_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fall.trajectory");
    let mut simulation = fall();
    simulation.record("fall", 0);
    simulation.run(END);
    simulation.recording().unwrap().write(&path).unwrap();
    let back = Trajectory::read(&path).unwrap();
    assert_eq!(back.digest(), simulation.digest());
    assert_eq!(back.events, simulation.events());
    assert_eq!(back.len(), 2500);
}

/// What a person may do to a character by hand.
const BY_HAND: &str = r#"(name: "by hand", duration: 3, characters: [(character: "humanoid")], events: [
    Push(at: 0.2, link: "torso", impulse: 30, upward: -20),
    Throw(at: 0.4, prop: (name: "ball", shape: Capsule(radius: 0.1, from: (0, 0), to: (0, 0)), mass: 4,
        position: (2, 1.5), velocity: (-6, 1))),
    Drag(at: 0.9, what: Link(name: "torso"), point: (0, 0.2), to: (0.4, 1.6)),
    Drag(at: 1.2, what: Link(name: "torso"), point: (0, 0.2), to: (0.6, 2.2)),
    Set(at: 1.3, setting: gravity, value: 4),
    Release(at: 1.6),
    Drag(at: 1.7, what: Prop(0), point: (0, 0), to: (0, 1)),
    Set(at: 2, setting: friction, value: 0.2),
])"#;

#[test]
fn what_is_done_by_hand_is_recorded_and_done_again_alike() {
    let scenario = Scenario::parse(&Source::new("by hand", BY_HAND)).unwrap();
    let registry = aplomb::controllers::registry();
    let mut recorded = Simulation::new(&scenario, &registry).unwrap();
    recorded.record("by hand", 0);
    recorded.run(3.0);
    let back = recorded.recording().unwrap();
    assert_eq!(back.digest(), recorded.digest());
    assert!(back.prop(300, 0)[0].is_nan(), "the ball is not there yet");
    assert!(back.prop(500, 0)[0] < 2.0, "it flies");
    let lifted = |step| back.moment(step, 0).com[1];
    assert!(lifted(1600) > lifted(1200) + 0.2, "it is lifted");
    let kinds: Vec<_> = recorded.events().iter().map(|e| e.kind.name()).collect();
    for kind in ["push", "thrown", "dragged", "released", "set"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
    // Given one by one while it runs, as a live view does.
    let idle = Scenario {
        events: Vec::new(),
        ..scenario.clone()
    };
    let mut live = Simulation::new(&idle, &registry).unwrap();
    for event in &scenario.events {
        let at = scenario.number(event.at()).unwrap();
        live.run(at - live.time());
        live = live.clone();
        live.schedule(&idle, event).unwrap();
    }
    live.run(3.0 - live.time());
    assert_eq!(live.digest(), recorded.digest());
    assert_eq!(live.events(), recorded.events());
}

#[test]
fn recording_and_explaining_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let digest = |more: &[&str]| {
        let output = cargo_bin_cmd!("aplomb")
            .current_dir(folder.path())
            .args([
                "run",
                "--duration",
                "2",
                "--push",
                "0.3:torso:-150",
                "--json",
            ])
            .args(more)
            .output()
            .unwrap();
        let run: Value = serde_json::from_slice(&output.stdout).unwrap();
        run["digest"].as_str().unwrap().to_owned()
    };
    let plain = digest(&[]);
    assert_eq!(plain, digest(&["--record", "x.trajectory", "--explain"]));
    let mut simulation = fall();
    simulation.run(2.0);
    assert_eq!(
        plain,
        simulation.digest(),
        "the program and the library agree"
    );
}

#[test]
fn trials_do_not_depend_on_the_number_of_threads() {
    let trials = |jobs: &str, more: &[&str]| {
        let output = cargo_bin_cmd!("aplomb")
            .args([
                "trials",
                "--count",
                "8",
                "--seed",
                "5",
                "--duration",
                "2.5",
                "--json",
            ])
            .args(["--jobs", jobs])
            .args(more)
            .output()
            .unwrap();
        let mut trials: Value = serde_json::from_slice(&output.stdout).unwrap();
        for clocked in ["wall_s", "steps_per_s"] {
            trials.as_object_mut().unwrap().remove(clocked).unwrap();
        }
        trials
    };
    for more in [
        &["--max-impulse", "200"][..],
        &["--fallen"],
        &["--max-angle", "0.3"],
    ] {
        assert_eq!(trials("1", more), trials("2", more), "{more:?}");
    }
}

//! Whatever happens to the humanoid, it ends on its feet: the scenarios of `tests/scenarios/recovery`, each with what it expects.

use aplomb::framework::events::{EventKind, Reason};
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::Scenario;

#[test]
fn every_scenario_of_recovery_ends_as_it_expects() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenarios/recovery");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(files.len() >= 8, "{files:?}");
    let registry = aplomb::controllers::registry();
    for file in files {
        let scenario = aplomb::scenarios::load(file.to_str().unwrap()).unwrap();
        assert!(!scenario.expect.is_empty(), "{}", file.display());
        let mut run = Simulation::new(&scenario, &registry).unwrap();
        run.run(scenario.duration);
        assert_eq!(run.unmet(&scenario.expect), None, "{}", file.display());
    }
}

#[test]
fn the_story_goes_from_two_falls_over_rising_each_time_to_a_step() {
    let scenario = aplomb::scenarios::load("story").unwrap();
    let mut run = Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap();
    run.run(scenario.duration);
    assert_eq!(run.unmet(&scenario.expect), None);
}

#[test]
fn a_rise_that_does_not_get_going_gives_up_within_two_seconds() {
    let registry = aplomb::controllers::registry();
    for (pitch, first) in [(1.57, "rise_supine"), (-1.57, "free_arms")] {
        let mut scenario = Scenario::standing("humanoid", 6.0);
        scenario.characters[0].start.pitch = pitch;
        scenario.settings.torque = 0.2;
        let mut run = Simulation::new(&scenario, &registry).unwrap();
        run.run(scenario.duration);
        let switches: Vec<(f64, &str, &Reason)> = run
            .events()
            .iter()
            .filter_map(|event| match &event.kind {
                EventKind::Switch { to, reason, .. } => Some((event.time, to.as_ref(), reason)),
                _ => None,
            })
            .collect();
        let mut lasted = Vec::new();
        for pair in switches.windows(2) {
            let [(begun, active, _), (left, _, reason)] = [pair[0], pair[1]];
            if active == first {
                assert!(matches!(reason, Reason::Failed(_)), "{first}: {reason}");
                lasted.push(left - begun);
            }
        }
        assert!(
            !lasted.is_empty() && lasted.iter().all(|s| *s < 2.0),
            "{first}: {lasted:?}"
        );
    }
}

//! Whatever happens to the humanoid, it ends on its feet: the scenarios of `tests/scenarios/recovery`, each with what it expects.

use aplomb::framework::simulation::Simulation;

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
        assert_eq!(
            run.disappointment(&scenario.expect),
            None,
            "{}",
            file.display()
        );
    }
}

#[test]
fn the_story_goes_from_a_push_over_a_fall_and_a_roll_to_standing_and_stepping() {
    let scenario = aplomb::scenarios::load("story").unwrap();
    let mut run = Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap();
    run.run(scenario.duration);
    assert_eq!(run.disappointment(&scenario.expect), None);
}

//! Heap allocations of the loop once it is warm: none of ours.
//!
//! The engine (rapier2d 0.36.1) makes eight a step: its list of bodies that were given torques is
//! dropped at the end of each step and grows anew (three), its narrow phase collects contact pairs
//! for the solver (three), and its step and its solver make one workspace each.
#![allow(clippy::unwrap_used)]

use allocation_counter::measure;
use aplomb_controllers::registry;
use aplomb_framework::character::{Model, Shape, State};
use aplomb_framework::control::{Controller, repertoire};
use aplomb_framework::input::{Source, options};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use aplomb_framework::world::{Prop, Settings, World};

/// Allocations of the engine a step, in `actuate` and in `step`.
const ENGINE: [u64; 2] = [3, 5];

/// Out of reach, but sensed.
fn wall() -> Prop {
    Prop {
        name: "wall".to_owned(),
        shape: Shape::Box {
            half: [0.1, 1.0],
            centre: [0.0, 0.0],
        },
        mass: 0.0,
        position: [5.0, 1.0],
        angle: 0.0,
        velocity: [0.0; 2],
        friction: 1.0,
        restitution: 0.0,
        grip: 100.0,
    }
}

#[test]
fn sensing_and_thinking_allocate_nothing() {
    let model = Model::load("humanoid").unwrap();
    let mut supervisor = repertoire::load("humanoid", &registry(), &model).unwrap();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    world.add_prop(&wall());
    world.detect_contacts();
    let mut torques = vec![0.0; model.joint_count()];
    let (mut ours, mut actuate, mut engine) = (0, 0, 0);
    for step in 0..3000 {
        let sensing = measure(|| {
            world.sense(0);
        });
        let thinking = measure(|| supervisor.act(&world.characters()[0].sensors, &mut torques));
        let acting = measure(|| world.actuate(0, &torques));
        let gripping = measure(|| world.grip(0, true));
        let stepping = measure(|| world.step());
        if step >= 2000 {
            ours += sensing.count_total + thinking.count_total + gripping.count_total;
            actuate += acting.count_total;
            engine += stepping.count_total;
        }
    }
    assert_eq!(supervisor.active(), Some("balance"));
    assert_eq!(ours, 0, "sense, act and grip");
    let [most, steps_most] = ENGINE.map(|n| 1000 * n);
    assert!(
        actuate <= most && engine <= steps_most,
        "actuate {actuate}, step {engine}"
    );
}

/// A learned boundary, polled and weighed.
#[test]
fn asking_what_was_learned_allocates_nothing() {
    const FILE: &str = "learned/balance.boundary.ron";
    const POOL: &str = r#"(name: "p", fallback: "rest", controllers: [
        Learned(controller: "skills/balance.ron", boundary: "learned/balance.boundary.ron", confident: true),
        File("skills/rest.ron"),
    ])"#;
    let model = Model::load("humanoid").unwrap();
    let text = format!(
        r#"(controller: "balance", character: "humanoid", character_digest: "{}",
            features: ["com_velocity_x", "velocity.knee_l"], mean: [0, 0], scale: [1, 1],
            decision: Gaussian(gamma: 0.5, support: [[0, 0], [2, 0]], weights: [1, -1], offset: 0),
            calibration: (slope: -1, offset: 0), provenance: "Written by hand.")"#,
        model.digest()
    );
    let registry = registry().with_file(FILE, text.leak());
    let pool = Source::new("p.ron", POOL);
    let supervisor = repertoire::build(&pool, None, &registry, &model).unwrap();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    world.detect_contacts();
    let now = world.sense(0);
    let bid = supervisor.bids(now)[0].suitability;
    assert!(bid > 5.0 && bid < 10.0, "by its probability: {bid}");
    let polling = measure(|| assert_eq!(supervisor.arbitrate(now), 0));
    assert_eq!(polling.count_total, 0);
}

#[test]
fn a_step_of_a_simulation_allocates_only_in_the_engine() {
    let mut scenario = Scenario::standing("humanoid", 3.0);
    for expectation in [
        "Balanced()",
        "Holds(condition: Within(feature: \"com_speed\", max: 1), at: 2.5)",
        "Reaches(condition: Within(feature: \"com_speed\", min: 9), before: 9)",
    ] {
        let expectation = options().from_str(expectation).unwrap();
        scenario.expect.push(expectation);
    }
    let mut simulation = Simulation::new(&scenario, &registry()).unwrap();
    simulation.run(2.0);
    let events = simulation.events().len();
    let counted = measure(|| simulation.run(1.0));
    assert_eq!(simulation.events().len(), events, "a quiet second");
    let most = 1000 * ENGINE.iter().sum::<u64>();
    assert!(
        counted.count_total <= most,
        "{} in 1000 steps",
        counted.count_total
    );
}

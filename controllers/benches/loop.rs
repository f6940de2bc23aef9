//! Times of the parts of a control step, and of whole steps.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use aplomb_controllers::kinds::cmrt::{Cmrt, Spline};
use aplomb_controllers::momentum::{Formulation, Gains, Momentum, Reference};
use aplomb_controllers::registry;
use aplomb_framework::character::{Dynamics, Model};
use aplomb_framework::control::boundary::{Calibration, DecisionFunction, VERSION};
use aplomb_framework::control::{Boundary, Controller, Supervisor, repertoire};
use aplomb_framework::input::Source;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use aplomb_framework::sensing::{Posture, Sensors};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

/// Steps that are timed together.
const STEPS: u32 = 1000;

fn scenario(pitch: f64, lift: f64) -> Scenario {
    let mut scenario = Scenario::standing("humanoid", 60.0);
    (
        scenario.characters[0].start.pitch,
        scenario.characters[0].start.lift,
    ) = (pitch, lift);
    scenario
}

/// A simulation that has run for some seconds.
fn after(seconds: f64, scenario: &Scenario) -> Simulation {
    let mut simulation = Simulation::new(scenario, &registry()).unwrap();
    simulation.run(seconds);
    simulation
}

/// What the humanoid senses while it recovers from a push.
fn pushed() -> Sensors {
    let mut simulation = after(1.0, &scenario(0.0, 0.0));
    simulation.push(0, "torso", 25.0).unwrap();
    simulation.run(0.12);
    simulation.sensors(0).clone()
}

#[divan::bench(sample_size = 1000)]
fn reference_trajectory(bencher: Bencher) {
    let spline = Spline::new(&Cmrt {
        displacements: vec![0.02, 0.05, -0.03, 0.01],
        ..Cmrt::flat(2.6, 4)
    });
    bencher.bench_local(|| black_box(&spline).at(black_box(1.7)));
}

/// The humanoid in the middle of a fast bend.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn thousand_steps_bending(bencher: Bencher) {
    let mut bent = scenario(0.0, 0.0);
    bent.duration = 3.0;
    let mut simulation = after(0.0, &bent);
    simulation.command(0, "bend").unwrap();
    simulation.run(0.8);
    bencher
        .counter(ItemsCount::new(STEPS))
        .with_inputs(|| simulation.clone())
        .bench_local_refs(|s| (0..STEPS).for_each(|_| s.step()));
}

#[divan::bench(sample_size = 1000)]
fn dynamics(bencher: Bencher) {
    let now = pushed();
    let mut dynamics = Dynamics::new(&now.model);
    bencher.bench_local(|| dynamics.update(black_box(&now.model), black_box(&now.state), 9.81));
}

#[divan::bench(sample_size = 1000)]
fn derived_sensors(bencher: Bencher) {
    let mut now = pushed();
    bencher.bench_local(|| black_box(&mut now).derive());
}

#[divan::bench(args = ["equality", "inequality"], sample_size = 100)]
fn quadratic_program(bencher: Bencher, formulation: &str) {
    let formulation = match formulation {
        "equality" => Formulation::Equality,
        _ => Formulation::Inequality,
    };
    let now = pushed();
    let joints = now.model.joint_count();
    let gains = Gains {
        period: 0.0,
        ..Gains::default()
    };
    let mut momentum = Momentum::new(&now.model, formulation, gains, vec![1.0; joints]);
    let reference = Reference {
        com: [now.support_centre().unwrap(), now.model.standing_com()[1]],
        com_velocity: [0.0; 2],
        pose: vec![0.0; joints],
        rates: vec![0.0; joints],
        accelerations: vec![0.0; joints],
        pitch: 0.0,
        swing: None,
    };
    let mut torques = vec![0.0; joints];
    assert!(momentum.torques(&now, &reference, &mut torques));
    bencher.bench_local(|| momentum.torques(black_box(&now), &reference, &mut torques));
}

/// The first seven of the humanoid's controllers, and the one that accepts every state.
fn pool_of_eight(model: &Arc<Model>) -> Supervisor {
    let shipped = repertoire::load("humanoid", &registry(), model).unwrap();
    let rest = shipped
        .controllers()
        .filter(|c| c.contract().name == "rest");
    let pool = shipped.controllers().take(7).chain(rest);
    let pool: Vec<_> = pool.map(Controller::clone_box).collect();
    assert_eq!(pool.len(), 8);
    Supervisor::new("eight", pool, "rest").unwrap()
}

#[divan::bench(sample_size = 1000)]
fn arbitration_of_eight(bencher: Bencher) {
    let now = pushed();
    let supervisor = pool_of_eight(&now.model);
    bencher.bench_local(|| supervisor.arbitrate(black_box(&now)));
}

/// A polynomial of the second degree over twenty features of the humanoid.
fn learned_boundary(now: &Sensors) -> Boundary {
    const COUNT: usize = 20;
    let joints = now.model.joints().map(|j| format!("velocity.{}", j.name));
    let others = ["com_from_feet", "capture_from_feet", "com_over_feet"];
    let others = others
        .into_iter()
        .chain(["trunk_pitch", "trunk_rate", "load", "head_height"]);
    let names = joints.chain(others.map(str::to_owned));
    let names = names.chain(["com_velocity_x".to_owned()]);
    let mut boundary = Boundary {
        version: VERSION,
        provenance: "Numbers without a meaning.".to_owned(),
        figures: None,
        controller: "balance".to_owned(),
        character: now.model.name.clone(),
        character_digest: now.model.digest(),
        features: names.map(|n| n.parse().unwrap()).collect(),
        mean: vec![0.0; COUNT],
        scale: vec![1.0; COUNT],
        decision: DecisionFunction::Polynomial {
            degree: 2,
            coefficients: (0..231).map(|i| f64::from(i % 7) - 3.0).collect(),
        },
        calibration: Calibration {
            slope: -1.0,
            offset: 0.0,
        },
    };
    boundary.resolve(&now.model).unwrap();
    boundary
}

#[divan::bench(sample_size = 1000)]
fn boundary_of_twenty_features(bencher: Bencher) {
    let now = pushed();
    let boundary = learned_boundary(&now);
    assert!(boundary.score(&now).is_finite());
    bencher.bench_local(|| black_box(&boundary).score(black_box(&now)));
}

/// That of balance is a radial one with 1,290 support vectors of 17 features, that of roll has 4,702 of 24.
#[divan::bench(args = ["balance", "roll"])]
fn shipped_boundary(bencher: Bencher, controller: &str) {
    let now = pushed();
    let file = registry().file(&format!("learned/{controller}.boundary.ron"));
    let mut boundary = Boundary::parse(&file.unwrap()).unwrap();
    boundary.resolve(&now.model).unwrap();
    assert!(boundary.score(&now).is_finite());
    bencher.bench_local(|| black_box(&boundary).score(black_box(&now)));
}

#[divan::bench(sample_count = 20)]
fn step_balancing(bencher: Bencher) {
    let start = after(1.0, &scenario(0.0, 0.0));
    assert_eq!(start.outcome(0).active, "balance");
    run(bencher, &start);
}

#[divan::bench(sample_count = 20)]
fn step_lying(bencher: Bencher) {
    let mut limp = scenario(1.5, 0.0);
    limp.characters[0].repertoire = Some("limp".to_owned());
    let start = after(5.0, &limp);
    assert_eq!(
        (start.outcome(0).posture, &*start.outcome(0).active),
        (Posture::Supine, "rest")
    );
    run(bencher, &start);
}

fn run(bencher: Bencher, start: &Simulation) {
    bencher
        .counter(ItemsCount::new(STEPS))
        .with_inputs(|| start.clone())
        .bench_local_refs(|simulation| {
            for _ in 0..STEPS {
                simulation.step();
            }
        });
}

/// The engine and sensing alone, with no controller's work to speak of.
#[divan::bench(sample_count = 20)]
fn step_at_rest_in_the_air(bencher: Bencher) {
    const REST: &str =
        "(name: \"r\", fallback: \"rest\", controllers: [File(\"skills/rest.ron\")])";
    let model = Model::load("humanoid").unwrap();
    let source = Source::new("r.ron", REST);
    let supervisor = repertoire::build(&source, None, &registry(), &model).unwrap();
    let start = Simulation::with_cast(&scenario(0.0, 50.0), vec![(model, supervisor)]).unwrap();
    run(bencher, &start);
}

//! The humanoid in a rapier scene that somebody else owns and steps: crates are thrown at it.
use aplomb::framework::character::{Model, State};
use aplomb::framework::control::{Controller, repertoire};
use aplomb::framework::input::Result;
use aplomb::framework::rapier2d::prelude::*;
use aplomb::framework::sensing::Sensors;
use aplomb::framework::world::{Body, Settings, integration_parameters};

fn main() -> Result<()> {
    // A scene of one's own. Stiff contacts suit a character that balances; the rest is free.
    let parameters = integration_parameters(&Settings::default());
    let (gravity, dt) = (Vector::new(0.0, -9.81), f64::from(parameters.dt));
    let (mut bodies, mut colliders) = (RigidBodySet::new(), ColliderSet::new());
    let (mut joints, mut multibodies) = (ImpulseJointSet::new(), MultibodyJointSet::new());
    let (mut soft_bodies, mut ccd) = (SoftBodySet::new(), CCDSolver::new());
    let (mut pipeline, mut islands) = (PhysicsPipeline::new(), IslandManager::new());
    let (mut broad_phase, mut narrow_phase) = (BroadPhaseBvh::new(), NarrowPhase::new());
    colliders.insert(ColliderBuilder::cuboid(50.0, 1.0).translation(Vector::new(0.0, -1.0)));
    for (distance, speed, size) in [(4.0, -4.0, 0.1), (9.0, -4.5, 0.12), (25.0, -6.0, 0.2)] {
        // So high that it arrives at the chest.
        let flight = distance / -speed;
        let height = 1.25 + 0.5 * 9.81 * flight * flight;
        let crate_ = RigidBodyBuilder::dynamic()
            .translation(Vector::new(distance, height))
            .linvel(Vector::new(speed, 0.0));
        let handle = bodies.insert(crate_);
        let shape = ColliderBuilder::cuboid(size, size).density(100.0);
        colliders.insert_with_parent(shape, handle, &mut bodies);
    }

    // The character, its senses and its supervisor.
    let model = Model::load("humanoid")?;
    let start = State::standing(&model);
    let mut body = Body::spawn(&model, &start, 0, &mut bodies, &mut colliders, &mut joints);
    let mut sensors = Sensors::new(&model, 9.81);
    let mut supervisor = repertoire::load("humanoid", &aplomb::controllers::registry(), &model)?;
    let mut torques = vec![0.0; model.joint_count()];

    let (mut shown, mut hit) = (String::new(), false);
    for step in 0..8000 {
        pipeline.step(
            gravity,
            &parameters,
            &mut islands,
            &mut broad_phase,
            &mut narrow_phase,
            &mut bodies,
            &mut colliders,
            &mut joints,
            &mut multibodies,
            &mut soft_bodies,
            &mut ccd,
            &(),
            &(),
        );
        sensors.time = f64::from(step + 1) * dt;
        body.sense(&bodies, &colliders, &narrow_phase, dt, &mut sensors);
        supervisor.act(&sensors, &mut torques);
        body.actuate(&mut bodies, &torques);
        let active = supervisor.active().expect("something is always active");
        let line = format!("{active:8} {}", sensors.posture.name());
        if line != shown {
            println!("{:6.3} s  {line}", sensors.time);
            shown = line;
        }
        hit |= sensors.contacts[model.trunk].force[0] < -50.0;
    }
    assert!(hit, "a crate has hit the trunk");
    Ok(())
}

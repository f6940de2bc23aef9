//! Motion without the ground: gravity, momentum, pushes; and what a state and a clone keep.

use std::sync::Arc;

use aplomb_framework::character::{Model, State};
use aplomb_framework::rapier2d::prelude::*;
use aplomb_framework::sensing::{Posture, Sensors};
use aplomb_framework::world::{Body, Settings, World, integration_parameters};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{G, ball, humanoid, lifted, limp, momentum, run, space, stiff, tree};

#[test]
fn a_falling_character_falls_at_g() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &lifted(&model, 5.0));
    let start = world.sense(0).com[1];
    run(&mut world, 800, limp);
    let now = world.sense(0);
    let t = now.time;
    assert!((now.com_velocity[1] + G * t).abs() < 1e-4 * G * t);
    assert!(now.com_velocity[0].abs() < 1e-4);
    // The engine integrates in two substeps a step, each as if its last velocity had held.
    let fallen = 0.5 * G * t * (t + 0.5e-3);
    assert!((start - now.com[1] - fallen).abs() < 1e-4 * fallen);
    assert_eq!(now.posture, Posture::Airborne);
}

/// L and H about the centre of mass, from the bodies themselves: the sensed momentum assumes that
/// the hinges hold exactly.
fn true_momentum(model: &Model, body: &Body, bodies: &RigidBodySet) -> [f64; 3] {
    let links = || {
        (0..model.links.len()).map(|i| {
            let (rigid, link) = (&bodies[body.link(i)], &model.links[i]);
            let wide = |v: Vector| [f64::from(v.x), f64::from(v.y)];
            let spin = link.inertia * f64::from(rigid.angvel());
            (
                link.mass,
                wide(rigid.center_of_mass()),
                wide(rigid.linvel()),
                spin,
            )
        })
    };
    let whole = model.total_mass();
    let mut sums = [0.0; 4];
    for (m, c, v, _) in links() {
        for (sum, x) in sums.iter_mut().zip([c[0], c[1], v[0], v[1]]) {
            *sum += m * x;
        }
    }
    let [cx, cy, vx, vy] = sums.map(|s| s / whole);
    let h = links()
        .map(|(m, c, v, spin)| spin + m * ((c[0] - cx) * (v[1] - vy) - (c[1] - cy) * (v[0] - vx)));
    [sums[2], sums[3], h.sum()]
}

#[test]
fn torques_in_the_air_change_no_momentum() {
    let model = humanoid();
    for gravity in [0.0, G] {
        let parameters = integration_parameters(&Settings {
            gravity,
            ..Settings::default()
        });
        let (mut bodies, mut colliders) = (RigidBodySet::new(), ColliderSet::new());
        let mut joints = ImpulseJointSet::new();
        let (mut multibody_joints, mut soft) = (MultibodyJointSet::new(), SoftBodySet::new());
        let (mut pipeline, mut islands) = (PhysicsPipeline::new(), IslandManager::new());
        let (mut broad_phase, mut narrow_phase) = (BroadPhaseBvh::new(), NarrowPhase::new());
        let mut ccd = CCDSolver::new();
        let start = lifted(&model, 3.0);
        let mut body = Body::spawn(&model, &start, 0, &mut bodies, &mut colliders, &mut joints);
        let mut now = Sensors::new(&model, gravity);
        let mut torques = vec![0.0; model.joint_count()];
        let (mut fastest, mut twist) = (0.0_f64, 0.0);
        for step in 0..600 {
            now.time = f64::from(step) * 1e-3;
            body.sense(&bodies, &colliders, &narrow_phase, 1e-3, &mut now);
            stiff(&now, &mut torques);
            for (j, torque) in torques.iter_mut().enumerate() {
                *torque += 40.0 * (7.0 * now.time + j as f64).sin();
                twist += torque.abs() * 1e-3;
            }
            fastest = now
                .state
                .rates()
                .iter()
                .fold(fastest, |m, r| m.max(r.abs()));
            body.actuate(&mut bodies, &torques);
            pipeline.step(
                Vector::new(0.0, -gravity as f32),
                &parameters,
                &mut islands,
                &mut broad_phase,
                &mut narrow_phase,
                &mut bodies,
                &mut colliders,
                &mut joints,
                &mut multibody_joints,
                &mut soft,
                &mut ccd,
                &(),
                &(),
            );
        }
        assert!(
            fastest > 2.0 && twist > 30.0,
            "{fastest} rad/s, {twist} N·m·s"
        );
        let [x, y, h] = true_momentum(&model, &body, &bodies);
        let fallen = model.total_mass() * gravity * 0.6;
        assert!(x.abs() < 1e-3, "L_x {x}");
        assert!(
            (y + fallen).abs() < 1e-3 + 1e-5 * fallen,
            "L_y {}",
            y + fallen
        );
        assert!(h.abs() < 2e-4 * twist, "H {h} of {twist}");
        // What is sensed strays from it by what the hinges give: some mm/s of the whole.
        body.sense(&bodies, &colliders, &narrow_phase, 1e-3, &mut now);
        let strays = [now.com_velocity[0], now.com_velocity[1] + gravity * 0.6];
        assert!(strays.iter().all(|v| v.abs() < 0.01), "{strays:?}");
    }
}

#[test]
fn a_push_gives_its_impulse() {
    let single = Arc::new(tree::random_tree(1, 0, 1.0));
    let gives = |model: &Arc<Model>, link: usize, impulse: [f64; 2], over: f64| {
        let mut world = space();
        world.spawn(model, &lifted(model, 3.0));
        world.push(0, link, impulse, over);
        run(&mut world, 200, limp);
        let [x, y, _] = momentum(&mut world, 0);
        let size = f64::hypot(impulse[0], impulse[1]);
        let error = f64::hypot(x - impulse[0], y - impulse[1]) / size;
        // What is sensed assumes that the hinges hold exactly; they give a little.
        assert!(error < 2e-3, "{impulse:?} over {over} s gave ({x}, {y})");
    };
    for over in [1e-4, 1e-3, 0.0301, 0.1] {
        gives(&single, 0, [3.0, -2.0], over);
    }
    gives(&humanoid(), 1, [35.0, 0.0], 0.1);
    gives(&humanoid(), 1, [-60.0, 10.0], 0.1);
}

#[test]
fn two_pushes_at_once_add_up() {
    let model = humanoid();
    let mut world = space();
    world.spawn(&model, &lifted(&model, 3.0));
    world.push(0, 1, [20.0, 0.0], 0.1);
    world.push(0, 1, [5.0, 5.0], 0.05);
    world.push(0, 0, [0.0, 10.0], 0.2);
    run(&mut world, 300, limp);
    let [x, y, _] = momentum(&mut world, 0);
    assert!(
        (x - 25.0).abs() < 0.025 && (y - 15.0).abs() < 0.015,
        "({x}, {y})"
    );
}

#[test]
fn a_clone_continues_bit_for_bit() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    world.add_prop(&ball(3.0, [0.3, 0.4], [-1.0, 0.0]));
    world.push(0, 1, [60.0, 0.0], 0.1);
    let weak = |now: &Sensors, torques: &mut [f64]| {
        stiff(now, torques);
        torques.iter_mut().for_each(|t| *t *= 0.1);
    };
    run(&mut world, 1800, weak);
    world.push(0, 4, [0.0, 9.0], 0.05);
    run(&mut world, 20, weak);
    let touching = world
        .sense(0)
        .contacts
        .iter()
        .filter(|c| c.touching)
        .count();
    assert!(touching >= 3, "in rich contact: {touching} links");
    let mut clone = world.clone();
    for _ in 0..200 {
        run(&mut world, 10, weak);
        run(&mut clone, 10, weak);
        assert_eq!(world.sense(0), clone.sense(0));
        assert!(world.prop_poses().eq(clone.prop_poses()));
    }
}

#[test]
fn what_is_spawned_is_sensed() {
    let model = humanoid();
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    for case in 0..40 {
        let mut state = State::standing(&model);
        state.q[0] = rng.gen_range(-2.0..2.0);
        state.q[1] = rng.gen_range(3.0..5.0);
        state.q[2] = rng.gen_range(-3.1..3.1);
        state.qdot.fill_with(|| rng.gen_range(-4.0..4.0));
        for (q, joint) in state.q[3..].iter_mut().zip(model.joints()) {
            *q = rng.gen_range(joint.range[0]..joint.range[1]);
        }
        let mut world = World::new(Settings::default());
        world.spawn(&model, &state);
        let check = |sensed: &State, when: &str| {
            let pairs = sensed.q.iter().chain(&sensed.qdot);
            for (i, (a, b)) in pairs.zip(state.q.iter().chain(&state.qdot)).enumerate() {
                // Two absolute angles or rates of some tens, in single precision.
                assert!(
                    (a - b).abs() < 1e-5,
                    "{case} {when}: {i} is {a} instead of {b}"
                );
            }
        };
        check(&world.sense(0).state, "at once");
        world.detect_contacts();
        check(&world.sense(0).state, "after looking for contacts");
    }
}

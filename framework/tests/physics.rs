//! The engine as we use it is honest: gravity, contact, torques, limits, pushes, clones.
#![allow(clippy::unwrap_used)]

#[path = "common/tree.rs"]
mod tree;

use std::sync::Arc;

use aplomb_framework::body::Body;
use aplomb_framework::model::{Model, Shape};
use aplomb_framework::rapier2d::prelude::*;
use aplomb_framework::sensors::{Posture, Sensors};
use aplomb_framework::state::State;
use aplomb_framework::world::{Prop, Settings, World, integration_parameters};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const G: f64 = 9.81;

fn humanoid() -> Arc<Model> {
    Model::load("humanoid").unwrap()
}

/// A world without gravity.
fn space() -> World {
    World::new(Settings {
        gravity: 0.0,
        ..Settings::default()
    })
}

/// The standing state, `height` m higher.
fn lifted(model: &Model, height: f64) -> State {
    let mut state = State::standing(model);
    state.q[1] += height;
    state
}

/// Steps of the whole loop; `act` sees the first character's sensors and fills its torques.
fn run(world: &mut World, steps: usize, mut act: impl FnMut(&Sensors, &mut [f64])) {
    let mut torques = vec![0.0; world.characters()[0].body.model().joint_count()];
    for _ in 0..steps {
        act(world.sense(0), &mut torques);
        world.actuate(0, &torques);
        world.step();
    }
}

/// Servos towards the upright pose, with half of the nominal damping: the explicit step carries that
/// with ease, while the whole of it lets the feet chatter.
fn stiff(now: &Sensors, torques: &mut [f64]) {
    for ((torque, joint), (q, v)) in torques
        .iter_mut()
        .zip(now.model.joints())
        .zip(now.state.angles().iter().zip(now.state.rates()))
    {
        *torque = -joint.kp * q - 0.5 * joint.kd * v;
    }
}

fn limp(_: &Sensors, torques: &mut [f64]) {
    torques.fill(0.0);
}

/// L and H of a character now.
fn momentum(world: &mut World, character: usize) -> [f64; 3] {
    let now = world.sense(character);
    let m = now.model.total_mass();
    [
        m * now.com_velocity[0],
        m * now.com_velocity[1],
        now.angular_momentum,
    ]
}

fn ball(mass: f64, position: [f64; 2], velocity: [f64; 2]) -> Prop {
    Prop {
        name: "ball".to_owned(),
        shape: Shape::Capsule {
            radius: 0.1,
            from: [0.0, 0.0],
            to: [0.0, 0.0],
        },
        mass,
        position,
        angle: 0.0,
        velocity,
        friction: 0.5,
        restitution: 0.0,
    }
}

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
    // The engine integrates in four substeps a step, each as if its last velocity had held.
    let fallen = 0.5 * G * t * (t + 0.25e-3);
    assert!((start - now.com[1] - fallen).abs() < 1e-4 * fallen);
    assert_eq!(now.posture, Posture::Airborne);
}

#[test]
fn a_standing_character_is_carried_with_its_weight() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    run(&mut world, 2000, stiff);
    let start = world.sense(0).base_of_support.unwrap();
    let (mut load, mut friction) = (0.0, 0.0_f64);
    run(&mut world, 2000, |now, torques| {
        stiff(now, torques);
        load += now.ground_reaction_force[1] / 2000.0 / (model.total_mass() * G);
        friction = friction.max(now.ground_reaction_force[0].abs());
        let ([rear, front], cop) = (now.base_of_support.unwrap(), now.cop.unwrap());
        assert!(rear <= cop && cop <= front, "{cop} outside {rear}..{front}");
        assert!(
            (rear - start[0]).abs() < 1e-3 && (front - start[1]).abs() < 1e-3,
            "the feet stay"
        );
    });
    assert!((load - 1.0).abs() < 1e-3, "mean load {load}");
    assert!(friction < 20.0, "standing quietly: {friction} N");
    let now = world.sense(0);
    let sum = now.feet.iter().fold(0.0, |s, f| s + f.force[1]);
    assert!((sum - now.ground_reaction_force[1]).abs() < 1e-9);
    assert_eq!(now.posture, Posture::Standing);
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
        let body = Body::spawn(&model, &start, 0, &mut bodies, &mut colliders, &mut joints);
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
fn torques_beyond_the_muscles_act_as_their_limit() {
    let model = humanoid();
    let end = |factor: f64| {
        let mut world = World::new(Settings::default());
        world.spawn(&model, &lifted(&model, 0.2));
        run(&mut world, 500, |now, torques| {
            for (j, (torque, joint)) in torques.iter_mut().zip(now.model.joints()).enumerate() {
                let sign = if (now.time * 10.0 + j as f64).sin() > 0.0 {
                    1.0
                } else {
                    -1.0
                };
                *torque = sign * factor * joint.torque;
            }
        });
        world.sense(0).clone()
    };
    let limit = end(1.0);
    assert_eq!(limit, end(10.0));
    assert_eq!(limit, end(f64::INFINITY));
    assert_ne!(limit, end(0.5));
}

#[test]
fn a_torque_that_is_not_a_number_counts_as_none() {
    let model = humanoid();
    let end = |torque: f64| {
        let mut world = World::new(Settings::default());
        world.spawn(&model, &lifted(&model, 0.2));
        run(&mut world, 500, |now, torques| {
            stiff(now, torques);
            torques[3] = torque;
        });
        world.sense(0).clone()
    };
    assert_eq!(end(f64::NAN), end(0.0));
}

/// rad by which a joint is beyond its range now; negative inside.
fn beyond(now: &Sensors, joint: usize) -> f64 {
    let [low, high] = now.model.joints().nth(joint).unwrap().range;
    let q = now.state.angles()[joint];
    (low - q).max(q - high)
}

#[test]
fn a_joint_stays_in_its_range_under_full_torque() {
    let model = humanoid();
    for joint in 0..model.joint_count() {
        for sign in [1.0, -1.0] {
            let mut world = space();
            world.spawn(&model, &lifted(&model, 3.0));
            let (mut reached, mut worst) = (false, f64::NEG_INFINITY);
            run(&mut world, 500, |now, torques| {
                stiff(now, torques);
                torques[joint] = sign * f64::INFINITY;
                worst = worst.max(beyond(now, joint));
                reached |= worst > 0.0;
            });
            let name = &model.joints().nth(joint).unwrap().name;
            assert!(reached, "{name} reaches its range's end");
            assert!(worst < 0.05, "{name} was {worst} rad beyond its range");
            let rests = beyond(world.sense(0), joint);
            assert!(rests < 0.01, "{name} rests {rests} rad beyond its range");
        }
    }
}

/// With every joint at full torque limbs whip: a shoulder that meets its stop at 30 rad/s throws the
/// forearm against the elbow's, which gives more in that moment.
#[test]
fn joints_return_to_their_range_when_all_are_at_full_torque() {
    let model = humanoid();
    for sign in [1.0, -1.0] {
        let mut world = space();
        world.spawn(&model, &lifted(&model, 3.0));
        run(&mut world, 1500, |now, torques| {
            torques.fill(sign * f64::INFINITY);
            let most = if now.time < 1.0 { 0.1 } else { 0.01 };
            for j in 0..torques.len() {
                let beyond = beyond(now, j);
                assert!(beyond < most, "{j} is {beyond} rad beyond at {}", now.time);
            }
        });
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
        assert!(error < 1e-3, "{impulse:?} over {over} s gave ({x}, {y})");
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
fn characters_collide_with_each_other_and_not_with_themselves() {
    let model = humanoid();
    let mut world = space();
    let moving = |x: f64, v: f64| {
        let mut state = lifted(&model, 3.0);
        (state.q[0], state.qdot[0]) = (x, v);
        state
    };
    // Arms and trunk of one character overlap in the plane.
    world.spawn(&model, &moving(-0.7, 2.0));
    world.spawn(&model, &moving(0.7, -1.0));
    world.detect_contacts();
    for character in [0, 1] {
        assert!(world.sense(character).contacts.iter().all(|c| !c.touching));
    }
    run(&mut world, 50, limp);
    for character in [0, 1] {
        let expected = [1.0, -1.0][character];
        let now = world.sense(character);
        assert!(
            now.state.rates().iter().all(|r| r.abs() < 1e-3),
            "nothing pushes the limbs"
        );
        assert!((now.com_velocity[0] * expected - [2.0, 1.0][character]).abs() < 1e-4);
    }
    let mut touched = [false; 2];
    for _ in 0..1000 {
        run(&mut world, 1, limp);
        for (i, touched) in touched.iter_mut().enumerate() {
            *touched |= world.sense(i).contacts.iter().any(|c| c.touching);
        }
    }
    assert_eq!(touched, [true, true]);
    let ([x0, y0, _], [x1, y1, _]) = (momentum(&mut world, 0), momentum(&mut world, 1));
    let m = model.total_mass();
    assert!(x0 < 1.5 * m, "the faster one is slowed down: {x0}");
    assert!(
        (x0 + x1 - m).abs() < 1e-3 * m,
        "together they go on: {}",
        x0 + x1
    );
    assert!((y0 + y1).abs() < 1e-3 * m, "{}", y0 + y1);
}

#[test]
fn a_thrown_ball_gives_the_character_its_momentum() {
    let model = humanoid();
    let mut world = space();
    world.spawn(&model, &lifted(&model, 3.0));
    let chest = world.sense(0).kinematics.links[1].com;
    let (mass, speed) = (6.0, 7.0);
    world.add_prop(&ball(mass, [chest[0] + 1.0, chest[1]], [-speed, 0.0]));
    let mut hit = false;
    run(&mut world, 400, |now, torques| {
        limp(now, torques);
        hit |= now.contacts.iter().any(|c| c.touching && c.force[0] < 0.0);
    });
    assert!(hit, "the ball pushes backwards");
    let at = |world: &World| world.prop_poses().next().unwrap();
    let from = at(&world);
    let [mut x, _, _] = momentum(&mut world, 0);
    run(&mut world, 100, limp);
    x = 0.5 * (x + momentum(&mut world, 0)[0]);
    let to = at(&world);
    let ball = mass * f64::from(to[0] - from[0]) / 0.1;
    assert!(
        (x + ball + mass * speed).abs() < 2e-3 * mass * speed,
        "{x} + {ball}"
    );
    assert!(x < -20.0, "it takes up most of it: {x}");
}

#[test]
fn a_fixed_prop_holds_and_a_loose_one_comes_to_rest() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    let plate = Shape::Box {
        half: [1.0, 0.25],
        centre: [0.0, 0.0],
    };
    let fixed = Prop {
        shape: plate,
        mass: 0.0,
        position: [0.0, 0.25],
        friction: 1.0,
        ..ball(1.0, [0.0; 2], [0.0; 2])
    };
    world.add_prop(&fixed);
    let loose = Prop {
        shape: Shape::Box {
            half: [0.2, 0.15],
            centre: [0.0, 0.0],
        },
        position: [3.0, 0.4],
        ..ball(4.0, [0.0; 2], [0.0; 2])
    };
    world.add_prop(&loose);
    world.spawn(&model, &lifted(&model, 0.52));
    run(&mut world, 3000, stiff);
    let poses: Vec<[f32; 3]> = world.prop_poses().collect();
    assert_eq!(poses[0], [0.0, 0.25, 0.0]);
    assert!((poses[1][1] - 0.15).abs() < 2e-3, "{:?}", poses[1]);
    let now = world.sense(0);
    assert_eq!(now.posture, Posture::Standing);
    assert!(
        (now.ground - 0.5).abs() < 3e-3,
        "stands on the plate: {}",
        now.ground
    );
    assert!((now.com_height() / model.standing_com()[1] - 1.0).abs() < 0.02);
}

/// The search for contacts before the first step once left what nobody actuates in the air.
#[test]
fn a_prop_falls_after_looking_for_contacts() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    world.add_prop(&ball(2.0, [2.0, 3.0], [1.0, 0.0]));
    world.detect_contacts();
    run(&mut world, 500, limp);
    let [x, y, _] = world.prop_poses().next().unwrap();
    assert!(
        (x - 2.5).abs() < 1e-3 && (y - (3.0 - 0.125 * 9.81)).abs() < 2e-3,
        "({x}, {y})"
    );
}

#[test]
fn a_resting_character_never_sleeps() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    let mut state = State::standing(&model);
    state.q[2] = std::f64::consts::FRAC_PI_2;
    state.q[1] = 0.3;
    world.spawn(&model, &state);
    run(&mut world, 20_000, |now, torques| {
        stiff(now, torques);
        torques.iter_mut().for_each(|t| *t *= 0.05);
    });
    let elbow = model.joint_index("elbow_r").unwrap();
    let before = world.sense(0).state.angles()[elbow];
    run(&mut world, 200, |_, torques| torques[elbow] = 20.0);
    let after = world.sense(0).state.angles()[elbow];
    assert!(after - before > 0.1, "from {before} to {after}");
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

#[test]
fn feet_are_on_the_ground_before_the_first_step() {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    world.spawn(&model, &State::standing(&model));
    assert_eq!(
        world.sense(0).posture,
        Posture::Airborne,
        "nobody has looked yet"
    );
    world.detect_contacts();
    let now = world.sense(0);
    assert_eq!(now.posture, Posture::Standing);
    assert!(now.feet.iter().all(|f| f.heel && f.toe));
    let [rear, front] = now.base_of_support.unwrap();
    let foot = &model.feet[0];
    assert!((rear - foot.heel[0]).abs() < 1e-3 && (front - foot.toe[0]).abs() < 1e-3);
    assert_eq!(
        now.ground_reaction_force,
        [0.0, 0.0],
        "no force before the first step"
    );
    // Looking changes nothing.
    let moved = now.state.clone();
    world.detect_contacts();
    assert_eq!(world.sense(0).state, moved);
}

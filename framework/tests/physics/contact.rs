//! Contacts: feet that carry, characters and props that meet.

use aplomb_framework::character::{Shape, State, put_on_ground};
use aplomb_framework::sensing::{Posture, Sensors};
use aplomb_framework::world::{Prop, Settings, World};

use super::{G, ball, humanoid, lifted, limp, momentum, run, space, stiff};

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

/// What is sensed of a character that has been put on the ground in a pose.
fn put_down(pitch: f64, angles: &[(&str, f64)]) -> Sensors {
    let model = humanoid();
    let mut state = State::standing(&model);
    state.q[2] = pitch;
    for (stem, angle) in angles {
        for side in ["r", "l"] {
            let joint = model.joint_index(&format!("{stem}_{side}")).unwrap();
            state.q[3 + joint] = *angle;
        }
    }
    put_on_ground(&model, &mut state, 0.0);
    let mut world = World::new(Settings::default());
    world.spawn(&model, &state);
    world.detect_contacts();
    world.sense(0).clone()
}

#[test]
fn a_thigh_that_touches_at_its_knee_kneels_and_one_that_lies_sits() {
    let thigh = humanoid().link_index("thigh_r").unwrap();
    // The shanks are folded up behind the thighs: nothing but the knees is left to kneel on.
    let knees = put_down(0.0, &[("knee", -2.6)]);
    assert!(knees.contacts[thigh].supported && knees.contacts[thigh].knee);
    assert_eq!(knees.posture, Posture::Kneeling);
    // On the same thighs, laid flat in front.
    let flat = put_down(0.0, &[("hip", 1.57), ("knee", 0.0), ("shoulder", 1.57)]);
    assert!(flat.contacts[thigh].supported && !flat.contacts[thigh].knee);
    assert_eq!(flat.posture, Posture::Sitting);
}

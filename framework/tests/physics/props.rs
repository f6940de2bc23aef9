//! Props that hang, break off, and are held.

use std::f64::consts::{FRAC_PI_2, TAU};

use aplomb_framework::character::{Shape, State};
use aplomb_framework::sensing::{Posture, Sensors};
use aplomb_framework::world::{Hinge, Prop, Settings, World};

use super::{G, ball, humanoid, lifted, limp, momentum, run, space, stiff};

const RADIUS: f64 = 0.1;

/// A ball of 10 kg that hangs by a thread without mass, `length` m long, `angle` rad from the vertical.
fn pendulum(length: f64, angle: f64, breaks: f64) -> World {
    let mut world = World::new(Settings::default());
    let pivot = [0.5, 3.0];
    let (sin, cos) = angle.sin_cos();
    let bob = Prop {
        angle,
        ..ball(
            10.0,
            [pivot[0] + sin * length, pivot[1] - cos * length],
            [0.0; 2],
        )
    };
    let prop = world.add_prop(&bob);
    let hinge = Hinge {
        prop,
        at: [0.0, length],
        to: None,
        to_at: pivot,
        breaks,
    };
    assert_eq!(world.add_hinge(&hinge), 0);
    world
}

/// s from swing to swing.
fn period(world: &mut World, swings: u32) -> f64 {
    let (mut last, mut crossings) = (f64::NAN, Vec::new());
    while crossings.len() <= swings as usize {
        world.step();
        let angle = world.prop_motion(0).angle;
        if last < 0.0 && angle >= 0.0 {
            let back = angle / (angle - last) * world.settings().dt;
            crossings.push(world.time() - back);
        }
        last = angle;
        assert!(world.time() < 100.0, "it swings");
    }
    (crossings[swings as usize] - crossings[0]) / f64::from(swings)
}

#[test]
fn a_pendulum_has_its_period() {
    for (length, amplitude) in [(0.5, 0.1), (1.0, 0.1), (1.0, 1.0)] {
        // About the pivot, a disc; with the next terms of the amplitude.
        let arm = length + 0.5 * RADIUS * RADIUS / length;
        let wider: f64 =
            1.0 + amplitude * amplitude / 16.0 + 11.0 / 3072.0 * f64::powi(amplitude, 4);
        let expected = TAU * (arm / G).sqrt() * wider;
        let found = period(&mut pendulum(length, amplitude, f64::INFINITY), 5);
        assert!(
            (found / expected - 1.0).abs() < 2e-3,
            "{length} m, {amplitude} rad: {found} for {expected} s"
        );
    }
}

#[test]
fn a_hinge_breaks_above_its_force_and_not_below() {
    let weight = 10.0 * G;
    let mut world = pendulum(0.0, 0.0, 1.02 * weight);
    (0..2000).for_each(|_| world.step());
    assert!(world.hinge_holds(0));
    assert!((world.prop_motion(0).position[1] - 3.0).abs() < 1e-3);
    let mut world = pendulum(0.0, 0.0, 0.98 * weight);
    (0..200).for_each(|_| world.step());
    assert!(!world.hinge_holds(0));
    assert!(world.prop_motion(0).position[1] < 3.0 - 0.5 * G * 0.1 * 0.1);
    // Swung down from the horizontal a pendulum pulls with three times its weight at the bottom;
    // that of a disc with a little less.
    let at_bottom = weight * (1.0 + 2.0 / (1.0 + 0.5 * RADIUS * RADIUS));
    for (breaks, holds) in [(1.03 * at_bottom, true), (0.97 * at_bottom, false)] {
        let mut world = pendulum(1.0, FRAC_PI_2, breaks);
        (0..1000).for_each(|_| world.step());
        assert_eq!(world.hinge_holds(0), holds, "{breaks} N");
    }
}

#[test]
fn a_broken_hinge_stays_broken_in_a_clone() {
    let mut world = pendulum(1.0, FRAC_PI_2, 200.0);
    let mut early = world.clone();
    while world.hinge_holds(0) {
        world.step();
        early.step();
        assert_eq!(world.prop_motion(0), early.prop_motion(0));
    }
    let mut late = world.clone();
    for _ in 0..1000 {
        for world in [&mut world, &mut early, &mut late] {
            world.step();
            assert!(!world.hinge_holds(0));
        }
        assert_eq!(world.prop_motion(0), early.prop_motion(0));
        assert_eq!(world.prop_motion(0), late.prop_motion(0));
    }
}

#[test]
fn a_chain_hangs_together() {
    let mut world = World::new(Settings::default());
    let link = Prop {
        shape: Shape::Capsule {
            radius: 0.03,
            from: [0.0, -0.1],
            to: [0.0, 0.1],
        },
        ..ball(1.0, [0.0; 2], [0.0; 2])
    };
    for i in 0..5 {
        let position = [0.1 + 0.2 * f64::from(i), 3.0];
        let angle = FRAC_PI_2;
        world.add_prop(&Prop {
            position,
            angle,
            ..link.clone()
        });
    }
    for prop in 0..5_usize {
        let to = prop.checked_sub(1);
        world.add_hinge(&Hinge {
            prop,
            at: [0.0, 0.1],
            to,
            to_at: to.map_or([0.0, 3.0], |_| [0.0, -0.1]),
            breaks: f64::INFINITY,
        });
    }
    for _ in 0..20_000 {
        world.step();
        for prop in 0..5 {
            let end = |prop: usize, along: f64| {
                let m = world.prop_motion(prop);
                let (sin, cos) = m.angle.sin_cos();
                [m.position[0] - sin * along, m.position[1] + cos * along]
            };
            let above = if prop == 0 {
                [0.0, 3.0]
            } else {
                end(prop - 1, -0.1)
            };
            let here = end(prop, 0.1);
            let gap = (here[0] - above[0]).hypot(here[1] - above[1]);
            assert!(
                gap < 5e-3,
                "link {prop} is off by {gap} m at {}",
                world.time()
            );
        }
    }
}

/// rad by which the arms are raised.
const RAISED: f64 = 1.5;

/// Upright, the arms raised.
fn reaching(now: &Sensors, torques: &mut [f64]) {
    stiff(now, torques);
    for (torque, joint) in torques.iter_mut().zip(now.model.joints()) {
        if joint.name.starts_with("shoulder") {
            *torque += joint.kp * RAISED;
        }
    }
}

/// A ball that touches the hands of raised arms from below, under their tips.
fn under_the_hands(mass: f64, grip: f64) -> World {
    let model = humanoid();
    let mut world = World::new(Settings::default());
    let mut state = State::standing(&model);
    for joint in ["shoulder_r", "shoulder_l"] {
        state.q[3 + model.joint_index(joint).unwrap()] = RAISED;
    }
    world.spawn(&model, &state);
    let [x, y] = tip(&mut world);
    let ball = Prop {
        grip,
        ..ball(mass, [x, y - 0.035 - RADIUS - 1e-3], [0.0; 2])
    };
    world.add_prop(&ball);
    world.detect_contacts();
    world
}

#[test]
fn a_ball_from_below_bears_hands_only_if_something_bears_it() {
    for on_a_table in [false, true] {
        let mut world = under_the_hands(7.0, 0.0);
        let [x, y] = world.prop_motion(0).position;
        if on_a_table {
            let half = [0.2, 0.05];
            let centre = [0.0, 0.0];
            world.add_prop(&Prop {
                shape: Shape::Box { half, centre },
                mass: 0.0,
                ..ball(1.0, [x, y - RADIUS - half[1]], [0.0; 2])
            });
            world.detect_contacts();
        }
        let now = world.sense(0);
        assert!(now.contacts[now.model.hands[0].link].touching);
        assert_eq!(now.only_feet_support(), !on_a_table);
    }
}

/// Where the tip of a hand is.
fn tip(world: &mut World) -> [f64; 2] {
    let now = world.sense(0);
    let hand = &now.model.hands[0];
    now.kinematics.point(hand.link, hand.tip)
}

#[test]
fn a_ball_that_is_grasped_hangs_and_falls_when_the_hands_open() {
    let mut world = under_the_hands(2.0, 600.0);
    world.grip(0, true);
    run(&mut world, 500, reaching);
    let mut load = 0.0;
    run(&mut world, 1000, |now, torques| {
        reaching(now, torques);
        load += now.ground_reaction_force[1] / G / 1000.0;
    });
    let now = world.sense(0).clone();
    let ball = &now.props[0];
    assert!(ball.held && world.holds(0, 0));
    assert_eq!((&*ball.name, now.posture), ("ball", Posture::Standing));
    assert!(now.only_feet_support());
    let ([x, y], hangs) = (tip(&mut world), world.prop_motion(0).position);
    assert!(
        (hangs[0] - x).abs() < 0.02 && (y - hangs[1] - RADIUS - 0.035).abs() < 0.01,
        "({x}, {y}) {hangs:?}"
    );
    let carried = load - now.model.total_mass();
    assert!((carried - 2.0).abs() < 0.25, "{carried} kg");
    assert!((ball.height - hangs[1]).abs() < 5e-3);
    assert!((ball.ahead + now.state.q[0] - hangs[0]).abs() < 1e-9);
    world.grip(0, false);
    assert!(!world.holds(0, 0));
    run(&mut world, 200, reaching);
    let fallen = hangs[1] - world.prop_motion(0).position[1];
    let down = -ball.velocity[1];
    assert!(
        (fallen - 0.2 * down - 0.5 * G * 0.04).abs() < 5e-3,
        "{fallen} from {down}"
    );
    let now = world.sense(0);
    assert!(!now.props[0].held);
    assert!((now.props[0].velocity[1] + down + 0.2 * G).abs() < 0.02);
}

#[test]
fn what_cannot_be_held_and_what_is_too_heavy_falls() {
    // Each hand bears half of 49 N.
    for (grip, taken, holds) in [(0.0, false, false), (20.0, true, false), (40.0, true, true)] {
        let mut world = under_the_hands(5.0, grip);
        world.grip(0, true);
        run(&mut world, 1, reaching);
        assert_eq!(world.holds(0, 0), taken);
        run(&mut world, 500, reaching);
        assert_eq!(world.holds(0, 0), holds, "{grip} N");
        let below = tip(&mut world)[1] - world.prop_motion(0).position[1];
        assert_eq!(below > 0.3, !holds, "{grip} N: {below} m");
    }
}

#[test]
fn a_hand_lets_be_what_has_slipped_from_it() {
    // It lies on a table, from which the arms try to lift it.
    let mut world = under_the_hands(20.0, 30.0);
    let [x, y] = world.prop_motion(0).position;
    let table = Prop {
        shape: Shape::Box {
            half: [0.2, 0.05],
            centre: [0.0, 0.0],
        },
        mass: 0.0,
        ..ball(1.0, [x, y - RADIUS - 0.05], [0.0; 2])
    };
    world.add_prop(&table);
    world.grip(0, true);
    let mut changes = Vec::new();
    for _ in 0..4000 {
        run(&mut world, 1, |now, torques| {
            reaching(now, torques);
            // Up and down, once a second.
            let lift = 30.0 * (TAU * now.time).sin();
            for (torque, joint) in torques.iter_mut().zip(now.model.joints()) {
                if joint.name.starts_with("shoulder") {
                    *torque += lift;
                }
            }
        });
        let holds = world.holds(0, 0);
        if changes.last().is_none_or(|(_, held)| *held != holds) {
            changes.push((world.time(), holds));
        }
    }
    let again = changes.windows(2).filter(|w| !w[0].1 && w[1].1);
    let pauses: Vec<f64> = again.map(|w| w[1].0 - w[0].0).collect();
    assert!(!pauses.is_empty(), "{changes:?}");
    assert!(pauses.iter().all(|p| *p > 0.499), "{changes:?}");
}

#[test]
fn a_catch_conserves_momentum_and_a_clone_catches_alike() {
    let model = humanoid();
    let mut world = space();
    world.spawn(&model, &lifted(&model, 3.0));
    let hand = &model.hands[0];
    let [x, y] = world.sense(0).kinematics.point(hand.link, hand.tip);
    let (mass, speed) = (2.0, 4.0);
    world.add_prop(&Prop {
        grip: 600.0,
        ..ball(mass, [x + 0.5, y], [-speed, 0.0])
    });
    world.grip(0, true);
    let before = world.clone();
    run(&mut world, 300, limp);
    assert!(world.holds(0, 0));
    let [px, py, _] = momentum(&mut world, 0);
    let v = world.prop_motion(0).velocity;
    let total = [px + mass * v[0], py + mass * v[1]];
    assert!(
        (total[0] + mass * speed).abs() < 0.05 && total[1].abs() < 0.05,
        "{total:?}"
    );
    let mut again = before.clone();
    let mut caught = false;
    for _ in 0..300 {
        // Cloned at every step, in the air, at the touch, and while it is held.
        again = again.clone();
        run(&mut again, 1, limp);
        caught |= again.holds(0, 0);
    }
    assert!(caught);
    assert_eq!(world.prop_motion(0), again.prop_motion(0));
    assert_eq!(*world.sense(0), *again.sense(0));
}

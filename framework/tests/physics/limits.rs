//! Limits: what muscles can give, where joints end.

use aplomb_framework::sensing::Sensors;
use aplomb_framework::world::{Settings, World};

use super::{humanoid, lifted, run, space, stiff};

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
                *torque = sign * factor * joint.muscles.strongest();
            }
        });
        world.sense(0).clone()
    };
    // Lengthening muscles bear 1.3 times their strength.
    let limit = end(2.0);
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
            let most = if now.time < 1.0 { 0.15 } else { 0.02 };
            for j in 0..torques.len() {
                let beyond = beyond(now, j);
                assert!(beyond < most, "{j} is {beyond} rad beyond at {}", now.time);
            }
        });
    }
}

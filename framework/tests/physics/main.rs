//! The engine as we use it is honest: gravity, contact, torques, limits, pushes, clones.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

#[path = "../common/tree.rs"]
mod tree;

mod contact;
mod limits;
mod motion;
mod props;

use std::sync::Arc;

use aplomb_framework::character::{Model, Shape, State};
use aplomb_framework::sensing::Sensors;
use aplomb_framework::world::{Prop, Settings, World};

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
        grip: 0.0,
    }
}

//! The equation of motion of the humanoid and of random trees: against an independent formulation,
//! against Lagrange's equations, against finite differences, and by what a free tree conserves.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

#[path = "../common/reference.rs"]
mod reference;
#[path = "../common/tree.rs"]
mod tree;

mod equation;
mod maps;
mod motion;

use aplomb_framework::character::{Dynamics, Kinematics, Model, State};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use reference::random_state;
use tree::random_tree;

const G: f64 = 9.81;
/// Agreement of two exact formulations, relative to the largest entry.
const EXACT: f64 = 1e-11;
/// Agreement with fourth-order finite differences.
const DIFFERENCED: f64 = 1e-9;
/// Their step, rad.
const STEP: f64 = 1e-3;

/// The humanoid and trees of 0 to 25 joints, each with some random states.
fn each_case(states: usize, mut check: impl FnMut(&Model, &State, &str)) {
    let humanoid = Model::load("humanoid").unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(2026);
    let trees = (0..26).map(|n| random_tree(100 + n, n as usize, 3.0));
    for model in std::iter::once((*humanoid).clone()).chain(trees) {
        for k in 0..states {
            let state = random_state(&mut rng, &model, 5.0);
            check(
                &model,
                &state,
                &format!("{} joints, state {k}", model.joint_count()),
            );
        }
    }
}

fn updated(model: &Model, state: &State) -> Dynamics {
    let mut dynamics = Dynamics::new(model);
    dynamics.update(model, state, G);
    dynamics
}

fn near(a: &[f64], b: &[f64], tolerance: f64, what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let scale = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        let error = (a - b).abs() / scale;
        assert!(
            error <= tolerance,
            "{what}[{i}]: {a} instead of {b}, error {error:e}"
        );
    }
}

fn moved(state: &State, direction: &[f64], by: f64) -> State {
    let q = state.q.iter().zip(direction).map(|(q, d)| q + by * d);
    State {
        q: q.collect(),
        qdot: state.qdot.clone(),
    }
}

/// Derivative of `f` along `direction` of q, by fourth-order central differences. No link turns by
/// more than the step, however fast the direction.
fn derivative(state: &State, direction: &[f64], f: impl Fn(&State) -> Vec<f64>) -> Vec<f64> {
    let fastest: f64 = direction.iter().map(|d| d.abs()).sum();
    let step = STEP / fastest.max(1.0);
    let at = |by: f64| f(&moved(state, direction, by));
    let (p1, m1, p2, m2) = (at(step), at(-step), at(2.0 * step), at(-2.0 * step));
    (0..p1.len())
        .map(|i| (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * step))
        .collect()
}

fn unit(n: usize, k: usize) -> Vec<f64> {
    let mut e = vec![0.0; n];
    e[k] = 1.0;
    e
}

fn transposed(columns: &[Vec<f64>]) -> Vec<f64> {
    let rows = columns[0].len();
    (0..rows)
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect()
}

/// Kinetic energy from the velocities of the links.
fn kinetic(model: &Model, q: &[f64], qdot: &[f64]) -> f64 {
    let mut kinematics = Kinematics::new(model);
    let state = State {
        q: q.to_vec(),
        qdot: qdot.to_vec(),
    };
    kinematics.update(model, &state);
    let of = |(l, m): (
        &aplomb_framework::character::Link,
        &aplomb_framework::character::LinkMotion,
    )| {
        let v2 = m.com_velocity[0].powi(2) + m.com_velocity[1].powi(2);
        0.5 * (l.mass * v2 + l.inertia * m.rate * m.rate)
    };
    model.links.iter().zip(&kinematics.links).map(of).sum()
}

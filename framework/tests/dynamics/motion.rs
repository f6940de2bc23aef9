//! What moves by the equation: free trees, pendulums.

use aplomb_framework::character::{Dynamics, Model, State};
use aplomb_framework::input::Source;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::reference::{Reference, random_state};
use super::tree::random_tree;
use super::{G, near, updated};

/// q̈ of the free tree.
fn acceleration(model: &Model, dynamics: &mut Dynamics, state: &State, gravity: f64) -> Vec<f64> {
    dynamics.update(model, state, gravity);
    let n = model.dof();
    let m = DMatrix::from_row_slice(n, n, &dynamics.mass_matrix);
    let bias = DVector::from_column_slice(&dynamics.bias);
    (-m.cholesky().unwrap().solve(&bias)).as_slice().to_vec()
}

/// One step of the classical fourth-order Runge–Kutta method.
fn runge_kutta(model: &Model, dynamics: &mut Dynamics, state: &mut State, gravity: f64, dt: f64) {
    let n = model.dof();
    let start = state.clone();
    let (mut rate, mut change) = (vec![0.0; n], vec![0.0; n]);
    for (ahead, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
        let mut stage = start.clone();
        if ahead > 0.0 {
            // `state` holds the last stage's q̇ and q̈.
            for i in 0..n {
                stage.q[i] += ahead * dt * state.q[i];
                stage.qdot[i] += ahead * dt * state.qdot[i];
            }
        }
        state.qdot = acceleration(model, dynamics, &stage, gravity);
        state.q = stage.qdot;
        for i in 0..n {
            rate[i] += weight * state.q[i];
            change[i] += weight * state.qdot[i];
        }
    }
    *state = start;
    for i in 0..n {
        state.q[i] += dt / 6.0 * rate[i];
        state.qdot[i] += dt / 6.0 * change[i];
    }
}

#[test]
fn a_free_tree_conserves_energy_and_momentum() {
    let humanoid = (*Model::load("humanoid").unwrap()).clone();
    let trees = [1, 2, 3, 6, 12].map(|n| random_tree(500 + n, n as usize, 0.5));
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for model in std::iter::once(humanoid).chain(trees) {
        for gravity in [0.0, G] {
            let mut dynamics = Dynamics::new(&model);
            let mut state = random_state(&mut rng, &model, 2.0);
            let before = Reference::new(&model, &state, gravity);
            let (dt, steps) = (2.5e-4, 2000);
            for _ in 0..steps {
                runge_kutta(&model, &mut dynamics, &mut state, gravity, dt);
            }
            let after = Reference::new(&model, &state, gravity);
            let case = format!("{} joints, gravity {gravity}", model.joint_count());
            let energy = |r: &Reference| r.kinetic + r.potential;
            let drift = (energy(&after) - energy(&before)).abs() / before.kinetic;
            assert!(drift < 1e-8, "{case}: energy drifts by {drift:e}");
            let mut momentum = after.momentum;
            momentum[1] += model.total_mass() * gravity * dt * f64::from(steps);
            near(&momentum, &before.momentum, 1e-8, &format!("{case}: L, H"));
        }
    }
}

/// A chain of links that hang from the root's origin when all angles are 0.
fn chain(links: &[(f64, f64, f64, f64)]) -> Model {
    let mut text = String::new();
    for (i, (mass, inertia, com, length)) in links.iter().enumerate() {
        let joint = match i {
            0 => String::new(),
            _ => format!(
                "joint: (name: \"j{i}\", parent: \"l{}\", anchor: (0.0, {:?}), \
                 range: (-3.0, 3.0), torque: 1.0, kp: 1.0, kd: 1.0),",
                i - 1,
                -links[i - 1].3
            ),
        };
        text += &format!(
            "(name: \"l{i}\", {joint} mass: {mass:?}, com: (0.0, {:?}), inertia: {inertia:?}, \
             shape: Capsule(radius: 0.05, from: (0.0, 0.0), to: (0.0, {:?}))),",
            -com, -length
        );
    }
    let text = format!(
        "(name: \"chain\", trunk: \"l0\", head: \"l0\", \
         feet: [(link: \"l0\", heel: (-0.1, 0.0), toe: (0.1, 0.0))], links: [{text}])"
    );
    Model::parse(&Source::new("chain", text)).unwrap()
}

#[test]
fn a_pinned_link_is_the_physical_pendulum() {
    let (m, inertia, l) = (2.5, 0.3, 0.7);
    let model = chain(&[(m, inertia, l, 1.0)]);
    for theta in [-2.0, 0.3, 1.2] {
        let state = State {
            q: vec![0.4, -0.2, theta],
            qdot: vec![0.0, 0.0, 1.7],
        };
        let dynamics = updated(&model, &state);
        let at_pin = (inertia + m * l * l, m * G * l * f64::sin(theta));
        near(
            &[dynamics.mass_matrix[8]],
            &[at_pin.0],
            1e-14,
            "moment of inertia",
        );
        near(&[dynamics.bias[2]], &[at_pin.1], 1e-14, "m g l sin θ");
    }
}

#[test]
fn two_pinned_links_are_the_double_pendulum() {
    let ((m1, i1, a1, l1), (m2, i2, a2)) = ((2.0, 0.2, 0.4, 0.9), (1.5, 0.1, 0.35));
    let model = chain(&[(m1, i1, a1, l1), (m2, i2, a2, 0.8)]);
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for _ in 0..20 {
        let mut any = || rng.gen_range(-3.0..3.0);
        let (t1, t2, w1, w2): (f64, f64, f64, f64) = (any(), any(), any(), any());
        // Angles from the vertical; the joint's is their difference.
        let state = State {
            q: vec![0.0, 0.0, t1, t2 - t1],
            qdot: vec![0.0, 0.0, w1, w2 - w1],
        };
        let dynamics = updated(&model, &state);
        let m = DMatrix::from_row_slice(4, 4, &dynamics.mass_matrix);
        let held = m.view((2, 2), (2, 2)).into_owned();
        let bias = DVector::from_column_slice(&dynamics.bias[2..]);
        let ours = -held.lu().solve(&bias).unwrap();
        // The textbook's two equations.
        let (sin, cos) = (t1 - t2).sin_cos();
        let k = m2 * l1 * a2;
        let textbook = DMatrix::from_row_slice(
            2,
            2,
            &[
                i1 + m1 * a1 * a1 + m2 * l1 * l1,
                k * cos,
                k * cos,
                i2 + m2 * a2 * a2,
            ],
        );
        let rhs = DVector::from_column_slice(&[
            -k * sin * w2 * w2 - (m1 * a1 + m2 * l1) * G * t1.sin(),
            k * sin * w1 * w1 - m2 * a2 * G * t2.sin(),
        ]);
        let theirs = textbook.lu().solve(&rhs).unwrap();
        near(
            &[ours[0], ours[0] + ours[1]],
            theirs.as_slice(),
            1e-12,
            "angular accelerations",
        );
    }
}

//! The equation of motion of the humanoid and of random trees: against an independent formulation,
//! against Lagrange's equations, against finite differences, and by what a free tree conserves.
#![allow(clippy::unwrap_used)]

#[path = "common/reference.rs"]
mod reference;
#[path = "common/tree.rs"]
mod tree;

use aplomb_framework::dynamics::Dynamics;
use aplomb_framework::file::Source;
use aplomb_framework::kinematics::Kinematics;
use aplomb_framework::model::{Model, Point};
use aplomb_framework::state::State;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use reference::{Reference, angle_row, point, random_state};
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
        &aplomb_framework::model::Link,
        &aplomb_framework::kinematics::LinkMotion,
    )| {
        let v2 = m.com_velocity[0].powi(2) + m.com_velocity[1].powi(2);
        0.5 * (l.mass * v2 + l.inertia * m.rate * m.rate)
    };
    model.links.iter().zip(&kinematics.links).map(of).sum()
}

#[test]
fn the_mass_matrix_is_the_hessian_of_kinetic_energy() {
    each_case(2, |model, state, case| {
        let n = model.dof();
        let dynamics = updated(model, state);
        let energy = |v: &[f64]| kinetic(model, &state.q, v);
        let single: Vec<f64> = (0..n).map(|i| energy(&unit(n, i))).collect();
        for i in 0..n {
            for j in 0..n {
                let mut both = unit(n, i);
                both[j] += 1.0;
                let hessian = energy(&both) - single[i] - single[j];
                let scale = 2.0 * (single[i] * single[j]).sqrt();
                let error = (dynamics.mass_matrix[i * n + j] - hessian).abs() / scale;
                assert!(error < 1e-9, "{case}: M[{i}][{j}] is off by {error:e}");
            }
        }
    });
}

#[test]
fn the_mass_matrix_is_the_sum_over_links_and_positive_definite() {
    each_case(3, |model, state, case| {
        let n = model.dof();
        let dynamics = updated(model, state);
        let reference = Reference::new(model, state, G);
        near(
            &dynamics.mass_matrix,
            reference.mass_matrix.transpose().as_slice(),
            EXACT,
            &format!("{case}: M"),
        );
        let m = DMatrix::from_row_slice(n, n, &dynamics.mass_matrix);
        assert_eq!(m, m.transpose(), "{case}");
        assert!(m.cholesky().is_some(), "{case}: not positive definite");
    });
}

#[test]
fn the_bias_is_the_sum_over_links() {
    each_case(3, |model, state, case| {
        let reference = Reference::new(model, state, G);
        let dynamics = updated(model, state);
        near(
            &dynamics.bias,
            reference.bias.as_slice(),
            EXACT,
            &format!("{case}: bias"),
        );
    });
}

#[test]
fn the_bias_is_lagranges() {
    each_case(1, |model, state, case| {
        let (n, qdot) = (model.dof(), &state.qdot);
        let mass = |s: &State| updated(model, s).mass_matrix;
        let along: Vec<Vec<f64>> = (0..n)
            .map(|k| derivative(state, &unit(n, k), mass))
            .collect();
        let potential = |s: &State| vec![Reference::new(model, s, G).potential];
        let expected: Vec<f64> = (0..n)
            .map(|k| {
                // d/dt (∂T/∂q̇_k) with q̈ = 0, less ∂T/∂q_k, plus ∂V/∂q_k.
                let mut sum = derivative(state, &unit(n, k), potential)[0];
                for i in 0..n {
                    for j in 0..n {
                        let change = along[i][k * n + j] - 0.5 * along[k][i * n + j];
                        sum += change * qdot[i] * qdot[j];
                    }
                }
                sum
            })
            .collect();
        near(
            &updated(model, state).bias,
            &expected,
            DIFFERENCED,
            &format!("{case}: bias"),
        );
    });
}

#[test]
fn the_centroidal_map_gives_momentum_and_its_change() {
    each_case(3, |model, state, case| {
        let n = model.dof();
        let dynamics = updated(model, state);
        let times_qdot = |map: &[f64]| -> Vec<f64> {
            let row = |r: &[f64]| r.iter().zip(&state.qdot).map(|(a, v)| a * v).sum();
            map.chunks(n).map(row).collect()
        };
        let reference = Reference::new(model, state, G);
        let momentum = times_qdot(&dynamics.centroidal_map);
        near(
            &momentum,
            &reference.momentum,
            EXACT,
            &format!("{case}: A q̇"),
        );
        let bias = dynamics.centroidal_bias;
        near(
            &bias,
            &reference.momentum_bias,
            EXACT,
            &format!("{case}: Ȧq̇"),
        );
        let differenced = derivative(state, &state.qdot, |s| {
            times_qdot(&updated(model, s).centroidal_map)
        });
        near(
            &bias,
            &differenced,
            DIFFERENCED,
            &format!("{case}: Ȧq̇, differenced"),
        );
        // The root's rows of M and h are momentum about the root's origin, and its change.
        let (m, a) = (&dynamics.mass_matrix, &dynamics.centroidal_map);
        near(&m[..2 * n], &a[..2 * n], 1e-14, &format!("{case}: M and A"));
        let c = dynamics.kinematics.com;
        let arm = [c[0] - state.q[0], c[1] - state.q[1]];
        let about_origin: Vec<f64> = (0..n)
            .map(|j| a[2 * n + j] + arm[0] * a[n + j] - arm[1] * a[j])
            .collect();
        near(
            &m[2 * n..3 * n],
            &about_origin,
            EXACT,
            &format!("{case}: third row"),
        );
        let lift = bias[1] + model.total_mass() * G;
        let root = [bias[0], lift, bias[2] + arm[0] * lift - arm[1] * bias[0]];
        near(
            &dynamics.bias[..3],
            &root,
            EXACT,
            &format!("{case}: root's bias"),
        );
    });
}

#[test]
fn kinematics_and_dynamics_agree_with_the_sum_over_links() {
    each_case(3, |model, state, case| {
        let reference = Reference::new(model, state, G);
        let k = updated(model, state).kinematics;
        let m = model.total_mass();
        near(&k.com, &reference.com, EXACT, &format!("{case}: c"));
        let momentum = [
            m * k.com_velocity[0],
            m * k.com_velocity[1],
            k.angular_momentum,
        ];
        near(
            &momentum,
            &reference.momentum,
            EXACT,
            &format!("{case}: L, H"),
        );
        let kinetic = kinetic(model, &state.q, &state.qdot);
        near(
            &[kinetic],
            &[reference.kinetic],
            EXACT,
            &format!("{case}: T"),
        );
    });
}

#[test]
fn jacobians_and_their_change_agree_with_finite_differences() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    each_case(2, |model, state, case| {
        let n = model.dof();
        let dynamics = updated(model, state);
        let link = rng.gen_range(0..model.links.len());
        let local: Point = [rng.gen_range(-1.0..1.0), rng.gen_range(-1.0..1.0)];
        let kinematics = |s: &State| updated(model, s).kinematics;
        let columns = |f: &dyn Fn(&State) -> Vec<f64>| {
            let column = |k| derivative(state, &unit(n, k), f);
            transposed(&(0..n).map(column).collect::<Vec<_>>())
        };

        let mut jacobian = vec![f64::NAN; 2 * n];
        dynamics.point_jacobian(link, local, &mut jacobian);
        let differenced = columns(&|s| kinematics(s).point(link, local).to_vec());
        near(
            &jacobian,
            &differenced,
            DIFFERENCED,
            &format!("{case}: point"),
        );
        let exact = point(model, state, link, local);
        near(
            &jacobian,
            exact.jacobian.transpose().as_slice(),
            EXACT,
            &format!("{case}: J"),
        );
        let velocity = dynamics.kinematics.point_velocity(link, local);
        near(&velocity, &exact.velocity, EXACT, &format!("{case}: ṗ"));
        near(
            &dynamics.kinematics.point(link, local),
            &exact.position,
            EXACT,
            case,
        );

        let bias = dynamics.point_bias(link, local);
        near(&bias, &exact.bias, EXACT, &format!("{case}: J̇q̇"));
        let differenced = derivative(state, &state.qdot, |s| {
            kinematics(s).point_velocity(link, local).to_vec()
        });
        near(
            &bias,
            &differenced,
            DIFFERENCED,
            &format!("{case}: J̇q̇, differenced"),
        );

        let mut row = vec![f64::NAN; n];
        dynamics.angle_jacobian(link, &mut row);
        assert_eq!(row, angle_row(model, link).as_slice(), "{case}: angle");
        let differenced = columns(&|s| vec![kinematics(s).links[link].angle]);
        near(
            &row,
            &differenced,
            DIFFERENCED,
            &format!("{case}: angle, differenced"),
        );

        dynamics.com_jacobian(&mut jacobian);
        let differenced = columns(&|s| kinematics(s).com.to_vec());
        near(
            &jacobian,
            &differenced,
            DIFFERENCED,
            &format!("{case}: centre of mass"),
        );
    });
}

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

#[test]
fn at_rest_the_bias_is_the_weight() {
    each_case(1, |model, state, case| {
        let still = State {
            q: state.q.clone(),
            qdot: vec![0.0; model.dof()],
        };
        let dynamics = updated(model, &still);
        let weight = model.total_mass() * G;
        near(&dynamics.bias[..2], &[0.0, weight], 1e-14, case);
        assert_eq!(dynamics.centroidal_bias, [0.0; 3], "{case}");
    });
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

//! Mass matrix and bias.

use aplomb_framework::character::State;
use nalgebra::DMatrix;

use super::reference::Reference;
use super::{DIFFERENCED, EXACT, G, derivative, each_case, kinetic, near, unit, updated};

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

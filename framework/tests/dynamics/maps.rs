//! Centroidal map, kinematics and Jacobians, with their change in time.

use aplomb_framework::character::{Point, State};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::reference::{Reference, angle_row, point};
use super::{
    DIFFERENCED, EXACT, G, derivative, each_case, kinetic, near, transposed, unit, updated,
};

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

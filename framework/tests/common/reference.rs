//! Dynamics from first principles: every point of a link is the root's origin plus a sum of vectors,
//! each turned by the absolute angle of one link. Positions, Jacobians and J̇q̇ follow by
//! differentiating that sum; nothing is recursive.

use aplomb_framework::character::{Model, Point, State};
use nalgebra::{DMatrix, DVector};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// A random state of any model.
pub(crate) fn random_state(rng: &mut ChaCha8Rng, model: &Model, speed: f64) -> State {
    let mut fill = |most: f64| {
        (0..model.dof())
            .map(|_| rng.gen_range(-most..most))
            .collect()
    };
    State {
        q: fill(3.0),
        qdot: fill(speed),
    }
}

/// One point of a link: position, velocity, 2 × dof Jacobian, J̇q̇.
pub(crate) struct PointMotion {
    pub(crate) position: Point,
    pub(crate) velocity: Point,
    pub(crate) jacobian: DMatrix<f64>,
    pub(crate) bias: Point,
}

/// The links of a model on the way from each link to the root, the link itself first.
pub(crate) fn path(model: &Model, link: usize) -> Vec<usize> {
    let parent = |i: &usize| model.links[*i].joint.as_ref().map(|j| j.parent);
    std::iter::successors(Some(link), parent).collect()
}

/// Row of the Jacobian of a link's absolute angle.
pub(crate) fn angle_row(model: &Model, link: usize) -> DVector<f64> {
    let mut row = DVector::zeros(model.dof());
    for i in path(model, link) {
        row[i + 2] = 1.0;
    }
    row
}

/// Position, Jacobian and J̇q̇ of a point of a link.
pub(crate) fn point(model: &Model, state: &State, link: usize, local: Point) -> PointMotion {
    let q = DVector::from_column_slice(&state.q);
    let qdot = DVector::from_column_slice(&state.qdot);
    let mut jacobian = DMatrix::zeros(2, model.dof());
    jacobian[(0, 0)] = 1.0;
    jacobian[(1, 1)] = 1.0;
    let (mut position, mut bias) = ([q[0], q[1]], [0.0; 2]);
    // The vectors of the sum, each fixed in one link.
    let hinges = path(model, link).into_iter().filter_map(|i| {
        let joint = model.links[i].joint.as_ref()?;
        Some((joint.parent, joint.anchor))
    });
    for (fixed_in, v) in hinges.chain([(link, local)]) {
        let row = angle_row(model, fixed_in);
        let (angle, rate) = (row.dot(&q), row.dot(&qdot));
        let turned = [
            v[0] * angle.cos() - v[1] * angle.sin(),
            v[0] * angle.sin() + v[1] * angle.cos(),
        ];
        for k in 0..2 {
            position[k] += turned[k];
            bias[k] -= rate * rate * turned[k];
        }
        for (k, row_k) in row.iter().enumerate() {
            jacobian[(0, k)] -= turned[1] * row_k;
            jacobian[(1, k)] += turned[0] * row_k;
        }
    }
    let velocity = &jacobian * &qdot;
    PointMotion {
        position,
        velocity: [velocity[0], velocity[1]],
        jacobian,
        bias,
    }
}

/// Everything that [`aplomb_framework::character::Dynamics`] computes, summed over the links.
pub(crate) struct Reference {
    pub(crate) mass_matrix: DMatrix<f64>,
    pub(crate) bias: DVector<f64>,
    pub(crate) kinetic: f64,
    pub(crate) potential: f64,
    pub(crate) com: Point,
    /// L and H.
    pub(crate) momentum: [f64; 3],
    /// Ȧq̇.
    pub(crate) momentum_bias: [f64; 3],
}

impl Reference {
    pub(crate) fn new(model: &Model, state: &State, gravity: f64) -> Self {
        let n = model.dof();
        let qdot = DVector::from_column_slice(&state.qdot);
        let mut reference = Self {
            mass_matrix: DMatrix::zeros(n, n),
            bias: DVector::zeros(n),
            kinetic: 0.0,
            potential: 0.0,
            com: [0.0; 2],
            momentum: [0.0; 3],
            momentum_bias: [0.0; 3],
        };
        let motions: Vec<(f64, f64, PointMotion, DVector<f64>)> = model
            .links
            .iter()
            .enumerate()
            .map(|(i, l)| {
                let motion = point(model, state, i, l.com);
                (l.mass, l.inertia, motion, angle_row(model, i))
            })
            .collect();
        let whole: f64 = motions.iter().map(|m| m.0).sum();
        for (mass, inertia, p, row) in &motions {
            reference.mass_matrix += *mass * p.jacobian.transpose() * &p.jacobian;
            reference.mass_matrix += *inertia * row * row.transpose();
            let carried = DVector::from_column_slice(&[p.bias[0], p.bias[1] + gravity]);
            reference.bias += *mass * p.jacobian.transpose() * carried;
            let rate = row.dot(&qdot);
            let v2 = p.velocity[0].powi(2) + p.velocity[1].powi(2);
            reference.kinetic += 0.5 * (mass * v2 + inertia * rate * rate);
            reference.potential += mass * gravity * p.position[1];
            for k in 0..2 {
                reference.com[k] += mass / whole * p.position[k];
                reference.momentum[k] += mass * p.velocity[k];
                reference.momentum_bias[k] += mass * p.bias[k];
            }
        }
        for (mass, inertia, p, row) in &motions {
            let c = reference.com;
            let arm = [p.position[0] - c[0], p.position[1] - c[1]];
            let cross = |v: Point| arm[0] * v[1] - arm[1] * v[0];
            reference.momentum[2] += mass * cross(p.velocity) + inertia * row.dot(&qdot);
            reference.momentum_bias[2] += mass * cross(p.bias);
        }
        reference
    }
}

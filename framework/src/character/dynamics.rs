//! Planar articulated dynamics of any tree: M(q) q̈ + h(q, q̇) = τ + Σ Jᵀ F.
//!
//! [`State`] → [`Dynamics`] (mass matrix, bias, centroidal momentum matrix, Jacobians with J̇q̇) →
//! momentum control. Composite rigid bodies for M and the centroidal map, recursive Newton–Euler
//! for h; allocates nothing after [`Dynamics::new`].
//!
//! A planar joint turns everything beyond it about one point, so that with a composite body of
//! mass m, centre c and inertia I about c, every entry is a closed form:
//! M_jk = I + m (c − o_j)·(c − o_k), where the composite is the one beyond the outer joint.

use crate::character::kinematics::{Kinematics, turned};
use crate::character::model::Model;
use crate::character::shape::Point;
use crate::character::state::State;

/// Everything beyond a joint, frozen into one body.
#[derive(Debug, Clone, Copy, Default)]
struct Composite {
    mass: f64,
    com: Point,
    inertia: f64,
}

/// The terms of the equation of motion at one state. Matrices are row-major with [`Self::dof`]
/// columns.
#[derive(Debug, Clone)]
pub struct Dynamics {
    dof: usize,
    /// M: dof × dof, kg, kg·m, kg·m².
    pub mass_matrix: Vec<f64>,
    /// h: centrifugal, Coriolis and gravity terms, N and N·m; at rest `bias[1]` = m g.
    pub bias: Vec<f64>,
    /// A: 3 × dof; A q̇ = (L_x, L_y, H), kg·m/s and kg·m²/s about the centre of mass.
    pub centroidal_map: Vec<f64>,
    /// Ȧ q̇: (L̇_x, L̇_y, Ḣ) when q̈ = 0, N and N·m.
    pub centroidal_bias: [f64; 3],
    /// Link poses and velocities, centre of mass, momentum.
    pub kinematics: Kinematics,
    parents: Vec<Option<usize>>,
    composites: Vec<Composite>,
    /// Acceleration of each link's origin when q̈ = 0, without gravity, m/s².
    origin_bias: Vec<Point>,
    /// Force on each link and what hangs on it, and its moment about the link's origin.
    force: Vec<Point>,
    moment: Vec<f64>,
}

impl Dynamics {
    /// Workspace for a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let (dof, links) = (model.dof(), model.links.len());
        Self {
            dof,
            mass_matrix: vec![0.0; dof * dof],
            bias: vec![0.0; dof],
            centroidal_map: vec![0.0; 3 * dof],
            centroidal_bias: [0.0; 3],
            kinematics: Kinematics::new(model),
            parents: model
                .links
                .iter()
                .map(|l| l.joint.as_ref().map(|j| j.parent))
                .collect(),
            composites: vec![Composite::default(); links],
            origin_bias: vec![[0.0; 2]; links],
            force: vec![[0.0; 2]; links],
            moment: vec![0.0; links],
        }
    }

    /// Degrees of freedom: the number of columns of every matrix.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.dof
    }

    /// Recomputes every term at a state, under gravity `gravity` (m/s², downwards positive).
    pub fn update(&mut self, model: &Model, state: &State, gravity: f64) {
        self.kinematics.update(model, state);
        self.newton_euler(model, gravity);
        self.composite_bodies(model);
        self.fill_matrices();
    }

    /// h by recursive Newton–Euler with q̈ = 0, and Ȧq̇ on the way.
    fn newton_euler(&mut self, model: &Model, gravity: f64) {
        let com = self.kinematics.com;
        self.centroidal_bias = [0.0; 3];
        for (i, link) in model.links.iter().enumerate() {
            let motion = &self.kinematics.links[i];
            self.origin_bias[i] = match &link.joint {
                None => [0.0; 2],
                Some(joint) => {
                    let parent = &self.kinematics.links[joint.parent];
                    let arm = turned(parent.turn, joint.anchor);
                    let w2 = parent.rate * parent.rate;
                    let a = self.origin_bias[joint.parent];
                    [a[0] - w2 * arm[0], a[1] - w2 * arm[1]]
                }
            };
            let arm = [
                motion.com[0] - motion.origin[0],
                motion.com[1] - motion.origin[1],
            ];
            let w2 = motion.rate * motion.rate;
            let inertial = [
                link.mass * (self.origin_bias[i][0] - w2 * arm[0]),
                link.mass * (self.origin_bias[i][1] - w2 * arm[1]),
            ];
            let lever = [motion.com[0] - com[0], motion.com[1] - com[1]];
            self.centroidal_bias[0] += inertial[0];
            self.centroidal_bias[1] += inertial[1];
            self.centroidal_bias[2] += lever[0] * inertial[1] - lever[1] * inertial[0];
            let f = [inertial[0], inertial[1] + link.mass * gravity];
            self.force[i] = f;
            self.moment[i] = arm[0] * f[1] - arm[1] * f[0];
        }
        for i in (1..model.links.len()).rev() {
            self.bias[i + 2] = self.moment[i];
            let Some(p) = self.parents[i] else { continue };
            let o = self.kinematics.links[i].origin;
            let po = self.kinematics.links[p].origin;
            let lever = [o[0] - po[0], o[1] - po[1]];
            let f = self.force[i];
            self.moment[p] += self.moment[i] + lever[0] * f[1] - lever[1] * f[0];
            self.force[p][0] += f[0];
            self.force[p][1] += f[1];
        }
        self.bias[0] = self.force[0][0];
        self.bias[1] = self.force[0][1];
        self.bias[2] = self.moment[0];
    }

    fn composite_bodies(&mut self, model: &Model) {
        for (i, link) in model.links.iter().enumerate() {
            self.composites[i] = Composite {
                mass: link.mass,
                com: self.kinematics.links[i].com,
                inertia: link.inertia,
            };
        }
        for i in (1..model.links.len()).rev() {
            let Some(p) = self.parents[i] else { continue };
            self.composites[p] = joined(&self.composites[p], &self.composites[i]);
        }
    }

    /// M and A from the composites.
    fn fill_matrices(&mut self) {
        let n = self.dof;
        let com = self.kinematics.com;
        let (lx, rest) = self.centroidal_map.split_at_mut(n);
        let (ly, h) = rest.split_at_mut(n);
        self.mass_matrix.fill(0.0);
        let whole = self.composites[0].mass;
        (lx[0], ly[0], h[0]) = (whole, 0.0, 0.0);
        (lx[1], ly[1], h[1]) = (0.0, whole, 0.0);
        self.mass_matrix[0] = whole;
        self.mass_matrix[n + 1] = whole;
        for i in 0..self.composites.len() {
            let j = i + 2;
            let beyond = self.composites[i];
            let o = self.kinematics.links[i].origin;
            let arm = [beyond.com[0] - o[0], beyond.com[1] - o[1]];
            lx[j] = -beyond.mass * arm[1];
            ly[j] = beyond.mass * arm[0];
            h[j] = beyond.inertia
                + beyond.mass
                    * ((beyond.com[0] - com[0]) * arm[0] + (beyond.com[1] - com[1]) * arm[1]);
            self.mass_matrix[j] = lx[j];
            self.mass_matrix[j * n] = lx[j];
            self.mass_matrix[n + j] = ly[j];
            self.mass_matrix[j * n + 1] = ly[j];
            let mut ancestor = Some(i);
            while let Some(a) = ancestor {
                let oa = self.kinematics.links[a].origin;
                let entry = beyond.inertia
                    + beyond.mass
                        * (arm[0] * (beyond.com[0] - oa[0]) + arm[1] * (beyond.com[1] - oa[1]));
                self.mass_matrix[j * n + a + 2] = entry;
                self.mass_matrix[(a + 2) * n + j] = entry;
                ancestor = self.parents[a];
            }
        }
    }

    /// Jacobian of a point of a link, 2 × dof row-major into `jacobian`: ṗ = J q̇.
    pub fn point_jacobian(&self, link: usize, local: Point, jacobian: &mut [f64]) {
        let n = self.dof;
        jacobian[..2 * n].fill(0.0);
        jacobian[0] = 1.0;
        jacobian[n + 1] = 1.0;
        let p = self.kinematics.point(link, local);
        let mut here = Some(link);
        while let Some(i) = here {
            let o = self.kinematics.links[i].origin;
            jacobian[i + 2] = -(p[1] - o[1]);
            jacobian[n + i + 2] = p[0] - o[0];
            here = self.parents[i];
        }
    }

    /// J̇q̇ of a point of a link: its acceleration when q̈ = 0, m/s².
    #[must_use]
    pub fn point_bias(&self, link: usize, local: Point) -> Point {
        let motion = &self.kinematics.links[link];
        let arm = turned(motion.turn, local);
        let w2 = motion.rate * motion.rate;
        let a = self.origin_bias[link];
        [a[0] - w2 * arm[0], a[1] - w2 * arm[1]]
    }

    /// Row of the Jacobian of a link's absolute angle: φ̇ = J q̇ (its J̇q̇ is 0 in the plane).
    pub fn angle_jacobian(&self, link: usize, row: &mut [f64]) {
        row[..self.dof].fill(0.0);
        let mut here = Some(link);
        while let Some(i) = here {
            row[i + 2] = 1.0;
            here = self.parents[i];
        }
    }

    /// Jacobian of the centre of mass, 2 × dof row-major into `jacobian`: ċ = J q̇.
    pub fn com_jacobian(&self, jacobian: &mut [f64]) {
        let m = self.composites[0].mass;
        for (out, a) in jacobian
            .iter_mut()
            .zip(&self.centroidal_map[..2 * self.dof])
        {
            *out = a / m;
        }
    }
}

/// Two bodies frozen into one.
fn joined(a: &Composite, b: &Composite) -> Composite {
    let mass = a.mass + b.mass;
    let com = [
        (a.mass * a.com[0] + b.mass * b.com[0]) / mass,
        (a.mass * a.com[1] + b.mass * b.com[1]) / mass,
    ];
    let d = [b.com[0] - a.com[0], b.com[1] - a.com[1]];
    let inertia = a.inertia + b.inertia + a.mass * b.mass / mass * (d[0] * d[0] + d[1] * d[1]);
    Composite { mass, com, inertia }
}

//! Dense strictly convex quadratic programs by the dual active-set method of
//! D. Goldfarb and A. Idnani, "A numerically stable dual method for solving strictly convex
//! quadratic programs", Mathematical Programming 27 (1983) 1–33.
//!
//! In: a [`Problem`], minimise ½ xᵀ H x + gᵀ x subject to E x = e and C x ≥ d.
//! Out: an [`Outcome`] and, held by the [`ActiveSet`], the minimiser x with multipliers y and
//! u ≥ 0 such that H x + g = Eᵀ y + Cᵀ u and uᵀ (C x − d) = 0.
//!
//! The method starts at the unconstrained minimiser and adds one violated constraint at a time,
//! keeping dual feasibility. With N the active normals (scaled to unit length) and H = L Lᵀ it
//! maintains J = L⁻ᵀ Q and the upper triangle R such that Jᵀ N = [R; 0]. A constraint enters by
//! one Householder reflection of the free columns of J and leaves by Givens rotations.

pub use crate::problem::{Problem, Rows};

/// Relative violation below which an inequality counts as satisfied.
const SATISFIED: f64 = 1e-12;
/// Relative residual below which a constraint that depends on the active ones is consistent.
const CONSISTENT: f64 = 1e-8;
/// Relative length below which a normal's free part is taken to be zero.
const DEPENDENT: f64 = 1e-9;
/// Least length of x that tolerances refer to, relative to the largest so far.
const LEAST_SCALE: f64 = 1e-5;
/// Relative rounding level of Jᵀ n and of r = R⁻¹ Jᵀ n.
const ROUNDING: f64 = 1e-13;

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The minimiser was found.
    Optimal,
    /// No x satisfies all constraints, or a constraint is not finite.
    Infeasible,
    /// H is not numerically positive definite, or H, g or their sizes are not valid.
    NotConvex,
    /// The bound on the number of steps was reached.
    IterationLimit,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Free,
    Active,
    /// Dependent on the active constraints and violated by no more than `CONSISTENT`.
    SetAside,
    /// A row of zeros.
    Void,
}

/// Workspace of the dual active-set method and its last solution. A solve does not depend on
/// earlier ones.
#[derive(Debug)]
pub struct ActiveSet {
    n: usize,
    /// Upper Cholesky factor of H; scratch while J is formed.
    factor: Vec<f64>,
    /// Jᵀ row-major: row i is column i of J.
    j: Vec<f64>,
    /// Frobenius norm of J.
    j_norm: f64,
    /// R by columns of stride n.
    r_factor: Vec<f64>,
    /// d = Jᵀ n for the entering normal n.
    d: Vec<f64>,
    /// Primal direction z = J₂ d₂.
    z: Vec<f64>,
    /// Negative dual direction r = R⁻¹ d₁.
    r: Vec<f64>,
    x: Vec<f64>,
    /// Largest length of x so far.
    x_scale: f64,
    /// Multipliers of the active constraints, for unit normals.
    u: Vec<f64>,
    /// Active constraints: equality i is i, inequality i is i + number of equalities.
    active: Vec<usize>,
    /// How many of the active constraints are equalities; they come first.
    active_equalities: usize,
    /// Inverse lengths of all constraint normals, equalities first.
    weight: Vec<f64>,
    state: Vec<State>,
    equality_multipliers: Vec<f64>,
    inequality_multipliers: Vec<f64>,
    iterations: usize,
}

/// A clone has a workspace of the same size and the same last solution.
impl Clone for ActiveSet {
    fn clone(&self) -> Self {
        let most_equalities = self.equality_multipliers.capacity();
        let most_inequalities = self.inequality_multipliers.capacity();
        let mut other = Self::new(self.n, most_equalities, most_inequalities);
        other.x.copy_from_slice(&self.x);
        let (y, u) = (&self.equality_multipliers, &self.inequality_multipliers);
        other.equality_multipliers.extend_from_slice(y);
        other.inequality_multipliers.extend_from_slice(u);
        other.iterations = self.iterations;
        other
    }
}

impl ActiveSet {
    /// Workspace for `n` variables and at most the given numbers of rows.
    pub fn new(n: usize, most_equalities: usize, most_inequalities: usize) -> Self {
        Self {
            n,
            factor: vec![0.0; n * n],
            j: vec![0.0; n * n],
            j_norm: 0.0,
            r_factor: vec![0.0; n * n],
            d: vec![0.0; n],
            z: vec![0.0; n],
            r: vec![0.0; n],
            x: vec![0.0; n],
            x_scale: 0.0,
            u: Vec::with_capacity(n),
            active: Vec::with_capacity(n),
            active_equalities: 0,
            weight: Vec::with_capacity(most_equalities + most_inequalities),
            state: Vec::with_capacity(most_inequalities),
            equality_multipliers: Vec::with_capacity(most_equalities),
            inequality_multipliers: Vec::with_capacity(most_inequalities),
            iterations: 0,
        }
    }

    /// The last minimiser; meaningful after [`Outcome::Optimal`].
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Steps taken by the last solve: constraints added or dropped.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Multipliers y of the equalities, 0 for redundant ones.
    pub fn equality_multipliers(&self) -> &[f64] {
        &self.equality_multipliers
    }

    /// Multipliers u ≥ 0 of the inequalities, 0 for inactive ones.
    pub fn inequality_multipliers(&self) -> &[f64] {
        &self.inequality_multipliers
    }

    /// Solves `problem`. Allocates only if it is larger than the workspace.
    pub fn solve(&mut self, problem: &Problem) -> Outcome {
        if !problem.well_formed() {
            return Outcome::NotConvex;
        }
        let (equalities, inequalities) = (problem.equalities.len(), problem.inequalities.len());
        if self.n != problem.n {
            *self = Self::new(problem.n, equalities, inequalities);
        }
        self.iterations = 0;
        self.x.fill(0.0);
        self.x_scale = 0.0;
        self.u.clear();
        self.active.clear();
        self.active_equalities = 0;
        self.equality_multipliers.clear();
        self.equality_multipliers.resize(equalities, 0.0);
        self.inequality_multipliers.clear();
        self.inequality_multipliers.resize(inequalities, 0.0);
        let outcome = self.search(problem);
        for (&id, u) in self.active.iter().zip(&self.u) {
            let multiplier = u * self.weight[id];
            match id.checked_sub(equalities) {
                Some(i) => self.inequality_multipliers[i] = multiplier.max(0.0),
                None => self.equality_multipliers[id] = multiplier,
            }
        }
        outcome
    }

    fn search(&mut self, problem: &Problem) -> Outcome {
        if !self.factorise(&problem.h) || !self.start(&problem.g) {
            return Outcome::NotConvex;
        }
        if !self.weigh(problem) {
            return Outcome::Infeasible;
        }
        let equalities = problem.equalities.len();
        for id in 0..equalities {
            let residual = self.residual(problem, id).0;
            self.transform(problem.equalities.row(id), self.weight[id]);
            if let Some(length) = self.direct() {
                let t = -residual / (length * length);
                self.step(t, true);
                self.enter(id, t, length);
                self.active_equalities = self.active.len();
            } else if !self.consistent(problem, id) {
                return Outcome::Infeasible;
            }
        }
        let limit = 50 + 10 * (self.n + equalities + problem.inequalities.len());
        let mut refined = false;
        loop {
            let Some(i) = self.most_violated(problem) else {
                if !refined {
                    self.refine(problem);
                    refined = true;
                    let scale = norm(&self.x).max(LEAST_SCALE * self.x_scale);
                    if scale < 0.1 * self.x_scale {
                        // x came from afar: look again with the tolerance of where it is now.
                        self.x_scale = scale;
                        self.recall();
                        continue;
                    }
                }
                break;
            };
            refined = false;
            let id = equalities + i;
            self.transform(problem.inequalities.row(i), self.weight[id]);
            let mut u = 0.0;
            loop {
                if self.iterations > limit {
                    return Outcome::IterationLimit;
                }
                let length = self.direct();
                let residual = self.residual(problem, id).0;
                let full = length.map_or(f64::INFINITY, |l| (-residual / (l * l)).max(0.0));
                let (partial, leaving) = self.blocking();
                let t = full.min(partial);
                let consistent = length.is_none() && self.consistent(problem, id);
                if t == f64::INFINITY && !consistent {
                    return Outcome::Infeasible;
                }
                if consistent && (u == 0.0 || t == f64::INFINITY) {
                    // Here n = N r, so the multiplier moves to the active constraints.
                    for (v, r) in self.u.iter_mut().zip(&self.r) {
                        *v += u * r;
                    }
                    self.state[i] = State::SetAside;
                    break;
                }
                self.step(t, length.is_some());
                u += t;
                match length {
                    Some(length) if full <= partial => {
                        self.recall();
                        self.state[i] = State::Active;
                        self.enter(id, u, length);
                        break;
                    }
                    _ => {
                        self.state[self.active[leaving] - equalities] = State::Free;
                        self.leave(leaving);
                    }
                }
            }
        }
        if !self.x.iter().chain(&self.u).all(|v| v.is_finite()) {
            return Outcome::NotConvex;
        }
        let holds = (0..equalities).all(|id| self.consistent(problem, id));
        if holds {
            Outcome::Optimal
        } else {
            Outcome::Infeasible
        }
    }

    /// Forms J = L⁻ᵀ by eliminating H and the identity together; false unless H is positive
    /// definite.
    fn factorise(&mut self, h: &[f64]) -> bool {
        let n = self.n;
        self.factor.copy_from_slice(h);
        self.j.fill(0.0);
        for k in 0..n {
            let (above, below) = self.factor.split_at_mut((k + 1) * n);
            let row = &mut above[k * n + k..];
            let pivot = row[0];
            if !(pivot > 2.0 * n as f64 * f64::EPSILON * h[k * n + k] && pivot.is_finite()) {
                return false;
            }
            let inverse = 1.0 / pivot.sqrt();
            scale(row, inverse);
            let (j_above, j_below) = self.j.split_at_mut((k + 1) * n);
            let j_row = &mut j_above[k * n..k * n + k + 1];
            j_row[k] = 1.0;
            scale(j_row, inverse);
            let rows = below.chunks_exact_mut(n).zip(j_below.chunks_exact_mut(n));
            for (i, (other, j_other)) in rows.enumerate() {
                let l = -row[i + 1];
                add_scaled(&mut other[k + 1 + i..], l, &row[i + 1..]);
                add_scaled(&mut j_other[..=k], l, j_row);
            }
        }
        self.j_norm = norm(&self.j);
        self.j_norm.is_finite()
    }

    /// Sets x to the unconstrained minimiser −J Jᵀ g; false unless it is finite.
    fn start(&mut self, g: &[f64]) -> bool {
        for (i, row) in self.j.chunks_exact(self.n.max(1)).enumerate() {
            let t = dot(&row[..=i], &g[..=i]);
            add_scaled(&mut self.x[..=i], -t, &row[..=i]);
        }
        self.x_scale = norm(&self.x);
        self.x_scale.is_finite()
    }

    /// Inverse lengths of the normals; false if a constraint is not finite or can not hold.
    fn weigh(&mut self, problem: &Problem) -> bool {
        self.weight.clear();
        self.state.clear();
        for (rows, equality) in [(&problem.equalities, true), (&problem.inequalities, false)] {
            for i in 0..rows.len() {
                let (row, rhs) = (rows.row(i), rows.rhs(i));
                let length = norm(row);
                let void = length == 0.0;
                let bounded = rhs < f64::INFINITY && (!equality || rhs > f64::NEG_INFINITY);
                let broken = void && (rhs > 0.0 || (equality && rhs < 0.0));
                if !length.is_finite() || !bounded || broken {
                    return false;
                }
                self.weight.push(if void { 0.0 } else { 1.0 / length });
                if !equality {
                    self.state
                        .push(if void { State::Void } else { State::Free });
                }
            }
        }
        true
    }

    /// Residual and right-hand side of a constraint for its unit normal.
    fn residual(&self, problem: &Problem, id: usize) -> (f64, f64) {
        let (rows, i) = match id.checked_sub(problem.equalities.len()) {
            Some(i) => (&problem.inequalities, i),
            None => (&problem.equalities, id),
        };
        let (rhs, weight) = (rows.rhs(i), self.weight[id]);
        ((dot(rows.row(i), &self.x) - rhs) * weight, rhs * weight)
    }

    /// Whether a constraint that depends on the active ones holds up to rounding.
    fn consistent(&self, problem: &Problem, id: usize) -> bool {
        let (residual, bound) = self.residual(problem, id);
        residual.abs() <= CONSISTENT * (self.x_scale + bound.abs())
    }

    /// Returns the inequalities set aside to the search.
    fn recall(&mut self) {
        for state in self.state.iter_mut().filter(|s| **s == State::SetAside) {
            *state = State::Free;
        }
    }

    fn most_violated(&self, problem: &Problem) -> Option<usize> {
        let mut worst = None;
        let mut least = 0.0;
        for (i, _) in self
            .state
            .iter()
            .enumerate()
            .filter(|(_, s)| **s == State::Free)
        {
            let (residual, bound) = self.residual(problem, problem.equalities.len() + i);
            if residual < least && residual < -SATISFIED * (self.x_scale + bound.abs()) {
                least = residual;
                worst = Some(i);
            }
        }
        worst
    }

    /// d = Jᵀ n.
    fn transform(&mut self, row: &[f64], weight: f64) {
        for (d, j) in self.d.iter_mut().zip(self.j.chunks_exact(self.n.max(1))) {
            *d = weight * dot(j, row);
        }
    }

    /// r = R⁻¹ d₁ and, unless the normal depends on the active ones, z = J₂ d₂ and |d₂|.
    fn direct(&mut self) -> Option<f64> {
        let (n, q) = (self.n, self.active.len());
        let (d1, d2) = self.d.split_at(q);
        self.r[..q].copy_from_slice(d1);
        solve_upper(&self.r_factor, n, &mut self.r[..q]);
        let length = norm(d2);
        let independent = length > DEPENDENT * norm(d1) && length > ROUNDING * self.j_norm;
        if !independent {
            return None;
        }
        self.z.fill(0.0);
        for (d, j) in d2.iter().zip(self.j[q * n..].chunks_exact(n)) {
            add_scaled(&mut self.z, *d, j);
        }
        Some(length)
    }

    /// Longest step that keeps the multipliers of the active inequalities non-negative, and the
    /// position of the one that blocks.
    fn blocking(&self) -> (f64, usize) {
        let q = self.active.len();
        let largest = self.r[..q].iter().fold(1.0_f64, |m, r| m.max(r.abs()));
        let mut first = (f64::INFINITY, q);
        for k in self.active_equalities..q {
            if self.r[k] > ROUNDING * largest {
                let t = self.u[k] / self.r[k];
                if t < first.0 {
                    first = (t, k);
                }
            }
        }
        first
    }

    /// Moves the multipliers by −t r and, if `primal`, x by t z.
    fn step(&mut self, t: f64, primal: bool) {
        add_scaled(&mut self.u, -t, &self.r);
        for u in self.u.iter_mut().skip(self.active_equalities) {
            *u = u.max(0.0);
        }
        if primal {
            add_scaled(&mut self.x, t, &self.z);
            self.x_scale = self.x_scale.max(norm(&self.x));
        }
    }

    /// Adds a constraint: reflects d₂ onto its first element, which joins R.
    fn enter(&mut self, id: usize, u: f64, length: f64) {
        let (n, q) = (self.n, self.active.len());
        let corner = -length.copysign(self.d[q]);
        let column = &mut self.r_factor[q * n..=q * n + q];
        column[..q].copy_from_slice(&self.d[..q]);
        column[q] = corner;
        // The reflection is I − v vᵀ / (length (length + |d|)), v = d₂ − corner e₁, J₂ v = w.
        let divisor = length * (length + self.d[q].abs());
        self.d[q] -= corner;
        let free = &mut self.j[q * n..];
        add_scaled(&mut self.z, -corner, &free[..n]);
        for (v, j) in self.d[q..].iter().zip(free.chunks_exact_mut(n)) {
            add_scaled(j, -v / divisor, &self.z);
        }
        self.active.push(id);
        self.u.push(u);
        self.iterations += 1;
    }

    /// Drops the active constraint at position `k`; rotations restore R and carry d along.
    fn leave(&mut self, k: usize) {
        let (n, q) = (self.n, self.active.len());
        for i in k + 1..q {
            self.r_factor.copy_within(i * n..=i * n + i, (i - 1) * n);
        }
        for i in k..q - 1 {
            let (a, b) = (self.r_factor[i * n + i], self.r_factor[i * n + i + 1]);
            let length = a.hypot(b);
            let (c, s) = (a / length, b / length);
            for column in self.r_factor[i * n..(q - 1) * n].chunks_exact_mut(n) {
                (column[i], column[i + 1]) = rotate(c, s, column[i], column[i + 1]);
            }
            (self.d[i], self.d[i + 1]) = rotate(c, s, self.d[i], self.d[i + 1]);
            let (upper, lower) = self.j[i * n..(i + 2) * n].split_at_mut(n);
            for (a, b) in upper.iter_mut().zip(lower) {
                (*a, *b) = rotate(c, s, *a, *b);
            }
        }
        self.active.remove(k);
        self.u.remove(k);
        self.iterations += 1;
    }

    /// One step of iterative refinement of x and u on the equations of the active set.
    fn refine(&mut self, problem: &Problem) {
        let (n, q) = (self.n, self.active.len());
        let equalities = problem.equalities.len();
        // z = N u − g − H x.
        self.z.fill(0.0);
        add_scaled(&mut self.z, -1.0, &problem.g);
        for (i, h) in problem.h.chunks_exact(n.max(1)).enumerate() {
            self.z[i] -= dot(&h[i..], &self.x[i..]);
            add_scaled(&mut self.z[i + 1..], -self.x[i], &h[i + 1..]);
        }
        for (k, &id) in self.active.iter().enumerate() {
            let row = match id.checked_sub(equalities) {
                Some(i) => problem.inequalities.row(i),
                None => problem.equalities.row(id),
            };
            add_scaled(&mut self.z, self.u[k] * self.weight[id], row);
        }
        // d = Jᵀ z; x gains J [y; d₂] and u gains R⁻¹ (y − d₁), where Rᵀ y = −residuals.
        for (d, j) in self.d.iter_mut().zip(self.j.chunks_exact(n.max(1))) {
            *d = dot(j, &self.z);
        }
        for k in 0..q {
            let residual = self.residual(problem, self.active[k]).0;
            let column = &self.r_factor[k * n..=k * n + k];
            let y = (-residual - dot(&column[..k], &self.z[..k])) / column[k];
            self.z[k] = y;
            self.r[k] = y - self.d[k];
        }
        self.d[..q].copy_from_slice(&self.z[..q]);
        solve_upper(&self.r_factor, n, &mut self.r[..q]);
        add_scaled(&mut self.u, 1.0, &self.r);
        for (d, j) in self.d.iter().zip(self.j.chunks_exact(n.max(1))) {
            add_scaled(&mut self.x, *d, j);
        }
    }
}

/// Solves R r = b in place, R upper triangular by columns of stride `n`.
fn solve_upper(r_factor: &[f64], n: usize, b: &mut [f64]) {
    for k in (0..b.len()).rev() {
        let column = &r_factor[k * n..=k * n + k];
        let (rest, last) = b.split_at_mut(k);
        last[0] /= column[k];
        add_scaled(rest, -last[0], column);
    }
}

fn rotate(c: f64, s: f64, a: f64, b: f64) -> (f64, f64) {
    (c * a + s * b, c * b - s * a)
}

fn scale(a: &mut [f64], s: f64) {
    for a in a {
        *a *= s;
    }
}

/// a += s b over their common length.
fn add_scaled(a: &mut [f64], s: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += s * b;
    }
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Inner product in four partial sums.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}

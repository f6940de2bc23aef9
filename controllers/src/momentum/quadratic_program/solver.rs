//! Dense strictly convex quadratic programs by the dual active-set method of
//! D. Goldfarb and A. Idnani, "A numerically stable dual method for solving strictly convex
//! quadratic programs", Mathematical Programming 27 (1983) 1–33.
//!
//! In: a [`Problem`], minimise ½ xᵀ H x + gᵀ x subject to E x = e and C x ≥ d.
//! Out: an [`Solution`] and, held by the [`ActiveSet`], the minimiser x with multipliers y and
//! u ≥ 0 such that H x + g = Eᵀ y + Cᵀ u and uᵀ (C x − d) = 0.
//!
//! The method starts at the unconstrained minimiser and adds one violated constraint at a time,
//! keeping dual feasibility. With N the active normals (scaled to unit length) and H = L Lᵀ it
//! maintains J = L⁻ᵀ Q and the upper triangle R such that Jᵀ N = [R; 0] (`factor`). A constraint
//! enters by one Householder reflection of the free columns of J and leaves by Givens rotations.

use crate::momentum::quadratic_program::constraints::{Constraints, Membership};
use crate::momentum::quadratic_program::factor::{Factor, ROUNDING, add_scaled, dot, norm};
use crate::momentum::quadratic_program::problem::Problem;

/// Least length of x that tolerances refer to, relative to the largest so far.
const LEAST_SCALE: f64 = 1e-5;

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solution {
    /// The minimiser was found.
    Optimal,
    /// No x satisfies all constraints, or a constraint is not finite.
    Infeasible,
    /// H is not numerically positive definite, or H, g or their sizes are not valid.
    NotConvex,
    /// The bound on the number of steps was reached.
    IterationLimit,
}

/// Workspace of the dual active-set method and its last solution. A solve does not depend on
/// earlier ones.
#[derive(Debug)]
pub struct ActiveSet {
    n: usize,
    factor: Factor,
    x: Vec<f64>,
    /// Largest length of x so far.
    x_scale: f64,
    /// Multipliers of the active constraints, for unit normals.
    u: Vec<f64>,
    /// Active constraints: equality i is i, inequality i is i + number of equalities.
    active: Vec<usize>,
    /// How many of the active constraints are equalities; they come first.
    active_equalities: usize,
    constraints: Constraints,
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
            factor: Factor::new(n),
            x: vec![0.0; n],
            x_scale: 0.0,
            u: Vec::with_capacity(n),
            active: Vec::with_capacity(n),
            active_equalities: 0,
            constraints: Constraints::new(most_equalities, most_inequalities),
            equality_multipliers: Vec::with_capacity(most_equalities),
            inequality_multipliers: Vec::with_capacity(most_inequalities),
            iterations: 0,
        }
    }

    /// The last minimiser; meaningful after [`Solution::Optimal`].
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
    pub fn solve(&mut self, problem: &Problem) -> Solution {
        if !problem.well_formed() {
            return Solution::NotConvex;
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
            let multiplier = u * self.constraints.weight[id];
            match id.checked_sub(equalities) {
                Some(i) => self.inequality_multipliers[i] = multiplier.max(0.0),
                None => self.equality_multipliers[id] = multiplier,
            }
        }
        outcome
    }

    /// Adds violated constraints one at a time until none is left.
    fn search(&mut self, problem: &Problem) -> Solution {
        if !self.factor.factorise(&problem.h) {
            return Solution::NotConvex;
        }
        self.factor.minimise(&problem.g, &mut self.x);
        self.x_scale = norm(&self.x);
        if !self.x_scale.is_finite() {
            return Solution::NotConvex;
        }
        if !self.constraints.weigh(problem) {
            return Solution::Infeasible;
        }
        let equalities = problem.equalities.len();
        for id in 0..equalities {
            let residual = self.residual(problem, id);
            self.transform(problem, id);
            if let Some(length) = self.factor.direct() {
                let t = -residual / (length * length);
                self.step(t, true);
                self.enter(id, t, length);
                self.active_equalities = self.active.len();
            } else if !self.consistent(problem, id) {
                return Solution::Infeasible;
            }
        }
        let limit = 50 + 10 * (self.n + equalities + problem.inequalities.len());
        let mut refined = false;
        loop {
            let (x, scale) = (&self.x, self.x_scale);
            if let Some(i) = self.constraints.most_violated(problem, x, scale) {
                refined = false;
                if let Err(outcome) = self.admit(problem, i, limit) {
                    return outcome;
                }
                continue;
            }
            if refined {
                break;
            }
            self.refine(problem);
            refined = true;
            let scale = norm(&self.x).max(LEAST_SCALE * self.x_scale);
            if scale < 0.1 * self.x_scale {
                // x came from afar: look again with the tolerance of where it is now.
                self.x_scale = scale;
                self.constraints.recall();
            } else {
                break;
            }
        }
        if !self.x.iter().chain(&self.u).all(|v| v.is_finite()) {
            return Solution::NotConvex;
        }
        if (0..equalities).all(|id| self.consistent(problem, id)) {
            Solution::Optimal
        } else {
            Solution::Infeasible
        }
    }

    /// Makes inequality `i` active, dropping those that block it, or sets it aside.
    fn admit(&mut self, problem: &Problem, i: usize, limit: usize) -> Result<(), Solution> {
        let equalities = problem.equalities.len();
        let id = equalities + i;
        self.transform(problem, id);
        let mut u = 0.0;
        loop {
            if self.iterations > limit {
                return Err(Solution::IterationLimit);
            }
            let length = self.factor.direct();
            let residual = self.residual(problem, id);
            let full = length.map_or(f64::INFINITY, |l| (-residual / (l * l)).max(0.0));
            let (partial, leaving) = self.blocking();
            let t = full.min(partial);
            let consistent = length.is_none() && self.consistent(problem, id);
            if t == f64::INFINITY && !consistent {
                return Err(Solution::Infeasible);
            }
            if consistent && (u == 0.0 || t == f64::INFINITY) {
                // Here n = N r, so the multiplier moves to the active constraints.
                for (v, r) in self.u.iter_mut().zip(&self.factor.r) {
                    *v += u * r;
                }
                self.constraints.state[i] = Membership::SetAside;
                return Ok(());
            }
            self.step(t, length.is_some());
            u += t;
            match length {
                Some(length) if full <= partial => {
                    self.constraints.recall();
                    self.constraints.state[i] = Membership::Active;
                    self.enter(id, u, length);
                    return Ok(());
                }
                _ => {
                    self.constraints.state[self.active[leaving] - equalities] = Membership::Free;
                    self.leave(leaving);
                }
            }
        }
    }

    /// Residual of a constraint for its unit normal.
    fn residual(&self, problem: &Problem, id: usize) -> f64 {
        self.constraints.residual(problem, id, &self.x).0
    }

    /// Whether a constraint that depends on the active ones holds up to rounding.
    fn consistent(&self, problem: &Problem, id: usize) -> bool {
        let constraints = &self.constraints;
        constraints.consistent(problem, id, &self.x, self.x_scale)
    }

    /// Takes up a constraint's unit normal.
    fn transform(&mut self, problem: &Problem, id: usize) {
        let row = self.constraints.row(problem, id);
        self.factor.transform(row, self.constraints.weight[id]);
    }

    /// Adds a constraint with its multiplier; `length` is that of its normal's free part.
    fn enter(&mut self, id: usize, u: f64, length: f64) {
        self.factor.enter(length);
        self.active.push(id);
        self.u.push(u);
        self.iterations += 1;
    }

    /// Drops the active constraint at position `k`.
    fn leave(&mut self, k: usize) {
        self.factor.leave(k);
        self.active.remove(k);
        self.u.remove(k);
        self.iterations += 1;
    }

    /// Longest step that keeps the multipliers of the active inequalities non-negative, and the
    /// position of the one that blocks.
    fn blocking(&self) -> (f64, usize) {
        let q = self.active.len();
        let r = &self.factor.r[..q];
        let largest = r.iter().fold(1.0_f64, |m, r| m.max(r.abs()));
        let mut first = (f64::INFINITY, q);
        let steps = self.u.iter().zip(r).enumerate();
        for (k, (u, r)) in steps.skip(self.active_equalities) {
            if *r > ROUNDING * largest && u / r < first.0 {
                first = (u / r, k);
            }
        }
        first
    }

    /// Moves the multipliers by −t r and, if `primal`, x by t z.
    fn step(&mut self, t: f64, primal: bool) {
        add_scaled(&mut self.u, -t, &self.factor.r);
        for u in self.u.iter_mut().skip(self.active_equalities) {
            *u = u.max(0.0);
        }
        if primal {
            add_scaled(&mut self.x, t, &self.factor.z);
            self.x_scale = self.x_scale.max(norm(&self.x));
        }
    }

    /// One step of iterative refinement of x and u on the equations of the active set.
    fn refine(&mut self, problem: &Problem) {
        // z = N u − g − H x.
        let z = &mut self.factor.z;
        z.fill(0.0);
        add_scaled(z, -1.0, &problem.g);
        for (i, h) in problem.h.chunks_exact(self.n.max(1)).enumerate() {
            z[i] -= dot(&h[i..], &self.x[i..]);
            add_scaled(&mut z[i + 1..], -self.x[i], &h[i + 1..]);
        }
        for (k, &id) in self.active.iter().enumerate() {
            let row = self.constraints.row(problem, id);
            add_scaled(z, self.u[k] * self.constraints.weight[id], row);
            self.factor.r[k] = self.constraints.residual(problem, id, &self.x).0;
        }
        self.factor.correct(&mut self.x, &mut self.u);
    }
}

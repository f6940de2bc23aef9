//! The constraints as the search sees them: by number, of unit length, each inequality in a state.
//!
//! problem, x → residuals, the most violated inequality.

use crate::momentum::quadratic_program::factor::{dot, norm};
use crate::momentum::quadratic_program::problem::{Problem, Rows};

/// Relative violation below which an inequality counts as satisfied.
const SATISFIED: f64 = 1e-12;
/// Relative residual below which a constraint that depends on the active ones is consistent.
const CONSISTENT: f64 = 1e-8;

/// How the search treats an inequality.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Membership {
    /// Looked at by the search.
    Free,
    /// Holds as an equation.
    Active,
    /// Dependent on the active constraints and violated by no more than `CONSISTENT`.
    SetAside,
    /// A row of zeros.
    Void,
}

/// Equality i is number i, inequality i is i + the number of equalities.
#[derive(Debug)]
pub(super) struct Constraints {
    equalities: usize,
    /// Inverse lengths of all constraint normals, equalities first.
    pub(super) weight: Vec<f64>,
    /// Of the inequalities.
    pub(super) state: Vec<Membership>,
}

impl Constraints {
    /// Room for at most the given numbers of rows.
    pub(super) fn new(most_equalities: usize, most_inequalities: usize) -> Self {
        Self {
            equalities: 0,
            weight: Vec::with_capacity(most_equalities + most_inequalities),
            state: Vec::with_capacity(most_inequalities),
        }
    }

    /// Inverse lengths of the normals; false if a constraint is not finite or can not hold.
    pub(super) fn weigh(&mut self, problem: &Problem) -> bool {
        self.equalities = problem.equalities.len();
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
                    self.state.push(if void {
                        Membership::Void
                    } else {
                        Membership::Free
                    });
                }
            }
        }
        true
    }

    /// Coefficients of a constraint.
    pub(super) fn row<'a>(&self, problem: &'a Problem, id: usize) -> &'a [f64] {
        let (rows, i) = self.place(problem, id);
        rows.row(i)
    }

    fn place<'a>(&self, problem: &'a Problem, id: usize) -> (&'a Rows, usize) {
        match id.checked_sub(self.equalities) {
            Some(i) => (&problem.inequalities, i),
            None => (&problem.equalities, id),
        }
    }

    /// Residual and right-hand side of a constraint for its unit normal.
    pub(super) fn residual(&self, problem: &Problem, id: usize, x: &[f64]) -> (f64, f64) {
        let (rows, i) = self.place(problem, id);
        let (rhs, weight) = (rows.rhs(i), self.weight[id]);
        ((dot(rows.row(i), x) - rhs) * weight, rhs * weight)
    }

    /// Whether a constraint that depends on the active ones holds up to the rounding of an x of
    /// length `scale`.
    pub(super) fn consistent(&self, problem: &Problem, id: usize, x: &[f64], scale: f64) -> bool {
        let (residual, bound) = self.residual(problem, id, x);
        residual.abs() <= CONSISTENT * (scale + bound.abs())
    }

    /// Returns the inequalities set aside to the search.
    pub(super) fn recall(&mut self) {
        for state in self
            .state
            .iter_mut()
            .filter(|s| **s == Membership::SetAside)
        {
            *state = Membership::Free;
        }
    }

    /// The free inequality that x violates most, if it violates one beyond rounding.
    pub(super) fn most_violated(&self, problem: &Problem, x: &[f64], scale: f64) -> Option<usize> {
        let mut worst = None;
        let mut least = 0.0;
        for (i, _) in self
            .state
            .iter()
            .enumerate()
            .filter(|(_, s)| **s == Membership::Free)
        {
            let (residual, bound) = self.residual(problem, self.equalities + i, x);
            if residual < least && residual < -SATISFIED * (scale + bound.abs()) {
                least = residual;
                worst = Some(i);
            }
        }
        worst
    }
}

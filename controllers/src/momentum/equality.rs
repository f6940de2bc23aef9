//! The equality formulation of momentum control: the 2017 paper's program, then inverse dynamics of
//! the floating base.
//!
//! dynamics, feet's Jacobians, objective → q̈* (6), contact forces that carry the root (9).

use aplomb_framework::sensing::Sensors;
use nalgebra::{Matrix3, Vector3};

use crate::momentum::control::{Momentum, dot};
use crate::momentum::quadratic_program::Solution;
use crate::momentum::reference::Reference;

impl Momentum {
    pub(super) fn solve_equality(&mut self, now: &Sensors, reference: &Reference) -> bool {
        let dof = self.dynamics.dof();
        self.objective(now, reference);
        for f in 0..now.feet.len() {
            if !self.carries(f, now) {
                continue;
            }
            for k in 3 * f..3 * f + 3 {
                let row = self.problem.equalities.push_row(self.feet_target[k]);
                row.copy_from_slice(&self.feet[k * dof..(k + 1) * dof]);
            }
        }
        if now.base_of_support.is_none() || self.solver.solve(&self.problem) != Solution::Optimal {
            return false;
        }
        self.acceleration.copy_from_slice(self.solver.x());
        // (9): the least forces of the touching feet that carry the root: λ = J (JᵀJ)⁻¹ r.
        let mut carried = Vector3::zeros();
        let mut gram = Matrix3::zeros();
        for i in 0..3 {
            let row = &self.dynamics.mass_matrix[i * dof..(i + 1) * dof];
            carried[i] = dot(row, &self.acceleration) + self.dynamics.bias[i];
        }
        let root = |k: usize| {
            Vector3::new(
                self.feet[k * dof],
                self.feet[k * dof + 1],
                self.feet[k * dof + 2],
            )
        };
        let rows = |f: usize| 3 * f..3 * f + 3;
        for f in 0..now.feet.len() {
            if !self.carries(f, now) {
                continue;
            }
            for k in rows(f) {
                gram += root(k) * root(k).transpose();
            }
        }
        let Some(inverse) = gram.try_inverse() else {
            return false;
        };
        let share = inverse * carried;
        for f in 0..now.feet.len() {
            for k in rows(f) {
                let on = self.carries(f, now);
                self.wrench[k] = if on { root(k).dot(&share) } else { 0.0 };
            }
        }
        true
    }
}

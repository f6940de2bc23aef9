//! The inequality formulation of momentum control: one quadratic program over accelerations and
//! contact forces, with contact, torque and range limits as constraints.
//!
//! dynamics, feet's Jacobians, objective → program → q̈*, contact forces. It always has a solution
//! but for the joints' ranges (letting go is one): without them it is solved again if need be.

use aplomb_framework::sensing::{FootContact, Sensors};

use crate::momentum::control::Momentum;
use crate::momentum::quadratic_program::Solution;
use crate::momentum::reference::Reference;

/// Rate at which joints are kept from their range's ends, 1/s.
const RANGE_RATE: f64 = 25.0;
/// m either way that the centre of pressure can move under the end of a tilted sole.
const EDGE: f64 = 0.003;
/// rad from a range's end within which it is a constraint.
const RANGE_NEAR: f64 = 0.3;

impl Momentum {
    pub(super) fn solve_inequality(&mut self, now: &Sensors, reference: &Reference) -> bool {
        let (n, dof) = (self.problem.n, self.dynamics.dof());
        let unit = self.model.total_mass() * now.gravity.max(1.0);
        // Unknowns of a foot: force over the weight, moment over the weight times 0.1 m.
        let scale = [unit, unit, 0.1 * unit];
        self.objective(now, reference);
        for (f, foot) in now.feet.iter().enumerate() {
            for k in 0..3 {
                let i = dof + 3 * f + k;
                self.problem.h[i * n + i] += 1e-3;
                let weight = match (foot.touching(), foot.heel && foot.toe, k) {
                    _ if self.swinging == Some(f) => self.swing_weight,
                    (false, ..) => self.gains.lifted,
                    (true, false, 2) => self.gains.tilted,
                    (true, ..) => self.gains.feet,
                };
                let row = &self.feet[(3 * f + k) * dof..(3 * f + k + 1) * dof];
                self.problem
                    .add_square(row, self.feet_target[3 * f + k], weight);
            }
        }
        for i in 0..3 {
            let row = self.problem.equalities.push_row(-self.dynamics.bias[i]);
            row[..dof].copy_from_slice(&self.dynamics.mass_matrix[i * dof..(i + 1) * dof]);
            for k in 0..self.wrench.len() {
                row[dof + k] = -self.feet[k * dof + i] * scale[k % 3];
            }
        }
        for (f, foot) in now.feet.iter().enumerate() {
            self.contact_rows(f, foot, dof + 3 * f);
        }
        self.torque_rows(scale, now);
        let without_ranges = self.problem.inequalities.len();
        self.range_rows(now);
        if self.solver.solve(&self.problem) != Solution::Optimal {
            // The muscles cannot stop a joint in time: let its range do so.
            self.problem.inequalities.truncate(without_ranges);
            if self.solver.solve(&self.problem) != Solution::Optimal {
                return false;
            }
        }
        let x = self.solver.x();
        self.acceleration.copy_from_slice(&x[..dof]);
        for (k, w) in self.wrench.iter_mut().enumerate() {
            *w = x[dof + k] * scale[k % 3];
        }
        true
    }

    /// Centre of pressure inside what touches, friction cone; no force from what does not touch.
    fn contact_rows(&mut self, f: usize, contact: &FootContact, at: usize) {
        if !contact.touching() || self.swinging == Some(f) {
            for k in 0..3 {
                self.problem.equalities.push_row(0.0)[at + k] = 1.0;
            }
            return;
        }
        let foot = &self.model.feet[f];
        let half = if contact.heel && contact.toe {
            0.5 * (foot.toe[0] - foot.heel[0]) - self.gains.margin
        } else {
            EDGE
        };
        // Moment = (centre of pressure ahead of the pivot) × f_y, in units of 0.1 m.
        let reach = half.max(EDGE) / 0.1;
        let mu = self.gains.friction;
        let rows = &mut self.problem.inequalities;
        for (fx, fy, moment) in [
            (0.0, reach, 1.0),
            (0.0, reach, -1.0),
            (1.0, mu, 0.0),
            (-1.0, mu, 0.0),
        ] {
            let row = rows.push_row(0.0);
            (row[at], row[at + 1], row[at + 2]) = (fx, fy, moment);
        }
    }

    /// u_x within what the muscles can do at the joints' rates, in units of what they can at rest.
    fn torque_rows(&mut self, scale: [f64; 3], now: &Sensors) {
        let dof = self.dynamics.dof();
        for (j, joint) in self.model.joints().enumerate() {
            let unit = self.gains.strength * joint.muscles.strongest();
            let i = j + 3;
            let [least, greatest] = joint.muscles.range(now.state.qdot[i]);
            for (sign, most) in [(1.0, -least), (-1.0, greatest)] {
                let most = self.gains.strength * most;
                let row = self
                    .problem
                    .inequalities
                    .push_row((-most + sign * -self.dynamics.bias[i]) / unit);
                let mass = &self.dynamics.mass_matrix[i * dof..(i + 1) * dof];
                for (r, m) in row.iter_mut().zip(mass) {
                    *r = sign * m / unit;
                }
                for k in 0..self.wrench.len() {
                    row[dof + k] = -sign * self.feet[k * dof + i] * scale[k % 3] / unit;
                }
            }
        }
    }

    /// Joints near the end of their range are slowed down before it: q̈ ≥ −ω² (q − q_min) − 2 ω q̇.
    fn range_rows(&mut self, now: &Sensors) {
        let w = RANGE_RATE;
        for (j, joint) in self.model.joints().enumerate() {
            let (q, v) = (now.state.q[j + 3], now.state.qdot[j + 3]);
            let ends = [(1.0, q - joint.range[0]), (-1.0, joint.range[1] - q)];
            for (sign, gap) in ends.into_iter().filter(|(_, gap)| *gap < RANGE_NEAR) {
                // Bounded, so that a joint beyond its range is not asked for the impossible.
                let least = (-w * w * gap - 2.0 * w * sign * v).min(30.0);
                self.problem.inequalities.push_row(least)[j + 3] = sign;
            }
        }
    }
}

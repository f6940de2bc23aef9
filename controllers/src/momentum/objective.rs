//! What the quadratic program minimises: errors of momentum and of the pose ((1) to (5)).
//!
//! sensors, [`Reference`], dynamics → H, g.

use aplomb_framework::character::wrapped;
use aplomb_framework::sensing::Sensors;

use crate::momentum::control::Momentum;
use crate::momentum::reference::Reference;

/// A lever of half a metre makes angular momentum comparable to linear.
const LEVER: f64 = 0.5;
/// Keeps the programs strictly convex.
const RIDGE: f64 = 1e-6;

impl Momentum {
    /// Adds the weighted momentum and tracking objectives (3), (4), (5) to H and g.
    pub(super) fn objective(&mut self, now: &Sensors, reference: &Reference) {
        let (n, dof) = (self.problem.n, self.dynamics.dof());
        let g = &self.gains;
        let m = self.model.total_mass();
        let desired = self.desired_momentum(now, reference);
        let scales = [1.0 / m, 1.0 / m, 1.0 / (m * LEVER)];
        let betas = [g.linear, g.linear, g.angular];
        self.problem.clear();
        for k in 0..3 {
            let row = &self.dynamics.centroidal_map[k * dof..(k + 1) * dof];
            let target = desired[k] - self.dynamics.centroidal_bias[k];
            let weight = betas[k] * scales[k] * scales[k];
            self.problem.add_square(row, target, weight);
        }
        let mut track = |dof: usize, target: f64, weight: f64| {
            self.problem.h[dof * n + dof] += weight;
            self.problem.g[dof] -= weight * target;
        };
        let s = &now.state;
        let pitch = wrapped(reference.pitch - s.q[2]);
        track(2, g.kt * pitch - g.dt * s.qdot[2], g.tracking * g.root);
        for (j, w) in self.weights.iter().enumerate() {
            let target = g.kt * (reference.pose[j] - s.q[j + 3])
                + g.dt * (reference.rates[j] - s.qdot[j + 3])
                + reference.accelerations[j];
            track(j + 3, target, g.tracking * w);
        }
        for i in 0..n {
            self.problem.h[i * n + i] += RIDGE;
        }
    }

    /// (L̇_des, Ḣ_des) (1), with the centre of pressure of the force clamped to the support.
    fn desired_momentum(&self, now: &Sensors, reference: &Reference) -> [f64; 3] {
        let (g, m) = (&self.gains, self.model.total_mass());
        let (c, v) = (now.com, now.com_velocity);
        let lx = m * (g.kl * (reference.com[0] - c[0]) + g.dl * (reference.com_velocity[0] - v[0]));
        let ly = m
            * (g.kl_height * (reference.com[1] - c[1])
                + g.dl_height * (reference.com_velocity[1] - v[1]));
        let mut h = -g.dh * now.angular_momentum;
        if let Some([rear, front]) = self.carrying_span(now) {
            let fy = (ly + m * now.gravity).max(0.2 * m * now.gravity);
            let height = now.com_height();
            let cop = c[0] - height * lx / fy;
            let (low, high) = (rear + g.margin, front - g.margin);
            let clamped = if low < high {
                cop.clamp(low, high)
            } else {
                0.5 * (rear + front)
            };
            h += (clamped - cop) * fy;
        }
        [lx, ly, h]
    }

    /// Rear and front end of what the carrying feet touch with, world x, m: where the centre of
    /// pressure can be. Shorter than the base of support when a foot stands on its edge.
    fn carrying_span(&self, now: &Sensors) -> Option<[f64; 2]> {
        let carrying = (0..now.feet.len()).filter(|f| self.carries(*f, now));
        let ends = carrying.filter_map(|f| now.feet[f].support);
        ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }
}

//! Generalised coordinates of a planar character.

use crate::character::model::Model;

/// Position and velocity of every degree of freedom, in the model's order:
/// root x, root y (m, the root link's frame origin), root pitch (rad, counter-clockwise), then one
/// angle a joint (rad, child minus parent). Velocities in m/s and rad/s.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions, length `3 + joints`.
    pub q: Vec<f64>,
    /// Velocities, length `3 + joints`.
    pub qdot: Vec<f64>,
}

impl State {
    /// Standing upright at x = 0 with all joints at 0 and the lowest sole point on y = 0.
    #[must_use]
    pub fn standing(model: &Model) -> Self {
        let mut q = vec![0.0; model.dof()];
        q[1] = model.standing_height();
        Self {
            q,
            qdot: vec![0.0; model.dof()],
        }
    }

    /// Joint angles, rad, without the root.
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.q[3..]
    }

    /// Joint velocities, rad/s, without the root.
    #[must_use]
    pub fn rates(&self) -> &[f64] {
        &self.qdot[3..]
    }
}

/// An angle brought into (−π, π].
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let a = angle.rem_euclid(TAU);
    if a > PI { a - TAU } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn wrapping_keeps_the_angle_and_its_half_open_range() {
        assert!((wrapped(3.0 * PI) - PI).abs() < 1e-12);
        assert!((wrapped(-PI) - PI).abs() < 1e-12);
        assert!((wrapped(0.3 - 4.0 * PI) - 0.3).abs() < 1e-12);
    }
}

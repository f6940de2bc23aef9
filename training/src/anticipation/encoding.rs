//! Trajectories as points of the unit cube: half of the coordinates are knots, half control points
//! (2017 paper, section 4.1), or coordinates in a basis.
//!
//! point ↔ [`Cmrt`]; the middle of the cube is the flat trajectory with knots at equal distances, or the
//! basis' mean.

use aplomb_controllers::kinds::cmrt::Cmrt;
use aplomb_framework::character::Model;

use crate::anticipation::basis::Basis;
use crate::anticipation::knots::ordered;

/// Largest displacement that is searched, relative to the standing height of the centre of mass.
const REACH: f64 = 0.12;

/// How points stand for trajectories.
#[derive(Debug, Clone, PartialEq)]
pub enum Encoding {
    /// Knots and control points.
    Full {
        /// How many of each.
        knots: usize,
        /// s
        length: f64,
        /// m at the faces of the cube.
        reach: f64,
    },
    /// Components of a basis.
    Reduced {
        /// Of trajectories like these.
        basis: Basis,
        /// s
        length: f64,
    },
}

impl Encoding {
    /// Knots and control points for a character.
    #[must_use]
    pub fn full(knots: usize, length: f64, model: &Model) -> Self {
        let reach = REACH * model.standing_com()[1];
        Self::Full {
            knots,
            length,
            reach,
        }
    }

    /// The number of coordinates.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Full { knots, .. } => 2 * knots,
            Self::Reduced { basis, .. } => basis.components.len(),
        }
    }

    /// The trajectory at a point: the knots in order, with gaps.
    #[must_use]
    pub fn trajectory(&self, point: &[f64]) -> Cmrt {
        match self {
            Self::Full {
                knots,
                length,
                reach,
            } => {
                let (times, displacements) = point.split_at(*knots);
                let times = times.iter().enumerate().map(|(i, u)| {
                    // The middle of the cube is an equal distance for all; a knot moves by up to
                    // one and a half of it either way.
                    let step = length / (knots + 1) as f64;
                    step * (i as f64 + 1.0 + 3.0 * (u - 0.5))
                });
                let displacements = displacements.iter().map(|u| 2.0 * reach * (u - 0.5));
                ordered(times.zip(displacements).collect(), *length)
            }
            Self::Reduced { basis, length } => basis.trajectory(point, *length),
        }
    }

    /// The point of a trajectory, moved into the cube; none where it has another number of knots.
    #[must_use]
    pub fn point(&self, cmrt: &Cmrt) -> Option<Vec<f64>> {
        match self {
            Self::Full {
                knots,
                length,
                reach,
            } => {
                let step = length / (knots + 1) as f64;
                let time = |(i, t): (usize, &f64)| (t / step - i as f64 - 1.0) / 3.0 + 0.5;
                let times = cmrt.times.iter().enumerate().map(time);
                let displacements = cmrt.displacements.iter().map(|d| d / (2.0 * reach) + 0.5);
                let all = times.chain(displacements).map(|u| u.clamp(0.0, 1.0));
                (cmrt.times.len() == *knots).then(|| all.collect())
            }
            Self::Reduced { basis, .. } => basis.point(cmrt),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn humanoid(knots: usize) -> Encoding {
        Encoding::full(knots, 2.6, &Model::load("humanoid").unwrap())
    }

    #[test]
    fn the_middle_is_flat() {
        for knots in [4, 8] {
            let encoding = humanoid(knots);
            let flat = encoding.trajectory(&vec![0.5; encoding.dimensions()]);
            let expected = Cmrt::flat(2.6, knots);
            assert_eq!(flat.displacements, expected.displacements);
            for (a, b) in flat.times.iter().zip(&expected.times) {
                assert!((a - b).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn any_point_is_a_valid_trajectory_and_an_inner_one_comes_back() {
        let encoding = humanoid(4);
        for corner in 0..256_u32 {
            let bit = |i: usize| f64::from(corner >> i & 1);
            let point: Vec<f64> = (0..8).map(bit).collect();
            encoding.trajectory(&point).validate().unwrap();
        }
        let point = [0.45, 0.55, 0.5, 0.52, 0.3, 0.7, 0.1, 0.5];
        let back = encoding.point(&encoding.trajectory(&point)).unwrap();
        for (a, b) in point.iter().zip(back) {
            assert!((a - b).abs() < 1e-3);
        }
    }
}

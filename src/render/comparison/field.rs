//! The learned probability over two features, between and on its grid points.

use anyhow::{Result, ensure};
use aplomb_training::preconditions::report::Slice;

use super::check_share;

/// A slice whose numbers fit together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<'a> {
    x: &'a [f64],
    y: &'a [f64],
    probability: &'a [Vec<f64>],
}

impl<'a> Field<'a> {
    /// # Errors
    /// Values that do not ascend, rows that are too short or long, probabilities that are none.
    pub(super) fn new(slice: &'a Slice) -> Result<Self> {
        let (x, y) = (&slice.x.1, &slice.y.1);
        for (field, values) in [("slice.x", x), ("slice.y", y)] {
            let ascends = values.windows(2).all(|w| w[0] < w[1]);
            ensure!(
                values.len() >= 2 && ascends && values.iter().all(|v| v.is_finite()),
                "{field} has {} values that may not ascend; accepted: 2 and more that do",
                values.len()
            );
        }
        let probability = &slice.probability;
        ensure!(
            probability.len() == y.len(),
            "slice.probability has {} rows; accepted: one for each of the {} values of slice.y",
            probability.len(),
            y.len()
        );
        for row in probability {
            ensure!(
                row.len() == x.len(),
                "slice.probability has a row of {} values; accepted: one for each of the {} values of slice.x",
                row.len(),
                x.len()
            );
            for p in row {
                check_share("slice.probability", *p)?;
            }
        }
        Ok(Self { x, y, probability })
    }

    /// First and last value along x and y.
    pub(super) fn spans(&self) -> [[f64; 2]; 2] {
        [self.x, self.y].map(|v| [v[0], v[v.len() - 1]])
    }

    /// Between the grid points, linear in both directions.
    pub(super) fn at(&self, x: f64, y: f64) -> f64 {
        let ((i, u), (j, v)) = (place(self.x, x), place(self.y, y));
        let row = |j: usize| {
            let row = &self.probability[j];
            row[i] + u * (row[i + 1] - row[i])
        };
        row(j) + v * (row(j + 1) - row(j))
    }

    /// Pieces of the line where the probability has this level (marching squares).
    pub(super) fn contour(&self, level: f64) -> Vec<[[f64; 2]; 2]> {
        let mut pieces = Vec::new();
        for j in 0..self.y.len() - 1 {
            for i in 0..self.x.len() - 1 {
                let corner = |di: usize, dj: usize| {
                    let at = [self.x[i + di], self.y[j + dj]];
                    (at, self.probability[j + dj][i + di] - level)
                };
                let ring = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                let edges = (0..4).filter_map(|k| crossing(ring[k], ring[(k + 1) % 4]));
                let crossings: Vec<_> = edges.collect();
                match crossings[..] {
                    [a, b] => pieces.push([a, b]),
                    [a, b, c, d] => {
                        // A saddle: its middle tells which corners hang together.
                        let middle: f64 = ring.iter().map(|(_, p)| p).sum();
                        if (middle >= 0.0) == (ring[0].1 >= 0.0) {
                            pieces.extend([[a, b], [c, d]]);
                        } else {
                            pieces.extend([[a, d], [b, c]]);
                        }
                    }
                    _ => {}
                }
            }
        }
        pieces
    }
}

/// The cell in which a value lies, and how far through it in 0 to 1.
fn place(values: &[f64], value: f64) -> (usize, f64) {
    let after = values.partition_point(|v| *v <= value);
    let cell = after.clamp(1, values.len() - 1) - 1;
    let part = (value - values[cell]) / (values[cell + 1] - values[cell]);
    (cell, part.clamp(0.0, 1.0))
}

/// Where the excess over the level changes its sign between two corners.
fn crossing((a, p): ([f64; 2], f64), (b, q): ([f64; 2], f64)) -> Option<[f64; 2]> {
    if (p >= 0.0) == (q >= 0.0) {
        return None;
    }
    let part = p / (p - q);
    Some([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slice(probability: [[f64; 3]; 2]) -> Slice {
        Slice {
            x: ("com_offset".into(), vec![0.0, 1.0, 3.0]),
            y: ("com_velocity_x".into(), vec![-1.0, 1.0]),
            probability: probability.map(|row| row.to_vec()).to_vec(),
            samples: vec![],
        }
    }

    #[test]
    fn values_between_the_grid_points_are_linear() {
        let slice = slice([[0.0, 1.0, 0.0], [0.0, 1.0, 1.0]]);
        let field = Field::new(&slice).unwrap();
        assert_eq!(field.at(0.5, -1.0), 0.5);
        assert_eq!(field.at(2.0, 0.0), 0.75);
        assert_eq!(field.at(9.0, 9.0), 1.0);
        assert_eq!(field.spans(), [[0.0, 3.0], [-1.0, 1.0]]);
    }

    #[test]
    fn the_contour_passes_between_the_grid_points() {
        let slice = slice([[0.0, 1.0, 1.0], [0.0, 1.0, 1.0]]);
        let contour = Field::new(&slice).unwrap().contour(0.5);
        assert_eq!(contour, [[[0.5, -1.0], [0.5, 1.0]]]);
    }

    #[test]
    fn a_saddle_has_two_pieces() {
        let slice = slice([[0.9, 0.0, 0.0], [0.0, 0.9, 0.0]]);
        let contour = Field::new(&slice).unwrap().contour(0.5);
        assert_eq!(contour.len(), 3);
    }

    #[test]
    fn numbers_that_do_not_fit_together_are_refused() {
        let refused = |spoil: fn(&mut Slice)| {
            let mut slice = slice([[0.0; 3]; 2]);
            spoil(&mut slice);
            Field::new(&slice).unwrap_err().to_string()
        };
        assert!(refused(|s| s.x.1[1] = 0.0).starts_with("slice.x has 3"));
        assert!(refused(|s| s.y.1.truncate(1)).starts_with("slice.y has 1"));
        assert!(refused(|s| s.probability.truncate(1)).contains("1 rows"));
        assert!(refused(|s| s.probability[1].push(0.0)).contains("row of 4"));
        assert!(refused(|s| s.probability[0][0] = 1.5).contains("is 1.5"));
    }
}

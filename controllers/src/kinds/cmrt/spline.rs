//! The curve of a centre-of-mass reference trajectory: a cubic spline through its control points that
//! begins and ends at zero with zero slope (2017 paper, section 4).
//!
//! knots, displacements, length → [`Spline`] → displacement and velocity at a time, without
//! allocating. The curvature is continuous: the slopes at the knots solve a tridiagonal system.

use crate::kinds::cmrt::trajectory::{Cmrt, MOST_KNOTS};

/// Knots with the two ends.
const POINTS: usize = MOST_KNOTS + 2;

/// A cubic spline in Hermite form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spline {
    times: [f64; POINTS],
    values: [f64; POINTS],
    slopes: [f64; POINTS],
    points: usize,
}

impl Spline {
    /// The curve of a trajectory whose knots are in order, at least one and at most
    /// [`MOST_KNOTS`].
    #[must_use]
    pub fn new(cmrt: &Cmrt) -> Self {
        let points = cmrt.times.len().min(MOST_KNOTS) + 2;
        let mut spline = Self {
            times: [cmrt.length; POINTS],
            values: [0.0; POINTS],
            slopes: [0.0; POINTS],
            points,
        };
        spline.times[0] = 0.0;
        for (i, (t, d)) in cmrt.times.iter().zip(&cmrt.displacements).enumerate() {
            if i < MOST_KNOTS {
                (spline.times[i + 1], spline.values[i + 1]) = (*t, *d);
            }
        }
        spline.solve_slopes();
        spline
    }

    /// m_{i−1}/h_{i−1} + 2 (1/h_{i−1} + 1/h_i) m_i + m_{i+1}/h_i = 3 (Δ_{i−1}/h_{i−1} + Δ_i/h_i), where Δ
    /// is the slope of the chord; the slopes at both ends are 0.
    fn solve_slopes(&mut self) {
        let (t, y) = (&self.times, &self.values);
        let inverse = |i: usize| 1.0 / (t[i + 1] - t[i]);
        let (mut upper, mut right) = ([0.0; POINTS], [0.0; POINTS]);
        for i in 1..self.points - 1 {
            let (a, b) = (inverse(i - 1), inverse(i));
            let target = 3.0 * ((y[i] - y[i - 1]) * a * a + (y[i + 1] - y[i]) * b * b);
            let pivot = 2.0 * (a + b) - a * upper[i - 1];
            upper[i] = b / pivot;
            right[i] = (target - a * right[i - 1]) / pivot;
        }
        for i in (1..self.points - 1).rev() {
            self.slopes[i] = right[i] - upper[i] * self.slopes[i + 1];
        }
    }

    /// (displacement m, its velocity m/s) at `time` s after the beginning; zero before the beginning
    /// and after the end.
    #[must_use]
    pub fn at(&self, time: f64) -> (f64, f64) {
        let last = self.points - 1;
        if !(time > 0.0 && time < self.times[last]) {
            return (0.0, 0.0);
        }
        let mut i = 0;
        while self.times[i + 1] <= time {
            i += 1;
        }
        let h = self.times[i + 1] - self.times[i];
        let u = (time - self.times[i]) / h;
        let (y0, y1) = (self.values[i], self.values[i + 1]);
        let (m0, m1) = (h * self.slopes[i], h * self.slopes[i + 1]);
        // y0 + u m0 + u² (3 (y1 − y0) − 2 m0 − m1) + u³ (2 (y0 − y1) + m0 + m1)
        let (b, c) = (3.0 * (y1 - y0) - 2.0 * m0 - m1, 2.0 * (y0 - y1) + m0 + m1);
        let value = y0 + u * (m0 + u * (b + u * c));
        let slope = (m0 + u * (2.0 * b + u * 3.0 * c)) / h;
        (value, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(times: &[f64], displacements: &[f64], length: f64) -> Spline {
        Spline::new(&Cmrt {
            length,
            times: times.to_vec(),
            displacements: displacements.to_vec(),
            ..Cmrt::default()
        })
    }

    #[test]
    fn goes_through_its_points_and_rests_at_both_ends() {
        let (times, values) = ([0.4, 0.9, 1.3, 2.0], [0.1, -0.2, 0.05, 0.02]);
        let s = spline(&times, &values, 2.6);
        for (t, y) in times.into_iter().zip(values) {
            assert!((s.at(t).0 - y).abs() < 1e-12, "{t}");
        }
        for t in [-1.0, 0.0, 2.6, 9.0, f64::NAN] {
            assert_eq!(s.at(t), (0.0, 0.0), "{t}");
        }
        let (value, slope) = s.at(1e-6);
        assert!(value.abs() < 1e-9 && slope.abs() < 1e-5);
    }

    #[test]
    fn value_slope_and_curvature_are_continuous() {
        let s = spline(&[0.4, 0.9, 1.3, 2.0], &[0.1, -0.2, 0.05, 0.02], 2.6);
        let e = 1e-5;
        for t in [0.4, 0.9, 1.3, 2.0] {
            let (before, after) = (s.at(t - e), s.at(t + e));
            assert!((after.0 - before.0).abs() < 1e-4);
            assert!((after.1 - before.1).abs() < 1e-3);
            let curvature = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / e;
            let left = curvature(s.at(t - 2.0 * e), before);
            let right = curvature(after, s.at(t + 2.0 * e));
            assert!((left - right).abs() < 1e-2, "{t}: {left} {right}");
        }
        // The slope is the derivative of the value.
        let t = 1.1;
        let numeric = (s.at(t + e).0 - s.at(t - e).0) / (2.0 * e);
        assert!((numeric - s.at(t).1).abs() < 1e-6);
    }

    #[test]
    fn one_point_in_the_middle_is_the_symmetric_bump() {
        // y = d (3 u² − 2 u³) on the way up.
        let s = spline(&[1.0], &[0.2], 2.0);
        assert!((s.at(0.5).0 - 0.1).abs() < 1e-12);
        assert!((s.at(0.25).0 - s.at(1.75).0).abs() < 1e-12);
    }
}

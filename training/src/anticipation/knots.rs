//! Knots in the order of time, apart from each other, with as many digits as a file has.
//!
//! (time, displacement) → [`Cmrt`].

use aplomb_controllers::kinds::cmrt::{Cmrt, LEAST_GAP};

/// Digits after the point of knots (s) and control points (m): what is tried is what a file says.
const DIGITS: f64 = 1e4;

/// The trajectory through (time, displacement) in the order of time, pushed apart to the least gap
/// inside the length, and rounded.
pub(super) fn ordered(mut knots: Vec<(f64, f64)>, length: f64) -> Cmrt {
    knots.sort_by(|a, b| a.0.total_cmp(&b.0));
    let gap = LEAST_GAP * length + 2.0 / DIGITS;
    let mut least = gap;
    for knot in &mut knots {
        knot.0 = knot.0.max(least);
        least = knot.0 + gap;
    }
    let mut most = length - gap;
    for knot in knots.iter_mut().rev() {
        knot.0 = knot.0.min(most);
        most = knot.0 - gap;
    }
    let rounded = |x: f64| (x * DIGITS).round() / DIGITS;
    let knots = knots.into_iter().map(|(t, d)| (rounded(t), rounded(d)));
    let (times, displacements) = knots.unzip();
    Cmrt {
        value: 0.0,
        length,
        times,
        displacements,
    }
}

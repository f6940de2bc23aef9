//! Sets with a known boundary, for tests.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::dataset::Dataset;

/// `count` samples of `width` features: successes within a ball that holds about half of them, a
/// twentieth of the labels near its face drawn at random.
pub(super) fn rings(count: usize, width: usize, seed: u64) -> Dataset {
    drawn(count, width, seed, |row, rng| {
        let near = (mean_square(row) - 1.0).abs() < 0.1;
        let flip = near && rng.gen_bool(0.3);
        is_inside(row) != flip
    })
}

/// The same with successes on one side of a plane through 0, the same share of all features.
pub(super) fn halves(count: usize, width: usize, seed: u64) -> Dataset {
    drawn(count, width, seed, |row, _| row.iter().sum::<f64>() > 0.0)
}

/// Whether a row lies within the ball of [`rings`].
pub(super) fn is_inside(row: &[f64]) -> bool {
    mean_square(row) < 1.0
}

fn mean_square(row: &[f64]) -> f64 {
    row.iter().map(|v| v * v).sum::<f64>() / row.len() as f64
}

/// Rows of features with mean 0 and standard deviation 1 each, and what becomes of them.
fn drawn(
    count: usize,
    width: usize,
    seed: u64,
    succeeds: impl Fn(&[f64], &mut ChaCha8Rng) -> bool,
) -> Dataset {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut set = Dataset {
        features: (0..width).map(|i| format!("f{i}")).collect(),
        ..Dataset::default()
    };
    for _ in 0..count {
        let draw = |_| rng.gen_range(-1.0..1.0) * 3.0_f64.sqrt();
        let row: Vec<f64> = (0..width).map(draw).collect();
        set.success.push(succeeds(&row, &mut rng));
        set.rows.push(row);
    }
    set
}

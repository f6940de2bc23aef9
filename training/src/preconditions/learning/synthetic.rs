//! Sets with a known boundary, for tests.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::dataset::Dataset;

/// `count` samples of `width` features: successes within a ball that holds about half of them, a
/// twentieth of the labels near its face drawn at random.
pub(super) fn rings(count: usize, width: usize, seed: u64) -> Dataset {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut set = Dataset {
        features: (0..width).map(|i| format!("f{i}")).collect(),
        ..Dataset::default()
    };
    for _ in 0..count {
        // Mean 0, standard deviation 1 each.
        let draw = |_| rng.gen_range(-1.0..1.0) * 3.0_f64.sqrt();
        let row: Vec<f64> = (0..width).map(draw).collect();
        let square = row.iter().map(|v| v * v).sum::<f64>() / width as f64;
        let near = (square - 1.0).abs() < 0.1;
        let flip = near && rng.gen_bool(0.3);
        set.success.push((square < 1.0) != flip);
        set.rows.push(row);
    }
    set
}

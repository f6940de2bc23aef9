//! What sums up numbers of many trials or tests.
//!
//! values → median, percentiles; hits of so many → interval of the share.

/// In ascending order.
pub(super) fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The middle value, or the mean of the two in the middle.
pub(super) fn median(values: &[f64]) -> Option<f64> {
    let sorted = sorted(values);
    let half = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n.is_multiple_of(2) => Some(0.5 * (sorted[half - 1] + sorted[half])),
        _ => Some(sorted[half]),
    }
}

/// The smallest value that so many of a hundred do not exceed.
pub(super) fn percentile(values: &[f64], percent: usize) -> Option<f64> {
    let rank = (percent * values.len()).div_ceil(100);
    Some(sorted(values)[rank.checked_sub(1)?])
}

/// The 95 % interval of a share (Wilson 1927); everything if there were no trials.
pub(super) fn wilson(hits: u64, count: u64) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    if count == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (count as f64, hits as f64 / count as f64);
    let middle = p + Z * Z / (2.0 * n);
    let spread = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + Z * Z / n;
    // Exact at the ends, where rounding would leave the share outside of its interval.
    let low = if hits == 0 { 0.0 } else { middle - spread };
    let high = if hits == count {
        scale
    } else {
        middle + spread
    };
    [low / scale, high / scale]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_gives_the_published_interval() {
        // Newcombe (1998), table I: 81 of 263.
        let [low, high] = wilson(81, 263);
        assert!((low - 0.2553).abs() < 1e-4 && (high - 0.3662).abs() < 1e-4);
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
        assert_eq!((wilson(0, 10)[0], wilson(10, 10)[1]), (0.0, 1.0));
    }

    #[test]
    fn the_median_of_an_even_number_is_the_mean_of_two() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
    }

    #[test]
    fn so_many_of_a_hundred_do_not_exceed_the_percentile() {
        assert_eq!(percentile(&[], 90), None);
        assert_eq!(percentile(&[7.0], 90), Some(7.0));
        let ten: Vec<f64> = (1..=10).rev().map(f64::from).collect();
        assert_eq!(percentile(&ten, 90), Some(9.0));
        assert_eq!(percentile(&ten, 95), Some(10.0));
        let eleven: Vec<f64> = (1..=11).map(f64::from).collect();
        assert_eq!(percentile(&eleven, 90), Some(10.0));
    }
}

//! The learned probability where the centre of mass and its velocity make the difference.
//!
//! pre-condition, training set, test set → [`Slice`], if the features allow one.

use super::dataset::Dataset;
use super::learned::LearnedPrecondition;
use crate::preconditions::report::Slice;

/// Values along each axis.
const POINTS: usize = 41;
/// The most test samples beside it.
const SAMPLES: usize = 500;
/// Features along x, the first that there is.
const ACROSS: [&str; 2] = ["com_from_feet", "com_offset"];
/// Feature along y.
const UP: &str = "com_velocity_x";

/// The slice between the 1st and 99th percentile of both features, all others at their median, all of
/// the training set; none if a feature is missing or does not vary. With the first 500 test samples.
#[must_use]
pub fn slice(learned: &LearnedPrecondition, train: &Dataset, test: &Dataset) -> Option<Slice> {
    let column = |name: &str| learned.features.iter().position(|f| f == name);
    let across = ACROSS.into_iter().find_map(column)?;
    let up = column(UP)?;
    let sorted = |column: usize| {
        let mut values: Vec<f64> = train.rows.iter().map(|row| row[column]).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let axis = |column: usize| {
        let values = sorted(column);
        let (low, high) = (percentile(&values, 0.01)?, percentile(&values, 0.99)?);
        let value = |i: usize| low + (high - low) * i as f64 / (POINTS - 1) as f64;
        (high > low).then(|| (0..POINTS).map(value).collect::<Vec<f64>>())
    };
    let (x, y) = (axis(across)?, axis(up)?);
    let columns = 0..learned.features.len();
    let mut row: Vec<f64> = columns
        .map(|column| percentile(&sorted(column), 0.5))
        .collect::<Option<_>>()?;
    let mut probability = Vec::with_capacity(POINTS);
    for value in &y {
        row[up] = *value;
        let mut along = Vec::with_capacity(POINTS);
        for value in &x {
            row[across] = *value;
            along.push(learned.probability(learned.score(&row)));
        }
        probability.push(along);
    }
    let samples = test.rows.iter().zip(&test.success).take(SAMPLES);
    Some(Slice {
        x: (learned.features[across].clone(), x),
        y: (UP.to_owned(), y),
        probability,
        samples: samples
            .map(|(row, success)| (row[across], row[up], *success))
            .collect(),
    })
}

/// Of sorted values, between the two nearest.
fn percentile(sorted: &[f64], part: f64) -> Option<f64> {
    let place = part * sorted.len().checked_sub(1)? as f64;
    let below = sorted[place.floor() as usize];
    let above = sorted[place.ceil() as usize];
    Some(below + (above - below) * place.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_by_hand() {
        assert_eq!(percentile(&[1.0, 2.0, 4.0], 0.5), Some(2.0));
        assert_eq!(percentile(&[1.0, 2.0, 4.0, 8.0], 0.5), Some(3.0));
        assert_eq!(percentile(&[7.0], 0.99), Some(7.0));
        assert_eq!(percentile(&[], 0.5), None);
    }
}

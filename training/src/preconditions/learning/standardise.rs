//! Features brought to mean 0 and standard deviation 1, as kernels and distances need them.
//!
//! training rows → [`Scaling`]; row → standardised row.
use aplomb_framework::math::square;

/// Mean and scale of every column of a training set.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scaling {
    /// Means, in the features' units.
    pub mean: Vec<f64>,
    /// Standard deviations, in the features' units; 1 for a column that is constant.
    pub scale: Vec<f64>,
}

impl Scaling {
    /// That of these rows, all of one length. Without rows it is empty.
    #[must_use]
    pub fn of(rows: &[Vec<f64>]) -> Self {
        let columns = rows.first().map_or(0, Vec::len);
        let count = rows.len() as f64;
        let average =
            |value: &dyn Fn(&Vec<f64>) -> f64| rows.iter().map(value).sum::<f64>() / count;
        let mut scaling = Self::default();
        for column in 0..columns {
            let mean = average(&|row| row[column]);
            let deviation = average(&|row| square(row[column] - mean)).sqrt();
            // Summation leaves a constant column a deviation of some roundings.
            let constant = deviation <= 1e-12 * mean.abs() || !deviation.is_normal();
            scaling.mean.push(mean);
            scaling.scale.push(if constant { 1.0 } else { deviation });
        }
        scaling
    }

    /// A row in standard deviations from the mean.
    #[must_use]
    pub fn apply(&self, row: &[f64]) -> Vec<f64> {
        let statistics = self.mean.iter().zip(&self.scale);
        row.iter()
            .zip(statistics)
            .map(|(value, (mean, scale))| (value - mean) / scale)
            .collect()
    }

    /// All rows.
    #[must_use]
    pub fn apply_all(&self, rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
        rows.iter().map(|row| self.apply(row)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_scale_by_hand_and_a_constant_column() {
        let rows = vec![vec![1.0, 0.1], vec![3.0, 0.1], vec![5.0, 0.1]];
        let scaling = Scaling::of(&rows);
        assert_eq!(scaling.mean[0], 3.0);
        assert!((scaling.scale[0] - (8.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(scaling.scale[1], 1.0);
        let z = scaling.apply_all(&rows);
        assert!((z[2][0] - 2.0 / (8.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!(z.iter().all(|row| row[1].abs() < 1e-15));
        assert_eq!(Scaling::of(&[]), Scaling::default());
    }
}

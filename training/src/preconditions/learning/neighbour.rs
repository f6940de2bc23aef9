//! The baseline: a situation ends like the most similar one of the training set.
//!
//! By linear search, which beats linfa-nn's trees from some ten features on.

use aplomb_framework::input::{Error, Result};
use linfa_nn::distance::L2Dist;
use linfa_nn::{LinearSearch, NearestNeighbour};
use ndarray::{Array2, ArrayView1};
use rayon::prelude::*;

/// The training set to search.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbours {
    rows: Array2<f64>,
    labels: Vec<bool>,
}

impl Neighbours {
    /// Of standardised rows and their labels.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are none, they differ in length, or one is not finite.
    pub fn new(rows: &[Vec<f64>], labels: &[bool]) -> Result<Self> {
        let width = rows.first().map_or(0, Vec::len);
        check("training set", rows, width)?;
        if rows.len() != labels.len() || width == 0 {
            let found = format!("{} for {} rows", labels.len(), rows.len());
            let accepted = "one for every row of at least one feature";
            return Err(Error::invalid("training set", "labels", found, accepted));
        }
        let values = rows.iter().flatten().copied().collect();
        let rows = Array2::from_shape_vec((rows.len(), width), values);
        let rows = rows.map_err(|e| refused(&e.to_string()))?;
        Ok(Self {
            rows,
            labels: labels.to_vec(),
        })
    }

    /// Labels of the nearest training rows, by Euclidean distance; in parallel.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a row has another length than the training rows or is not finite.
    pub fn predict(&self, rows: &[Vec<f64>]) -> Result<Vec<bool>> {
        check("test set", rows, self.rows.ncols())?;
        let index = LinearSearch::new().from_batch(&self.rows, L2Dist);
        let index = index.map_err(|e| refused(&e.to_string()))?;
        let nearest = |row: &Vec<f64>| {
            let found = index.k_nearest(ArrayView1::from(row), 1);
            let found = found.map_err(|e| refused(&e.to_string()))?;
            Ok(found.first().is_some_and(|(_, i)| self.labels[*i]))
        };
        rows.par_iter().map(nearest).collect()
    }
}

fn refused(reason: &str) -> Error {
    let accepted = "rows of one length that linfa-nn takes";
    Error::invalid("nearest neighbour", "rows", reason, accepted)
}

fn check(place: &str, rows: &[Vec<f64>], width: usize) -> Result<()> {
    let sound = |row: &Vec<f64>| row.len() == width && row.iter().all(|v| v.is_finite());
    match rows.iter().position(|row| !sound(row)) {
        None => Ok(()),
        Some(i) => {
            let accepted = format!("{width} finite numbers");
            let place = format!("{place}, sample {i}");
            Err(Error::invalid(place, "row", "another", accepted))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_decides() {
        let rows = vec![vec![0.0, 0.0], vec![1.0, 0.0], vec![0.0, 3.0]];
        let neighbours = Neighbours::new(&rows, &[true, false, true]).unwrap();
        let queries = vec![vec![0.4, 0.0], vec![0.6, 0.1], vec![0.6, 2.0]];
        assert_eq!(neighbours.predict(&queries).unwrap(), [true, false, true]);
        assert_eq!(neighbours.predict(&rows).unwrap(), [true, false, true]);
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let bad = vec![vec![0.0], vec![f64::NAN]];
        let told = Neighbours::new(&bad, &[true, false]).unwrap_err();
        assert!(told.to_string().contains("sample 1: row"), "{told}");
        let neighbours = Neighbours::new(&[vec![0.0]], &[true]).unwrap();
        assert!(neighbours.predict(&bad).is_err());
        assert!(neighbours.predict(&[vec![0.0, 1.0]]).is_err());
        assert!(Neighbours::new(&[], &[]).is_err());
    }
}

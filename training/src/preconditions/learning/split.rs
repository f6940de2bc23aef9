//! A training set and a test set that can be told apart and compared.

use std::collections::HashSet;

use aplomb_framework::input::{Error, Result};

use super::dataset::Dataset;

/// Refuses sets of which a boundary could not be learned or its worth not be told.
///
/// # Errors
/// [`Error::Invalid`] if the columns differ, a set lacks two samples of a class or has values that
/// are not finite, or a row of features of the test set occurs in the training set too.
pub fn check(train: &Dataset, test: &Dataset) -> Result<()> {
    train.check("training set")?;
    test.check("test set")?;
    if train.features != test.features {
        let found = test.features.join(",");
        let accepted = format!("{}, as in the training set", train.features.join(","));
        return Err(Error::invalid("test set:1", "columns", found, accepted));
    }
    let known: HashSet<Vec<u64>> = train.rows.iter().map(|row| bits(row)).collect();
    match test.rows.iter().position(|row| known.contains(&bits(row))) {
        None => Ok(()),
        Some(i) => {
            let place = format!("test set:{}", i + 2);
            let accepted = "rows that do not occur in the training set: it would be tested on what \
                            it has seen";
            Err(Error::invalid(place, "row", "in both sets", accepted))
        }
    }
}

/// Equal for rows that are equal, -0 and 0 alike.
fn bits(row: &[f64]) -> Vec<u64> {
    row.iter().map(|value| (value + 0.0).to_bits()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preconditions::learning::synthetic::rings;

    #[test]
    fn sets_that_cannot_be_compared_are_refused() {
        let (train, good) = (rings(50, 3, 1), rings(50, 3, 2));
        let told = |test: &Dataset| check(&train, test).unwrap_err().to_string();
        assert!(check(&train, &good).is_ok());
        let mut test = good.clone();
        test.features.swap(0, 1);
        let found = told(&test);
        assert!(
            found.contains("columns is f1,f0,f2; accepted: f0,f1,f2"),
            "{found}"
        );
        let mut test = good.clone();
        test.success.fill(false);
        let found = told(&test);
        assert!(
            found.contains("test set: success is 0 times 1 and 50"),
            "{found}"
        );
        let mut test = good.clone();
        test.rows[4] = train.rows[9].clone();
        let found = told(&test);
        assert!(found.contains("test set:6: row is in both sets"), "{found}");
        assert_eq!(bits(&[0.0]), bits(&[-0.0]));
    }
}

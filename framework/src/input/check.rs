//! Bounds of numbers and lists: the one place where they are checked and their messages are made.
//!
//! field, value, what is accepted → nothing, or an [`Error`] whose path begins at the field. Those
//! who hold the field add the way to it ([`Error::inside`]); who holds the file, the place
//! ([`Source::locate`](crate::input::Source::locate)). What is not a number lies in no bounds.

use std::fmt;
use std::ops::RangeInclusive;

use crate::input::error::{Error, Result};
use crate::input::path::FieldPath;

/// A number between two bounds, which are accepted themselves.
///
/// # Errors
/// [`Error::Invalid`] with both.
pub fn within(
    field: impl Into<FieldPath>,
    value: f64,
    accepted: RangeInclusive<f64>,
) -> Result<()> {
    if accepted.contains(&value) {
        return Ok(());
    }
    let accepted = format!("{} to {}", accepted.start(), accepted.end());
    Err(Error::refused(field, value, accepted))
}

/// A number above `low`, which is not accepted itself, and at most `high`.
///
/// # Errors
/// [`Error::Invalid`] with both.
pub fn above(field: impl Into<FieldPath>, value: f64, low: f64, high: f64) -> Result<()> {
    if value > low && value <= high {
        return Ok(());
    }
    let accepted = if high.is_infinite() {
        format!("above {low}")
    } else {
        format!("above {low}, at most {high}")
    };
    Err(Error::refused(field, value, accepted))
}

/// A finite number.
///
/// # Errors
/// [`Error::Invalid`].
pub fn finite(field: impl Into<FieldPath>, value: f64) -> Result<()> {
    if value.is_finite() {
        return Ok(());
    }
    Err(Error::refused(field, value, "a finite number"))
}

/// A list of finite numbers.
///
/// # Errors
/// [`Error::Invalid`] of the first that is none.
pub fn all_finite(values: &[f64]) -> Result<()> {
    let mut places = values.iter().enumerate();
    places.try_for_each(|(i, value)| finite(i, *value))
}

/// Coordinates of at most `most` either way.
///
/// # Errors
/// [`Error::Invalid`] of the first that is further.
pub fn point(coordinates: [f64; 2], most: f64) -> Result<()> {
    let mut places = coordinates.into_iter().enumerate();
    places.try_for_each(|(i, value)| within(i, value, -most..=most))
}

/// How many entries a list has; `what` they are.
///
/// # Errors
/// [`Error::Invalid`] of the list.
pub fn count(
    field: impl Into<FieldPath>,
    found: usize,
    accepted: RangeInclusive<usize>,
    what: impl fmt::Display,
) -> Result<()> {
    if accepted.contains(&found) {
        return Ok(());
    }
    let accepted = match accepted.into_inner() {
        (0, most) => format!("at most {most} {what}"),
        (least, most) if least == most => format!("{most} {what}"),
        (least, most) => format!("{least} to {most} {what}"),
    };
    Err(Error::refused(
        field,
        format!("a list of {found}"),
        accepted,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(result: Result<()>, message: Option<&str>) {
        let found = result.err().map(|e| e.to_string());
        assert_eq!(found.as_deref(), message);
    }

    #[test]
    fn bounds_are_inclusive_and_hold_no_nan() {
        check(within("a", 1.0, 0.0..=1.0), None);
        check(
            within("a", 1.5, 0.0..=1.0),
            Some("a is 1.5; accepted: 0 to 1"),
        );
        check(
            within("a.b", f64::NAN, 0.0..=1.0),
            Some("a.b is NaN; accepted: 0 to 1"),
        );
        check(
            above("a", 0.0, 0.0, 9.0),
            Some("a is 0; accepted: above 0, at most 9"),
        );
        check(
            above("a", f64::NAN, 0.0, f64::INFINITY),
            Some("a is NaN; accepted: above 0"),
        );
        check(
            finite("a", f64::INFINITY),
            Some("a is inf; accepted: a finite number"),
        );
    }

    #[test]
    fn of_several_the_one_that_is_refused_is_told() {
        check(
            point([1.0, -3.0], 2.0),
            Some("[1] is -3; accepted: -2 to 2"),
        );
        check(
            all_finite(&[0.0, f64::NAN]),
            Some("[1] is NaN; accepted: a finite number"),
        );
        let few = count("a", 0, 1..=3, "links");
        check(few, Some("a is a list of 0; accepted: 1 to 3 links"));
        let unequal = count("a", 4, 2..=2, "numbers, one a feature");
        check(
            unequal,
            Some("a is a list of 4; accepted: 2 numbers, one a feature"),
        );
        check(
            count("a", 4, 0..=3, "props"),
            Some("a is a list of 4; accepted: at most 3 props"),
        );
    }
}

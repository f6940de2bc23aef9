//! A centre-of-mass reference trajectory as data, and the family of those of one motion over a
//! parameter: its speed, or the mass that it deals with.
//!
//! (parameter, knots, control points) … → the trajectory for any value in between, by interpolating
//! knots and control points (2017 paper, section 4.2).

use aplomb_framework::input::{Error, FieldPath, Result, check};
use serde::{Deserialize, Serialize};

/// At most this many knots beside the two ends.
pub const MOST_KNOTS: usize = 8;
/// Least distance of two knots, part of the length.
pub const LEAST_GAP: f64 = 0.02;
/// Largest displacement, m.
pub const FARTHEST: f64 = 2.0;

/// The horizontal displacement of the reference from the middle of the base of support.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cmrt {
    /// What it was learned for: the value of the motion's parameter.
    #[serde(default)]
    pub value: f64,
    /// s from the beginning of the preparation to the end of the decay.
    pub length: f64,
    /// Knots, s, in order, inside the length.
    pub times: Vec<f64>,
    /// Control points at the knots, m, forward positive.
    pub displacements: Vec<f64>,
}

impl Cmrt {
    /// No anticipation: `knots` control points of zero at equal distances.
    #[must_use]
    pub fn flat(length: f64, knots: usize) -> Self {
        let step = length / (knots + 1) as f64;
        Self {
            value: 0.0,
            length,
            times: (1..=knots).map(|i| step * i as f64).collect(),
            displacements: vec![0.0; knots],
        }
    }

    /// Checks that there is a curve through it.
    ///
    /// # Errors
    /// No knots or too many, knots out of order or too near to each other, numbers out of bounds.
    pub fn validate(&self) -> Result<()> {
        check::within("length", self.length, 0.1..=600.0)?;
        check::within("value", self.value, -1e6..=1e6)?;
        let knots = self.times.len();
        check::count("times", knots, 1..=MOST_KNOTS, "knots")?;
        let found = self.displacements.len();
        let right = knots..=knots;
        check::count("displacements", found, right, "numbers, one a knot")?;
        for (i, d) in self.displacements.iter().enumerate() {
            check::within(("displacements", i), *d, -FARTHEST..=FARTHEST)?;
        }
        let gap = (1.0 - 1e-6) * LEAST_GAP * self.length;
        let mut before = 0.0;
        for (i, t) in self.times.iter().chain([&self.length]).enumerate() {
            if t.is_nan() || t - before < gap {
                let field = if i < knots {
                    FieldPath::from(("times", i))
                } else {
                    "length".into()
                };
                let accepted = format!("knots in order, at least {gap:.3} s apart");
                return Err(Error::refused(field, t, accepted));
            }
            before = *t;
        }
        Ok(())
    }

    /// Part of the way to another with as many knots.
    fn towards(&self, other: &Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + part * (b - a);
        let all = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| mix(*a, *b)).collect();
        Self {
            value: mix(self.value, other.value),
            length: mix(self.length, other.length),
            times: all(&self.times, &other.times),
            displacements: all(&self.displacements, &other.displacements),
        }
    }
}

/// Checks a family: every member, in the order of the parameter, with equally many knots.
///
/// # Errors
/// What [`Cmrt::validate`] refuses; members out of order or of unequal kind.
pub fn validate(family: &[Cmrt]) -> Result<()> {
    for (i, member) in family.iter().enumerate() {
        member.validate().map_err(|e| e.inside(i))?;
    }
    for (i, pair) in family.windows(2).enumerate() {
        let of = |e: Error| e.inside(i + 1);
        if pair[0].value >= pair[1].value {
            let accepted = format!("more than {}, the one before", pair[0].value);
            return Err(of(Error::refused("value", pair[1].value, accepted)));
        }
        let (knots, found) = (pair[0].times.len(), pair[1].times.len());
        let as_many = check::count("times", found, knots..=knots, "knots as the others");
        as_many.map_err(of)?;
    }
    Ok(())
}

/// The trajectory for a value of the parameter: between the two members next to it, or the member
/// at the end of the family; none of an empty family.
#[must_use]
pub fn interpolated(family: &[Cmrt], value: f64) -> Option<Cmrt> {
    let after = family.partition_point(|c| c.value < value);
    match (after.checked_sub(1).map(|i| &family[i]), family.get(after)) {
        (Some(low), Some(high)) => {
            Some(low.towards(high, (value - low.value) / (high.value - low.value)))
        }
        (one, other) => one.or(other).cloned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(value: f64, first: f64, displacement: f64) -> Cmrt {
        Cmrt {
            value,
            length: 2.0,
            times: vec![first, 1.0],
            displacements: vec![displacement, 0.0],
        }
    }

    #[test]
    fn between_two_members_knots_and_control_points_are_mixed() {
        let family = [member(1.0, 0.4, 0.1), member(3.0, 0.8, 0.3)];
        let two = interpolated(&family, 2.0).unwrap();
        assert!((two.times[0] - 0.6).abs() < 1e-12 && (two.displacements[0] - 0.2).abs() < 1e-12);
        assert_eq!(interpolated(&family, 1.0).unwrap(), family[0]);
        assert_eq!(interpolated(&family, 9.0).unwrap(), family[1]);
        assert_eq!(interpolated(&family, -9.0).unwrap(), family[0]);
        assert_eq!(interpolated(&[], 1.0), None);
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        let refusal = |c: Cmrt| validate(&[c]).unwrap_err().to_string();
        let good = member(1.0, 0.5, 0.1);
        assert!(validate(&[good.clone(), member(2.0, 0.4, 0.0)]).is_ok());
        let mut bad = good.clone();
        bad.times = vec![1.0, 0.5];
        assert!(refusal(bad).contains("in order"));
        let mut bad = good.clone();
        bad.times[1] = f64::NAN;
        assert!(refusal(bad).contains("NaN"));
        let mut bad = good.clone();
        bad.displacements.pop();
        assert!(refusal(bad).contains("one a knot"));
        let mut bad = good.clone();
        bad.displacements[0] = 7.0;
        assert!(refusal(bad).contains("-2 to 2"));
        let mut bad = good.clone();
        bad.times = vec![0.1; 9];
        bad.displacements = vec![0.0; 9];
        assert!(refusal(bad).contains("1 to 8"));
        let unordered = [good.clone(), good];
        assert!(validate(&unordered).is_err());
    }
}

//! Every bound that a learned boundary must keep, and whom it is valid for.
//!
//! [`Boundary`], model → nothing, or the first field that is out of bounds.

use crate::character::Model;
use crate::control::Boundary;
use crate::control::boundary::{DecisionFunction, MOST_FEATURES, MOST_SUPPORT_VECTORS};
use crate::input::{Error, Result, shortened};

/// Where a field stands, for messages.
type Place<'a> = &'a dyn Fn(&str) -> String;

/// Number of monomials in so many features up to a degree: the coefficients of
/// [`DecisionFunction::Polynomial`].
#[must_use]
pub fn monomials(features: usize, degree: u8) -> usize {
    (1..=usize::from(degree)).fold(1, |count, k| count * (features + k) / k)
}

impl Boundary {
    /// What [`Boundary::resolve`] promises, with the places of the fields.
    pub(crate) fn resolve_at(&mut self, model: &Model, at: Place<'_>) -> Result<()> {
        self.check(at)?;
        let name = &model.name;
        if self.character != *name {
            let accepted = format!("'{name}', the character that is to be controlled");
            return refuse(at, "character", quoted(&self.character), accepted);
        }
        let digest = model.digest();
        if self.character_digest != digest {
            let accepted = format!("'{digest}', {name} as it is; learn anew after a change to it");
            let found = quoted(&self.character_digest);
            return refuse(at, "character_digest", found, accepted);
        }
        for feature in &mut self.features {
            let name = feature.to_string();
            feature.resolve(model).map_err(|e| e.at(&at(&name)))?;
        }
        Ok(())
    }

    /// Counts and numbers.
    pub(crate) fn check(&self, at: Place<'_>) -> Result<()> {
        let count = self.features.len();
        if count == 0 || count > MOST_FEATURES {
            let accepted = format!("1 to {MOST_FEATURES} features");
            return refuse(at, "features", format!("a list of {count}"), accepted);
        }
        for (i, feature) in self.features.iter().enumerate() {
            if self.features[..i].contains(feature) {
                let problem = format!("'{feature}' a second time");
                return refuse(at, "features", problem, "no feature twice");
            }
        }
        for (field, values) in [("mean", &self.mean), ("scale", &self.scale)] {
            counted(at, field, values.len(), count, "one a feature")?;
            finite(at, field, values)?;
        }
        if let Some((i, scale)) = first(&self.scale, |s| *s <= 0.0) {
            return refuse(at, &format!("scale[{i}]"), scale, "above 0");
        }
        self.check_decision(at)?;
        let (slope, offset) = (self.calibration.slope, self.calibration.offset);
        if !(slope.is_finite() && slope <= 0.0) {
            let accepted = "finite, 0 or less: a higher score means a likelier success";
            return refuse(at, "calibration.slope", slope, accepted);
        }
        if !offset.is_finite() {
            return refuse(at, "calibration.offset", offset, "a finite number");
        }
        Ok(())
    }

    fn check_decision(&self, at: Place<'_>) -> Result<()> {
        let count = self.features.len();
        match &self.decision {
            DecisionFunction::Polynomial {
                degree,
                coefficients,
            } => {
                if !(1..=3).contains(degree) {
                    return refuse(at, "decision.degree", degree, "1 to 3");
                }
                let reason = format!("all monomials of {count} features up to degree {degree}");
                let (field, most) = ("decision.coefficients", monomials(count, *degree));
                counted(at, field, coefficients.len(), most, &reason)?;
                finite(at, field, coefficients)
            }
            DecisionFunction::Gaussian {
                gamma,
                support,
                weights,
                offset,
            } => {
                if !(gamma.is_finite() && *gamma > 0.0) {
                    return refuse(at, "decision.gamma", gamma, "finite and above 0");
                }
                if support.len() > MOST_SUPPORT_VECTORS {
                    let found = format!("a list of {}", support.len());
                    let accepted = format!("at most {MOST_SUPPORT_VECTORS} support vectors");
                    return refuse(at, "decision.support", found, accepted);
                }
                for (s, vector) in support.iter().enumerate() {
                    let field = format!("decision.support[{s}]");
                    counted(at, &field, vector.len(), count, "one a feature")?;
                    finite(at, &field, vector)?;
                }
                let reason = "one a support vector";
                counted(at, "decision.weights", weights.len(), support.len(), reason)?;
                finite(at, "decision.weights", weights)?;
                finite(at, "decision.offset", &[*offset])
            }
        }
    }
}

fn quoted(text: &str) -> String {
    format!("'{}'", shortened(text))
}

/// The refusal of a field, told where its last part stands; of a calibration, where that stands.
fn refuse<T>(
    at: Place<'_>,
    field: &str,
    problem: impl ToString,
    accepted: impl Into<String>,
) -> Result<T> {
    let path = field.split('[').next().unwrap_or(field);
    let (outer, inner) = path.split_once('.').unwrap_or((path, path));
    let needle = match outer {
        "calibration" => outer,
        _ => inner,
    };
    Err(Error::invalid(at(needle), field, problem, accepted))
}

fn counted(at: Place<'_>, field: &str, found: usize, right: usize, reason: &str) -> Result<()> {
    if found == right {
        return Ok(());
    }
    let accepted = format!("{right} numbers, {reason}");
    refuse(at, field, format!("a list of {found}"), accepted)
}

fn finite(at: Place<'_>, field: &str, values: &[f64]) -> Result<()> {
    match first(values, |v| !v.is_finite()) {
        Some((i, v)) => refuse(at, &format!("{field}[{i}]"), v, "finite numbers"),
        None => Ok(()),
    }
}

fn first(values: &[f64], is_bad: impl Fn(&f64) -> bool) -> Option<(usize, f64)> {
    let bad = |(_, v): &(usize, f64)| is_bad(v);
    values.iter().copied().enumerate().find(bad)
}

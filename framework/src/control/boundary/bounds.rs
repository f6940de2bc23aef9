//! Every bound that a learned boundary must keep, and whom it is valid for.
//!
//! [`Boundary`], model → nothing, or the first field that is out of bounds.

use crate::character::Model;
use crate::control::Boundary;
use crate::control::boundary::{DecisionFunction, MOST_FEATURES, MOST_SUPPORT_VECTORS};
use crate::input::{Error, Result, check, shortened};

/// Number of monomials in so many features up to a degree: the coefficients of
/// [`DecisionFunction::Polynomial`].
#[must_use]
pub fn monomials(features: usize, degree: u8) -> usize {
    (1..=usize::from(degree)).fold(1, |count, k| count * (features + k) / k)
}

impl Boundary {
    /// Looks up the joints that its features name, and checks everything.
    ///
    /// # Errors
    /// As [`Self::parse`], by the way to the field alone; another character than the one it was
    /// learned with; an unknown joint.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        self.check()?;
        let name = &model.name;
        if self.character != *name {
            let accepted = format!("'{name}', the character that is to be controlled");
            return Err(Error::refused(
                "character",
                quoted(&self.character),
                accepted,
            ));
        }
        let digest = model.digest();
        if self.character_digest != digest {
            let accepted = format!("'{digest}', {name} as it is; learn anew after a change to it");
            let found = quoted(&self.character_digest);
            return Err(Error::refused("character_digest", found, accepted));
        }
        for (i, feature) in self.features.iter_mut().enumerate() {
            let named = feature.resolve(model);
            named.map_err(|e| e.inside(("features", i)))?;
        }
        Ok(())
    }

    /// Counts and numbers.
    pub(super) fn check(&self) -> Result<()> {
        let count = self.features.len();
        check::count("features", count, 1..=MOST_FEATURES, "features")?;
        for (i, feature) in self.features.iter().enumerate() {
            if self.features[..i].contains(feature) {
                let problem = format!("'{feature}' a second time");
                let error = Error::refused(("features", i), problem, "no feature twice");
                return Err(error);
            }
        }
        for (field, values) in [("mean", &self.mean), ("scale", &self.scale)] {
            numbers(field, values, count, "one a feature")?;
        }
        for (i, scale) in self.scale.iter().enumerate() {
            check::above(("scale", i), *scale, 0.0, f64::INFINITY)?;
        }
        self.decision
            .check(count)
            .map_err(|e| e.inside("decision"))?;
        let (slope, offset) = (self.calibration.slope, self.calibration.offset);
        if !(slope.is_finite() && slope <= 0.0) {
            let accepted = "finite, 0 or less: a higher score means a likelier success";
            return Err(Error::refused("calibration.slope", slope, accepted));
        }
        check::finite("calibration.offset", offset)
    }
}

impl DecisionFunction {
    /// Counts and numbers of one in `features` features.
    fn check(&self, features: usize) -> Result<()> {
        match self {
            Self::Polynomial {
                degree,
                coefficients,
            } => {
                check::within("degree", f64::from(*degree), 1.0..=3.0)?;
                let reason = format!("all monomials of {features} features up to degree {degree}");
                let most = monomials(features, *degree);
                numbers("coefficients", coefficients, most, &reason)
            }
            Self::Gaussian {
                gamma,
                support,
                weights,
                offset,
            } => {
                check::finite("gamma", *gamma)?;
                check::above("gamma", *gamma, 0.0, f64::INFINITY)?;
                let most = 0..=MOST_SUPPORT_VECTORS;
                check::count("support", support.len(), most, "support vectors")?;
                for (s, vector) in support.iter().enumerate() {
                    let vector = numbers("", vector, features, "one a feature");
                    vector.map_err(|e| e.inside(("support", s)))?;
                }
                numbers("weights", weights, support.len(), "one a support vector")?;
                check::finite("offset", *offset)
            }
        }
    }
}

fn quoted(text: &str) -> String {
    format!("'{}'", shortened(text))
}

/// As many finite numbers as there must be, and why as many.
fn numbers(field: &str, values: &[f64], right: usize, reason: &str) -> Result<()> {
    let what = format_args!("numbers, {reason}");
    check::count(field, values.len(), right..=right, what)?;
    check::all_finite(values).map_err(|e| e.inside(field))
}

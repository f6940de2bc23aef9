//! Regions of situations, as data: they can be stored, printed, evaluated and explained.
//!
//! In the 2001 paper's terms these are the relations on state, environment, contacts and balance
//! of which pre-conditions, post-conditions and expected performance are made.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::boundary::Boundary;
use crate::error::{Error, Result};
use crate::feature::Feature;
use crate::model::Model;
use crate::sensors::{Posture, Sensors};

/// A region of situations. Bounds are inclusive; what is not a number lies in no bounds.
///
/// ```
/// # use aplomb_framework::{condition::Condition, model::Model, sensors::Sensors};
/// let text = r#"All([Posture([standing]), Within(feature: "com_height", min: 0.9)])"#;
/// let condition: Condition = ron::from_str(text)?;
/// let now = Sensors::new(&Model::load("humanoid")?, 9.81); // in the air
/// let refusal = condition.first_failure(&now).unwrap();
/// assert_eq!(refusal.to_string(), "posture standing (is airborne)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Condition {
    /// Holds everywhere.
    Always,
    /// Holds nowhere.
    Never,
    /// A feature lies between two bounds.
    Within {
        /// The feature.
        feature: Feature,
        /// Lowest value; no bound if left out.
        #[serde(default = "lowest", skip_serializing_if = "is_infinite")]
        min: f64,
        /// Highest value; no bound if left out.
        #[serde(default = "highest", skip_serializing_if = "is_infinite")]
        max: f64,
    },
    /// The posture is one of these.
    Posture(Vec<Posture>),
    /// All hold; an empty list always does.
    All(Vec<Condition>),
    /// At least one holds; an empty list never does.
    Any(Vec<Condition>),
    /// The other does not hold.
    Not(Box<Condition>),
    /// A learned boundary says that success is expected. Where a feature of it is not a number it
    /// does not.
    Svm(Arc<Boundary>),
}

fn lowest() -> f64 {
    f64::NEG_INFINITY
}

fn highest() -> f64 {
    f64::INFINITY
}

fn is_infinite(bound: &f64) -> bool {
    bound.is_infinite()
}

/// The clause that refused, and the value that it refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refusal<'a> {
    /// The first clause that does not hold.
    pub clause: &'a Condition,
    /// The value of its feature, if it is about one; the score of a learned boundary.
    pub value: Option<f64>,
    /// The posture at the time.
    pub posture: Posture,
}

impl Condition {
    /// The first clause that does not hold now; none if the condition holds. Of alternatives
    /// none of which holds, the last one's refusal is told.
    #[must_use]
    pub fn first_failure<'a>(&'a self, now: &Sensors) -> Option<Refusal<'a>> {
        let refused = |value| {
            Some(Refusal {
                clause: self,
                value,
                posture: now.posture,
            })
        };
        match self {
            Self::Always => None,
            Self::Never => refused(None),
            Self::Within { feature, min, max } => {
                let v = feature.value(now);
                if v >= *min && v <= *max {
                    None
                } else {
                    refused(Some(v))
                }
            }
            Self::Posture(any) if any.contains(&now.posture) => None,
            Self::Posture(_) => refused(None),
            Self::All(all) => all.iter().find_map(|c| c.first_failure(now)),
            Self::Any(any) => {
                let mut last = refused(None);
                for c in any {
                    last = Some(c.first_failure(now)?);
                }
                last
            }
            Self::Not(c) if c.holds(now) => refused(None),
            Self::Not(_) => None,
            Self::Svm(boundary) => {
                let score = boundary.score(now);
                if score >= 0.0 {
                    None
                } else {
                    refused(Some(score))
                }
            }
        }
    }

    /// Whether the condition holds now.
    #[must_use]
    pub fn holds(&self, now: &Sensors) -> bool {
        self.first_failure(now).is_none()
    }

    /// Whether any of its clauses was learned.
    #[must_use]
    pub fn is_learned(&self) -> bool {
        match self {
            Self::Svm(_) => true,
            Self::All(list) | Self::Any(list) => list.iter().any(Self::is_learned),
            Self::Not(c) => c.is_learned(),
            Self::Always | Self::Never | Self::Within { .. } | Self::Posture(_) => false,
        }
    }

    /// How likely success is where the condition holds: the product of the calibrated
    /// probabilities of the learned boundaries that all have to hold; 1 if there are none.
    /// Alternatives and negations say nothing about it.
    #[must_use]
    pub fn probability(&self, now: &Sensors) -> f64 {
        match self {
            Self::Svm(boundary) => boundary.probability(boundary.score(now)),
            Self::All(all) => all.iter().map(|c| c.probability(now)).product(),
            _ => 1.0,
        }
    }

    /// Visits every feature that it names outright, until a visit fails.
    ///
    /// # Errors
    /// The visit's.
    pub(crate) fn each_feature(
        &self,
        visit: &mut impl FnMut(&Feature) -> Result<()>,
    ) -> Result<()> {
        match self {
            Self::Within { feature, .. } => visit(feature),
            Self::All(list) | Self::Any(list) => {
                list.iter().try_for_each(|c| c.each_feature(visit))
            }
            Self::Not(c) => c.each_feature(visit),
            Self::Always | Self::Never | Self::Posture(_) | Self::Svm(_) => Ok(()),
        }
    }

    /// Looks up the joints that features name, and checks the bounds.
    ///
    /// # Errors
    /// An unknown joint; bounds that are not numbers or out of order; a learned boundary that is
    /// invalid or of another character.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        match self {
            Self::Within { feature, min, max } => {
                feature.resolve(model)?;
                if min.is_nan() || max.is_nan() || min > max {
                    return Err(Error::invalid(
                        format!("Within(feature: \"{feature}\")"),
                        "min, max",
                        format!("{min}, {max}"),
                        "two numbers with min ≤ max",
                    ));
                }
            }
            Self::All(list) | Self::Any(list) => {
                for c in list {
                    c.resolve(model)?;
                }
            }
            Self::Not(c) => c.resolve(model)?,
            Self::Svm(boundary) => Arc::make_mut(boundary).resolve(model)?,
            Self::Always | Self::Never | Self::Posture(_) => {}
        }
        Ok(())
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, all: &[Self], word: &str| {
            f.write_str("(")?;
            for (i, c) in all.iter().enumerate() {
                if i > 0 {
                    write!(f, " {word} ")?;
                }
                write!(f, "{c}")?;
            }
            f.write_str(")")
        };
        match self {
            Self::Always => f.write_str("always"),
            Self::Never => f.write_str("never"),
            Self::Within { feature, min, max } => match (min.is_finite(), max.is_finite()) {
                (true, true) => write!(f, "{feature} in {min}..{max}"),
                (true, false) => write!(f, "{feature} ≥ {min}"),
                (false, true) => write!(f, "{feature} ≤ {max}"),
                (false, false) => write!(f, "{feature} is a number"),
            },
            Self::Posture(any) => {
                f.write_str("posture ")?;
                for (i, p) in any.iter().enumerate() {
                    write!(f, "{}{}", if i > 0 { "|" } else { "" }, p.name())?;
                }
                Ok(())
            }
            Self::All(all) => list(f, all, "and"),
            Self::Any(any) => list(f, any, "or"),
            Self::Not(c) => write!(f, "not {c}"),
            Self::Svm(boundary) => write!(f, "{boundary}"),
        }
    }
}

impl fmt::Display for Refusal<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.clause)?;
        match (self.clause, self.value) {
            (_, Some(v)) => write!(f, " (is {v:.3})"),
            (Condition::Posture(_), None) => write!(f, " (is {})", self.posture.name()),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Decision;
    use crate::boundary::tests::{boundary, polynomial};
    use crate::model::Model;
    use proptest::prelude::*;

    fn within(feature: &str, min: f64, max: f64) -> Condition {
        Condition::Within {
            feature: feature.parse().unwrap(),
            min,
            max,
        }
    }

    #[test]
    fn the_first_clause_that_fails_is_told_with_its_value() {
        let mut now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
        now.com_velocity[0] = 0.7;
        let c = Condition::All(vec![
            within("com_height", 0.9, 1.1),
            Condition::Any(vec![within("com_velocity_x", -0.3, 0.3), Condition::Never]),
            within("com_velocity_x", -0.5, 0.5),
        ]);
        assert_eq!(c.first_failure(&now).unwrap().to_string(), "never");
        let c = Condition::All(vec![within("com_velocity_x", -0.5, 0.5)]);
        let refusal = c.first_failure(&now).unwrap();
        assert_eq!(refusal.value, Some(0.7));
        assert_eq!(
            refusal.to_string(),
            "com_velocity_x in -0.5..0.5 (is 0.700)"
        );
    }

    #[test]
    fn what_is_not_a_number_lies_in_no_bounds() {
        let now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
        assert!(!within("com_offset", f64::NEG_INFINITY, f64::INFINITY).holds(&now));
    }

    fn slower_than_one() -> Condition {
        Condition::Svm(Arc::new(polynomial(&["com_velocity_x"], &[1.0, -1.0])))
    }

    #[test]
    fn a_learned_boundary_refuses_with_its_score() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        let mut c = Condition::All(vec![
            Condition::Posture(vec![now.posture]),
            slower_than_one(),
        ]);
        c.resolve(&model).unwrap();
        now.com_velocity[0] = 1.0;
        assert!(c.holds(&now), "0 is within");
        now.com_velocity[0] = 1.3125;
        assert_eq!(
            c.first_failure(&now).unwrap().to_string(),
            "svm of balance (1 feature, poly1) (is -0.312)"
        );
        now.com_velocity[0] = f64::NAN;
        assert!(!c.holds(&now));
    }

    #[test]
    fn probabilities_of_what_has_to_hold_are_multiplied() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        now.com_velocity[0] = 0.25;
        let one = 1.0 / (1.0 + (-2.0 * 0.75 + 0.5_f64).exp());
        let learned = slower_than_one;
        for (c, is_learned, probability) in [
            (learned(), true, one),
            (
                Condition::All(vec![learned(), Condition::Always, learned()]),
                true,
                one * one,
            ),
            (Condition::Any(vec![learned()]), true, 1.0),
            (Condition::Not(Box::new(learned())), true, 1.0),
            (Condition::All(vec![Condition::Always]), false, 1.0),
            (within("com_height", 0.0, 1.0), false, 1.0),
        ] {
            assert_eq!(c.is_learned(), is_learned, "{c}");
            assert!((c.probability(&now) - probability).abs() < 1e-15, "{c}");
        }
    }

    #[test]
    fn unordered_bounds_are_refused() {
        let model = Model::load("humanoid").unwrap();
        assert!(within("com_height", 1.0, 0.0).resolve(&model).is_err());
        assert!(within("com_height", f64::NAN, 0.0).resolve(&model).is_err());
    }

    fn any_boundary() -> impl Strategy<Value = Boundary> {
        let numbers = |n| prop::collection::vec(-1e3..1e3_f64, n);
        let features = ["com_velocity_x", "angle.knee_l"];
        let quadratic = numbers(6).prop_map(move |c| polynomial(&features, &c));
        let gaussian = (1e-3..10.0_f64, numbers(7)).prop_map(move |(gamma, n)| {
            let decision = Decision::Gaussian {
                gamma,
                support: vec![n[..2].to_vec(), n[2..4].to_vec()],
                weights: n[4..6].to_vec(),
                offset: n[6],
            };
            boundary(&features, decision)
        });
        prop_oneof![quadratic, gaussian]
    }

    fn any_condition() -> impl Strategy<Value = Condition> {
        let leaf = prop_oneof![
            Just(Condition::Always),
            Just(Condition::Never),
            Just(Condition::Posture(vec![Posture::Prone, Posture::Airborne])),
            (-1e3..1e3_f64, 0.0..1e3_f64).prop_map(|(a, w)| within("com_velocity_x", a, a + w)),
            (-1e3..1e3_f64).prop_map(|a| within("angle.knee_l", a, f64::INFINITY)),
            any_boundary().prop_map(|b| Condition::Svm(Arc::new(b))),
        ];
        leaf.prop_recursive(4, 24, 4, |inner| {
            prop_oneof![
                prop::collection::vec(inner.clone(), 0..4).prop_map(Condition::All),
                prop::collection::vec(inner.clone(), 0..4).prop_map(Condition::Any),
                inner.prop_map(|c| Condition::Not(Box::new(c))),
            ]
        })
    }

    proptest! {
        #[test]
        fn conditions_round_trip_as_text(c in any_condition()) {
            let text = ron::to_string(&c).unwrap();
            prop_assert_eq!(ron::from_str::<Condition>(&text).unwrap(), c);
        }

        #[test]
        fn a_condition_and_its_negation_never_agree(c in any_condition(), v in -2e3..2e3_f64) {
            let model = Model::load("humanoid").unwrap();
            let mut now = Sensors::new(&model, 9.81);
            now.com_velocity[0] = v;
            let mut c = c;
            c.resolve(&model).unwrap();
            prop_assert_ne!(c.holds(&now), Condition::Not(Box::new(c.clone())).holds(&now));
        }
    }
}

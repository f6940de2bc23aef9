//! Regions of situations, as data: they can be stored, printed, evaluated and explained.
//!
//! In the 2001 paper's terms these are the relations on state, environment, contacts and balance
//! of which pre-conditions, post-conditions and expected performance are made.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::character::Model;
use crate::control::boundary::Boundary;
use crate::events::{Found, Unmet};
use crate::input::{Error, FieldPath, Result};
use crate::sensing::{Feature, Posture, Sensors};

/// A region of situations. Bounds are inclusive; what is not a number lies in no bounds.
///
/// ```
/// # use aplomb_framework::{Condition, Model, Sensors};
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
    /// The condition that the file gives this name to. It stands in files alone: [`Condition::named`]
    /// puts the condition in its place; without that it holds nowhere.
    Named(String),
}

fn lowest() -> f64 {
    f64::NEG_INFINITY
}

fn highest() -> f64 {
    f64::INFINITY
}

pub(crate) fn is_infinite(bound: &f64) -> bool {
    bound.is_infinite()
}

/// The clause that refused, and the value that it refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure<'a> {
    /// The first clause that does not hold.
    pub clause: &'a Condition,
    /// The value of its feature, if it is about one; the score of a learned boundary. Of a negation
    /// that of what it negates.
    pub value: Option<f64>,
    /// What was sensed.
    pub now: &'a Sensors,
}

impl Condition {
    /// The first clause that does not hold now; none if the condition holds. Alternatives none of
    /// which holds are one clause.
    #[must_use]
    pub fn first_failure<'a>(&'a self, now: &'a Sensors) -> Option<Failure<'a>> {
        let refused = |value| {
            Some(Failure {
                clause: self,
                value,
                now,
            })
        };
        match self {
            Self::Always => None,
            Self::Never | Self::Named(_) => refused(None),
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
            Self::Any(any) if any.iter().any(|c| c.holds(now)) => None,
            Self::Any(_) => refused(None),
            Self::Not(c) if c.holds(now) => refused(c.value(now)),
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

    /// The value that it bounds: its feature's, a learned boundary's score; of a negation that of what
    /// it negates.
    #[must_use]
    pub fn value(&self, now: &Sensors) -> Option<f64> {
        match self {
            Self::Within { feature, .. } => Some(feature.value(now)),
            Self::Svm(boundary) => Some(boundary.score(now)),
            Self::Not(c) => c.value(now),
            _ => None,
        }
    }

    /// Whether the condition holds now.
    #[must_use]
    pub fn holds(&self, now: &Sensors) -> bool {
        self.first_failure(now).is_none()
    }

    /// Whether it is the one that never holds.
    #[must_use]
    pub fn is_never(&self) -> bool {
        *self == Self::Never
    }

    /// Whether it is the one that always holds.
    #[must_use]
    pub fn is_always(&self) -> bool {
        *self == Self::Always
    }

    /// Whether any of its clauses was learned.
    #[must_use]
    pub fn is_learned(&self) -> bool {
        match self {
            Self::Svm(_) => true,
            Self::All(list) | Self::Any(list) => list.iter().any(Self::is_learned),
            Self::Not(c) => c.is_learned(),
            Self::Always
            | Self::Never
            | Self::Within { .. }
            | Self::Posture(_)
            | Self::Named(_) => false,
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
            Self::Within { feature, .. } => visit(feature).map_err(|e| e.inside("feature")),
            Self::All(list) | Self::Any(list) => {
                let mut clauses = list.iter().enumerate();
                clauses
                    .try_for_each(|(i, c)| c.each_feature(visit).map_err(|e| e.inside(clause(i))))
            }
            Self::Not(c) => c
                .each_feature(visit)
                .map_err(|e| e.inside(FieldPath::inner())),
            Self::Always | Self::Never | Self::Posture(_) | Self::Svm(_) | Self::Named(_) => Ok(()),
        }
    }

    /// The same condition with those that it names in their places.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the names that there are.
    pub fn named(&self, names: &BTreeMap<String, Self>) -> Result<Self> {
        let all = |list: &[Self]| {
            let one = |(i, c): (usize, &Self)| c.named(names).map_err(|e| e.inside(clause(i)));
            list.iter().enumerate().map(one).collect::<Result<Vec<_>>>()
        };
        Ok(match self {
            Self::Named(name) => {
                let known = || names.keys().map(String::as_str);
                let unknown = || Error::unknown("condition", name, known());
                names.get(name).ok_or_else(unknown)?.clone()
            }
            Self::All(list) => Self::All(all(list)?),
            Self::Any(list) => Self::Any(all(list)?),
            Self::Not(c) => {
                let named = c.named(names).map_err(|e| e.inside(FieldPath::inner()))?;
                Self::Not(Box::new(named))
            }
            _ => self.clone(),
        })
    }

    /// Looks up the joints that features name, and checks the bounds.
    ///
    /// # Errors
    /// An unknown joint; a name in the place of a condition; bounds that are not numbers or out of order; a learned boundary that is
    /// invalid or of another character.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        match self {
            Self::Within { feature, min, max } => {
                let named = feature.resolve(model);
                named.map_err(|e| e.inside("feature"))?;
                if max.is_nan() {
                    return Err(Error::refused("max", max, "a number"));
                }
                if min.is_nan() || min > max {
                    let accepted = format!("a number with min ≤ max, which is {max}");
                    return Err(Error::refused("min", min, accepted));
                }
            }
            Self::All(list) | Self::Any(list) => {
                for (i, c) in list.iter_mut().enumerate() {
                    c.resolve(model).map_err(|e| e.inside(clause(i)))?;
                }
            }
            Self::Not(c) => c.resolve(model).map_err(|e| e.inside(FieldPath::inner()))?,
            Self::Svm(boundary) => {
                let learned = Arc::make_mut(boundary).resolve(model);
                learned.map_err(|e| e.inside(FieldPath::inner()))?;
            }
            Self::Named(name) => {
                return Err(Error::unknown("condition", name, std::iter::empty()));
            }
            Self::Always | Self::Never | Self::Posture(_) => {}
        }
        Ok(())
    }
}

/// The way to a clause of `All([…])` or `Any([…])`.
fn clause(place: usize) -> FieldPath {
    FieldPath::inner().then(place)
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
            Self::Named(name) => f.write_str(name),
        }
    }
}

impl Failure<'_> {
    /// The clause in words, and what was found instead.
    #[must_use]
    pub fn unmet(&self) -> Unmet {
        let found = match (self.clause, self.value) {
            (Condition::Within { feature, .. }, Some(v)) if v.is_nan() => {
                Found::Absent(feature.absence(self.now))
            }
            (Condition::Svm(boundary), Some(v)) if v.is_nan() => {
                Found::Absent(boundary.absence(self.now))
            }
            (_, Some(v)) => Found::Value(v),
            (Condition::Posture(_), None) => Found::State(self.now.posture.name().to_owned()),
            (Condition::Any(any), None) if !any.is_empty() => {
                let refusals = any.iter().filter_map(|c| c.first_failure(self.now));
                Found::NoneOf(refusals.map(|r| r.unmet()).collect())
            }
            _ => Found::Nothing,
        };
        Unmet {
            clause: self.clause.to_string(),
            found,
        }
    }

    /// The same, said of an expected performance.
    #[must_use]
    pub fn expected(&self) -> Unmet {
        self.unmet().after("expected")
    }
}

impl fmt::Display for Failure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.unmet().fmt(f)
    }
}

#[cfg(test)]
mod tests;

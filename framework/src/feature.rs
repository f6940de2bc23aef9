//! Named scalars of [`Sensors`]: the one vocabulary of conditions, datasets and plots.
//!
//! name → [`Feature`]; sensors → its value.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::error::{Error, Result};
use crate::model::Model;
use crate::sensors::Sensors;
use crate::vocabulary::{NONE, SCALARS};

/// A named scalar of [`Sensors`]. In files: its name as a string, `com_height` or `angle.knee_r`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature(Kind);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    Scalar(usize),
    Angle { joint: String, index: usize },
    Velocity { joint: String, index: usize },
}

const UNRESOLVED: usize = usize::MAX;

impl Feature {
    /// The value now; not a number where the situation has none.
    #[must_use]
    pub fn value(&self, now: &Sensors) -> f64 {
        match &self.0 {
            Kind::Scalar(i) => (SCALARS[*i].value)(now),
            Kind::Angle { index, .. } => now.state.angles().get(*index).copied().unwrap_or(NONE),
            Kind::Velocity { index, .. } => now.state.rates().get(*index).copied().unwrap_or(NONE),
        }
    }

    /// SI unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match &self.0 {
            Kind::Scalar(i) => SCALARS[*i].unit,
            Kind::Angle { .. } => "rad",
            Kind::Velocity { .. } => "rad/s",
        }
    }

    /// Looks up the joint that the feature names.
    ///
    /// # Errors
    /// [`Error::Unknown`] if the model has no such joint.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        match &mut self.0 {
            Kind::Scalar(_) => {}
            Kind::Angle { joint, index } | Kind::Velocity { joint, index } => {
                *index = model.joint_index(joint)?;
            }
        }
        Ok(())
    }

    /// Name, unit and meaning of every feature but the joints'.
    pub fn vocabulary() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
        SCALARS.iter().map(|s| (s.name, s.unit, s.meaning))
    }
}

impl FromStr for Feature {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        let joint = |j: &str| j.to_owned();
        if let Some(j) = name.strip_prefix("angle.") {
            return Ok(Self(Kind::Angle {
                joint: joint(j),
                index: UNRESOLVED,
            }));
        }
        if let Some(j) = name.strip_prefix("velocity.") {
            return Ok(Self(Kind::Velocity {
                joint: joint(j),
                index: UNRESOLVED,
            }));
        }
        let known = || {
            SCALARS
                .iter()
                .map(|s| s.name)
                .chain(["angle.JOINT", "velocity.JOINT"])
        };
        SCALARS
            .iter()
            .position(|s| s.name == name)
            .map(|i| Self(Kind::Scalar(i)))
            .ok_or_else(|| Error::unknown("feature", name, known()))
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Scalar(i) => f.write_str(SCALARS[*i].name),
            Kind::Angle { joint, .. } => write!(f, "angle.{joint}"),
            Kind::Velocity { joint, .. } => write!(f, "velocity.{joint}"),
        }
    }
}

impl Serialize for Feature {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Feature {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_round_trip() {
        for (i, s) in SCALARS.iter().enumerate() {
            assert!(
                SCALARS[..i].iter().all(|o| o.name != s.name),
                "{} twice",
                s.name
            );
            assert_eq!(s.name.parse::<Feature>().unwrap().to_string(), s.name);
        }
    }

    #[test]
    fn joints_are_resolved_against_the_model() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        now.state.q[3] = 0.25;
        let mut waist: Feature = "angle.waist".parse().unwrap();
        assert!(
            waist.value(&now).is_nan(),
            "unresolved features have no value"
        );
        waist.resolve(&model).unwrap();
        assert_eq!(waist.value(&now), 0.25);
        let mut tail: Feature = "angle.tail".parse().unwrap();
        assert!(tail.resolve(&model).is_err());
        assert!(
            "com_hieght"
                .parse::<Feature>()
                .unwrap_err()
                .to_string()
                .contains("'com_height'")
        );
    }
}

//! Named scalars of [`Sensors`]: the one vocabulary of conditions, datasets and plots.
//!
//! name → [`Feature`]; sensors → its value.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::character::Model;
use crate::input::{Error, Result, nearest};
use crate::sensing::sensed_prop::PROP_SCALARS;
use crate::sensing::sensors::Sensors;
use crate::sensing::vocabulary::{NONE, SCALARS};

/// A named scalar of [`Sensors`]. In files: its name as a string, `com_height`,
/// `angle.knee_r` or `prop_ahead.ball`.
///
/// ```
/// # use aplomb_framework::{Model, Sensors, sensing::Feature};
/// let model = Model::load("humanoid")?;
/// let mut knee: Feature = "angle.knee_r".parse()?;
/// knee.resolve(&model)?; // looks up the joint
/// let now = Sensors::new(&model, 9.81);
/// assert_eq!((knee.value(&now), knee.unit()), (0.0, "rad"));
/// let ball: Feature = "prop_ahead.ball".parse()?;
/// assert!(ball.value(&now).is_nan()); // there is none
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature(FeatureKind);

#[derive(Debug, Clone, PartialEq, Eq)]
enum FeatureKind {
    Scalar(usize),
    Angle { joint: String, index: usize },
    Velocity { joint: String, index: usize },
    Prop { scalar: usize, prop: String },
}

const UNRESOLVED: usize = usize::MAX;

impl Feature {
    /// The value now; not a number where the situation has none.
    #[must_use]
    pub fn value(&self, now: &Sensors) -> f64 {
        match &self.0 {
            FeatureKind::Scalar(i) => (SCALARS[*i].value)(now),
            FeatureKind::Angle { index, .. } => {
                now.state.angles().get(*index).copied().unwrap_or(NONE)
            }
            FeatureKind::Velocity { index, .. } => {
                now.state.rates().get(*index).copied().unwrap_or(NONE)
            }
            FeatureKind::Prop { scalar, prop } => {
                let sensed = now.props.iter().find(|p| *p.name == **prop);
                sensed.map_or(NONE, PROP_SCALARS[*scalar].value)
            }
        }
    }

    /// Why it has no value now, where it has none; the nearest name if it names a prop that is not
    /// there.
    #[must_use]
    pub fn absence(&self, now: &Sensors) -> String {
        match &self.0 {
            FeatureKind::Prop { prop, .. } => {
                match nearest(prop, now.props.iter().map(|p| &*p.name)) {
                    Some(near) => format!("there is no prop '{prop}'; did you mean '{near}'?"),
                    None => format!("there is no prop '{prop}'"),
                }
            }
            FeatureKind::Angle { joint, .. } | FeatureKind::Velocity { joint, .. } => {
                format!("there is no joint '{joint}'")
            }
            FeatureKind::Scalar(i) => SCALARS[*i].absent.to_owned(),
        }
    }

    /// SI unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match &self.0 {
            FeatureKind::Scalar(i) => SCALARS[*i].unit,
            FeatureKind::Angle { .. } => "rad",
            FeatureKind::Velocity { .. } => "rad/s",
            FeatureKind::Prop { scalar, .. } => PROP_SCALARS[*scalar].unit,
        }
    }

    /// Looks up the joint that the feature names.
    ///
    /// # Errors
    /// [`Error::Unknown`] if the model has no such joint.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        match &mut self.0 {
            FeatureKind::Scalar(_) | FeatureKind::Prop { .. } => {}
            FeatureKind::Angle { joint, index } | FeatureKind::Velocity { joint, index } => {
                *index = model.joint_index(joint)?;
            }
        }
        Ok(())
    }

    /// The prop that the feature is about, if it is about one.
    #[must_use]
    pub fn prop(&self) -> Option<&str> {
        match &self.0 {
            FeatureKind::Prop { prop, .. } => Some(prop),
            _ => None,
        }
    }

    /// Name, unit and meaning of every feature but those of single joints and props.
    pub fn vocabulary() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
        SCALARS.iter().map(|s| (s.name, s.unit, s.meaning))
    }

    /// Name, unit and meaning of the features of single joints and props, which stand in capitals.
    pub const FAMILIES: [(&'static str, &'static str, &'static str); 6] = [
        ("angle.JOINT", "rad", "angle of a joint"),
        ("velocity.JOINT", "rad/s", "angular velocity of a joint"),
        ("prop_ahead.PROP", "m", "prop ahead of the root"),
        (
            "prop_height.PROP",
            "m",
            "prop above the surface last touched",
        ),
        ("prop_velocity.PROP", "m/s", "forward velocity of a prop"),
        ("prop_held.PROP", "1", "1 if a hand holds the prop, else 0"),
    ];
}

impl FromStr for Feature {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        let joint = |j: &str| j.to_owned();
        if let Some(j) = name.strip_prefix("angle.") {
            return Ok(Self(FeatureKind::Angle {
                joint: joint(j),
                index: UNRESOLVED,
            }));
        }
        if let Some(j) = name.strip_prefix("velocity.") {
            return Ok(Self(FeatureKind::Velocity {
                joint: joint(j),
                index: UNRESOLVED,
            }));
        }
        if let Some((kind, prop)) = name.split_once('.')
            && let Some(scalar) = PROP_SCALARS.iter().position(|s| s.name == kind)
        {
            let prop = prop.to_owned();
            return Ok(Self(FeatureKind::Prop { scalar, prop }));
        }
        let known = || {
            let families = Self::FAMILIES.iter().map(|f| f.0);
            SCALARS.iter().map(|s| s.name).chain(families)
        };
        SCALARS
            .iter()
            .position(|s| s.name == name)
            .map(|i| Self(FeatureKind::Scalar(i)))
            .ok_or_else(|| Error::unknown("feature", name, known()))
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            FeatureKind::Scalar(i) => f.write_str(SCALARS[*i].name),
            FeatureKind::Angle { joint, .. } => write!(f, "angle.{joint}"),
            FeatureKind::Velocity { joint, .. } => write!(f, "velocity.{joint}"),
            FeatureKind::Prop { scalar, prop } => {
                write!(f, "{}.{prop}", PROP_SCALARS[*scalar].name)
            }
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
    fn a_prop_that_is_not_there_has_no_value() {
        let mut now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
        let mut ball = crate::sensing::SensedProp::new(&"ball".into());
        (ball.ahead, ball.height, ball.velocity, ball.held) = (1.5, 1.25, [-7.0, 2.0], true);
        for (name, unit, value) in [
            ("prop_ahead.ball", "m", 1.5),
            ("prop_height.ball", "m", 1.25),
            ("prop_velocity.ball", "m/s", -7.0),
            ("prop_held.ball", "1", 1.0),
        ] {
            let mut feature: Feature = name.parse().unwrap();
            feature.resolve(&now.model).unwrap();
            assert_eq!((feature.to_string().as_str(), feature.unit()), (name, unit));
            assert_eq!(feature.prop(), Some("ball"));
            assert!(feature.value(&now).is_nan());
            now.props.push(ball.clone());
            assert_eq!(feature.value(&now), value);
            now.props.clear();
        }
        assert!("prop_hold.ball".parse::<Feature>().is_err());
    }

    #[test]
    fn a_misspelt_prop_is_told_with_the_nearest() {
        let mut now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
        let feature: Feature = "prop_ahead.bal".parse().unwrap();
        assert_eq!(feature.absence(&now), "there is no prop 'bal'");
        for name in ["crate", "ball"] {
            now.props
                .push(crate::sensing::SensedProp::new(&name.into()));
        }
        let told = "there is no prop 'bal'; did you mean 'ball'?";
        assert_eq!(feature.absence(&now), told);
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

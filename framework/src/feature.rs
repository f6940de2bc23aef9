//! Named scalars of [`Sensors`]: the one vocabulary of conditions, datasets and plots.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::error::{Error, Result};
use crate::model::Model;
use crate::sensors::Sensors;

/// An entry of the vocabulary.
#[derive(Debug)]
struct Scalar {
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    value: fn(&Sensors) -> f64,
}

/// What does not exist in a situation (an offset from the base of support in the air) is not a
/// number, and fails every bound.
const NONE: f64 = f64::NAN;

const fn scalar(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    value: fn(&Sensors) -> f64,
) -> Scalar {
    Scalar {
        name,
        unit,
        meaning,
        value,
    }
}

/// The vocabulary, apart from `angle.JOINT` and `velocity.JOINT`.
const SCALARS: &[Scalar] = &[
    scalar(
        "com_offset",
        "m",
        "centre of mass ahead of the middle of the base of support",
        |s| s.support_centre().map_or(NONE, |c| s.com[0] - c),
    ),
    scalar(
        "com_front",
        "m",
        "front end of the base of support ahead of the centre of mass",
        |s| s.base_of_support.map_or(NONE, |b| b[1] - s.com[0]),
    ),
    scalar(
        "com_rear",
        "m",
        "centre of mass ahead of the rear end of the base of support",
        |s| s.base_of_support.map_or(NONE, |b| s.com[0] - b[0]),
    ),
    scalar(
        "com_height",
        "1",
        "height of the centre of mass, 1 = standing",
        |s| s.com_height() / s.model.standing_com()[1],
    ),
    scalar(
        "com_velocity_x",
        "m/s",
        "forward velocity of the centre of mass",
        |s| s.com_velocity[0],
    ),
    scalar(
        "com_velocity_y",
        "m/s",
        "upward velocity of the centre of mass",
        |s| s.com_velocity[1],
    ),
    scalar("com_speed", "m/s", "speed of the centre of mass", |s| {
        s.com_velocity[0].hypot(s.com_velocity[1])
    }),
    scalar(
        "capture_offset",
        "m",
        "capture point ahead of the middle of the base of support",
        |s| s.support_centre().map_or(NONE, |c| s.capture_point - c),
    ),
    scalar(
        "capture_front",
        "m",
        "front end of the base of support ahead of the capture point",
        |s| s.base_of_support.map_or(NONE, |b| b[1] - s.capture_point),
    ),
    scalar(
        "capture_rear",
        "m",
        "capture point ahead of the rear end of the base of support",
        |s| s.base_of_support.map_or(NONE, |b| s.capture_point - b[0]),
    ),
    scalar(
        "cop_offset",
        "m",
        "centre of pressure ahead of the middle of the base of support",
        |s| match (s.cop, s.support_centre()) {
            (Some(p), Some(c)) => p - c,
            _ => NONE,
        },
    ),
    scalar(
        "support_length",
        "m",
        "length of the base of support",
        |s| s.base_of_support.map_or(NONE, |b| b[1] - b[0]),
    ),
    scalar(
        "angular_momentum",
        "kg·m²/s",
        "about the centre of mass, leaning back positive",
        |s| s.angular_momentum,
    ),
    scalar(
        "load",
        "1",
        "ground reaction force on the feet over the weight",
        |s| s.ground_reaction_force[1] / (s.model.total_mass() * s.gravity.max(1e-6)),
    ),
    scalar(
        "trunk_pitch",
        "rad",
        "pitch of the trunk, leaning back positive",
        Sensors::trunk_pitch,
    ),
    scalar("trunk_rate", "rad/s", "rate of the trunk's pitch", |s| {
        s.kinematics.links[s.model.trunk].rate
    }),
    scalar(
        "root_pitch",
        "rad",
        "pitch of the root link, leaning back positive",
        |s| crate::state::wrapped(s.state.q[2]),
    ),
    scalar(
        "head_height",
        "1",
        "height of the head's centre of mass, 1 = the standing centre of mass",
        |s| (s.kinematics.links[s.model.head].com[1] - s.ground) / s.model.standing_com()[1],
    ),
    scalar("joint_speed", "rad/s", "fastest joint", |s| {
        s.state.rates().iter().fold(0.0, |a: f64, r| a.max(r.abs()))
    }),
    scalar("feet_touching", "1", "number of feet that touch", |s| {
        s.feet.iter().filter(|f| f.touching()).count() as f64
    }),
    scalar("hands_touching", "1", "number of hands that touch", |s| {
        s.model
            .hands
            .iter()
            .filter(|h| s.contacts[h.link].touching)
            .count() as f64
    }),
    scalar("head_touching", "1", "1 if the head touches, else 0", |s| {
        f64::from(u8::from(s.contacts[s.model.head].touching))
    }),
    scalar("links_touching", "1", "number of links that touch", |s| {
        s.contacts.iter().filter(|c| c.touching).count() as f64
    }),
    scalar(
        "feet_apart",
        "m",
        "distance between the foremost and the rearmost ankle",
        |s| {
            let x = |f: &crate::model::Foot| s.kinematics.links[f.link].origin[0];
            let most = s.model.feet.iter().map(x).fold(f64::NEG_INFINITY, f64::max);
            let least = s.model.feet.iter().map(x).fold(f64::INFINITY, f64::min);
            most - least
        },
    ),
];

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

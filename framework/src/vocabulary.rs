//! The scalars that features name, apart from those of single joints.
//!
//! sensors → numbers.

use crate::sensors::Sensors;

/// An entry of the vocabulary.
#[derive(Debug)]
pub(crate) struct Scalar {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) value: fn(&Sensors) -> f64,
}

/// What does not exist in a situation (an offset from the base of support in the air) is not a
/// number, and fails every bound.
pub(crate) const NONE: f64 = f64::NAN;

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
pub(crate) const SCALARS: &[Scalar] = &[
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
        Sensors::feet_apart,
    ),
];

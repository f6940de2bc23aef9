//! The scalars that features name, apart from those of single joints.
//!
//! sensors → numbers.

use crate::math::hypot;
use crate::sensing::sensors::Sensors;

/// An entry of the vocabulary.
#[derive(Debug)]
pub(crate) struct Scalar {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) value: fn(&Sensors) -> f64,
    /// Why it has no value, where it has none.
    pub(crate) absent: &'static str,
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
        absent: "no foot is supported",
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
        hypot(s.com_velocity[0], s.com_velocity[1])
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
        |s| crate::character::wrapped(s.state.q[2]),
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
    // These exist in the air, too.
    scalar(
        "com_from_feet",
        "m",
        "centre of mass ahead of the middle of all soles, touching or not",
        |s| s.com[0] - middle(s.soles()),
    ),
    scalar(
        "capture_from_feet",
        "m",
        "capture point ahead of the middle of all soles, touching or not",
        |s| s.capture_point - middle(s.soles()),
    ),
    scalar(
        "com_over_feet",
        "m",
        "centre of mass above the lowest sole",
        |s| s.com[1] - s.lowest_sole(),
    ),
    scalar(
        "feet_height",
        "m",
        "lowest sole above the surface last touched",
        |s| s.lowest_sole() - s.ground,
    ),
    scalar(
        "footing_front",
        "m",
        "front end of the footing (base of support, or the soles while nothing supports) ahead of the capture point",
        |s| footing(s)[1] - s.capture_point,
    ),
    scalar(
        "footing_rear",
        "m",
        "capture point ahead of the rear end of the footing",
        |s| s.capture_point - footing(s)[0],
    ),
];

fn footing(now: &Sensors) -> [f64; 2] {
    now.base_of_support.unwrap_or_else(|| now.soles())
}

fn middle([rear, front]: [f64; 2]) -> f64 {
    0.5 * (rear + front)
}

#[cfg(test)]
mod tests {
    use crate::character::Model;
    use crate::sensing::feature::Feature;
    use crate::sensing::sensors::Sensors;

    fn value(feature: &str, now: &Sensors) -> f64 {
        feature.parse::<Feature>().unwrap().value(now)
    }

    #[test]
    fn what_is_told_from_the_feet_exists_in_the_air() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        let lift = 0.4;
        now.state.q[1] += lift;
        (now.state.qdot[0], now.ground) = (0.5, 0.1);
        now.derive();
        assert_eq!(now.base_of_support, None);
        // Both feet are below the hips, which are at the root's x.
        let (foot, com) = (&model.feet[0], model.standing_com());
        let ahead = com[0] - 0.5 * (foot.heel[0] + foot.toe[0]);
        let to_capture = 0.5 * ((com[1] + lift - 0.1) / 9.81).sqrt();
        for (feature, expected) in [
            ("com_from_feet", ahead),
            ("capture_from_feet", ahead + to_capture),
            ("com_over_feet", com[1]),
            ("feet_height", lift - 0.1),
            ("footing_front", now.soles()[1] - com[0] - to_capture),
            ("footing_rear", com[0] + to_capture - now.soles()[0]),
        ] {
            let found = value(feature, &now);
            assert!(
                (found - expected).abs() < 1e-12,
                "{feature}: {found} for {expected}"
            );
        }
    }

    #[test]
    fn the_feet_are_taken_together() {
        let model = Model::load("humanoid").unwrap();
        let mut now = Sensors::new(&model, 9.81);
        let (right, left) = (
            model.joint_index("hip_r").unwrap(),
            model.joint_index("hip_l"),
        );
        (now.state.q[3 + right], now.state.q[3 + left.unwrap()]) = (0.3, -0.3);
        now.derive();
        let [rear, front] = now.soles();
        assert!(front - rear > now.feet_apart() && now.feet_apart() > 0.3);
        let lowest = now.lowest_sole();
        let ends = [
            model.feet[0].toe,
            model.feet[0].heel,
            model.feet[1].toe,
            model.feet[1].heel,
        ];
        for (i, end) in ends.into_iter().enumerate() {
            let [x, y] = now.kinematics.point(model.feet[i / 2].link, end);
            assert!(x >= rear && x <= front && y >= lowest, "({x}, {y})");
        }
    }
}

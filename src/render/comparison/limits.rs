//! Limits of standing that depend on no implementation, over position and velocity of the centre of
//! mass: the zero-step limit of the linear inverted pendulum, and what is feasible for humans.
//!
//! character, feature → lines in the feature's unit and in m/s.

use aplomb_framework::character::Model;

/// m/s², as in the rollouts.
const GRAVITY: f64 = 9.81;
/// Feasible states of standing humans (Pai and Patton 1997), moving forward: centre of mass ahead
/// of the heel in foot lengths, velocity in body heights a second. Upper boundary from behind to
/// the toe, lower from the heel to behind.
const FEASIBLE: [[f64; 2]; 5] = [
    [-2.4, 1.1],
    [0.0, 0.45],
    [1.0, 0.0],
    [0.0, 0.0],
    [-2.7, 0.9],
];
/// The one character that has human proportions.
const HUMAN: &str = "humanoid";
/// Its body height, m, after its file.
pub(super) const STATURE: f64 = 1.75;

/// Limits for a feature along x and the forward velocity of the centre of mass along y.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Limits {
    /// Where standing begins and ends, as values of the feature: at the heels, at the toes.
    pub(super) sole: [f64; 2],
    /// Forward, m/s, for each unit of the feature: the slope of the capture point's lines.
    slope: f64,
    /// Corners of the region that is feasible for humans; none of other characters.
    pub(super) feasible: Option<[[f64; 2]; 5]>,
}

impl Limits {
    /// None for other features and unknown characters.
    pub(super) fn new(character: &str, x: &str, y: &str) -> Option<Self> {
        if y != "com_velocity_x" {
            return None;
        }
        let model = Model::load(character).ok()?;
        let foot = model.feet.first()?;
        let length = foot.toe[0] - foot.heel[0];
        let rate = (GRAVITY / model.standing_com()[1]).sqrt();
        // From the position ahead of the heels to the feature.
        let (sign, shift) = match x {
            // With parallel feet both are from the middle of the soles.
            "com_offset" | "com_from_feet" => (1.0, -0.5 * length),
            "com_rear" => (1.0, 0.0),
            "com_front" => (-1.0, length),
            _ => return None,
        };
        let feature = |ahead: f64| sign * ahead + shift;
        let human = model.name == HUMAN;
        let corner = |[feet, bodies]: [f64; 2]| [feature(feet * length), bodies * STATURE];
        Some(Self {
            sole: [feature(0.0), feature(length)],
            slope: -sign * rate,
            feasible: human.then(|| FEASIBLE.map(corner)),
        })
    }

    /// The velocity, m/s, at which the capture point of a position lies over an end of the sole.
    pub(super) fn velocity(&self, end: f64, x: f64) -> f64 {
        self.slope * (x - end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64) {
        assert!(
            (a - b).abs() < 2e-3 * b.abs().max(1.0),
            "{a} instead of {b}"
        );
    }

    #[test]
    fn the_humanoids_limits_are_those_of_its_segments() {
        let limits = Limits::new("humanoid", "com_offset", "com_velocity_x").unwrap();
        let [heel, toe] = limits.sole;
        near(toe - heel, 0.254);
        near(toe + heel, 0.0);
        // Standing, the centre of mass is 0.1135 m ahead of the heels: 80 kg take 35.5 N·s
        // forward and 28.6 backward without a step.
        near(80.0 * limits.velocity(toe, heel + 0.1135), 35.5);
        near(80.0 * limits.velocity(heel, heel + 0.1135), -28.6);
        // Over the heel both limits nearly agree.
        let feasible = limits.feasible.unwrap();
        near(feasible[1][0], heel);
        near(feasible[1][1], 0.7875);
        assert!((limits.velocity(toe, heel) - feasible[1][1]).abs() < 0.03);
        near(feasible[2][0], toe);
        near(feasible[0][0], heel - 2.4 * 0.254);
    }

    #[test]
    fn the_same_limits_are_told_of_distances_to_either_end() {
        let of = |x: &str| Limits::new("humanoid", x, "com_velocity_x").unwrap();
        let (offset, front) = (of("com_offset"), of("com_front"));
        near(front.sole[1], 0.0);
        let half = offset.sole[1];
        let velocity = |l: &Limits, x: f64| l.velocity(l.sole[1], x);
        near(velocity(&offset, 0.03), velocity(&front, half - 0.03));
        near(of("com_rear").sole[0], 0.0);
    }

    #[test]
    fn other_planes_and_characters_have_none() {
        assert_eq!(
            Limits::new("humanoid", "com_height", "com_velocity_x"),
            None
        );
        assert_eq!(Limits::new("humanoid", "com_offset", "trunk_rate"), None);
        assert_eq!(Limits::new("nobody", "com_offset", "com_velocity_x"), None);
    }
}

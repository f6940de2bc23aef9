//! A stable hash of a character's numbers, by which what was learned with it knows it again.
//!
//! model → 64 bits (XXH3).

use xxhash_rust::xxh3::Xxh3;

use crate::character::model::definition::{Link, Model};
use crate::character::muscle::Muscles;
use crate::character::shape::Point;

/// Everything that moves, holds and limits the character: tree, joint names, masses, inertias,
/// lengths, outlines, ranges, muscles, servos, feet, hands and flesh. Neither the layout of its file nor
/// its comments, nor the names of its links.
pub(crate) fn digest(model: &Model) -> u64 {
    let mut hash = Hash(Xxh3::new());
    let (links, feet, hands) = (&model.links, &model.feet, &model.hands);
    for count in [
        links.len(),
        feet.len(),
        hands.len(),
        model.trunk,
        model.head,
    ] {
        hash.count(count);
    }
    for link in links {
        hash.link(link);
    }
    for foot in feet {
        hash.count(foot.link);
        hash.points(&[foot.heel, foot.toe]);
    }
    for hand in hands {
        hash.count(hand.link);
        hash.points(&[hand.tip]);
    }
    if let Some(flesh) = &model.flesh {
        hash.numbers(&[flesh.stiffness, flesh.gives]);
    }
    hash.0.digest()
}

struct Hash(Xxh3);

impl Hash {
    fn count(&mut self, n: usize) {
        self.0.update(&(n as u64).to_le_bytes());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for x in numbers {
            self.0.update(&x.to_le_bytes());
        }
    }

    fn points(&mut self, points: &[Point]) {
        points.iter().for_each(|p| self.numbers(p));
    }

    fn muscles(&mut self, muscles: &Muscles) {
        let (positive, negative) = (&muscles.positive, &muscles.negative);
        self.numbers(&[positive.torque]);
        if (positive.speeds, negative) != (None, positive) {
            self.numbers(&[negative.torque]);
            for speeds in [positive.speeds, negative.speeds] {
                self.numbers(&speeds.unwrap_or([f64::INFINITY; 2]));
            }
        }
    }

    fn link(&mut self, link: &Link) {
        self.numbers(&[link.mass, link.inertia]);
        self.points(&[link.com]);
        let (kind, numbers) = link.shape.numbers();
        self.count(kind);
        self.numbers(&numbers);
        if let Some(joint) = &link.joint {
            self.count(joint.name.len());
            self.0.update(joint.name.as_bytes());
            self.count(joint.parent);
            self.points(&[joint.anchor, joint.range]);
            self.muscles(&joint.muscles);
            self.numbers(&[joint.kp, joint.kd]);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::character::model::Model;
    use crate::input::Source;

    const HUMANOID: &str = include_str!("../../../characters/humanoid.ron");

    fn digest(text: &str) -> String {
        Model::parse(&Source::new("test.ron", text))
            .unwrap()
            .digest()
    }

    #[test]
    fn a_digest_follows_the_numbers_and_not_the_layout() {
        let plain = digest(HUMANOID);
        assert_eq!(plain.len(), 16);
        assert_eq!(plain, digest(&format!("// Another comment.\n{HUMANOID}")));
        for (from, to) in [
            ("mass: 8.936", "mass: 8.937"),
            ("torque: 350.0", "torque: 351.0"),
            ("speeds: (1.578, 3.19)", "speeds: (1.6, 3.19)"),
            ("stiffness: 3000.0", "stiffness: 3001.0"),
            ("name: \"waist\"", "name: \"loin\""),
            ("trunk: \"torso\"", "trunk: \"pelvis\""),
            ("radius: 0.045", "radius: 0.046"),
        ] {
            assert!(HUMANOID.contains(from), "{from}");
            assert_ne!(plain, digest(&HUMANOID.replacen(from, to, 1)), "{to}");
        }
    }

    /// What was learned with a character holds in the worlds in which it was learned, and some of
    /// these vary strength and mass.
    #[test]
    fn a_varied_character_is_still_the_character() {
        let model = Model::load("humanoid").unwrap();
        assert_eq!(model.varied(0.8, 1.1).digest(), model.digest());
    }
}

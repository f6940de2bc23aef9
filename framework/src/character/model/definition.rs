//! A character as data: links, joints, limits, feet.
//!
//! character file (RON) → [`Model`] → dynamics, body, sensors.

use std::sync::Arc;

use serde::Deserialize;

use crate::character::muscle::Muscles;
use crate::character::shape::{Point, Shape};
use crate::input::{Error, Result};

/// At most this many links a character.
pub const MOST_LINKS: usize = 128;

/// A hinge between a link and its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Unique name, as in poses and features.
    pub name: String,
    /// The parent's place in [`Model::links`].
    pub parent: usize,
    /// The hinge in the parent's frame; it is the origin of the child's.
    pub anchor: Point,
    /// Lowest and highest angle, rad.
    pub range: [f64; 2],
    /// What its muscles can do.
    pub muscles: Muscles,
    /// Nominal servo stiffness, N·m/rad.
    pub kp: f64,
    /// Nominal servo damping, N·m·s/rad.
    pub kd: f64,
}

/// A rigid body of the character.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Unique name.
    pub name: String,
    /// Its hinge; none for the root, which is the first link.
    pub joint: Option<Joint>,
    /// kg
    pub mass: f64,
    /// Centre of mass in the link's frame.
    pub com: Point,
    /// About the centre of mass, kg·m².
    pub inertia: f64,
    /// Outline for contact and drawing.
    pub shape: Shape,
}

/// A foot: a link that is stood on.
#[derive(Debug, Clone, PartialEq)]
pub struct Foot {
    /// Its place in [`Model::links`].
    pub link: usize,
    /// Rear end of the sole, in the link's frame.
    pub heel: Point,
    /// Front end of the sole.
    pub toe: Point,
}

/// How limbs that meet press each other apart: F = k d (1 + (d/g)⁶) at an overlap d of their outlines.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flesh {
    /// k, N/m: of the first touch.
    pub stiffness: f64,
    /// g, m: the overlap at which the force is twice that, and beyond which it rises steeply.
    pub gives: f64,
}

/// A hand: the point of a link that reaches for things and breaks falls.
#[derive(Debug, Clone, PartialEq)]
pub struct Hand {
    /// Its place in [`Model::links`].
    pub link: usize,
    /// In the link's frame.
    pub tip: Point,
}

/// A validated character. Degrees of freedom: root x, y, pitch, then the joints in the order of
/// their links.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Name of the character.
    pub name: String,
    /// The root first, every parent before its children.
    pub links: Vec<Link>,
    /// At least one.
    pub feet: Vec<Foot>,
    /// May be empty.
    pub hands: Vec<Hand>,
    /// The link whose angle is the trunk's pitch.
    pub trunk: usize,
    /// The link to be kept off the ground.
    pub head: usize,
    /// What trunk and head are like where they meet the legs; they pass through each other if there is none.
    pub flesh: Option<Flesh>,
    /// The character file's text, so that a recording can carry its character.
    pub source: String,
    pub(super) digest: u64,
    pub(super) total_mass: f64,
    pub(super) standing_height: f64,
    pub(super) standing_com: Point,
}

impl Model {
    /// The same character with stronger or weaker muscles and heavier or lighter links: factors of
    /// all torque limits, and of all masses and inertias. Its digest stays.
    #[must_use]
    pub fn varied(self: &Arc<Self>, torque: f64, mass: f64) -> Arc<Self> {
        if (torque, mass) == (1.0, 1.0) {
            return Arc::clone(self);
        }
        let mut model = Self::clone(self);
        for link in &mut model.links {
            link.mass *= mass;
            link.inertia *= mass;
            if let Some(joint) = &mut link.joint {
                joint.muscles = joint.muscles.scaled(torque);
            }
        }
        model.total_mass *= mass;
        Arc::new(model)
    }

    /// 16 hexadecimal digits that are the same as long as the character's numbers are: those of its
    /// file, however it is [`varied`](Self::varied).
    #[must_use]
    pub fn digest(&self) -> String {
        format!("{:016x}", self.digest)
    }

    /// Number of degrees of freedom: three of the root and one a joint.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.links.len() + 2
    }

    /// Number of joints, which is the length of every torque and pose vector.
    #[must_use]
    pub fn joint_count(&self) -> usize {
        self.links.len() - 1
    }

    /// The joints in the order of torques and poses: joint `j` turns link `j + 1` and is degree of
    /// freedom `j + 3`.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = &Joint> {
        self.links[1..].iter().map(|l| {
            l.joint
                .as_ref()
                .unwrap_or_else(|| unreachable!("only the root has no joint"))
        })
    }

    /// Mass of all links, kg.
    #[must_use]
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Height of the root's origin above the sole when all joints are 0, m.
    #[must_use]
    pub fn standing_height(&self) -> f64 {
        self.standing_height
    }

    /// Centre of mass when standing with all joints 0: ahead of the root's origin, and above the
    /// sole, m.
    #[must_use]
    pub fn standing_com(&self) -> Point {
        self.standing_com
    }

    /// Place of the joint with this name among the joints.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the joint names.
    pub fn joint_index(&self, name: &str) -> Result<usize> {
        self.joints()
            .position(|j| j.name == name)
            .ok_or_else(|| Error::unknown("joint", name, self.joints().map(|j| j.name.as_str())))
    }

    /// Place of the link with this name.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the link names.
    pub fn link_index(&self, name: &str) -> Result<usize> {
        self.links
            .iter()
            .position(|l| l.name == name)
            .ok_or_else(|| Error::unknown("link", name, self.links.iter().map(|l| l.name.as_str())))
    }

    /// The joint of the other side (`hip_r` ↔ `hip_l`), or the joint itself if it has none.
    #[must_use]
    pub fn mirrored_joint(&self, joint: usize) -> usize {
        let name = &self.links[joint + 1]
            .joint
            .as_ref()
            .map_or("", |j| j.name.as_str());
        let other = if let Some(stem) = name.strip_suffix("_r") {
            format!("{stem}_l")
        } else if let Some(stem) = name.strip_suffix("_l") {
            format!("{stem}_r")
        } else {
            return joint;
        };
        self.joint_index(&other).unwrap_or(joint)
    }

    /// Whether the link is a foot.
    #[must_use]
    pub fn is_foot(&self, link: usize) -> bool {
        self.feet.iter().any(|f| f.link == link)
    }

    /// Whether a foot hangs on the link.
    #[must_use]
    pub fn is_shank(&self, link: usize) -> bool {
        let parent = |f: &Foot| self.links[f.link].joint.as_ref().map(|j| j.parent);
        self.feet.iter().any(|f| parent(f) == Some(link))
    }

    /// The hinge of a shank that hangs on the link, in the link's frame: the end that is knelt on.
    #[must_use]
    pub fn knee(&self, link: usize) -> Option<Point> {
        let hinge = |(i, l): (usize, &Link)| {
            let joint = l.joint.as_ref().filter(|j| j.parent == link)?;
            self.is_shank(i).then_some(joint.anchor)
        };
        self.links.iter().enumerate().find_map(hinge)
    }

    /// Whether the character sits on the link: the root, or a link that a shank hangs on.
    #[must_use]
    pub fn is_seat(&self, link: usize) -> bool {
        let hangs = |l: &Link| l.joint.as_ref().is_some_and(|j| j.parent == link);
        let mut links = self.links.iter().enumerate();
        link == 0 || links.any(|(i, l)| self.is_shank(i) && hangs(l))
    }

    /// Whether the link ends in a hand.
    #[must_use]
    pub fn is_hand(&self, link: usize) -> bool {
        self.hands.iter().any(|h| h.link == link)
    }
}

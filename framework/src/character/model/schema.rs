//! The schema of a character file.

use serde::Deserialize;

use crate::character::model::definition::Flesh;
use crate::character::muscle::Muscles;
use crate::character::shape::{Point, Shape};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CharacterFile {
    pub(super) name: String,
    pub(super) trunk: String,
    pub(super) head: String,
    #[serde(default)]
    pub(super) flesh: Option<Flesh>,
    #[serde(default)]
    pub(super) hands: Vec<HandEntry>,
    #[serde(default)]
    pub(super) feet: Vec<FootEntry>,
    pub(super) links: Vec<LinkEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FootEntry {
    pub(super) link: String,
    pub(super) heel: Point,
    pub(super) toe: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HandEntry {
    pub(super) link: String,
    pub(super) tip: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkEntry {
    pub(super) name: String,
    #[serde(default)]
    pub(super) joint: Option<JointEntry>,
    pub(super) mass: f64,
    pub(super) com: Point,
    pub(super) inertia: f64,
    pub(super) shape: Shape,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointEntry {
    pub(super) name: String,
    pub(super) parent: String,
    pub(super) anchor: Point,
    pub(super) range: [f64; 2],
    /// N·m either way and at every speed; or `muscles`.
    #[serde(default)]
    pub(super) torque: Option<f64>,
    #[serde(default)]
    pub(super) muscles: Option<Muscles>,
    pub(super) kp: f64,
    pub(super) kd: f64,
}

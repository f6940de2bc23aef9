//! A person: which piece of a body, and of its clothes, a link is.
//!
//! model, link → pieces. Proportions are those of a side view in anatomy books, about the radii of
//! the character's own capsules; neighbours share a disc at their joint, so that no angle parts them.

use aplomb_framework::character::{Model, Shape};

use super::anatomy::{Dress, stem};
use super::{Patch, arms, head, legs, trunk};

/// The pieces of a link of a person; none if its name or its shape is another's.
pub(super) fn pieces(model: &Model, link: usize) -> Vec<Patch> {
    let dress = if model.name == "sumo" {
        Dress::Belt
    } else {
        Dress::Clothes
    };
    let round = matches!(model.links[link].shape, Shape::Capsule { .. });
    let found = match (stem(model, link), round) {
        ("pelvis", true) => trunk::pelvis(model, link, dress),
        ("torso", true) => trunk::torso(model, link, dress),
        ("head", true) => Some(head::pieces(model, link, dress)),
        ("upper_arm", true) => arms::upper_arm(model, link, dress),
        ("forearm", true) => arms::forearm(model, link),
        ("thigh", true) => legs::thigh(model, link, dress),
        ("shank", true) => legs::shank(model, link, dress),
        ("foot", false) => Some(legs::foot(model, link, dress)),
        _ => None,
    };
    found.unwrap_or_default()
}

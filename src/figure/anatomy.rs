//! The links of a body: how they are called, where they are joined, how thick a person is there.
//!
//! model, link → names, joints, radii.

use aplomb_framework::character::{Model, Point};

use super::plain::thickness;

/// What a person wears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dress {
    Clothes,
    Belt,
}

/// Lines begin so many radii away from a joint: where a limb leaves the trunk, and where it bends.
pub(super) const SEAM: f64 = 1.25;
pub(super) const BEND: f64 = 1.03;

/// A link's name without its side.
pub(super) fn stem(model: &Model, link: usize) -> &str {
    let name = &model.links[link].name;
    let stem = name.strip_suffix("_r").or_else(|| name.strip_suffix("_l"));
    stem.unwrap_or(name)
}

/// The link with a name that hangs on another.
pub(super) fn child(model: &Model, link: usize, name: &str) -> Option<usize> {
    let hangs = |l: &usize| {
        let joint = model.links[*l].joint.as_ref();
        joint.is_some_and(|j| j.parent == link) && stem(model, *l) == name
    };
    (0..model.links.len()).find(hangs)
}

/// Where a link turns, in its parent's frame, m.
pub(super) fn anchor(model: &Model, link: usize) -> Point {
    let joint = model.links[link].joint.as_ref();
    joint.map_or([0.0; 2], |j| j.anchor)
}

/// The radius of the disc that a link and its parent share at their joint, m.
pub(super) fn joint(model: &Model, link: usize) -> f64 {
    let own = thickness(&model.links[link].shape);
    let parent = model.links[link].joint.as_ref().map_or(link, |j| j.parent);
    let above = thickness(&model.links[parent].shape);
    match stem(model, link) {
        "torso" => 0.46 * (own + above),
        "head" => 0.6 * own,
        "upper_arm" => 1.28 * own,
        "forearm" => 0.5 * (own + above),
        "thigh" => 1.25 * own,
        "shank" => 0.65 * above + 0.35 * own,
        "foot" => 0.8 * above,
        _ => own,
    }
}

//! A lion: fur, a mane about head and chest, paws, a tail with a tuft.
//!
//! model, link → pieces. As for a person, neighbours share a disc at their joint.

use std::f64::consts::TAU;

use aplomb_framework::character::{Model, Point, Shape};
use aplomb_framework::math::sin_cos;

use super::anatomy::{anchor, child, stem};
use super::curve::{Taper, smooth, soft};
use super::plain::{stroke, thickness};
use super::{Patch, Tone};

/// Locks around a mane.
const LOCKS: usize = 13;

/// Whether a character is one: it has paws and a tail.
pub(super) fn is(model: &Model) -> bool {
    let has = |name: &str| (0..model.links.len()).any(|l| stem(model, l) == name);
    has("paw") && has("tail_1")
}

/// The pieces of a link; none if its name or its shape is another's.
pub(super) fn pieces(model: &Model, link: usize) -> Vec<Patch> {
    let round = matches!(model.links[link].shape, Shape::Capsule { .. });
    let r = thickness(&model.links[link].shape);
    let radius = |l: usize| joint(model, l);
    let next = |name: &str| child(model, link, name);
    let found = match (stem(model, link), round) {
        ("pelvis", true) => next("torso").map(|t| {
            let rump = 0.93 * r;
            trunk(anchor(model, t), [rump, radius(t)], [1.0 * r, 1.06 * r])
        }),
        ("torso", true) => next("chest").map(|c| {
            trunk(
                anchor(model, c),
                [radius(link), radius(c)],
                [1.0 * r, 1.0 * r],
            )
        }),
        ("chest", true) => next("head").map(|h| chest(model, link, h)),
        ("head", true) => Some(head(model, link)),
        ("upper_arm", true) => next("forearm").map(|f| {
            leg(
                anchor(model, f),
                [radius(link), radius(f)],
                [0.35, 1.02, 1.05],
            )
        }),
        ("forearm", true) => next("paw").map(|p| {
            leg(
                anchor(model, p),
                [radius(link), radius(p)],
                [0.25, 1.06, 1.02],
            )
        }),
        ("thigh", true) => next("shank").map(|s| {
            leg(
                anchor(model, s),
                [radius(link), radius(s)],
                [0.3, 1.08, 1.1],
            )
        }),
        ("shank", true) => next("foot").map(|f| {
            leg(
                anchor(model, f),
                [radius(link), radius(f)],
                [0.25, 1.0, 1.12],
            )
        }),
        ("paw", true) => Some(paw(model, link)),
        ("foot", false) => Some(foot(model, link)),
        (name, true) if name.starts_with("tail_") => Some(tail(model, link)),
        _ => None,
    };
    found.unwrap_or_default()
}

/// The radius of the disc that a link and its parent share at their joint, m.
fn joint(model: &Model, link: usize) -> f64 {
    let own = thickness(&model.links[link].shape);
    let parent = model.links[link].joint.as_ref().map_or(link, |j| j.parent);
    let above = thickness(&model.links[parent].shape);
    match stem(model, link) {
        "upper_arm" | "thigh" => 1.25 * own,
        "foot" => 0.85 * above,
        "paw" => 0.9 * above,
        _ => 0.5 * (own + above),
    }
}

/// A section of the trunk from its joint upward; `bulge` is the half width at the middle behind and
/// before, m.
fn trunk(to: Point, [start, end]: [f64; 2], bulge: [f64; 2]) -> Vec<Patch> {
    let outline = Taper {
        from: [0.0; 2],
        to,
        front: &[(0.0, start), (0.5, bulge[0]), (1.0, end)],
        back: &[(0.0, start), (0.5, bulge[1]), (1.0, end)],
        round: [1.0; 2],
    };
    let seams = [([0.0; 2], 1.2 * start), (to, 1.2 * end)];
    vec![Patch::seamed(Tone::Fur, outline.outline(), &seams)]
}

/// The chest, with the lower mane on it.
fn chest(model: &Model, link: usize, head: usize) -> Vec<Patch> {
    let r = thickness(&model.links[link].shape);
    let neck = anchor(model, head);
    let mut pieces = trunk(
        [neck[0], neck[1] - 0.3 * r],
        [joint(model, link), 0.85 * r],
        [1.03 * r, 1.1 * r],
    );
    let middle = [neck[0] + 0.1 * r, neck[1] - 0.15 * r];
    pieces.push(Patch::edged(Tone::Mane, mane(middle, [1.05 * r, 1.12 * r])));
    pieces
}

/// An ellipse of locks.
fn mane(middle: Point, half: Point) -> Vec<Point> {
    let corners = (0..2 * LOCKS).map(|i| {
        let (sin, cos) = sin_cos(TAU * i as f64 / (2 * LOCKS) as f64);
        let lock = if i % 2 == 0 { 1.06 } else { 0.92 };
        let place = [
            middle[0] + lock * half[0] * cos,
            middle[1] + lock * half[1] * sin,
        ];
        (place, if i % 2 == 0 { 0.01 } else { 0.05 })
    });
    soft(&corners.collect::<Vec<_>>())
}

/// A head in profile, looking to +x.
fn head(model: &Model, link: usize) -> Vec<Patch> {
    let shape = &model.links[link].shape;
    let (middle, r) = (shape.middle(), thickness(shape));
    let at = |x: f64, y: f64| -> Point { [middle[0] + x * r, middle[1] + y * r] };
    let line = |points: &[(f64, f64)]| points.iter().map(|(x, y)| at(*x, *y)).collect::<Vec<_>>();
    let neck = stroke([0.0; 2], at(-0.2, -0.2), joint(model, link));
    let mane = mane(at(-0.3, 0.0), [1.25 * r, 1.45 * r]);
    let face = soft(
        &[
            (-0.3, 0.75, 0.3),
            (0.3, 0.98, 0.3),
            (0.72, 0.62, 0.2),
            (0.82, 0.38, 0.1),
            (1.28, 0.16, 0.1),
            (1.4, -0.02, 0.08),
            (1.36, -0.32, 0.12),
            (1.22, -0.62, 0.15),
            (0.75, -0.78, 0.2),
            (0.2, -0.7, 0.3),
            (-0.35, -0.3, 0.4),
        ]
        .map(|(x, y, c)| (at(x, y), c * r)),
    );
    let nose = smooth(&line(&[
        (1.18, 0.16),
        (1.42, 0.12),
        (1.46, -0.08),
        (1.26, -0.08),
    ]));
    let eye = smooth(&line(&[
        (0.5, 0.36),
        (0.68, 0.32),
        (0.72, 0.46),
        (0.52, 0.5),
    ]));
    let ear = smooth(&line(&[
        (-0.35, 0.8),
        (-0.42, 1.25),
        (0.0, 1.35),
        (0.25, 0.98),
        (0.0, 0.75),
    ]));
    vec![
        Patch::plain(Tone::Mane, neck),
        Patch::edged(Tone::Mane, mane),
        Patch::edged(Tone::Fur, face).with(line(&[
            (1.3, -0.1),
            (1.2, -0.34),
            (0.95, -0.42),
            (0.78, -0.34),
        ])),
        Patch::plain(Tone::Hair, nose),
        Patch::plain(Tone::Hair, eye),
        Patch::edged(Tone::Fur, ear),
    ]
}

/// A section of a leg; `bulge`: where it is thickest, and how much front and back bulge there.
fn leg(to: Point, [start, end]: [f64; 2], [place, front, back]: [f64; 3]) -> Vec<Patch> {
    let between = start + place * (end - start);
    let outline = Taper {
        from: [0.0; 2],
        to,
        front: &[(0.0, start), (place, front * between), (1.0, end)],
        back: &[(0.0, start), (place, back * between), (1.0, end)],
        round: [1.0; 2],
    };
    let seams = [([0.0; 2], 1.3 * start), (to, 0.9 * end)];
    vec![Patch::seamed(Tone::Fur, outline.outline(), &seams)]
}

/// A forepaw, bent forward at its tip.
fn paw(model: &Model, link: usize) -> Vec<Patch> {
    let Shape::Capsule { radius: r, to, .. } = model.links[link].shape else {
        return Vec::new();
    };
    let wrist = joint(model, link);
    let hand = Taper {
        from: [0.0; 2],
        to,
        front: &[(0.0, wrist), (0.6, 1.02 * r), (1.0, r)],
        back: &[(0.0, wrist), (1.0, r)],
        round: [1.0; 2],
    };
    let toe = |x: f64| {
        let tip = [to[0] + x * r, to[1] - 0.9 * r];
        vec![tip, [tip[0] + 0.15 * r, tip[1] + 0.5 * r]]
    };
    let paw = Patch::seamed(Tone::Fur, hand.outline(), &[([0.0; 2], 1.25 * wrist)]);
    vec![paw.with(toe(-0.1)).with(toe(0.35))]
}

/// A hind foot that stands on the whole of its sole.
fn foot(model: &Model, link: usize) -> Vec<Patch> {
    let shape = &model.links[link].shape;
    let ([x, y], [wide, high]) = (shape.middle(), shape.reach());
    let ankle = joint(model, link);
    let (length, height) = (2.0 * wide, 2.0 * high);
    let at = |along: f64, up: f64| [x - wide + along * length, y - high + up * height];
    let outline = soft(&[
        (at(0.01, 0.0), 0.03),
        (at(0.98, 0.0), 0.02),
        (at(1.01, 0.45), 0.03),
        (at(0.94, 0.9), 0.03),
        (at(0.78, 1.0), 0.04),
        (at(0.55, 0.72), 0.06),
        ([1.1 * ankle, 0.1 * ankle], 0.04),
        ([0.9 * ankle, 0.8 * ankle], 0.03),
        ([-0.9 * ankle, 0.8 * ankle], 0.03),
        (at(-0.02, 0.8), 0.05),
    ]);
    let toe = |x: f64| vec![at(x, 0.1), at(x - 0.02, 0.4)];
    let foot = Patch::seamed(Tone::Fur, outline, &[([0.0; 2], 1.15 * ankle)]);
    vec![foot.with(toe(0.86)).with(toe(0.94))]
}

/// A section of the tail; the last one ends in a tuft.
fn tail(model: &Model, link: usize) -> Vec<Patch> {
    let shape = &model.links[link].shape;
    let Shape::Capsule {
        radius: r,
        from,
        to,
    } = *shape
    else {
        return Vec::new();
    };
    let next = (0..model.links.len()).any(|l| {
        let joint = model.links[l].joint.as_ref();
        joint.is_some_and(|j| j.parent == link)
    });
    if next {
        let seams = [([0.0; 2], 1.2 * r), (to, 1.2 * r)];
        return vec![Patch::seamed(Tone::Fur, stroke(from, to, r), &seams)];
    }
    let tuft = Taper {
        from,
        to,
        front: &[(0.0, 0.6 * r), (0.5, 1.2 * r), (1.0, 0.5 * r)],
        back: &[(0.0, 0.6 * r), (0.5, 1.2 * r), (1.0, 0.5 * r)],
        round: [1.0; 2],
    };
    vec![Patch::edged(Tone::Mane, tuft.outline())]
}

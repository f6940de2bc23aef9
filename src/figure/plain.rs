//! A link that is nothing known: its physical outline, with bridges over the gaps at its joints.
//!
//! link → pieces.

use aplomb_framework::character::{Model, Outline, Point, Shape};

use super::curve::{Taper, inside, soft};
use super::{Patch, Tone};

/// A bridge is so thick beside the thinner of what it joins.
const BRIDGE: f64 = 0.75;

/// Half of a shape's thickness, m.
pub(super) fn thickness(shape: &Shape) -> f64 {
    shape.nearest(shape.middle()).1
}

/// What a link is covered with whose name says nothing.
pub(super) fn tone(model: &Model, link: usize) -> Tone {
    let descends = |from: usize| {
        std::iter::successors(Some(from), |l| {
            model.links[*l].joint.as_ref().map(|j| j.parent)
        })
        .any(|l| l == link)
    };
    if model.is_foot(link) {
        Tone::Shoe
    } else if link == model.head || model.is_hand(link) {
        Tone::Skin
    } else if link == model.trunk {
        Tone::Shirt
    } else if model.feet.iter().any(|f| descends(f.link)) {
        Tone::Trousers
    } else {
        Tone::Shirt
    }
}

/// The outline that touches the world.
pub(super) fn physical(model: &Model, link: usize) -> Patch {
    let Outline { corners, radius } = model.links[link].shape.outline();
    let outline = if let [a, b] = corners[..] {
        stroke(a, b, radius)
    } else {
        let half = radius.max(0.004);
        soft(&corners.into_iter().map(|c| (c, half)).collect::<Vec<_>>())
    };
    Patch::edged(tone(model, link), outline)
}

/// All points within a radius of a segment.
pub(super) fn stroke(from: Point, to: Point, radius: f64) -> Vec<Point> {
    let side = [(0.0, radius), (1.0, radius)];
    Taper {
        from,
        to,
        front: &side,
        back: &side,
        round: [1.0; 2],
    }
    .outline()
}

/// Bridges from a link's pieces to the joints that they do not reach: its own, and its children's.
pub(super) fn bridges(model: &Model, link: usize, pieces: &[Patch]) -> Vec<Patch> {
    let shape = &model.links[link].shape;
    let tone = pieces.first().map_or(tone(model, link), |p| p.tone);
    let joint = |l: usize| model.links[l].joint.as_ref();
    let own = joint(link).map(|j| ([0.0; 2], j.parent));
    let children = (0..model.links.len()).filter_map(|l| {
        let joint = joint(l).filter(|j| j.parent == link)?;
        Some((joint.anchor, l))
    });
    let mut bridges = Vec::new();
    for (at, neighbour) in own.into_iter().chain(children) {
        let thin = thickness(&model.links[neighbour].shape).min(thickness(shape));
        let radius = BRIDGE * thin;
        let around = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.0, 0.0]];
        let covered = around.iter().all(|d| {
            let p = [at[0] + 0.6 * radius * d[0], at[1] + 0.6 * radius * d[1]];
            pieces.iter().any(|piece| inside(&piece.outline, p))
        });
        if !covered {
            let (own, _) = shape.nearest(at);
            bridges.push(Patch::plain(tone, stroke(at, own, radius)));
        }
    }
    bridges
}

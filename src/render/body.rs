//! Draws a character: filled limbs in layers, the far side darker and behind, a face that shows
//! where it looks.

use aplomb_framework::character::{Kinematics, Link, Model, Outline, Point, State};
use svg::node::element::{Circle, Group, Polyline};

use super::camera::Camera;
use super::style::{line, points, polygon, px};

/// The colours of one character.
#[derive(Debug, Clone, Copy)]
pub(super) struct Skin {
    pub(super) near: &'static str,
    pub(super) middle: &'static str,
    pub(super) far: &'static str,
    edge: &'static str,
}

/// A skin a character, in turn.
pub(super) const SKINS: [Skin; 3] = [
    Skin {
        near: "#8fbbe0",
        middle: "#c3d9ec",
        far: "#3f6488",
        edge: "#16283a",
    },
    Skin {
        near: "#ecb27d",
        middle: "#f5d8bb",
        far: "#95602f",
        edge: "#3b2410",
    },
    Skin {
        near: "#a9c99a",
        middle: "#d3e4ca",
        far: "#55784a",
        edge: "#1f3018",
    },
];

/// World poses of all links for recorded positions.
pub(super) fn pose(model: &Model, q: &[f32]) -> Kinematics {
    let mut kinematics = Kinematics::new(model);
    let state = State {
        q: q.iter().map(|x| f64::from(*x)).collect(),
        qdot: vec![0.0; q.len()],
    };
    kinematics.update(model, &state);
    kinematics
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Far,
    Middle,
    Near,
}

/// The camera stands at the right of a character that faces +x.
fn side(link: &Link) -> Side {
    if link.name.ends_with("_r") {
        Side::Near
    } else if link.name.ends_with("_l") {
        Side::Far
    } else {
        Side::Middle
    }
}

/// Links of the same side that hang together, each in its own layer, from back to front.
fn layers(model: &Model) -> Vec<(Side, Vec<usize>)> {
    let mut layers: Vec<(Side, Vec<usize>)> = Vec::new();
    for (i, link) in model.links.iter().enumerate() {
        let parent = link.joint.as_ref().map(|j| j.parent);
        let same = layers
            .iter_mut()
            .find(|(s, limb)| *s == side(link) && parent.is_some_and(|p| limb.contains(&p)));
        match same {
            Some((_, limb)) => limb.push(i),
            None => layers.push((side(link), vec![i])),
        }
    }
    let pick = |wanted| layers.iter().filter(move |(s, _)| *s == wanted).cloned();
    let (far, middle) = (pick(Side::Far), pick(Side::Middle));
    far.chain(middle)
        .chain(pick(Side::Near).collect::<Vec<_>>().into_iter().rev())
        .collect()
}

/// A piece of a limb, world frame, m: two corners are a thick line with round ends.
type Piece = Outline;

fn pieces(model: &Model, poses: &Kinematics, limb: &[usize]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for &i in limb {
        let link = &model.links[i];
        let world = |p: Point| poses.point(i, p);
        let Outline { corners, radius } = link.shape.outline();
        pieces.push(Piece {
            corners: corners.into_iter().map(world).collect(),
            radius,
        });
        // Bridges between the outlines of neighbours, such as the neck.
        let Some(joint) = &link.joint else { continue };
        let parent = &model.links[joint.parent];
        let (own, radius) = link.shape.nearest([0.0, 0.0]);
        let (others, other_radius) = parent.shape.nearest(joint.anchor);
        let share = if i == model.head { 0.6 } else { 0.85 };
        let thin = share * radius.min(other_radius);
        pieces.push(stroke(world([0.0, 0.0]), world(own), thin));
        if limb.contains(&joint.parent) {
            let from = poses.point(joint.parent, others);
            pieces.push(stroke(from, world([0.0, 0.0]), thin));
        }
    }
    let finite = |p: &Point| p[0].is_finite() && p[1].is_finite();
    pieces.retain(|p| p.corners.iter().all(finite));
    pieces
}

/// A thick line with round ends.
fn stroke(from: Point, to: Point, radius: f64) -> Piece {
    Piece {
        corners: vec![from, to],
        radius,
    }
}

/// The pieces in one colour, `wider` px on all sides.
fn fill(pieces: &[Piece], camera: &Camera, colour: &str, wider: f64) -> Group {
    let mut group = Group::new()
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round");
    for piece in pieces {
        let corners: Vec<Point> = piece.corners.iter().map(|c| camera.at(*c)).collect();
        let width = 2.0 * (piece.radius * camera.scale + wider);
        group = if let [a, mut b] = corners[..] {
            b[0] += 0.01; // a line without length has no round ends in some viewers
            group.add(line(a, b, colour, width))
        } else {
            let shape = polygon(&corners, colour).set("stroke", colour);
            // Slightly rounded; the outline grows by as much as lines do.
            group.add(shape.set("stroke-width", px(width)))
        };
    }
    group
}

/// Nose and eye: whoever faces +x when upright looks to the right.
fn face(model: &Model, poses: &Kinematics, camera: &Camera, skin: &Skin) -> Option<Group> {
    let shape = &model.links[model.head].shape;
    let (middle, up) = (shape.middle(), shape.reach()[1]);
    let (_, forward) = shape.nearest(middle);
    let world =
        |x: f64, y: f64| poses.point(model.head, [middle[0] + x * forward, middle[1] + y * up]);
    let nose = [
        world(0.8, 0.12),
        world(1.0, 0.1),
        world(1.34, -0.2),
        world(0.96, -0.22),
        world(0.8, -0.22),
    ];
    let eye = world(0.52, 0.2);
    if !nose.iter().chain([&eye]).flatten().all(|x| x.is_finite()) {
        return None;
    }
    let edge = outline_width(camera);
    let eye = camera.at(eye);
    let nose = nose.map(|p| camera.at(p));
    Some(
        Group::new()
            .add(
                Polyline::new()
                    .set("points", points(&nose[1..4]))
                    .set("fill", skin.middle)
                    .set("stroke", skin.edge)
                    .set("stroke-width", px(edge))
                    .set("stroke-linejoin", "round"),
            )
            .add(polygon(&[nose[0], nose[1], nose[3], nose[4]], skin.middle))
            .add(
                Circle::new()
                    .set("cx", px(eye[0]))
                    .set("cy", px(eye[1]))
                    .set("r", px((0.15 * forward * camera.scale).max(0.8)))
                    .set("fill", skin.edge),
            ),
    )
}

/// px
fn outline_width(camera: &Camera) -> f64 {
    (0.011 * camera.scale).clamp(0.6, 2.0)
}

/// The character in a pose; links with positions that are no numbers are left out.
pub(super) fn draw(model: &Model, poses: &Kinematics, camera: &Camera, skin: &Skin) -> Group {
    let mut group = Group::new();
    for (side, limb) in layers(model) {
        let colour = match side {
            Side::Far => skin.far,
            Side::Middle => skin.middle,
            Side::Near => skin.near,
        };
        let pieces = pieces(model, poses, &limb);
        group = group.add(fill(&pieces, camera, skin.edge, outline_width(camera)));
        group = group.add(fill(&pieces, camera, colour, 0.0));
        if limb.contains(&model.head)
            && let Some(face) = face(model, poses, camera, skin)
        {
            group = group.add(face);
        }
    }
    group
}

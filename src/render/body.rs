//! Draws a character: its figure, link by link, in its colours, the far side darker.
//!
//! model → outlines, written once a picture; pose, camera → where each of them is drawn.

use aplomb_framework::character::{Kinematics, Model, Outline, Point, State};
use svg::node::element::{Definitions, Ellipse, Group, Path, Use};

use super::camera::Camera;
use super::style::{INK, SHADOW, px};
use super::wardrobe::{colour, sign};
use crate::figure::{FigurePart, figure};

/// Outlines are written in so many units per m.
const UNITS: f64 = 1000.0;
/// Links up to this height cast a shadow, m.
const SHADOWY: f64 = 0.5;

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

/// What one character of a recording looks like, in every pose.
#[derive(Debug)]
pub(super) struct Looks {
    parts: Vec<FigurePart>,
    /// Its place in the cast.
    who: usize,
}

impl Looks {
    pub(super) fn new(model: &Model, who: usize) -> Self {
        Self {
            parts: figure(model),
            who,
        }
    }

    /// The colour that it is told apart by.
    pub(super) fn sign(&self) -> String {
        sign(self.who, &self.parts)
    }

    /// Whether it has limbs on a far side; their colour, near and far.
    pub(super) fn sides(&self) -> Option<[String; 2]> {
        let far = self.parts.iter().find(|p| p.far)?;
        Some([false, true].map(|side| colour(self.who, far.tone, side)))
    }

    fn name(&self, part: usize, lines: bool) -> String {
        format!("{}{}-{part}", if lines { "line" } else { "part" }, self.who)
    }

    /// Outlines and lines, to be used in every frame of a picture.
    pub(super) fn definitions(&self) -> Definitions {
        let mut definitions = Definitions::new();
        for (i, part) in self.parts.iter().enumerate() {
            let outline = format!("{}Z", path(&part.outline));
            let outline = Path::new().set("id", self.name(i, false)).set("d", outline);
            definitions = definitions.add(outline);
            if !part.lines.is_empty() {
                let lines: String = part.lines.iter().map(|l| path(l)).collect();
                let lines = Path::new().set("id", self.name(i, true)).set("d", lines);
                definitions = definitions.add(lines.set("fill", "none"));
            }
        }
        definitions
    }

    /// The character in a pose; links with positions that are no numbers are left out.
    pub(super) fn draw(&self, poses: &Kinematics, camera: &Camera) -> Group {
        let mut group = Group::new();
        let edge = edge_width(camera) / camera.scale * UNITS;
        let mut first = 0;
        for layer in self.parts.chunk_by(|a, b| a.layer == b.layer) {
            let numbered = (first..).zip(layer);
            first += layer.len();
            let seen: Vec<(usize, &FigurePart, String)> = numbered
                .filter_map(|(i, part)| Some((i, part, place(poses, part.link, camera)?)))
                .collect();
            let mut edges = Group::new()
                .set("fill", INK)
                .set("stroke", INK)
                .set("stroke-width", px(2.0 * edge))
                .set("stroke-linejoin", "round");
            let mut fills = Group::new()
                .set("stroke-width", px(0.8 * edge))
                .set("stroke-linecap", "round")
                .set("stroke-linejoin", "round");
            for (i, part, place) in seen {
                let used = |lines: bool| {
                    Use::new()
                        .set("href", format!("#{}", self.name(i, lines)))
                        .set("transform", place.as_str())
                };
                edges = edges.add(used(false));
                fills = fills.add(used(false).set("fill", colour(self.who, part.tone, part.far)));
                if !part.lines.is_empty() {
                    fills = fills.add(used(true).set("stroke", INK));
                }
            }
            group = group.add(edges).add(fills);
        }
        group
    }
}

/// px
fn edge_width(camera: &Camera) -> f64 {
    (0.010 * camera.scale).clamp(0.6, 2.0)
}

/// Points joined, in an SVG path's words.
fn path(points: &[Point]) -> String {
    let units = |x: f64| (x * UNITS * 10.0).round() / 10.0;
    let mut text = String::new();
    for (i, p) in points.iter().enumerate() {
        text += if i == 0 { "M" } else { "L" };
        text += &format!("{},{}", units(p[0]), units(p[1]));
    }
    text
}

/// The transformation from a link's units to the picture.
fn place(poses: &Kinematics, link: usize, camera: &Camera) -> Option<String> {
    let motion = &poses.links[link];
    let finite = motion
        .origin
        .iter()
        .chain(&motion.turn)
        .all(|x| x.is_finite());
    if !finite {
        return None;
    }
    let [x, y] = camera.at(motion.origin).map(px);
    let part = |x: f64| (x * camera.scale / UNITS * 1e6).round() / 1e6;
    let [cos, sin] = motion.turn.map(part);
    Some(format!("matrix({cos} {} {} {} {x} {y})", -sin, -sin, -cos))
}

/// Where the character keeps light from the ground: wider the nearer a link is.
pub(super) fn shadow(model: &Model, poses: &Kinematics, camera: &Camera) -> Group {
    let mut group = Group::new().set("fill", SHADOW);
    for (i, link) in model.links.iter().enumerate() {
        let Outline { corners, radius } = link.shape.outline();
        let world: Vec<Point> = corners.iter().map(|c| poses.point(i, *c)).collect();
        if !world.iter().flatten().all(|x| x.is_finite()) {
            continue;
        }
        let ends = |k: usize| {
            let all = || world.iter().map(|p| p[k]);
            [
                all().fold(f64::INFINITY, f64::min) - radius,
                all().fold(f64::NEG_INFINITY, f64::max) + radius,
            ]
        };
        let ([left, right], [low, _]) = (ends(0), ends(1));
        let near = 1.0 - (low / SHADOWY).max(0.0);
        if near <= 0.0 {
            continue;
        }
        let [x, y] = camera.at([0.5 * (left + right), 0.0]);
        let wide = (0.5 * (right - left) + 0.08 * near) * near * camera.scale;
        let high = (0.045 * near * camera.scale).min(0.4 * camera.ground);
        let ellipse = Ellipse::new()
            .set("cx", px(x))
            .set("cy", px(y + 0.5 * high))
            .set("rx", px(wide))
            .set("ry", px(high));
        group = group.add(ellipse);
    }
    group
}

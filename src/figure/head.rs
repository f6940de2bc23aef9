//! The head of a person in profile: it looks forward, to +x.
//!
//! head's capsule → face, hair, eye, ear.

use aplomb_framework::character::{Model, Point};

use super::anatomy::{Dress, joint};
use super::curve::{smooth, soft};
use super::plain::{stroke, thickness};
use super::{Patch, Tone};

/// Corners of face and skull, in radii ahead of the middle and in heights above the chin, with how
/// far each is rounded, in radii.
const FACE: [(f64, f64, f64); 20] = [
    (-0.45, 0.1, 0.2),
    (0.2, 0.08, 0.2),
    (0.7, -0.01, 0.2),
    (0.9, 0.05, 0.15),
    (0.86, 0.18, 0.06),
    (0.94, 0.23, 0.05),
    (0.9, 0.27, 0.03),
    (0.97, 0.3, 0.05),
    (0.93, 0.345, 0.05),
    (1.24, 0.36, 0.08),
    (1.22, 0.4, 0.08),
    (1.0, 0.53, 0.12),
    (0.98, 0.57, 0.06),
    (1.04, 0.63, 0.08),
    (1.0, 0.85, 0.5),
    (0.55, 1.02, 0.5),
    (-0.55, 1.04, 0.6),
    (-1.12, 0.8, 0.6),
    (-1.05, 0.4, 0.5),
    (-0.6, 0.22, 0.3),
];
const HAIR: [(f64, f64, f64); 15] = [
    (0.92, 0.76, 0.1),
    (1.03, 0.84, 0.15),
    (0.72, 1.02, 0.4),
    (0.1, 1.1, 0.4),
    (-0.65, 1.06, 0.6),
    (-1.24, 0.82, 0.6),
    (-1.16, 0.42, 0.4),
    (-0.78, 0.2, 0.15),
    (-0.5, 0.22, 0.1),
    (-0.42, 0.42, 0.15),
    (-0.1, 0.44, 0.05),
    (0.02, 0.38, 0.05),
    (0.12, 0.42, 0.05),
    (0.14, 0.62, 0.15),
    (0.45, 0.74, 0.2),
];
const EYE: [(f64, f64); 6] = [
    (0.64, 0.5),
    (0.8, 0.49),
    (0.86, 0.54),
    (0.8, 0.59),
    (0.64, 0.58),
    (0.56, 0.54),
];
const BROW: [(f64, f64); 3] = [(0.52, 0.635), (0.72, 0.655), (0.92, 0.63)];
const MOUTH: [(f64, f64); 2] = [(0.62, 0.255), (0.9, 0.27)];
const EAR: [(f64, f64); 6] = [
    (-0.2, 0.36),
    (-0.36, 0.44),
    (-0.34, 0.56),
    (-0.14, 0.56),
    (-0.08, 0.5),
    (-0.2, 0.42),
];

/// The head and its neck.
pub(super) fn pieces(model: &Model, link: usize, dress: Dress) -> Vec<Patch> {
    let neck = joint(model, link);
    let shape = &model.links[link].shape;
    let (middle, up, r) = (shape.middle(), shape.reach()[1], thickness(shape));
    let at = |x: f64, y: f64| -> Point { [middle[0] + x * r, middle[1] + (2.0 * y - 1.0) * up] };
    let line = |points: &[(f64, f64)]| points.iter().map(|(x, y)| at(*x, *y)).collect::<Vec<_>>();
    let shaped = |corners: &[(f64, f64, f64)]| {
        let corners: Vec<_> = corners
            .iter()
            .map(|(x, y, c)| (at(*x, *y), c * r))
            .collect();
        soft(&corners)
    };
    let seam = [([0.0; 2], 1.3 * neck)];
    let nape = stroke([0.0; 2], at(-0.2, 0.3), neck);
    let face = Patch::seamed(Tone::Skin, shaped(&FACE), &seam)
        .with(line(&MOUTH))
        .with(line(&BROW));
    let hair = Patch::edged(Tone::Hair, shaped(&HAIR));
    let eye = Patch::plain(Tone::Hair, smooth(&line(&EYE)));
    let ear = Patch::edged(Tone::Skin, smooth(&line(&EAR)));
    let mut pieces = vec![Patch::plain(Tone::Skin, nape), face, eye, ear, hair];
    if dress == Dress::Belt {
        let knot = [
            (-0.5, 0.98),
            (-0.45, 1.16),
            (0.1, 1.2),
            (0.2, 1.1),
            (0.0, 1.0),
        ];
        pieces.push(Patch::edged(Tone::Hair, smooth(&line(&knot))));
    }
    pieces
}

//! A person's trunk: hips, chest and back, and the root of the neck.
//!
//! capsules of pelvis and torso → trousers and shirt, or a bare body in a belt.

use aplomb_framework::character::Model;

use super::anatomy::{Dress, SEAM, anchor, child, joint};
use super::curve::{Taper, smooth, soft};
use super::plain::{stroke, thickness};
use super::{Patch, Tone};

pub(super) fn pelvis(model: &Model, link: usize, dress: Dress) -> Option<Vec<Patch>> {
    let torso = child(model, link, "torso")?;
    let thigh = child(model, link, "thigh")?;
    let (hip, waist) = (joint(model, thigh), joint(model, torso));
    let (from, to) = (anchor(model, thigh), anchor(model, torso));
    let r = thickness(&model.links[link].shape);
    let before = match dress {
        Dress::Clothes => 0.97 * r,
        Dress::Belt => 1.12 * r,
    };
    // The axis points up: its front is behind.
    let outline = Taper {
        from,
        to,
        front: &[(0.0, hip), (0.3, 1.13 * r), (0.65, 1.06 * r), (1.0, waist)],
        back: &[(0.0, hip), (0.5, before), (1.0, waist)],
        round: [1.0; 2],
    }
    .outline();
    if dress == Dress::Clothes {
        let seams = [(from, SEAM * hip), (to, 1.1 * waist)];
        return Some(vec![Patch::seamed(Tone::Trousers, outline, &seams)]);
    }
    let body = Patch::seamed(Tone::Skin, outline, &[(to, 1.1 * waist)]);
    // The belt goes around the waist and between the legs; its knot is behind.
    let at = |x: f64, y: f64| [x * r, y * r];
    let band = soft(&[
        (at(-1.13, 0.12), 0.02),
        (at(0.0, -0.1), 0.15),
        (at(1.1, 0.02), 0.03),
        (at(1.2, 0.4), 0.05),
        (at(1.16, 0.85), 0.02),
        (at(0.0, 0.72), 0.15),
        (at(-1.1, 0.9), 0.02),
    ]);
    let front = smooth(&[at(0.55, 0.4), at(0.3, -0.75), at(0.62, -0.75), at(1.0, 0.4)]);
    let knot = smooth(&[
        at(-1.0, 0.25),
        at(-1.29, 0.25),
        at(-1.33, 0.85),
        at(-1.0, 0.8),
    ]);
    let fold = |y: f64| vec![at(-1.08, y + 0.08), at(0.0, y - 0.1), at(1.14, y)];
    Some(vec![
        body,
        Patch::edged(Tone::Belt, front),
        Patch::edged(Tone::Belt, knot).over(),
        Patch::edged(Tone::Belt, band)
            .with(fold(0.3))
            .with(fold(0.6))
            .over(),
    ])
}

pub(super) fn torso(model: &Model, link: usize, dress: Dress) -> Option<Vec<Patch>> {
    let neck = anchor(model, child(model, link, "head")?);
    let waist = joint(model, link);
    let shape = &model.links[link].shape;
    let r = thickness(shape);
    let below = match dress {
        Dress::Clothes => 0.85 * r,
        Dress::Belt => 0.66 * r,
    };
    let top = [neck[0], neck[1] - below];
    // Where the trunk's middle line lies ahead of the axis.
    let ahead = |t: f64| shape.nearest([top[0], t * top[1]]).0[0] - t * top[0];
    let neck_radius = joint(model, child(model, link, "head")?);
    let seam = [([0.0; 2], 1.15 * waist)];
    let (tone, cap, hem) = match dress {
        Dress::Clothes => (Tone::Shirt, 0.68 * r, 0.55),
        Dress::Belt => (Tone::Skin, 0.66 * r, 0.7),
    };
    let (behind, before) = match dress {
        Dress::Clothes => (
            [(0.2, 0.84), (0.5, 0.93), (0.75, 1.0)],
            [(0.25, 0.88), (0.65, 1.08), (0.82, 0.98)],
        ),
        Dress::Belt => (
            [(0.2, 0.97), (0.5, 1.0), (0.75, 0.96)],
            [(0.14, 1.02), (0.36, 1.08), (0.68, 0.94)],
        ),
    };
    let side = |widths: [(f64, f64); 3], sign: f64| {
        let [a, b, c] = widths.map(|(t, width)| (t, width * r + sign * ahead(t)));
        [(0.0, waist), a, b, c, (1.0, cap)]
    };
    // The axis points up: its front is behind.
    let outline = Taper {
        from: [0.0; 2],
        to: top,
        front: &side(behind, -1.0),
        back: &side(before, 1.0),
        round: [hem, 1.0],
    }
    .outline();
    let base = [top[0], top[1] + 0.5 * r];
    let collar = Patch::plain(Tone::Skin, stroke(base, neck, neck_radius));
    let mut trunk = Patch::seamed(tone, outline, &seam);
    if dress == Dress::Belt {
        // The breast hangs over the belly.
        let at = |x: f64, y: f64| [x * r, y * top[1]];
        trunk = trunk.with(vec![at(0.5, 0.66), at(0.72, 0.6), at(0.95, 0.62)]);
    }
    Some(vec![collar, trunk])
}

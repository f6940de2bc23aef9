//! A person's legs: thigh, shank, and the foot in its shoe.
//!
//! capsules of a leg, box of a foot → pieces.

use aplomb_framework::character::Model;

use super::anatomy::{BEND, Dress, anchor, child, joint};
use super::curve::{Taper, soft};
use super::{Patch, Tone};

pub(super) fn thigh(model: &Model, link: usize, dress: Dress) -> Option<Vec<Patch>> {
    let shank = child(model, link, "shank")?;
    let (hip, knee) = (joint(model, link), joint(model, shank));
    let to = anchor(model, shank);
    let between = |t: f64, factor: f64| (t, factor * (hip + t * (knee - hip)));
    let outline = Taper {
        from: [0.0; 2],
        to,
        front: &[
            (0.0, hip),
            between(0.3, 1.07),
            between(0.7, 1.04),
            (1.0, knee),
        ],
        back: &[
            (0.0, hip),
            between(0.4, 0.99),
            between(0.8, 0.94),
            (1.0, knee),
        ],
        round: [1.0; 2],
    }
    .outline();
    let tone = match dress {
        Dress::Clothes => Tone::Trousers,
        Dress::Belt => Tone::Skin,
    };
    let seams = [([0.0; 2], 1.45 * hip), (to, 0.9 * knee)];
    Some(vec![Patch::seamed(tone, outline, &seams)])
}

pub(super) fn shank(model: &Model, link: usize, dress: Dress) -> Option<Vec<Patch>> {
    let foot = child(model, link, "foot")?;
    let (knee, ankle) = (joint(model, link), joint(model, foot));
    let to = anchor(model, foot);
    let between = |t: f64, factor: f64| (t, factor * (knee + t * (ankle - knee)));
    let calf = between(0.3, 1.12);
    let leg = Taper {
        from: [0.0; 2],
        to,
        front: &[
            (0.0, knee),
            between(0.25, 0.95),
            between(0.6, 0.95),
            (1.0, ankle),
        ],
        back: &[
            (0.0, knee),
            between(0.1, 1.0),
            calf,
            between(0.75, 0.92),
            (1.0, ankle),
        ],
        round: [1.0; 2],
    };
    let seams = [([0.0; 2], BEND * knee), (to, 1.05 * ankle)];
    if dress == Dress::Belt {
        return Some(vec![Patch::seamed(Tone::Skin, leg.outline(), &seams)]);
    }
    let hem = 1.2 * ankle;
    let trousers = Taper {
        front: &[
            (0.0, knee),
            between(0.25, 0.98),
            between(0.6, 1.0),
            (1.0, hem),
        ],
        back: &[
            (0.0, knee),
            between(0.1, 1.0),
            calf,
            between(0.75, 1.06),
            (1.0, hem),
        ],
        round: [1.0, 0.35],
        ..leg
    };
    Some(vec![Patch::seamed(
        Tone::Trousers,
        trousers.outline(),
        &seams[..1],
    )])
}

/// A shoe, or a bare foot, on the sole of the physical foot.
pub(super) fn foot(model: &Model, link: usize, dress: Dress) -> Vec<Patch> {
    let shape = &model.links[link].shape;
    let ([x, y], [wide, high]) = (shape.middle(), shape.reach());
    let (heel, toe, sole) = (x - wide, x + wide, y - high);
    let length = toe - heel;
    let ankle = joint(model, link);
    // Lengths of the sole ahead of the heel, and above the sole.
    let at = |along: f64, up: f64| [heel + along * length, sole + up * length];
    let seam = [([0.0; 2], 1.1 * ankle)];
    match dress {
        Dress::Clothes => {
            let outline = soft(&[
                (at(0.005, 0.0), 0.012),
                (at(0.96, 0.0), 0.02),
                (at(1.0, 0.075), 0.02),
                (at(0.93, 0.17), 0.03),
                (at(0.66, 0.23), 0.06),
                ([1.0 * ankle, 0.5 * ankle], 0.03),
                ([0.9 * ankle, 0.95 * ankle], 0.01),
                ([-1.1 * ankle, 0.85 * ankle], 0.01),
                (at(0.03, 0.2), 0.03),
                (at(-0.005, 0.08), 0.02),
            ]);
            let welt = vec![at(0.0, 0.065), at(0.5, 0.06), at(0.985, 0.075)];
            vec![Patch::seamed(Tone::Shoe, outline, &seam).with(welt)]
        }
        Dress::Belt => {
            let outline = soft(&[
                (at(0.01, 0.0), 0.03),
                (at(0.96, 0.0), 0.015),
                (at(1.0, 0.05), 0.02),
                (at(0.95, 0.12), 0.02),
                (at(0.72, 0.17), 0.06),
                ([1.0 * ankle, 0.3 * ankle], 0.04),
                ([0.9 * ankle, 0.8 * ankle], 0.02),
                ([-0.9 * ankle, 0.8 * ankle], 0.02),
                (at(0.03, 0.2), 0.03),
                (at(-0.005, 0.1), 0.03),
            ]);
            let toes = vec![at(0.86, 0.09), at(0.9, 0.045), at(0.99, 0.05)];
            vec![Patch::seamed(Tone::Skin, outline, &seam).with(toes)]
        }
    }
}

//! A person's arms: upper arm with its sleeve, forearm, hand.
//!
//! capsules of an arm → pieces.

use aplomb_framework::character::Model;
use aplomb_framework::math::hypot;

use super::anatomy::{BEND, Dress, SEAM, anchor, child, joint};
use super::curve::{Taper, smooth};
use super::plain::thickness;
use super::{Patch, Tone};

pub(super) fn upper_arm(model: &Model, link: usize, dress: Dress) -> Option<Vec<Patch>> {
    let forearm = child(model, link, "forearm")?;
    let (shoulder, elbow) = (joint(model, link), joint(model, forearm));
    let to = anchor(model, forearm);
    let r = thickness(&model.links[link].shape);
    let front = [(0.0, shoulder), (0.45, 1.08 * r), (1.0, elbow)];
    let back = [(0.0, shoulder), (0.5, 1.02 * r), (1.0, elbow)];
    let arm = Taper {
        from: [0.0; 2],
        to,
        front: &front,
        back: &back,
        round: [1.0; 2],
    };
    let seams = [([0.0; 2], SEAM * shoulder), (to, 0.8 * elbow)];
    let mut pieces = vec![Patch::seamed(Tone::Skin, arm.outline(), &seams)];
    if dress == Dress::Clothes {
        let part = 0.56;
        let hem = 1.22 * r;
        let sleeve = Taper {
            to: to.map(|x| part * x),
            front: &[(0.0, shoulder), (0.6, 1.2 * r), (1.0, hem)],
            back: &[(0.0, shoulder), (0.6, 1.2 * r), (1.0, hem)],
            round: [1.0, 0.15],
            ..arm
        };
        pieces.push(Patch::seamed(Tone::Shirt, sleeve.outline(), &seams[..1]));
    }
    Some(pieces)
}

/// Forearm and hand.
pub(super) fn forearm(model: &Model, link: usize) -> Option<Vec<Patch>> {
    let hand = model.hands.iter().find(|h| h.link == link)?;
    let elbow = joint(model, link);
    let r = thickness(&model.links[link].shape);
    let length = hypot(hand.tip[0], hand.tip[1]).max(1e-9);
    let down = hand.tip.map(|x| x / length);
    let front = [-down[1], down[0]];
    let wrist = length - 2.0 * r;
    // In radii: ahead of the arm's axis, and beyond the wrist.
    let at = |x: f64, y: f64| [0, 1].map(|k| (wrist + y * r) * down[k] + x * r * front[k]);
    let arm = Taper {
        from: [0.0; 2],
        to: at(0.0, 0.0),
        front: &[
            (0.0, elbow),
            (0.25, 1.12 * elbow),
            (0.7, 0.92 * r),
            (1.0, 0.76 * r),
        ],
        back: &[
            (0.0, elbow),
            (0.25, 1.02 * elbow),
            (0.7, 0.86 * r),
            (1.0, 0.76 * r),
        ],
        round: [1.0; 2],
    };
    let wrist_seam = (at(0.0, 0.0), 0.85 * r);
    let arm = Patch::seamed(
        Tone::Skin,
        arm.outline(),
        &[([0.0; 2], BEND * elbow), wrist_seam],
    );
    let palm = smooth(&[
        at(-0.7, -0.5),
        at(-0.95, 0.5),
        at(-1.0, 1.6),
        at(-0.75, 2.8),
        at(-0.2, 3.25),
        at(0.55, 3.2),
        at(0.95, 2.6),
        at(0.95, 1.2),
        at(0.7, -0.5),
    ]);
    let thumb = smooth(&[
        at(0.1, 0.1),
        at(0.9, 0.2),
        at(1.4, 1.1),
        at(1.45, 2.1),
        at(1.05, 2.15),
        at(0.5, 1.2),
    ]);
    let palm = Patch::seamed(Tone::Skin, palm, &[wrist_seam]);
    let between = [-0.42, 0.0, 0.42].map(|x| vec![at(x, 3.0), at(x, 1.9)]);
    let fingers = between.into_iter().fold(palm, Patch::with);
    let thumb = Patch::seamed(Tone::Skin, thumb, &[(at(0.2, 0.3), 1.0 * r)]);
    Some(vec![arm, fingers, thumb])
}

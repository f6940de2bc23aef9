//! Where the soles are, and what of the ground can carry.
//!
//! sensors → stretches of world x.

use aplomb_framework::sensing::Sensors;

use crate::momentum::sole_centre;

/// The middle of a foot's sole, world, m.
pub(super) fn sole(now: &Sensors, foot: usize) -> [f64; 2] {
    let f = &now.model.feet[foot];
    now.kinematics.point(f.link, sole_centre(f))
}

/// Rear and front end of a foot's sole, world x, m.
pub(super) fn ends(now: &Sensors, foot: usize) -> [f64; 2] {
    let f = &now.model.feet[foot];
    let [a, b] = [f.heel, f.toe].map(|p| now.kinematics.point(f.link, p)[0]);
    [a.min(b), a.max(b)]
}

/// Whether x lies outside of a stretch by more than a margin, m.
pub(super) fn beyond(x: f64, [rear, front]: [f64; 2], margin: f64) -> bool {
    x > front + margin || x < rear - margin
}

/// Height below which a sole is as good as on the ground: it only has to be pressed, m.
const NEAR: f64 = 0.03;

/// The stretch of the ground that can carry: the support, and every sole that hangs just above the
/// ground. A foot that is unloaded for a moment is no reason to step.
pub(super) fn carried(now: &Sensors) -> Option<[f64; 2]> {
    let mut span = now.base_of_support?;
    for foot in 0..2 {
        if sole(now, foot)[1] - now.ground < NEAR {
            let [rear, front] = ends(now, foot);
            span = [span[0].min(rear), span[1].max(front)];
        }
    }
    Some(span)
}

/// The foot whose sole is nearer to the capture point.
pub(super) fn nearer(now: &Sensors) -> usize {
    let [a, b] = [0, 1].map(|foot| (now.capture_point - sole(now, foot)[0]).abs());
    usize::from(b < a)
}

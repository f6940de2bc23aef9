//! What is drawn over and under the bodies: centre of mass, centre of pressure, base of support,
//! ground reaction force, pushes.

use aplomb_framework::run::Moment;
use svg::node::element::{Circle, Group, Path};

use super::camera::{Camera, mark_size};
use super::style::{FORCE, INK, PUSH, SUPPORT, arrow, line, polygon, px, text, text_width};

/// Length of the arrow for a force as large as the character's weight, m.
pub(super) const WEIGHT_ARROW: f64 = 0.6;
/// Longest arrow, in weights.
const LONGEST: f64 = 2.2;
/// Length of a push's arrow, m, and its growth with the impulse, m per N·s.
const PUSH_ARROW: [f64; 2] = [0.25, 0.003];

/// The usual sign of a centre of mass: a disc in quarters.
pub(super) fn com_sign(at: [f64; 2], radius: f64) -> Group {
    let (x, y, r) = (px(at[0]), px(at[1]), px(radius));
    let quarters = format!(
        "M{x},{y} V{top} A{r},{r} 0 0 1 {right},{y} Z M{x},{y} V{low} A{r},{r} 0 0 1 {left},{y} Z",
        top = px(y - r),
        right = px(x + r),
        low = px(y + r),
        left = px(x - r),
    );
    let disc = Circle::new().set("cx", x).set("cy", y).set("r", r);
    Group::new()
        .add(
            disc.set("fill", "#ffffff")
                .set("stroke", INK)
                .set("stroke-width", px(0.22 * r)),
        )
        .add(Path::new().set("d", quarters).set("fill", INK))
}

/// A triangle under the ground that points at the centre of pressure.
pub(super) fn cop_sign(at: [f64; 2], size: f64) -> Group {
    let [x, y] = at;
    let corners = [
        [x, y + 0.4],
        [x + 0.62 * size, y + 1.3 * size],
        [x - 0.62 * size, y + 1.3 * size],
    ];
    Group::new().add(
        polygon(&corners, FORCE)
            .set("stroke", "#ffffff")
            .set("stroke-width", 0.8)
            .set("paint-order", "stroke"),
    )
}

/// The base of support, as a thick line on the ground.
pub(super) fn support_sign(from: [f64; 2], to: [f64; 2], size: f64) -> Group {
    let width = 0.8 * size;
    let middle = from[1] + width / 2.0;
    let (a, mut b) = ([from[0], middle], [to[0], middle]);
    b[0] = b[0].max(a[0] + 0.6 * size);
    Group::new().add(line(a, b, SUPPORT, width))
}

/// Marks behind the body: the base of support.
pub(super) fn behind(moment: &Moment<'_>, camera: &Camera) -> Group {
    let size = 4.5 * camera.mark_size();
    let mut group = Group::new();
    if let Some([rear, front]) = moment.support
        && rear.is_finite()
        && front.is_finite()
    {
        let [a, b] = [rear, front].map(|x| camera.at([f64::from(x), 0.0]));
        group = group.add(support_sign(a, b, size));
    }
    group
}

/// The ground reaction force as an arrow from the centre of pressure: its direction and length, in
/// weights; none if an arrow would be all head.
fn force_arrow(moment: &Moment<'_>, weight: f64, scale: f64, size: f64) -> Option<[f64; 2]> {
    let force = moment.force.map(|f| f64::from(f) / weight.max(1e-9));
    let amount = force[0].hypot(force[1]);
    let long = amount.is_finite() && amount * WEIGHT_ARROW * scale > 2.0 * size;
    long.then(|| force.map(|f| f * amount.min(LONGEST) / amount))
}

/// Whether the ground reaction force is drawn at this scale, in px per m; `weight` in N.
pub(super) fn shows_force(moment: &Moment<'_>, weight: f64, scale: f64) -> bool {
    let known = moment.cop.is_some_and(f32::is_finite);
    known && force_arrow(moment, weight, scale, 4.5 * mark_size(scale)).is_some()
}

/// Marks before the body: ground reaction force, centre of pressure, centre of mass with its plumb
/// line.
/// `weight` in N.
pub(super) fn before(moment: &Moment<'_>, weight: f64, camera: &Camera) -> Group {
    let size = 4.5 * camera.mark_size();
    let mut group = Group::new();
    let com = moment.com.map(f64::from);
    let finite_com = com.iter().all(|x| x.is_finite());
    if finite_com {
        let (top, foot) = (camera.at(com), camera.at([com[0], 0.0]));
        let dashes = format!("{0},{0}", px(0.55 * size));
        group = group.add(line(top, foot, INK, 0.2 * size).set("stroke-dasharray", dashes));
    }
    if let Some(cop) = moment.cop.map(f64::from).filter(|x| x.is_finite()) {
        let at = camera.at([cop, 0.0]);
        if let Some(force) = force_arrow(moment, weight, camera.scale, size) {
            let [x, y] = force.map(|f| f * WEIGHT_ARROW * camera.scale);
            let tip = [at[0] + x, at[1] - y];
            group = group.add(arrow(at, tip, FORCE, 0.55 * size));
        }
        group = group.add(cop_sign(at, size));
    }
    if finite_com {
        group = group.add(com_sign(camera.at(com), size));
    }
    group
}

/// A push's arrow ends at the link it pushes; its impulse in N·s stands at its tail. Several at
/// once, numbered by `place`, are drawn one below the other.
pub(super) fn push(
    at: [f64; 2],
    impulse: [f64; 2],
    opacity: f64,
    place: usize,
    camera: &Camera,
) -> Group {
    let amount = impulse[0].hypot(impulse[1]);
    if !(amount.is_finite() && amount > 0.0 && at.iter().all(|x| x.is_finite())) {
        return Group::new();
    }
    let size = camera.mark_size();
    let length = (PUSH_ARROW[0] + PUSH_ARROW[1] * amount).min(0.75) * camera.scale;
    let mut tip = camera.at(at);
    tip[1] += 13.0 * size.max(1.0) * place as f64;
    let (ux, uy) = (impulse[0] / amount, -impulse[1] / amount);
    let tail = [tip[0] - ux * length, tip[1] - uy * length];
    let label = format!("{amount:.0} N·s");
    let font = (9.5 * size).max(9.5);
    // Beyond the tail if the picture has room there, else above the shaft, short of what is pushed.
    let room = text_width(&label, font) + 6.0;
    let (x, y, anchor) = if ux > 0.5 && tail[0] > room {
        (tail[0] - 4.0, tail[1] + 0.36 * font, "end")
    } else if ux < -0.5 && tail[0] < camera.width - room {
        (tail[0] + 4.0, tail[1] + 0.36 * font, "start")
    } else {
        let above = tail[1].min(tip[1]) - 0.9 * font;
        // As far from the body as the picture allows.
        if ux > 0.5 {
            let left = tail[0].min(tip[0] - 16.0 - room);
            (left.max(3.0), above, "start")
        } else if ux < -0.5 {
            let right = tail[0].max(tip[0] + 16.0 + room);
            (right.min(camera.width - 3.0), above, "end")
        } else {
            let x = tail[0].clamp(room / 2.0, camera.width - room / 2.0);
            (x, above, "middle")
        }
    };
    Group::new()
        .set("opacity", px(opacity))
        .add(arrow(tail, tip, PUSH, 3.4 * size))
        .add(text([x, y], font, PUSH, anchor, &label).set("font-weight", "bold"))
}

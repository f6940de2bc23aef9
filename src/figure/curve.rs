//! Closed outlines of bodies: limbs that taper between two joints, and polygons with soft corners.
//!
//! axis, half widths along it → outline; corners → outline; outline → the lines drawn on it.

use std::f64::consts::PI;

use aplomb_framework::character::Point;
use aplomb_framework::math::{hypot, sin_cos};

/// Steps along a limb's side, and around each of its ends.
const STEPS: [usize; 2] = [12, 10];
/// Points on a soft corner.
const CORNER: usize = 5;

/// Half widths in m at places along an axis, from 0 at its start to 1 at its end.
pub(super) type Profile<'a> = &'a [(f64, f64)];

/// A piece of a body about an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Taper<'a> {
    /// Where it starts, m.
    pub(super) from: Point,
    /// Where it ends.
    pub(super) to: Point,
    /// On the forward side of an axis that points down.
    pub(super) front: Profile<'a>,
    /// On the other side. Both sides agree at the ends.
    pub(super) back: Profile<'a>,
    /// How far start and end are rounded out: 1 is half a disc, 0 is flat.
    pub(super) round: [f64; 2],
}

impl Taper<'_> {
    /// Its outline, counter-clockwise.
    pub(super) fn outline(&self) -> Vec<Point> {
        let d = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let length = hypot(d[0], d[1]).max(1e-9);
        let along = [d[0] / length, d[1] / length];
        let front = [-along[1], along[0]];
        let at = |t: f64, side: f64, beyond: f64| {
            let way = t * length + beyond;
            [0, 1].map(|k| self.from[k] + way * along[k] + side * front[k])
        };
        let mut outline = Vec::new();
        let places = || (0..=STEPS[0]).map(|i| i as f64 / STEPS[0] as f64);
        let end = |t: f64, profile: Profile<'_>, sign: f64, round: f64| {
            let radius = width(profile, t);
            (1..STEPS[1]).map(move |i| {
                let (sin, cos) = sin_cos(PI * i as f64 / STEPS[1] as f64);
                (t, sign * radius * cos, round * radius * sin)
            })
        };
        // Down the back, around the end, up the front, around the start.
        outline.extend(places().map(|t| at(t, -width(self.back, t), 0.0)));
        outline.extend(end(1.0, self.back, -1.0, self.round[1]).map(|(t, s, b)| at(t, s, b)));
        let up = places().collect::<Vec<_>>().into_iter().rev();
        outline.extend(up.map(|t| at(t, width(self.front, t), 0.0)));
        outline.extend(end(0.0, self.front, 1.0, self.round[0]).map(|(t, s, b)| at(t, s, -b)));
        counter_clockwise(outline)
    }
}

/// A half width between the places that are given: a smooth curve through all of them.
fn width(profile: Profile<'_>, t: f64) -> f64 {
    let last = profile.len() - 1;
    let i = (1..last).find(|i| t < profile[*i].0).unwrap_or(last).max(1) - 1;
    let [(t0, w0), (t1, w1)] = [profile[i], profile[(i + 1).min(last)]];
    let slope = |k: usize| {
        let (a, b) = (profile[k.saturating_sub(1)], profile[(k + 1).min(last)]);
        (b.1 - a.1) / (b.0 - a.0).max(1e-9)
    };
    let span = t1 - t0;
    let s = ((t - t0) / span.max(1e-9)).clamp(0.0, 1.0);
    let (a, b) = (slope(i) * span, slope((i + 1).min(last)) * span);
    let (s2, s3) = (s * s, s * s * s);
    (2.0 * s3 - 3.0 * s2 + 1.0) * w0
        + (s3 - 2.0 * s2 + s) * a
        + (3.0 * s2 - 2.0 * s3) * w1
        + (s3 - s2) * b
}

/// A polygon with soft corners: each is cut off at most so far from it, in m, but no further than
/// half its sides.
pub(super) fn soft(corners: &[(Point, f64)]) -> Vec<Point> {
    let n = corners.len();
    let mut outline = Vec::new();
    for (i, &(corner, most)) in corners.iter().enumerate() {
        let [before, after] = [corners[(i + n - 1) % n].0, corners[(i + 1) % n].0];
        let cut = |other: Point| {
            let d = [other[0] - corner[0], other[1] - corner[1]];
            let length = hypot(d[0], d[1]).max(1e-9);
            let part = (most / length).min(0.5);
            [corner[0] + part * d[0], corner[1] + part * d[1]]
        };
        let (a, b) = (cut(before), cut(after));
        outline.extend((0..=CORNER).map(|k| {
            let t = k as f64 / CORNER as f64;
            [0, 1].map(|k| {
                (1.0 - t) * (1.0 - t) * a[k] + 2.0 * t * (1.0 - t) * corner[k] + t * t * b[k]
            })
        }));
    }
    let same = |a: &Point, b: &Point| hypot(a[0] - b[0], a[1] - b[1]) < 1e-9;
    outline.dedup_by(|a, b| same(a, b));
    if outline.len() > 1 && same(&outline[0], &outline[outline.len() - 1]) {
        outline.pop();
    }
    counter_clockwise(outline)
}

/// A smooth closed curve inside its corners.
pub(super) fn smooth(corners: &[Point]) -> Vec<Point> {
    let corners: Vec<_> = corners.iter().map(|c| (*c, f64::INFINITY)).collect();
    soft(&corners)
}

/// Twice the area, positive if counter-clockwise.
pub(super) fn area(outline: &[Point]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let pairs = outline.iter().zip(next);
    pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn counter_clockwise(mut outline: Vec<Point>) -> Vec<Point> {
    if area(&outline) < 0.0 {
        outline.reverse();
    }
    outline
}

/// Whether a point lies inside an outline.
pub(super) fn inside(outline: &[Point], p: Point) -> bool {
    let next = outline.iter().cycle().skip(1);
    let crossed = outline.iter().zip(next).filter(|(a, b)| {
        let across = (a[1] > p[1]) != (b[1] > p[1]);
        across && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// The parts of an outline that lie outside all the discs, each (middle, radius in m).
pub(super) fn outside(outline: &[Point], discs: &[(Point, f64)]) -> Vec<Vec<Point>> {
    let kept = |p: &Point| {
        let far = |(c, r): &(Point, f64)| hypot(p[0] - c[0], p[1] - c[1]) > *r;
        discs.iter().all(far)
    };
    let n = outline.len();
    // Begin behind a gap, so that no part is cut in two where the outline closes.
    let Some(start) = (0..n).find(|i| !kept(&outline[*i])) else {
        let mut closed = outline.to_vec();
        closed.extend(outline.first());
        return vec![closed];
    };
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut open = false;
    for p in (0..n).map(|i| outline[(start + i) % n]) {
        if !kept(&p) {
            open = false;
        } else if let Some(part) = parts.last_mut().filter(|_| open) {
            part.push(p);
        } else {
            parts.push(vec![p]);
            open = true;
        }
    }
    parts.retain(|part| part.len() > 1);
    parts
}

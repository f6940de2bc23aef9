//! One panel of a plot, most often over time: axes with units, lines with gaps, bands.

mod axes;

use svg::node::element::{Group, Polyline, SVG};

use super::scene::window;
use super::style::points;
pub(super) use axes::{even, logarithmic};

/// A chart's place in the picture and what it spans.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chart {
    /// Upper left corner of the plotting area, px.
    pub(super) at: [f64; 2],
    /// Its size, px.
    pub(super) size: [f64; 2],
    /// Leftmost and rightmost value along x; of plots over time first and last time, s.
    pub(super) span: [f64; 2],
    /// Lowest and highest value.
    pub(super) value: [f64; 2],
}

/// The range of all finite values with some air, at least so wide.
pub(super) fn range(values: impl Iterator<Item = f64>, least: f64) -> [f64; 2] {
    let finite = values.filter(|v| v.is_finite() && v.abs() < 1e9);
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
        [a.min(v), b.max(v)]
    });
    if low > high {
        return [-0.5 * least, 0.5 * least];
    }
    let air = (0.06 * (high - low)).max(0.5 * (least - (high - low)));
    [low - air, high + air]
}

impl Chart {
    /// px from the left of the plotting area.
    fn x(&self, along: f64) -> f64 {
        (along - self.span[0]) / (self.span[1] - self.span[0]) * self.size[0]
    }

    /// px from its top.
    fn y(&self, value: f64) -> f64 {
        (self.value[1] - value) / (self.value[1] - self.value[0]) * self.size[1]
    }

    /// Picture x of a value along x, px.
    pub(super) fn across(&self, along: f64) -> f64 {
        self.at[0] + self.x(along)
    }

    /// A point within the plotting area, px from its upper left corner.
    pub(super) fn inside(&self, [along, value]: [f64; 2]) -> [f64; 2] {
        [self.x(along), self.y(value)]
    }

    /// The same in the picture, px.
    pub(super) fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.inside(point);
        [self.at[0] + x, self.at[1] + y]
    }

    /// What is drawn from the plotting area's upper left corner on, cut off at its edges.
    pub(super) fn window(&self, content: Group) -> SVG {
        window(self.at, self.size, content)
    }

    /// Indices of `len` samples to draw: all, or those with the extreme values of each px.
    fn thinned(&self, len: usize, value: &impl Fn(usize) -> f64) -> Vec<usize> {
        let buckets = self.size[0] as usize;
        if len <= 2 * buckets {
            return (0..len).collect();
        }
        let mut kept = Vec::with_capacity(2 * buckets);
        for b in 0..buckets {
            let all = b * len / buckets..(b + 1) * len / buckets;
            let gap = all.clone().find(|i| value(*i).is_nan());
            let last_gap = all.clone().rfind(|i| value(*i).is_nan());
            let low = all.clone().min_by(|i, j| value(*i).total_cmp(&value(*j)));
            let high = all
                .clone()
                .filter(|i| !value(*i).is_nan())
                .max_by(|i, j| value(*i).total_cmp(&value(*j)));
            let mut these: Vec<usize> = [gap, last_gap, low, high].into_iter().flatten().collect();
            these.sort_unstable();
            these.dedup();
            kept.extend(these);
        }
        kept
    }

    /// Lines through `len` samples `dt` apart, interrupted where a value is no number.
    pub(super) fn curve(
        &self,
        len: usize,
        dt: f64,
        value: impl Fn(usize) -> f64,
        style: Style,
    ) -> Group {
        let mut group = Group::new();
        let mut run: Vec<[f64; 2]> = Vec::new();
        let add = |group: Group, run: &mut Vec<[f64; 2]>| {
            let group = if run.is_empty() {
                group
            } else {
                group.add(style.polyline(run))
            };
            run.clear();
            group
        };
        for i in self.thinned(len, &value) {
            let v = value(i);
            if v.is_finite() {
                run.push([self.x(i as f64 * dt), self.y(v)]);
            } else {
                group = add(group, &mut run);
            }
        }
        group = add(group, &mut run);
        Group::new().add(self.window(group))
    }

    /// The area between two values, interrupted where there are none.
    pub(super) fn area(
        &self,
        len: usize,
        dt: f64,
        edges: impl Fn(usize) -> Option<[f64; 2]>,
        colour: &str,
    ) -> Group {
        let mut group = Group::new();
        let mut run: Vec<[f64; 3]> = Vec::new();
        let every = (len / (4.0 * self.size[0]) as usize).max(1);
        let close = |group: Group, run: &mut Vec<[f64; 3]>| {
            if run.is_empty() {
                return group;
            }
            let there = run.iter().map(|r| [r[0], r[1]]);
            let back = run.iter().rev().map(|r| [r[0], r[2]]);
            let corners: Vec<_> = there.chain(back).collect();
            run.clear();
            group.add(super::style::polygon(&corners, colour))
        };
        for i in (0..len).step_by(every) {
            match edges(i).filter(|e| e[0].is_finite() && e[1].is_finite()) {
                Some([low, high]) => {
                    let (x, mut low, high) = (self.x(i as f64 * dt), self.y(low), self.y(high));
                    low = low.max(high + 1.5); // a single point of support is seen, too
                    // Feet touch and leave at once: the edges jump, they do not slope.
                    if let Some(&[_, a, b]) = run.last() {
                        run.push([x, a, b]);
                    }
                    run.push([x, low, high]);
                }
                None => group = close(group, &mut run),
            }
        }
        group = close(group, &mut run);
        Group::new().add(self.window(group))
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    pub(super) colour: &'static str,
    pub(super) width: f64,
    /// As SVG's `stroke-dasharray`; empty is solid.
    pub(super) dashes: &'static str,
}

impl Style {
    /// Without gaps.
    pub(super) const fn solid(colour: &'static str, width: f64) -> Self {
        Self::dashed(colour, width, "")
    }

    /// Dashes and gaps in turn, px, as SVG's `stroke-dasharray`.
    pub(super) const fn dashed(colour: &'static str, width: f64, dashes: &'static str) -> Self {
        Self {
            colour,
            width,
            dashes,
        }
    }

    /// Through the points.
    pub(super) fn polyline(&self, run: &[[f64; 2]]) -> Polyline {
        let line = Polyline::new()
            .set("points", points(run))
            .set("fill", "none")
            .set("stroke", self.colour)
            .set("stroke-width", self.width)
            .set("stroke-linejoin", "round");
        if self.dashes.is_empty() {
            line
        } else {
            line.set("stroke-dasharray", self.dashes)
        }
    }

    /// For a legend.
    pub(super) fn sample(&self, at: [f64; 2], length: f64) -> Polyline {
        self.polyline(&[at, [at[0] + length, at[1]]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        Chart {
            at: [0.0; 2],
            size: [100.0, 50.0],
            span: [0.0, 10.0],
            value: [-1.0, 1.0],
        }
    }

    #[test]
    fn thinning_keeps_spikes_and_gaps() {
        let value = |i: usize| match i {
            5_003 => 9.0,
            7_001 => f64::NAN,
            _ => 0.0,
        };
        let kept = chart().thinned(10_000, &value);
        assert!(kept.contains(&5_003) && kept.contains(&7_001));
        assert!(kept.len() <= 600, "{}", kept.len());
        assert!(kept.is_sorted());
    }

    #[test]
    fn ranges_have_air_and_survive_what_is_no_number() {
        assert_eq!(range([f64::NAN].into_iter(), 1.0), [-0.5, 0.5]);
        let [low, high] = range([0.0, f64::INFINITY, 2.0].into_iter(), 0.5);
        assert!(low < 0.0 && high > 2.0 && high < 3.0);
    }
}

//! The best objective against the number of evaluations (figure 7).

use anyhow::{Result, ensure};
use svg::node::element::Group;

use crate::render::chart::{Chart, Style, even, logarithmic, range};
use crate::render::legend::{Legend, Mark};
use crate::render::style::{FAINT_INK, INK, document, text};

const COLOUR: &str = "#0072b2";
const BEST: Style = Style::solid(COLOUR, 2.0);
const FLAT: Style = Style::dashed(FAINT_INK, 1.5, "6,4");
/// The vertical axis is logarithmic if the objectives are further apart than this factor.
const DECADE: f64 = 10.0;

/// # Errors
/// A course without or with unordered numbers of evaluations.
pub(super) fn figure(course: &[(usize, f64)], flat: f64) -> Result<String> {
    let first = course.first().map_or(0, |c| c.0);
    ensure!(
        first > 0 && course.is_sorted_by(|a, b| a.0 < b.0),
        "course begins at {first} evaluations or is unordered; accepted: more and more from 1 on"
    );
    let finite = course.iter().filter(|c| c.1.is_finite());
    let best: Vec<[f64; 2]> = finite.map(|(n, best)| [*n as f64, *best]).collect();
    let all = || best.iter().map(|p| p[1]).chain([flat]);
    let numbers = || all().filter(|x| x.is_finite());
    let least = numbers().fold(f64::INFINITY, f64::min);
    let most = numbers().fold(f64::NEG_INFINITY, f64::max);
    let log = least > 0.0 && most > DECADE * least;
    let scaled = |x: f64| if log { x.log10() } else { x };
    let last = course.last().map_or(1, |c| c.0) as f64;
    let mut value = range(all().map(scaled), if log { 1.0 } else { 1e-3 });
    if !log && least >= 0.0 {
        // The part of the objective that is left is seen against nothing.
        value[0] = 0.0;
    }
    let chart = Chart {
        at: [66.0, 14.0],
        size: [430.0, 260.0],
        span: [0.0, 1.03 * last],
        value,
    };
    let label = if log {
        "best objective (logarithmic)"
    } else {
        "best objective"
    };
    let evaluations = Some("evaluations");
    let axes = if log {
        let ticks = even(chart.span, chart.size[0] / 75.0);
        Group::new()
            .add(chart.rows_at(&logarithmic(value), label))
            .add(chart.columns(&ticks, evaluations))
    } else {
        chart.axes(label, evaluations)
    };
    // The best stays until a generation has a better one.
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for p in &best {
        let place = chart.inside([p[0], scaled(p[1])]);
        if let Some(before) = steps.last().copied() {
            steps.push([place[0], before[1]]);
        }
        steps.push(place);
    }
    let mut lines = Group::new();
    if flat.is_finite() {
        let ends = chart.span.map(|n| chart.inside([n, scaled(flat)]));
        lines = lines.add(FLAT.polyline(&ends));
    }
    lines = lines.add(BEST.polyline(&steps));
    let mut group = Group::new()
        .add(axes)
        .add(chart.window(lines))
        .add(chart.frame());
    if let (Some(p), Some([x, y])) = (best.last(), steps.last()) {
        let at = [chart.at[0] + x, chart.at[1] + y];
        // Over the mark, or under it at the upper edge.
        let off = if *y > 24.0 { -9.0 } else { 18.0 };
        let told = [at[0] - 2.0, at[1] + off];
        let told = text(told, 10.5, INK, "end", &short(p[1]));
        group = group.add(Mark::Circle.draw(at, 4.0, COLOUR)).add(told);
    }
    let legend = Legend::new([chart.at[0] + chart.size[0] + 16.0, 24.0])
        .line("best so far", BEST)
        .line(&format!("without anticipation:\n{}", short(flat)), FLAT);
    Ok(document([672.0, 322.0], group.add(legend.finish())))
}

/// An objective in a few digits.
fn short(objective: f64) -> String {
    if objective.is_finite() {
        format!("{objective:.3}")
    } else {
        "none".to_owned()
    }
}

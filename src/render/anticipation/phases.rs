//! The phases of a motion behind and over a chart over time: preparation, task, decay.

use svg::node::element::Group;

use crate::render::chart::Chart;
use crate::render::style::{FAINT_INK, INK, PUSH, line, rectangle, text, text_width};

const NAMES: [&str; 3] = ["preparation", "task", "decay"];
const SHADES: [&str; 3] = ["#eef4fa", "#fdeccd", "#f1f1ef"];
const SIZE: f64 = 10.5;
/// Between two names, px.
const GAP: f64 = 8.0;

/// The phases' shades, and their names in a line over the plotting area. `ends` in s from the left.
pub(super) fn shaded(chart: &Chart, ends: [f64; 3]) -> Group {
    let mut group = Group::new();
    let mut from = chart.span[0];
    let mut free = f64::NEG_INFINITY;
    for ((name, shade), to) in NAMES.into_iter().zip(SHADES).zip(ends) {
        let to = to.min(chart.span[1]);
        if to - from > 1e-9 {
            let [left, right] = [from, to].map(|t| chart.across(t));
            let half = 0.5 * text_width(name, SIZE);
            let middle = (0.5 * (left + right)).max(free + half);
            let at = [left, chart.at[1]];
            group = group
                .add(rectangle(at, [right - left, chart.size[1]], shade))
                .add(text([middle, at[1] - 6.0], SIZE, FAINT_INK, "middle", name));
            free = middle + half + GAP;
        }
        from = to;
    }
    group
}

/// Bars where the task begins and ends.
pub(super) fn bars(chart: &Chart, ends: [f64; 3]) -> Group {
    let mut group = Group::new();
    for time in &ends[..2] {
        group = group.add(bar(chart.across(*time), chart.at[1], chart.size[1]));
    }
    group
}

/// One of them, also for a legend.
pub(super) fn bar(x: f64, top: f64, height: f64) -> Group {
    Group::new().add(line([x, top], [x, top + height], INK, 1.6))
}

/// Where another controller took over, at a time in s, with its name near the lower edge.
pub(super) fn successor(chart: &Chart, (time, name): (f64, &str)) -> Group {
    let x = chart.across(time);
    let [top, bottom] = [chart.at[1], chart.at[1] + chart.size[1]];
    let told = format!("{name} takes over");
    let width = text_width(&told, SIZE) + 8.0;
    let fits = x + 4.0 + width < chart.at[0] + chart.size[0];
    let left = if fits { x + 4.0 } else { x - 4.0 - width };
    let mark = line([x, top], [x, bottom], PUSH, 1.3).set("stroke-dasharray", "2,2.5");
    // On a plate, to be read over curves.
    let plate = rectangle([left, bottom - 36.0], [width, 16.0], "#ffffff");
    let middle = [left + 0.5 * width, bottom - 24.5];
    Group::new()
        .add(mark)
        .add(plate.set("opacity", 0.85).set("rx", 3))
        .add(text(middle, SIZE, PUSH, "middle", &told))
}

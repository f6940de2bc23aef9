//! The learned boundary over position and velocity of the centre of mass: probability as a shaded
//! field, its 50 % contour, test samples, and the limits that depend on no implementation.

use anyhow::Result;
use aplomb_framework::sensing::Feature;
use aplomb_training::preconditions::report::{Report, Slice};
use svg::node::element::{Group, Path};

use super::Figure;
use super::field::Field;
use super::limits::{Limits, STATURE};
use crate::render::chart::{Chart, Style};
use crate::render::legend::{Legend, Mark};
use crate::render::style::{CAPTURE, INK, document, px, rectangle, text, text_width};

/// Shades of the field.
const SHADES: usize = 20;
/// Side of its cells, px.
const GRAIN: f64 = 2.0;
/// At most so many samples are drawn.
const MOST_SAMPLES: usize = 1500;
/// Colours of no, even and certain success.
const COLOURS: [[f64; 3]; 3] = [
    [249.0, 205.0, 156.0],
    [252.0, 251.0, 249.0],
    [158.0, 203.0, 232.0],
];
const SUCCESS: &str = "#0b4f8a";
const FAILURE: &str = "#8c2d04";
const RADIUS: f64 = 2.6;

const CONTOUR: Style = Style::solid(INK, 2.4);
const CAPTURE_LINE: Style = Style::dashed(CAPTURE, 2.2, "7,4");
const FEASIBLE_EDGE: Style = Style::dashed("#0b5d3b", 2.6, "2.6,2.6");

/// # Errors
/// A slice whose numbers do not fit together.
pub(super) fn figure(report: &Report, slice: &Slice) -> Result<Figure> {
    let field = Field::new(slice)?;
    let [span, value] = field.spans();
    let chart = Chart {
        at: [64.0, 12.0],
        size: [430.0, 360.0],
        span,
        value,
    };
    let limits = Limits::new(&report.character, &slice.x.0, &slice.y.0);
    let mut picture = Group::new()
        .add(shaded(&chart, &field))
        .add(samples(&chart, slice));
    if let Some(limits) = &limits {
        picture = picture.add(drawn(&chart, limits));
    }
    let picture = picture.add(contour(&chart, &field));
    let [width, height] = chart.size;
    let axes = chart.axes(&label(&slice.y.0, height), Some(&label(&slice.x.0, width)));
    let legend = legend([chart.at[0] + width + 20.0, chart.at[1]], limits.as_ref());
    let group = Group::new()
        .add(axes)
        .add(chart.window(picture))
        .add(chart.frame())
        .add(legend);
    Ok(Figure {
        title: "Learned boundary",
        svg: document([702.0, 420.0], group),
        caption: caption(slice, limits.as_ref()),
    })
}

/// What a feature means and its unit, or shorter where that is too long.
fn label(name: &str, room: f64) -> String {
    let Ok(feature) = name.parse::<Feature>() else {
        return name.to_owned();
    };
    let meaning = Feature::vocabulary().find(|(n, ..)| *n == name);
    let long = meaning.map(|(_, unit, meaning)| match unit {
        "1" => meaning.to_owned(),
        _ => format!("{meaning} ({unit})"),
    });
    long.filter(|l| text_width(l, 11.0) <= room)
        .unwrap_or_else(|| format!("{name} ({})", feature.unit()))
}

fn colour(probability: f64) -> String {
    let [low, even, high] = COLOURS;
    let (from, to, part) = if probability < 0.5 {
        (low, even, 2.0 * probability)
    } else {
        (even, high, 2.0 * probability - 1.0)
    };
    let channel = |k: usize| (from[k] + part * (to[k] - from[k])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

/// The middle of a shade.
fn shade(k: usize) -> String {
    colour((k as f64 + 0.5) / SHADES as f64)
}

/// One path a shade: its runs along x.
fn shaded(chart: &Chart, field: &Field) -> Group {
    let [columns, rows] = chart.size.map(|side| (side / GRAIN).ceil() as usize);
    let mut paths = vec![String::new(); SHADES];
    let [span, value] = field.spans();
    let along = |[low, high]: [f64; 2], part: f64| low + part * (high - low);
    for row in 0..rows {
        let y = along(value, 1.0 - (row as f64 + 0.5) * GRAIN / chart.size[1]);
        let shade = |column: usize| {
            let x = along(span, (column as f64 + 0.5) * GRAIN / chart.size[0]);
            ((field.at(x, y) * SHADES as f64) as usize).min(SHADES - 1)
        };
        let mut from = 0;
        while from < columns {
            let this = shade(from);
            let to = (from + 1..columns).find(|c| shade(*c) != this);
            let run = to.unwrap_or(columns) - from;
            let (x, y, width) = (from as f64 * GRAIN, row as f64 * GRAIN, run as f64 * GRAIN);
            paths[this].push_str(&format!("M{x} {y}h{width}v{GRAIN}h-{width}z"));
            from += run;
        }
    }
    let mut group = Group::new().set("shape-rendering", "crispEdges");
    for (k, path) in paths.iter().enumerate().filter(|(_, p)| !p.is_empty()) {
        group = group.add(Path::new().set("d", path.as_str()).set("fill", shade(k)));
    }
    group
}

fn samples(chart: &Chart, slice: &Slice) -> Group {
    let every = slice.samples.len().div_ceil(MOST_SAMPLES).max(1);
    let mut group = Group::new();
    for (x, y, success) in slice.samples.iter().step_by(every) {
        let seen = |v: &f64, [low, high]: [f64; 2]| (low..=high).contains(v);
        if seen(x, chart.span) && seen(y, chart.value) {
            let at = chart.inside([*x, *y]);
            let (mark, colour) = outcome(*success);
            group = group.add(mark.draw(at, RADIUS, colour));
        }
    }
    group
}

fn outcome(success: bool) -> (Mark, &'static str) {
    match success {
        true => (Mark::Circle, SUCCESS),
        false => (Mark::Cross, FAILURE),
    }
}

fn contour(chart: &Chart, field: &Field) -> Group {
    let mut path = String::new();
    for piece in field.contour(0.5) {
        let [[a, b], [c, d]] = piece.map(|p| chart.inside(p).map(px));
        path.push_str(&format!("M{a} {b}L{c} {d}"));
    }
    let line = |colour: &str, width: f64| {
        Path::new()
            .set("d", path.as_str())
            .set("fill", "none")
            .set("stroke", colour)
            .set("stroke-width", width)
            .set("stroke-linecap", "round")
    };
    let halo = line("#ffffff", CONTOUR.width + 2.0);
    Group::new()
        .add(halo)
        .add(line(CONTOUR.colour, CONTOUR.width))
}

fn drawn(chart: &Chart, limits: &Limits) -> Group {
    let mut group = Group::new();
    for end in limits.sole {
        let ends = chart
            .span
            .map(|x| chart.inside([x, limits.velocity(end, x)]));
        group = group.add(haloed(CAPTURE_LINE, &ends));
    }
    // Without a halo: from heel to toe it nearly lies on the line above.
    if let Some(corners) = &limits.feasible {
        let mut corners: Vec<_> = corners.iter().map(|c| chart.inside(*c)).collect();
        corners.push(corners[0]);
        group = group.add(FEASIBLE_EDGE.polyline(&corners));
    }
    group
}

/// A line that is seen over field and samples.
fn haloed(style: Style, places: &[[f64; 2]]) -> Group {
    let halo = Style::solid("#ffffff", style.width + 2.0);
    Group::new()
        .add(halo.polyline(places).set("stroke-opacity", 0.75))
        .add(style.polyline(places))
}

fn legend([x, y]: [f64; 2], limits: Option<&Limits>) -> Group {
    const BAR: [f64; 2] = [14.0, 110.0];
    let top = y + 18.0;
    let mut group = Group::new().add(text(
        [x, y + 8.0],
        10.5,
        INK,
        "start",
        "probability of success",
    ));
    let height = BAR[1] / SHADES as f64;
    for k in 0..SHADES {
        let at = [x, top + BAR[1] - (k + 1) as f64 * height];
        group = group
            .add(rectangle(at, [BAR[0], height], &shade(k)).set("shape-rendering", "crispEdges"));
    }
    for percentage in [0, 50, 100] {
        let at = top + BAR[1] * (1.0 - f64::from(percentage) / 100.0) + 3.8;
        let told = format!("{percentage} %");
        group = group.add(text([x + BAR[0] + 7.0, at], 10.5, INK, "start", &told));
    }
    let mut legend = Legend::new([x, top + BAR[1] + 26.0]).line("learned boundary: 50 %", CONTOUR);
    for (name, success) in [
        ("test sample, succeeded", true),
        ("test sample, failed", false),
    ] {
        let (mark, colour) = outcome(success);
        legend = legend.mark(name, mark, 1.5 * RADIUS, colour);
    }
    if let Some(limits) = limits {
        let name = "capture point over the\ntoes, over the heels";
        legend = legend.line(name, CAPTURE_LINE);
        if limits.feasible.is_some() {
            let name = "feasible in humans,\nmoving forward";
            legend = legend.line(name, FEASIBLE_EDGE);
        }
    }
    group.add(legend.finish())
}

fn caption(slice: &Slice, limits: Option<&Limits>) -> String {
    let mut caption = format!(
        "Learned probability of success over {} and {}, the other features at their median; marks \
         are test samples, whose other features differ.",
        slice.x.0, slice.y.0
    );
    if let Some(limits) = limits {
        caption.push_str(
            " Between the dashed lines the capture point lies over the soles of both feet side by \
             side: there, and only there, an inverted pendulum comes to rest without a step.",
        );
        if limits.feasible.is_some() {
            let foot = (limits.sole[1] - limits.sole[0]).abs();
            caption.push_str(&format!(
                " Dotted: from where humans can come to rest over their feet when they move \
                 forward (Pai and Patton 1997, at a foot of {foot:.3} m and a stature of \
                 {STATURE} m)."
            ));
        }
    }
    caption
}

//! What a plot shows above its charts: the active controllers as a band, the events as upright
//! lines with labels.

use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

use super::captions::event_colour;
use super::chart::Chart;
use super::scene::Scene;
use super::style::{FAINT_INK, INK, line, readable_on, rectangle, shortened, text, text_width};

/// Height of the controller band, px.
pub(super) const BAND: f64 = 20.0;
/// Height of a line of event labels, px, and how many there may be.
pub(super) const LANE: f64 = 13.0;
pub(super) const LANES: usize = 5;
/// How far labels may reach beyond the chart, px.
const MARGIN: f64 = 120.0;

/// The active controllers as a coloured band; below it, the names that found no room in it.
/// Returns the height of the latter, px.
pub(super) fn band(
    trajectory: &Trajectory,
    character: usize,
    chart: &Chart,
    y: f64,
) -> (Group, f64) {
    let scene = Scene::new(trajectory);
    let mut group = Group::new();
    let mut named: Vec<&str> = Vec::new();
    let mut unnamed: Vec<(&str, &str)> = Vec::new();
    let mut from = 0;
    let who = |step| scene.controller(step, character);
    for step in 1..=trajectory.len() {
        if step < trajectory.len() && who(step) == who(from) {
            continue;
        }
        if let Some((name, colour)) = who(from) {
            let dt = trajectory.header.dt;
            let [a, b] =
                [from as f64 * dt, (step as f64 * dt).min(chart.span[1])].map(|t| chart.across(t));
            group = group.add(rectangle([a, y], [(b - a).max(0.6), BAND], colour));
            if text_width(name, 10.5) + 8.0 <= b - a {
                let at = [(a + b) / 2.0, y + 13.8];
                group = group.add(
                    text(at, 10.5, readable_on(colour), "middle", name).set("font-weight", "bold"),
                );
                named.push(name);
            } else if !unnamed.iter().any(|(n, _)| *n == name) {
                unnamed.push((name, colour));
            }
        }
        from = step;
    }
    group = group
        .add(
            rectangle([chart.at[0], y], [chart.size[0], BAND], "none")
                .set("stroke", FAINT_INK)
                .set("stroke-width", 1),
        )
        .add(text(
            [chart.at[0] - 7.0, y + 13.8],
            10.5,
            INK,
            "end",
            "controller",
        ));
    unnamed.retain(|(n, _)| !named.contains(n));
    let (mut x, mut row) = (chart.at[0], 0.0);
    for (name, colour) in &unnamed {
        let width = 15.0 + text_width(name, 10.5) + 14.0;
        if x + width > chart.at[0] + chart.size[0] && x > chart.at[0] {
            (x, row) = (chart.at[0], row + 1.0);
        }
        let top = y + BAND + 6.0 + 15.0 * row;
        group = group
            .add(rectangle([x, top], [10.0, 10.0], colour))
            .add(text([x + 15.0, top + 9.0], 10.5, INK, "start", name));
        x += width;
    }
    let rows = if unnamed.is_empty() { 0.0 } else { row + 1.0 };
    (group, if rows > 0.0 { 6.0 + 15.0 * rows } else { 0.0 })
}

/// An event's mark in the plot.
pub(super) struct Label {
    x: f64,
    text: String,
    colour: &'static str,
    pub(super) lane: usize,
    /// Its text stands left of the line, at the right end.
    left: bool,
}

/// Events that are marked, each label in the lowest line where it does not touch another.
pub(super) fn event_labels(trajectory: &Trajectory, character: usize, chart: &Chart) -> Vec<Label> {
    let mut ends: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut labels = Vec::new();
    for event in trajectory
        .events
        .iter()
        .filter(|e| e.character == character && e.time <= chart.span[1] + 1e-3)
    {
        let Some(full) = event.kind.label() else {
            continue;
        };
        let colour = event_colour(&event.kind);
        let x = chart.across(event.time.clamp(chart.span[0], chart.span[1]));
        let text = shortened(&full, 10.5, 200.0);
        let width = text_width(&text, 10.5) + 10.0;
        let left = x + width > chart.at[0] + chart.size[0] + MARGIN;
        let taken = if left {
            [x - width, x + 1.0]
        } else {
            [x - 1.0, x + width]
        };
        let free = |lane: &Vec<[f64; 2]>| lane.iter().all(|t| t[1] < taken[0] || taken[1] < t[0]);
        let lane = ends.iter().position(free).unwrap_or(ends.len());
        if lane == ends.len() {
            ends.push(Vec::new());
        }
        ends[lane].push(taken);
        labels.push(Label {
            x,
            text,
            colour,
            lane,
            left,
        });
    }
    labels
}

/// Upright lines through all charts; labels above the controller band, as far as there are lines of
/// text for them.
pub(super) fn event_marks(labels: &[Label], charts: &[Chart], top: f64) -> Group {
    let mut group = Group::new();
    for label in labels {
        let shown = label.lane < LANES;
        let rise = if shown {
            LANE * (label.lane as f64 + 1.0)
        } else {
            0.0
        };
        group = group.add(line(
            [label.x, top - rise],
            [label.x, top],
            label.colour,
            1.0,
        ));
        for chart in charts {
            let (from, to) = (chart.at[1], chart.at[1] + chart.size[1]);
            let mark = line([label.x, from], [label.x, to], label.colour, 1.0);
            group = group.add(mark.set("opacity", 0.75).set("stroke-dasharray", "4,2"));
        }
        if shown {
            let (dx, anchor) = if label.left {
                (-4.0, "end")
            } else {
                (4.0, "start")
            };
            let at = [label.x + dx, top - LANE * label.lane as f64 - 4.0];
            group = group.add(text(at, 10.5, label.colour, anchor, &label.text));
        }
    }
    group
}

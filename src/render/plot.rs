//! One character's run over time: controllers, events, where it balances, how it holds itself.

use anyhow::Result;
use aplomb_framework::state::wrapped;
use aplomb_framework::trajectory::{Event, EventKind, Trajectory};
use svg::node::element::Group;

use super::body::pose;
use super::chart::{Chart, Style, range};
use super::drawable;
use super::scene::Scene;
use super::style::{
    CAPTURE, COM, FAINT_INK, FORCE, INK, PUSH, SUPPORT, line, px, readable_on, rectangle,
    shortened, text, text_width,
};

const LEFT: f64 = 66.0;
const RIGHT: f64 = 150.0;
/// Heights of the controller band and of the three charts, px.
const BAND: f64 = 20.0;
const HEIGHTS: [f64; 3] = [230.0, 110.0, 110.0];
const GAP: f64 = 16.0;
/// Height of a line of event labels, px, and how many there may be.
const LANE: f64 = 13.0;
const LANES: usize = 5;
/// m/s²
const GRAVITY: f64 = 9.81;

const COM_LINE: Style = Style {
    colour: COM,
    width: 2.0,
    dashes: "",
};
const COP_LINE: Style = Style {
    colour: FORCE,
    width: 1.0,
    dashes: "",
};
const CAPTURE_LINE: Style = Style {
    colour: CAPTURE,
    width: 1.5,
    dashes: "5,3",
};
const REFERENCE_LINE: Style = Style {
    colour: INK,
    width: 1.3,
    dashes: "1.5,2.5",
};

/// The plot and its size; `width` in px.
pub(super) fn plot(
    trajectory: &Trajectory,
    character: usize,
    width: f64,
) -> Result<(Group, [f64; 2])> {
    drawable(trajectory, character)?;
    let (len, dt) = (trajectory.len(), trajectory.header.dt);
    let duration = trajectory.duration().max(dt);
    let inner = width - LEFT - RIGHT;
    let mut chart = Chart {
        at: [LEFT, 0.0],
        size: [inner, 0.0],
        time: [0.0, duration],
        value: [0.0, 1.0],
    };
    let labels = event_labels(trajectory, character, &chart);
    let lanes = labels
        .iter()
        .map(|l| l.lane + 1)
        .filter(|l| *l <= LANES)
        .max()
        .unwrap_or(0);

    let mut y = 12.0 + lanes as f64 * LANE;
    let top = y;
    let (band, unnamed) = band(trajectory, character, &chart, y);
    let mut group = Group::new().add(band);
    y += BAND + unnamed + GAP / 2.0;

    let series = Series::new(trajectory, character);
    let mut charts = Vec::new();
    for (k, value) in [
        series.positions(len),
        series.heights(len),
        series.pitches(len),
    ]
    .into_iter()
    .enumerate()
    {
        chart.at[1] = y;
        chart.size[1] = HEIGHTS[k];
        chart.value = value;
        charts.push(chart);
        y += HEIGHTS[k] + GAP;
    }
    let bottom = y - GAP;
    let names = ["position x (m)", "height (m)", "trunk pitch (rad)"];
    for (k, chart) in charts.iter().enumerate() {
        group = group.add(chart.axes(names[k], k + 1 == charts.len()));
    }
    group = group.add(event_marks(&labels, &charts, top));

    let c = &charts[0];
    group = group
        .add(
            c.area(len, dt, |i| series.support(i), SUPPORT)
                .set("opacity", 0.3),
        )
        .add(c.curve(len, dt, |i| series.cop(i), COP_LINE))
        .add(c.curve(len, dt, |i| series.capture(i), CAPTURE_LINE))
        .add(c.curve(len, dt, |i| series.com(i)[0], COM_LINE))
        .add(c.curve(len, dt, |i| series.reference(i), REFERENCE_LINE))
        .add(charts[1].curve(len, dt, |i| series.com(i)[1], COM_LINE))
        .add(charts[2].curve(len, dt, |i| series.pitch[i], COM_LINE));
    for chart in &charts {
        group = group.add(chart.frame());
    }
    let referenced = (0..len).any(|i| series.reference(i).is_finite());
    group = group.add(legend(&charts, width - RIGHT + 14.0, referenced));
    Ok((group, [width, bottom + 44.0]))
}

/// A character's numbers as they are drawn; NaN where there are none.
struct Series<'a> {
    trajectory: &'a Trajectory,
    character: usize,
    /// √(h/g) of the standing character, s.
    pendulum: f64,
    /// rad, against upright
    pitch: Vec<f64>,
}

impl<'a> Series<'a> {
    fn new(trajectory: &'a Trajectory, character: usize) -> Self {
        let model = &trajectory.models[character];
        let pitch = (0..trajectory.len()).map(|i| {
            wrapped(pose(model, trajectory.moment(i, character).q).links[model.trunk].angle)
        });
        // A turn past ±π is a gap, no line across the chart.
        let mut pitch: Vec<f64> = pitch.collect();
        for i in 1..pitch.len() {
            if (pitch[i] - pitch[i - 1]).abs() > std::f64::consts::PI {
                pitch[i - 1] = f64::NAN;
            }
        }
        Self {
            trajectory,
            character,
            pendulum: (model.standing_com()[1].max(0.0) / GRAVITY).sqrt(),
            pitch,
        }
    }

    fn com(&self, step: usize) -> [f64; 2] {
        self.trajectory
            .moment(step, self.character)
            .com
            .map(f64::from)
    }

    fn capture(&self, step: usize) -> f64 {
        let moment = self.trajectory.moment(step, self.character);
        f64::from(moment.com[0]) + self.pendulum * f64::from(moment.com_velocity[0])
    }

    fn cop(&self, step: usize) -> f64 {
        self.trajectory
            .moment(step, self.character)
            .cop
            .map_or(f64::NAN, f64::from)
    }

    fn reference(&self, step: usize) -> f64 {
        self.trajectory
            .moment(step, self.character)
            .reference
            .map_or(f64::NAN, f64::from)
    }

    fn support(&self, step: usize) -> Option<[f64; 2]> {
        self.trajectory
            .moment(step, self.character)
            .support
            .map(|s| s.map(f64::from))
    }

    /// The capture point may leave the chart by far; it widens it by 0.3 m at most.
    fn positions(&self, len: usize) -> [f64; 2] {
        let each = (0..len).flat_map(|i| {
            let [rear, front] = self.support(i).unwrap_or([f64::NAN; 2]);
            [self.com(i)[0], self.cop(i), self.reference(i), rear, front]
        });
        let [low, high] = range(each, 0.4);
        let captures = (0..len).map(|i| self.capture(i).clamp(low - 0.3, high + 0.3));
        range(captures.chain([low + 0.02, high - 0.02]), 0.4)
    }

    fn heights(&self, len: usize) -> [f64; 2] {
        let [_, high] = range((0..len).map(|i| self.com(i)[1]), 0.2);
        let [low, _] = range((0..len).map(|i| self.com(i)[1]).chain([0.0]), 0.2);
        [low.max(-0.02).min(0.0), high.max(0.5)]
    }

    fn pitches(&self, len: usize) -> [f64; 2] {
        range((0..len).map(|i| self.pitch[i]), 0.4)
    }
}

/// The active controllers as a coloured band; below it, the names that found no room in it.
/// Returns the height of the latter, px.
fn band(trajectory: &Trajectory, character: usize, chart: &Chart, y: f64) -> (Group, f64) {
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
                [from as f64 * dt, (step as f64 * dt).min(chart.time[1])].map(|t| chart.across(t));
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

struct Label {
    x: f64,
    text: String,
    colour: &'static str,
    lane: usize,
    /// Its text stands left of the line, at the right end.
    left: bool,
}

fn event_text(event: &Event) -> Option<(String, &'static str)> {
    Some(match &event.kind {
        EventKind::Push { impulse, .. } => (
            format!("push {:.0} N·s", impulse[0].hypot(impulse[1])),
            PUSH,
        ),
        EventKind::Command {
            text,
            accepted: true,
        } => (format!("“{text}”"), INK),
        EventKind::Command {
            text,
            accepted: false,
        } => (format!("“{text}” not taken up"), INK),
        EventKind::Fell => ("fell".to_owned(), PUSH),
        EventKind::Stood => ("stood".to_owned(), FORCE),
        _ => return None,
    })
}

/// Events that are marked, each label in the lowest line where it does not touch another.
fn event_labels(trajectory: &Trajectory, character: usize, chart: &Chart) -> Vec<Label> {
    let mut ends: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut labels = Vec::new();
    for event in trajectory
        .events
        .iter()
        .filter(|e| e.character == character)
    {
        let Some((full, colour)) = event_text(event) else {
            continue;
        };
        let x = chart.across(event.time.clamp(chart.time[0], chart.time[1]));
        let text = shortened(&full, 10.5, 200.0);
        let width = text_width(&text, 10.5) + 10.0;
        let left = x + width > chart.at[0] + chart.size[0] + 0.8 * RIGHT;
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
fn event_marks(labels: &[Label], charts: &[Chart], top: f64) -> Group {
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

fn legend(charts: &[Chart], x: f64, referenced: bool) -> Group {
    let mut group = Group::new();
    let y = charts[0].at[1] + 12.0;
    let mut row = 0.0;
    let mut lines = vec![
        (COM_LINE, "centre of mass"),
        (COP_LINE, "centre of pressure"),
        (CAPTURE_LINE, "capture point"),
    ];
    if referenced {
        lines.push((REFERENCE_LINE, "reference"));
    }
    for (style, name) in lines {
        let at = [x, y + 19.0 * row];
        group = group.add(style.sample(at, 22.0)).add(text(
            [x + 28.0, at[1] + 3.6],
            10.5,
            INK,
            "start",
            name,
        ));
        row += 1.0;
    }
    let at = [x, y + 19.0 * row - 5.5];
    group = group
        .add(rectangle(at, [22.0, 11.0], SUPPORT).set("opacity", px(0.3)))
        .add(text(
            [x + 28.0, at[1] + 9.1],
            10.5,
            INK,
            "start",
            "base of support",
        ));
    let notes = [(1, "centre of mass"), (2, "+ leans back")];
    for (k, note) in notes {
        let at = [x, charts[k].at[1] + 15.0];
        group = group.add(text(at, 10.5, FAINT_INK, "start", note));
    }
    group
}

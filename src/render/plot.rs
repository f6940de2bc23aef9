//! One character's run over time: controllers, events, where it balances, how it holds itself.

use anyhow::Result;
use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

use super::chart::{Chart, Style};
use super::drawable;
use super::series::Series;
use super::style::{CAPTURE, COM, FAINT_INK, FORCE, INK, SUPPORT, px, rectangle, text};
use super::timeline::{BAND, LANE, LANES, band, event_labels, event_marks};

const LEFT: f64 = 66.0;
const RIGHT: f64 = 150.0;
/// Heights of the three charts, px.
const HEIGHTS: [f64; 3] = [230.0, 110.0, 110.0];
const GAP: f64 = 16.0;

const COM_LINE: Style = Style::solid(COM, 2.0);
const COP_LINE: Style = Style::solid(FORCE, 1.0);
const CAPTURE_LINE: Style = Style::dashed(CAPTURE, 1.5, "5,3");
const REFERENCE_LINE: Style = Style::dashed(INK, 1.3, "1.5,2.5");

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
        span: [0.0, duration],
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
        let below = (k + 1 == charts.len()).then_some("time (s)");
        group = group.add(chart.axes(names[k], below));
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

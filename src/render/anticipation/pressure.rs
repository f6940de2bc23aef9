//! The centre of pressure's error over time, without and with the trajectory (figure 1).

use anyhow::Result;
use svg::node::element::Group;

use super::phases::{bar, bars, successor};
use super::samples::Samples;
use super::{LearnedTrajectory, Rollout};
use crate::render::chart::{Chart, Style, range};
use crate::render::legend::Legend;
use crate::render::style::{FORCE, INK, SUPPORT, document, px, rectangle, text};

const ERROR: Style = Style::solid(FORCE, 1.6);
/// Of the error after another controller took over.
const AFTERWARDS: f64 = 0.4;
/// Of the area between the ends of the soles.
const OPACITY: f64 = 0.25;
/// Of the plotting areas, px.
const SIZE: [f64; 2] = [470.0, 165.0];
/// From one to the other, px.
const PITCH: f64 = 206.0;
/// Of the first one's upper left corner, px.
const CORNER: [f64; 2] = [66.0, 30.0];

/// # Errors
/// Recordings that cannot be drawn.
pub(super) fn figure(learned: &LearnedTrajectory<'_>) -> Result<String> {
    let rollouts = [
        ("without anticipation", learned.without),
        ("with anticipation", learned.with),
    ];
    let samples = [
        Samples::new(learned, learned.without)?,
        Samples::new(learned, learned.with)?,
    ];
    let value = range(samples.iter().flat_map(extremes), 0.1);
    let mut group = Group::new();
    for (k, ((name, rollout), samples)) in rollouts.iter().zip(&samples).enumerate() {
        let chart = Chart {
            at: [CORNER[0], CORNER[1] + PITCH * k as f64],
            size: SIZE,
            span: [0.0, learned.phases[2]],
            value,
        };
        let (len, dt) = (samples.len, samples.dt);
        let sole = chart.area(len, dt, |i| samples.sole(i), SUPPORT);
        let below = (k == 1).then_some("time from the beginning of the motion (s)");
        group = group
            .add(sole.set("opacity", OPACITY))
            .add(chart.axes("centre of pressure (m)", below))
            .add(error(&chart, samples, |i| i < samples.own()))
            .add(error(&chart, samples, |i| i >= samples.own()).set("opacity", AFTERWARDS))
            .add(bars(&chart, learned.phases));
        if let Some(next) = samples.successor() {
            group = group.add(successor(&chart, next));
        }
        group = group
            .add(chart.frame())
            .add(title(&chart, name, *rollout, samples));
    }
    let legend = Legend::new([CORNER[0] + SIZE[0] + 16.0, CORNER[1] + 10.0])
        .line("centre of pressure\nfrom the middle\nof the support", ERROR)
        .entry("base of support", |[x, y]| {
            let area = rectangle([x, y - 5.5], [22.0, 11.0], SUPPORT);
            Group::new().add(area.set("opacity", px(OPACITY)))
        })
        .entry("begin and end\nof the task", |[x, y]| {
            bar(x + 11.0, y - 7.0, 14.0)
        });
    let height = CORNER[1] + PITCH + SIZE[1] + 46.0;
    let svg = document(
        [CORNER[0] + SIZE[0] + 168.0, height],
        group.add(legend.finish()),
    );
    Ok(svg)
}

/// What has to be seen: all errors and soles before another controller took over.
fn extremes(samples: &Samples<'_>) -> impl Iterator<Item = f64> {
    (0..samples.own()).flat_map(|i| {
        let [rear, front] = samples.sole(i).unwrap_or([f64::NAN; 2]);
        [samples.cop_error(i), rear, front]
    })
}

/// The error where it is wanted.
fn error(chart: &Chart, samples: &Samples<'_>, wanted: impl Fn(usize) -> bool) -> Group {
    let value = |i| {
        if wanted(i) {
            samples.cop_error(i)
        } else {
            f64::NAN
        }
    };
    chart.curve(samples.len, samples.dt, value, ERROR)
}

/// What a panel shows, over it. A norm is comparable only if the motion came to its end.
fn title(chart: &Chart, name: &str, rollout: Rollout<'_>, samples: &Samples<'_>) -> Group {
    let [x, y] = [chart.at[0], chart.at[1] - 8.0];
    let mut told = Vec::new();
    if samples.left.is_none() && rollout.cop_norm.is_finite() {
        told.push(format!("2-norm {:.2} m", rollout.cop_norm));
    }
    if rollout.objective.is_finite() {
        told.push(format!("objective {:.2}", rollout.objective));
    }
    let right = [x + chart.size[0], y];
    Group::new()
        .add(text([x, y], 11.5, INK, "start", name).set("font-weight", "bold"))
        .add(text(right, 10.5, INK, "end", &told.join(", ")))
}

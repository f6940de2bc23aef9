//! The reference trajectory of the centre of mass over time, with its knots and the phases of the
//! motion (figure 2).

use anyhow::Result;
use aplomb_controllers::kinds::cmrt::{Cmrt, Spline};
use svg::node::element::Group;

use super::LearnedTrajectory;
use super::phases::{shaded, successor};
use super::samples::Samples;
use crate::render::chart::{Chart, Style, range};
use crate::render::legend::{Legend, Mark};
use crate::render::style::{COM, INK, document};

const REFERENCE: Style = Style::solid(INK, 2.0);
const ACTUAL: Style = Style::dashed(COM, 1.8, "5,3");
/// Points of a drawn spline.
const POINTS: usize = 400;
/// Of a knot, px.
const RADIUS: f64 = 4.0;

/// A trajectory's curve as (s, m), from 0 to its length.
pub(super) fn curve(cmrt: &Cmrt) -> Vec<[f64; 2]> {
    let spline = Spline::new(cmrt);
    let time = |i: usize| cmrt.length * i as f64 / POINTS as f64;
    let place = |i: usize| [time(i), spline.at(time(i)).0];
    (0..=POINTS).map(place).collect()
}

/// The same as a line in a chart.
pub(super) fn drawn(chart: &Chart, curve: &[[f64; 2]], style: Style) -> Group {
    let finite = curve.iter().filter(|p| p.iter().all(|x| x.is_finite()));
    let places: Vec<_> = finite.map(|p| chart.inside(*p)).collect();
    let line = Group::new().add(style.polyline(&places));
    Group::new().add(chart.window(line))
}

/// Dots at a trajectory's knots.
pub(super) fn knots(chart: &Chart, cmrt: &Cmrt, radius: f64, colour: &str) -> Group {
    let mut group = Group::new();
    for (time, displacement) in cmrt.times.iter().zip(&cmrt.displacements) {
        let at = chart.place([*time, *displacement]);
        group = group.add(Mark::Circle.draw(at, radius, colour));
    }
    group
}

/// # Errors
/// A recording that cannot be drawn.
pub(super) fn figure(learned: &LearnedTrajectory<'_>) -> Result<String> {
    let samples = Samples::new(learned, learned.with)?;
    let reference = curve(learned.cmrt);
    let heights = reference.iter().map(|p| p[1]);
    let actual = (0..samples.own()).map(|i| samples.com(i));
    let chart = Chart {
        at: [66.0, 28.0],
        size: [470.0, 270.0],
        span: [0.0, learned.phases[2]],
        value: range(heights.chain(actual), 0.02),
    };
    let mut group = Group::new()
        .add(shaded(&chart, learned.phases))
        .add(chart.axes(
            "displacement from the middle of the support (m)",
            Some("time from the beginning of the motion (s)"),
        ))
        .add(chart.curve(samples.len, samples.dt, |i| samples.com(i), ACTUAL))
        .add(drawn(&chart, &reference, REFERENCE));
    if let Some(next) = samples.successor() {
        group = group.add(successor(&chart, next));
    }
    group = group
        .add(chart.frame())
        .add(knots(&chart, learned.cmrt, RADIUS, INK));
    let legend = Legend::new([chart.at[0] + chart.size[0] + 16.0, 38.0])
        .marked(
            "reference trajectory\nwith its knots",
            REFERENCE,
            Mark::Circle,
            RADIUS,
            INK,
        )
        .line("centre of mass\nas it moved", ACTUAL);
    Ok(document([706.0, 346.0], group.add(legend.finish())))
}

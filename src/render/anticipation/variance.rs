//! The part of the variance that each principal component explains, and that it explains with those
//! before it (figure 6).

use anyhow::{Result, ensure};
use aplomb_training::anticipation::basis::Basis;
use svg::node::element::Group;

use crate::render::chart::{Chart, Style};
use crate::render::legend::{Legend, Mark, marked_line};
use crate::render::style::{FAINT_INK, INK, document, line, text};

const COLOUR: &str = "#0072b2";
const PROPORTION: Style = Style::solid(COLOUR, 2.0);
const CUMULATIVE: Style = Style::dashed(COLOUR, 2.0, "2,3");
/// Of a mark, px.
const RADIUS: f64 = 4.0;

/// # Errors
/// No parts, or parts that are none.
pub(super) fn figure(basis: &Basis) -> Result<String> {
    let parts = &basis.explained;
    ensure!(
        !parts.is_empty(),
        "explained is empty; accepted: 1 and more"
    );
    if let Some(bad) = parts.iter().find(|p| !(0.0..=1.0).contains(*p)) {
        anyhow::bail!("explained is {bad}; accepted: 0 to 1");
    }
    let mut sum = 0.0;
    let sums = parts.iter().map(|p| {
        sum += p;
        sum
    });
    let sums: Vec<f64> = sums.collect();
    let chart = Chart {
        at: [66.0, 14.0],
        size: [380.0, 260.0],
        span: [0.5, parts.len() as f64 + 0.5],
        value: [-4.0, 104.0],
    };
    let every = parts.len().div_ceil(20);
    let numbers = (1..=parts.len()).step_by(every);
    let across: Vec<_> = numbers.map(|k| (k as f64, k.to_string())).collect();
    let up = [0, 20, 40, 60, 80, 100].map(|p| (f64::from(p), p.to_string()));
    let mut group = Group::new()
        .add(chart.rows_at(&up, "variance explained (%)"))
        .add(chart.columns(&across, Some("principal component")))
        .add(cut(&chart, basis.components.len(), parts.len()))
        .add(chart.frame());
    let mut legend = Legend::new([chart.at[0] + chart.size[0] + 16.0, 24.0]);
    for (name, values, style, mark) in [
        ("with those before", &sums, CUMULATIVE, Mark::Diamond),
        ("each alone", parts, PROPORTION, Mark::Circle),
    ] {
        let place = |(k, part): (usize, &f64)| chart.place([(k + 1) as f64, 100.0 * part]);
        let places: Vec<_> = values.iter().enumerate().map(place).collect();
        group = marked_line(group, &places, style, mark, RADIUS, COLOUR);
        legend = legend.marked(name, style, mark, RADIUS, COLOUR);
    }
    Ok(document([622.0, 322.0], group.add(legend.finish())))
}

/// Where the components that are kept end.
fn cut(chart: &Chart, kept: usize, all: usize) -> Group {
    if kept == 0 || kept >= all {
        return Group::new();
    }
    let x = chart.across(kept as f64 + 0.5);
    let [top, bottom] = [chart.at[1], chart.at[1] + chart.size[1]];
    let mark = line([x, top], [x, bottom], FAINT_INK, 1.2).set("stroke-dasharray", "4,4");
    let y = 0.5 * (top + bottom);
    let told = format!("{kept} kept");
    Group::new()
        .add(mark)
        .add(text([x + 6.0, y], 10.5, INK, "start", &told))
}

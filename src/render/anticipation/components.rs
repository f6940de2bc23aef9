//! Principal components: the mean trajectory, and it moved by one standard deviation to either side
//! (figure 5).

use anyhow::{Result, ensure};
use aplomb_training::anticipation::basis::Basis;
use svg::node::element::Group;

use super::reference::{curve, drawn};
use crate::render::chart::{Chart, Style, range};
use crate::render::legend::Legend;
use crate::render::style::{FAINT_INK, INK, document, text};

const MEAN: Style = Style::solid(FAINT_INK, 1.4);
const MORE: Style = Style::solid("#d55e00", 1.9);
const LESS: Style = Style::dashed("#0072b2", 1.9, "5,3");
/// Panels a row.
const COLUMNS: usize = 3;
/// Of a panel's plotting area, px.
const SIZE: [f64; 2] = [230.0, 170.0];
/// From one panel to the next, px.
const PITCH: [f64; 2] = [248.0, 214.0];
/// Of the first one's upper left corner, px.
const CORNER: [f64; 2] = [66.0, 30.0];

/// # Errors
/// No components, or vectors of unequal length.
pub(super) fn figure(basis: &Basis) -> Result<String> {
    let (width, count) = (basis.mean.len(), basis.components.len());
    ensure!(
        width % 2 == 1 && width > 1,
        "mean has {width} numbers; accepted: an odd number from 3 on"
    );
    ensure!(count > 0, "components is empty; accepted: 1 and more");
    ensure!(
        basis.components.iter().all(|c| c.len() == width) && basis.deviations.len() == count,
        "components and deviations do not fit the mean of {width} numbers"
    );
    let mean = basis.along(0, 0.0);
    mean.validate().map_err(|e| e.at("the mean"))?;
    let mean = curve(&mean);
    let moved = |k, deviations| curve(&basis.along(k, deviations));
    let curves: Vec<_> = (0..count)
        .map(|k| [moved(k, -1.0), moved(k, 1.0)])
        .collect();
    let all = || curves.iter().flatten().chain([&mean]).flatten();
    let longest = all().map(|p| p[0]).filter(|t| t.is_finite());
    let span = [0.0, longest.fold(0.1, f64::max)];
    let value = range(all().map(|p| p[1]), 0.02);
    let columns = count.min(COLUMNS);
    let mut group = Group::new();
    for (k, [less, more]) in curves.iter().enumerate() {
        let (row, column) = (k / COLUMNS, k % COLUMNS);
        let chart = Chart {
            at: [
                CORNER[0] + PITCH[0] * column as f64,
                CORNER[1] + PITCH[1] * row as f64,
            ],
            size: SIZE,
            span,
            value,
        };
        // The panels share their scales: only those at the edges are labelled.
        let below = (k + COLUMNS >= count).then_some("time (s)");
        group = group
            .add(if column == 0 {
                chart.axes("displacement (m)", below)
            } else {
                chart.inner_axes(below)
            })
            .add(drawn(&chart, &mean, MEAN))
            .add(drawn(&chart, less, LESS))
            .add(drawn(&chart, more, MORE))
            .add(chart.frame())
            .add(title(&chart, k, basis.explained.get(k).copied()));
    }
    let right = CORNER[0] + PITCH[0] * (columns - 1) as f64 + SIZE[0];
    let legend = Legend::new([right + 16.0, CORNER[1] + 10.0])
        .line("mean", MEAN)
        .line("one standard\ndeviation more", MORE)
        .line("one less", LESS);
    let rows = count.div_ceil(COLUMNS);
    let height = CORNER[1] + PITCH[1] * (rows - 1) as f64 + SIZE[1] + 46.0;
    Ok(document(
        [right + 142.0, height],
        group.add(legend.finish()),
    ))
}

/// Which component it is and how much it explains, over its panel.
fn title(chart: &Chart, k: usize, explained: Option<f64>) -> Group {
    let [x, y] = [chart.at[0], chart.at[1] - 8.0];
    let name = format!("component {}", k + 1);
    let name = text([x, y], 11.5, INK, "start", &name).set("font-weight", "bold");
    let group = Group::new().add(name);
    match explained.filter(|e| e.is_finite()) {
        Some(part) => {
            let told = format!("{:.1} % of the variance", 100.0 * part);
            let right = x + chart.size[0];
            group.add(text([right, y], 10.5, INK, "end", &told))
        }
        None => group,
    }
}

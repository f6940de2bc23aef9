//! The trajectories of a clip over a parameter, in graded colours (figure 3).

use anyhow::{Result, ensure};
use aplomb_training::anticipation::basis::Basis;
use svg::node::element::Group;

use super::grades::grade;
use super::reference::{curve, drawn, knots};
use crate::render::chart::{Chart, Style, range};
use crate::render::legend::Legend;
use crate::render::style::{INK, document, shortened, text};

/// At most so many members are named.
const NAMED: usize = 13;
/// Of a knot, px.
const RADIUS: f64 = 2.6;

/// # Errors
/// No trajectories, or an invalid one.
pub(super) fn figure(basis: &Basis) -> Result<String> {
    let family = &basis.family;
    ensure!(
        !family.is_empty(),
        "family has no trajectories; accepted: 1 and more"
    );
    for (i, member) in family.iter().enumerate() {
        let valid = member.validate();
        valid.map_err(|e| e.inside(("family", i)).at("the basis"))?;
    }
    let curves: Vec<_> = family.iter().map(curve).collect();
    let heights = curves.iter().flatten().map(|p| p[1]);
    let longest = family.iter().map(|c| c.length).fold(0.0, f64::max);
    let chart = Chart {
        at: [66.0, 14.0],
        size: [470.0, 290.0],
        span: [0.0, longest],
        value: range(heights, 0.02),
    };
    let mut group = Group::new().add(chart.axes(
        "displacement from the middle of the support (m)",
        Some("time from the beginning of the motion (s)"),
    ));
    let x = chart.at[0] + chart.size[0] + 16.0;
    let name = shortened(&basis.parameter, 10.5, 92.0);
    let mut legend = Legend::new([x, 42.0]);
    group = group.add(text([x, 24.0], 10.5, INK, "start", &name).set("font-weight", "bold"));
    let every = family.len().div_ceil(NAMED);
    for (i, (member, curve)) in family.iter().zip(&curves).enumerate() {
        let colour = grade(i, family.len());
        let style = Style::solid(colour, 1.7);
        group = group
            .add(drawn(&chart, curve, style))
            .add(knots(&chart, member, RADIUS, colour));
        if i % every == 0 || i + 1 == family.len() {
            legend = legend.line(&number(member.value), style);
        }
    }
    group = group.add(chart.frame()).add(legend.finish());
    Ok(document([652.0, 352.0], group))
}

/// A parameter's value in a few digits.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "−")
}

//! Balanced accuracy against the size of the training set.

use anyhow::{Result, ensure};
use aplomb_training::preconditions::report::{CurvePoint, Report};
use svg::node::element::Group;

use super::{Figure, NEIGHBOUR, SVM, check_share};
use crate::render::chart::{Chart, Style, logarithmic, range};
use crate::render::legend::{Legend, Mark, marked_line};
use crate::render::style::document;

const RADIUS: f64 = 4.0;

/// # Errors
/// A size of 0 or a share that is none.
pub(super) fn figure(report: &Report) -> Result<Figure> {
    let mut points = report.curve.clone();
    points.sort_by_key(|p| p.train);
    for p in &points {
        ensure!(p.train > 0, "curve.train is 0; accepted: 1 and more");
        check_share("curve.svm", p.svm)?;
        check_share("curve.nn", p.nn)?;
    }
    let sizes = points.iter().map(|p| (p.train as f64).log10());
    let percentages = points.iter().flat_map(|p| [100.0 * p.svm, 100.0 * p.nn]);
    let [low, high] = range(percentages, 10.0);
    let chart = Chart {
        at: [62.0, 12.0],
        size: [330.0, 250.0],
        span: range(sizes, 0.5),
        value: [low.max(0.0), high.min(100.0)],
    };
    let axes = Group::new()
        .add(chart.rows("balanced accuracy (%)"))
        .add(chart.columns(
            &logarithmic(chart.span),
            Some("training samples (logarithmic)"),
        ));
    let mut group = Group::new().add(axes).add(chart.frame());
    let mut legend = Legend::new([chart.at[0] + chart.size[0] + 18.0, 22.0]);
    type Accuracy = fn(&CurvePoint) -> f64;
    let rivals: [(_, _, _, _, Accuracy); 2] = [
        ("SVM", Mark::Circle, SVM, "", |p| p.svm),
        ("nearest neighbour", Mark::Diamond, NEIGHBOUR, "5,3", |p| {
            p.nn
        }),
    ];
    for (name, mark, colour, dashes, accuracy) in rivals {
        let style = Style::dashed(colour, 2.0, dashes);
        let place = |p: &CurvePoint| chart.place([(p.train as f64).log10(), 100.0 * accuracy(p)]);
        let places: Vec<_> = points.iter().map(place).collect();
        group = marked_line(group, &places, style, mark, RADIUS, colour);
        legend = legend.marked(name, style, mark, RADIUS, colour);
    }
    let (first, last) = (&points[0], &points[points.len() - 1]);
    let caption = format!(
        "Balanced accuracy on the {} test samples against the number of samples trained on; the \
         SVM with the kernel, C and gamma of the whole training set. From {} to {} samples it goes \
         from {:.1} to {:.1} %, the nearest neighbour from {:.1} to {:.1} %.",
        report.test,
        first.train,
        last.train,
        100.0 * first.svm,
        100.0 * last.svm,
        100.0 * first.nn,
        100.0 * last.nn
    );
    Ok(Figure {
        title: "Accuracy against training size",
        svg: document([560.0, 308.0], group.add(legend.finish())),
        caption,
    })
}

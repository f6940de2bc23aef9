//! The ROC curve: what is won and lost as the threshold of the learned probability moves.

use anyhow::{Result, ensure};
use aplomb_training::preconditions::report::Report;
use svg::node::element::Group;

use super::{Figure, HAND_MADE, NEIGHBOUR, SVM, check_share, operating_point};
use crate::render::chart::{Chart, Style};
use crate::render::legend::{Legend, Mark};
use crate::render::style::{FAINT_INK, document};

const CURVE: Style = Style::solid(SVM, 2.2);
const GUESSING: Style = Style::dashed(FAINT_INK, 1.2, "4,4");
const RADIUS: f64 = 5.0;

/// # Errors
/// Fewer than two points, or points outside of the unit square.
pub(super) fn figure(report: &Report) -> Result<Figure> {
    ensure!(
        report.roc.len() >= 2,
        "roc has {} points; accepted: 2 and more",
        report.roc.len()
    );
    for rate in report.roc.as_flattened() {
        check_share("roc", *rate)?;
    }
    let chart = Chart {
        at: [62.0, 12.0],
        size: [290.0, 290.0],
        span: [0.0, 100.0],
        value: [0.0, 100.0],
    };
    let place = |rates: &[f64; 2]| chart.inside(rates.map(|r| 100.0 * r));
    let curve: Vec<_> = report.roc.iter().map(place).collect();
    let lines = Group::new()
        .add(GUESSING.polyline(&[place(&[0.0, 0.0]), place(&[1.0, 1.0])]))
        .add(CURVE.polyline(&curve));
    let ticks = [0, 20, 40, 60, 80, 100].map(|p| (f64::from(p), p.to_string()));
    let axes = Group::new()
        .add(chart.rows("true positive rate (%)"))
        .add(chart.columns(&ticks, Some("false positive rate (%)")));
    let mut group = Group::new()
        .add(axes)
        .add(chart.window(lines))
        .add(chart.frame());
    let auc = format!("SVM, any threshold:\nAUC {:.3}", report.svm.auc);
    let mut legend = Legend::new([chart.at[0] + chart.size[0] + 18.0, 22.0]).line(&auc, CURVE);
    // The rivals last: where they agree with the machine, they are seen.
    let answers = [
        ("SVM as it decides", Mark::Circle, SVM, &report.svm.metrics),
        (
            "nearest neighbour",
            Mark::Diamond,
            NEIGHBOUR,
            &report.nn.metrics,
        ),
        ("hand-made", Mark::Square, HAND_MADE, &report.manual),
    ];
    for (name, mark, colour, metrics) in answers {
        let Some(rates) = operating_point(metrics) else {
            continue;
        };
        let at = chart.place(rates.map(|r| 100.0 * r));
        group = group.add(mark.draw(at, RADIUS, colour));
        legend = legend.mark(name, mark, RADIUS, colour);
    }
    legend = legend.line("guessing", GUESSING);
    let caption = format!(
        "ROC curve on {} test samples: how many of the successes are foretold (up) at the price of \
         how many failures foretold as successes (right), as the threshold of the SVM's \
         probability moves. Up and left is better; the dashed diagonal is guessing. The area under \
         the curve is {:.3}. Marks: those that have one answer only.",
        report.test, report.svm.auc
    );
    Ok(Figure {
        title: "ROC curve",
        svg: document([510.0, 348.0], group.add(legend.finish())),
        caption,
    })
}

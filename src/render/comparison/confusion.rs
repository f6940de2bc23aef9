//! Confusion matrices of the learned, the remembered and the hand-made pre-condition.

use aplomb_training::preconditions::report::{Metrics, Report};
use svg::node::element::Group;

use super::{Figure, HAND_MADE, NEIGHBOUR, SVM, share};
use crate::render::style::{FAINT_INK, INK, document, px, rectangle, text};

/// Width and height of a cell, px.
const CELL: [f64; 2] = [86.0, 56.0];
/// Between two matrices, px.
const GAP: f64 = 26.0;
/// Upper left corner of the first, px.
const FIRST: [f64; 2] = [92.0, 62.0];

pub(super) fn figure(report: &Report) -> Figure {
    let rivals = [
        ("SVM", SVM, &report.svm.metrics),
        ("nearest neighbour", NEIGHBOUR, &report.nn.metrics),
        ("hand-made", HAND_MADE, &report.manual),
    ];
    let mut group = Group::new();
    for (row, name) in ["succeeded", "failed"].into_iter().enumerate() {
        let y = FIRST[1] + (row as f64 + 0.5) * CELL[1] + 4.0;
        group = group.add(text([FIRST[0] - 10.0, y], 11.0, INK, "end", name));
    }
    let mut right = FIRST[0];
    for (name, colour, metrics) in rivals {
        group = group.add(matrix([right, FIRST[1]], name, colour, metrics));
        right += 2.0 * CELL[0] + GAP;
    }
    let size = [right - GAP + 12.0, FIRST[1] + 2.0 * CELL[1] + 12.0];
    Figure {
        title: "Confusion matrices",
        svg: document(size, group),
        caption: format!(
            "What was foretold (columns) and what came true (rows) of the {} test samples; \
             percentages and shades are of the row. The diagonal from the upper left is right. The \
             upper right are chances missed, the lower left are failures that were not foretold.",
            report.test
        ),
    }
}

fn matrix(at: [f64; 2], name: &str, colour: &str, m: &Metrics) -> Group {
    let middle = at[0] + CELL[0];
    let mut group = Group::new()
        .add(text([middle, at[1] - 42.0], 12.5, colour, "middle", name).set("font-weight", "bold"))
        .add(text(
            [middle, at[1] - 23.0],
            10.5,
            FAINT_INK,
            "middle",
            "foretold:",
        ));
    let rows = [
        [m.true_positives, m.false_negatives],
        [m.false_positives, m.true_negatives],
    ];
    for (column, title) in ["success", "failure"].into_iter().enumerate() {
        let x = at[0] + (column as f64 + 0.5) * CELL[0];
        group = group.add(text([x, at[1] - 7.0], 11.0, INK, "middle", title));
    }
    for (i, row) in rows.iter().enumerate() {
        let all = row[0].saturating_add(row[1]);
        for (j, count) in row.iter().enumerate() {
            let corner = [at[0] + j as f64 * CELL[0], at[1] + i as f64 * CELL[1]];
            group = group.add(cell(corner, *count, share(*count, all)));
        }
    }
    let frame = rectangle(at, CELL.map(|side| 2.0 * side), "none");
    group.add(frame.set("stroke", colour).set("stroke-width", px(1.6)))
}

fn cell(at: [f64; 2], count: u64, part: Option<f64>) -> Group {
    let middle = at[0] + 0.5 * CELL[0];
    let told = part.map_or("none".to_owned(), |p| format!("{:.1} %", 100.0 * p));
    Group::new()
        .add(rectangle(at, CELL, &shade(part.unwrap_or(0.0))).set("stroke", "#ffffff"))
        .add(
            text(
                [middle, at[1] + 26.0],
                15.0,
                INK,
                "middle",
                &count.to_string(),
            )
            .set("font-weight", "bold"),
        )
        .add(text([middle, at[1] + 43.0], 10.5, INK, "middle", &told))
}

/// From nearly white to a blue on which dark text is still read well.
fn shade(part: f64) -> String {
    let [light, dark] = [[243.0, 246.0, 249.0], [124.0, 168.0, 208.0]];
    let channel = |k: usize| (light[k] + part * (dark[k] - light[k])) as u8;
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

use aplomb_training::preconditions::report::{CurvePoint, NeighbourReport, Slice, SvmReport};

use super::*;
use crate::render::seen::{Sight, assert_seen};
use crate::render::style::INK;

fn metrics(counts: [u64; 4]) -> Metrics {
    let [tp, fp, tn, fne] = counts;
    let part = |a: u64, b: u64| a as f64 / b as f64;
    Metrics {
        accuracy: part(tp + tn, counts.iter().sum()),
        balanced_accuracy: 0.5 * (part(tp, tp + fne) + part(tn, tn + fp)),
        precision: part(tp, tp + fp),
        recall: part(tp, tp + fne),
        mcc: 0.8,
        true_positives: tp,
        false_positives: fp,
        true_negatives: tn,
        false_negatives: fne,
    }
}

/// A balance whose successes lie between the capture point's lines, somewhat inside.
fn report() -> Report {
    let grid = |low: f64, high: f64, n: usize| -> Vec<f64> {
        (0..n)
            .map(|i| low + (high - low) * i as f64 / (n - 1) as f64)
            .collect()
    };
    let (x, y) = (grid(-0.4, 0.4, 49), grid(-1.6, 1.6, 41));
    let chance = |x: f64, y: f64| {
        let capture = x + y / 3.155 + 0.03 * (4.0 * x).sin();
        1.0 / (1.0 + (60.0 * (capture.abs() - 0.1)).exp())
    };
    let probability = y
        .iter()
        .map(|y| x.iter().map(|x| chance(*x, *y)).collect())
        .collect();
    let samples = (0..500_u32).map(|i| {
        // Spread evenly without a generator.
        let unit = |k: f64| (f64::from(i) * k).fract();
        let (x, y) = (0.8 * unit(0.618_034) - 0.4, 3.2 * unit(0.754_878) - 1.6);
        (x, y, unit(0.569_840) < chance(x, y))
    });
    Report {
        controller: "balance".into(),
        character: "humanoid".into(),
        seed: 1,
        train: 4000,
        test: 2000,
        positive_rate: 0.4,
        test_positive_rate: 0.4,
        features: vec!["com_offset".into(), "com_velocity_x".into()],
        svm: SvmReport {
            kernel: "rbf".into(),
            solver: "libsvm-rs".into(),
            c: 10.0,
            gamma: 0.1,
            metrics: metrics([770, 40, 1160, 30]),
            auc: 0.989,
            log_loss: 0.1,
            support_vectors: 321,
            train_s: 1.5,
            choice_s: 60.0,
            query_us: 12.5,
        },
        nn: NeighbourReport {
            metrics: metrics([745, 85, 1115, 55]),
            query_us: 40.0,
        },
        manual: metrics([520, 15, 1185, 280]),
        majority: 0.6,
        roc: (0..=200)
            .map(|i| f64::from(i) / 200.0)
            .map(|f| [f, f.powf(0.0112)])
            .collect(),
        curve: [125, 250, 500, 1000, 2000, 4000]
            .map(|train| CurvePoint {
                train,
                svm: 0.97 - 1.6 / (train as f64).sqrt(),
                nn: 0.94 - 2.1 / (train as f64).sqrt(),
                train_s: 0.1,
            })
            .to_vec(),
        slice: Some(Slice {
            x: ("com_offset".into(), x),
            y: ("com_velocity_x".into(), y),
            probability,
            samples: samples.collect(),
        }),
    }
}

fn drawn(report: &Report) -> Vec<Figure> {
    let figures = figures(report).unwrap();
    for figure in &figures {
        let seen = assert_seen(&figure.svg, &sights(figure.title));
        let crowded = seen.crowded();
        assert!(crowded.is_empty(), "{}: {crowded:?}", figure.title);
    }
    figures
}

/// What each figure must show of any report.
fn sights(title: &str) -> Vec<Sight<'static>> {
    let texts: &[&str] = match title {
        "ROC curve" => &[
            "true positive rate (%)",
            "false positive rate (%)",
            "AUC 0.989",
        ],
        "Confusion matrices" => &["SVM", "nearest neighbour", "hand-made", "foretold:"],
        "Accuracy against training size" => &["balanced accuracy (%)", "training samples"],
        _ => &[
            "probability of success",
            "learned boundary: 50 %",
            "test sample, failed",
        ],
    };
    let mut sights: Vec<_> = texts.iter().map(|t| Sight::Text(t, 1)).collect();
    match title {
        "ROC curve" => sights.push(Sight::Curve(SVM, 200, 280.0)),
        "Learned boundary" => sights.push(Sight::Curve(INK, 100, 100.0)),
        _ => {}
    }
    sights
}

#[test]
fn counts_and_curves_of_a_report_are_drawn() {
    let figures = drawn(&report());
    let counts = [
        "770", "40", "1160", "30", "745", "85", "1115", "55", "520", "280",
    ];
    let cells = counts.map(|count| Sight::Text(count, 1));
    assert_seen(&figures[1].svg, &cells);
    // A line with six marks, and a sample of both beside it.
    let learning = [
        Sight::Curve(SVM, 6, 100.0),
        Sight::Shapes(SVM, 9),
        Sight::Shapes(NEIGHBOUR, 9),
    ];
    assert_seen(&figures[2].svg, &learning[..1]);
    for sight in &learning[1..] {
        assert_seen(&figures[2].svg, std::slice::from_ref(sight));
    }
}

#[test]
fn a_full_report_has_four_figures() {
    let titles: Vec<_> = drawn(&report()).iter().map(|f| f.title).collect();
    assert_eq!(
        titles,
        [
            "ROC curve",
            "Confusion matrices",
            "Accuracy against training size",
            "Learned boundary"
        ]
    );
}

#[test]
fn what_a_report_does_not_have_is_not_drawn() {
    let mut report = report();
    report.curve.clear();
    report.slice = None;
    report.nn.metrics = Metrics::default();
    let figures = drawn(&report);
    let titles: Vec<_> = figures.iter().map(|f| f.title).collect();
    assert_eq!(titles, ["ROC curve", "Confusion matrices"]);
    // Counts that no sum holds are shares all the same; their digits are wider than a cell.
    report.manual.true_positives = u64::MAX;
    report.manual.false_negatives = u64::MAX;
    let matrices = &super::figures(&report).unwrap()[1].svg;
    assert_seen(
        matrices,
        &[
            Sight::Text("100.0 %", 1),
            Sight::Text("18446744073709551615", 2),
        ],
    );
}

#[test]
fn a_single_size_is_drawn() {
    let mut report = report();
    report.curve.truncate(1);
    assert_eq!(drawn(&report).len(), 4);
}

#[test]
fn other_planes_are_drawn_without_limits() {
    let mut report = report();
    report.controller = "<fall> & \u{1}".into();
    let plain = |report: &Report| drawn(report).pop().unwrap();
    assert!(plain(&report).svg.contains("toes, over the heels"));
    report.slice.as_mut().unwrap().x.0 = "com_height".into();
    report.slice.as_mut().unwrap().y.0 = "no <feature>".into();
    let figure = plain(&report);
    assert!(!figure.svg.contains("heels") && !figure.caption.contains("inverted"));
}

#[test]
fn numbers_that_cannot_be_drawn_are_named() {
    let refused = |spoil: fn(&mut Report)| {
        let mut report = report();
        spoil(&mut report);
        figures(&report).unwrap_err().to_string()
    };
    assert!(refused(|r| r.roc.truncate(1)).starts_with("roc has 1 points"));
    assert!(refused(|r| r.roc[3][1] = -0.5).starts_with("roc is -0.5"));
    assert!(refused(|r| r.curve[1].train = 0).starts_with("curve.train is 0"));
    assert!(refused(|r| r.curve[1].nn = f64::NAN).starts_with("curve.nn is NaN"));
    assert!(refused(|r| r.slice.as_mut().unwrap().y.1.clear()).starts_with("slice.y"));
}

//! `compare`, on two reports that nobody measured.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::{called, refusals};

/// Shares from the counts of true and false positives and negatives.
fn metrics(tp: u64, fp: u64, tn: u64, fne: u64) -> Value {
    // So few digits are read back exactly.
    let round = |x: f64| (1e4 * x).round() / 1e4;
    let part = |a: u64, b: u64| round(a as f64 / b as f64);
    let [hits, misses] = [part(tp, tp + fne), part(tn, tn + fp)];
    json!({
        "accuracy": part(tp + tn, tp + fp + tn + fne),
        "balanced_accuracy": round(0.5 * (hits + misses)),
        "precision": part(tp, tp + fp), "recall": hits, "mcc": round(hits + misses - 1.0),
        "true_positives": tp, "false_positives": fp,
        "true_negatives": tn, "false_negatives": fne,
    })
}

fn with(mut value: Value, more: Value) -> Value {
    let (all, more) = (value.as_object_mut().unwrap(), more.as_object().unwrap());
    all.extend(more.clone());
    value
}

fn balance() -> Value {
    let svm = json!({
        "kernel": "rbf", "solver": "libsvm-rs", "c": 10.0, "gamma": 0.125, "auc": 0.9876,
        "log_loss": 0.15, "support_vectors": 321, "train_s": 1.25, "choice_s": 61.0,
        "query_us": 12.34,
    });
    json!({
        "controller": "balance", "character": "humanoid", "seed": 7,
        "train": 4000, "test": 2000, "positive_rate": 0.4125, "test_positive_rate": 0.4,
        "features": ["com_offset", "com_velocity_x", "com_height"],
        "svm": with(metrics(770, 40, 1160, 30), svm),
        "nn": with(metrics(745, 85, 1115, 55), json!({"query_us": 40.0})),
        "manual": metrics(520, 15, 1185, 280),
        "majority": 0.6,
        "roc": [[0.0, 0.0], [0.03, 0.96], [1.0, 1.0]],
        "curve": [
            {"train": 500, "svm": 0.91, "nn": 0.87, "train_s": 0.1},
            {"train": 4000, "svm": 0.965, "nn": 0.93, "train_s": 1.25},
        ],
        "slice": {
            "x": ["com_offset", [-0.2, 0.0, 0.2]],
            "y": ["com_velocity_x", [-0.5, 0.5]],
            "probability": [[0.1, 0.6, 0.9], [0.9, 0.6, 0.1]],
            "samples": [[0.05, 0.1, true], [0.15, 0.4, false]],
        },
        "added_later": "is no fault",
    })
}

/// With names that are markup, and without curve and slice.
fn fall() -> Value {
    let svm = json!({
        "kernel": "poly3", "solver": "linfa-svm", "c": 0.1, "gamma": 1e-4, "auc": 0.71,
        "log_loss": 0.6, "support_vectors": 98, "train_s": 0.02, "choice_s": 2.0,
        "query_us": 0.75,
    });
    json!({
        "controller": "fall<b>|_", "character": "humanoid", "seed": 7,
        "train": 300, "test": 100, "positive_rate": 0.9, "test_positive_rate": 0.91,
        "features": ["com_speed"],
        "svm": with(metrics(91, 5, 4, 0), svm),
        "nn": with(metrics(88, 6, 3, 3), json!({"query_us": 3.0})),
        "manual": metrics(91, 9, 0, 0),
        "majority": 0.91,
        "roc": [[0.0, 0.0], [1.0, 1.0]],
    })
}

fn write(folder: &Path, name: &str, report: &Value) {
    let text = serde_json::to_string_pretty(report).unwrap();
    std::fs::write(folder.join(name), text).unwrap();
}

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    // Not in the order of their names.
    write(folder.path(), "fall.report.json", &fall());
    write(folder.path(), "balance.report.json", &balance());
    std::fs::write(folder.path().join("balance.csv"), "not a report").unwrap();
    folder
}

fn told(folder: &Path, arguments: &str) -> String {
    let mut call = called(arguments);
    let output = call.current_dir(folder).output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{error}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn tables() {
    insta::assert_snapshot!(told(folder().path(), "compare ."));
}

#[test]
fn markdown() {
    insta::assert_snapshot!(told(folder().path(), "compare . --format markdown"));
}

#[test]
fn json_is_one_list_with_everything_measured() {
    let text = told(folder().path(), "compare . --format json");
    assert_eq!(text.lines().count(), 1);
    let all: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(all.as_array().unwrap().len(), 2);
    let (row, report) = (&all[0], balance());
    let keys: Vec<_> = row.as_object().unwrap().keys().collect();
    let mut expected = vec![
        "controller",
        "train",
        "test",
        "positive_rate",
        "svm",
        "nn",
        "manual",
        "majority",
    ];
    expected.sort_unstable();
    assert_eq!(keys, expected);
    for key in expected {
        assert_eq!(row[key], report[key], "{key}");
    }
    assert_eq!(all[1]["svm"]["kernel"], "poly3");
}

#[test]
fn the_page_has_every_figure_and_needs_nothing_else() {
    let page = told(folder().path(), "compare . --format html");
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
    for elsewhere in ["http", "src=", "<script", "@import", "url("] {
        assert!(!page.contains(elsewhere), "{elsewhere}");
    }
    let count = |text: &str| page.matches(text).count();
    assert_eq!(count("<section"), 2);
    assert_eq!(count("<figure>"), 4 + 2);
    for (title, times) in [
        ("ROC curve", 2),
        ("Confusion matrices", 2),
        ("Accuracy against training size", 1),
        ("Learned boundary", 1),
    ] {
        assert_eq!(count(&format!("<figcaption><b>{title}.</b>")), times);
        assert_eq!(
            count(&format!("role=\"img\" aria-label=\"{title}, ")),
            times
        );
    }
    for seen in [
        "AUC 0.988",
        "capture point over the",
        "Pai and Patton 1997",
        "96.5 (95.6 to 97.2)",
        "centre of mass ahead of the middle of the base of support (m)",
        "forward velocity of the centre of mass (m/s)",
        "fall&lt;b&gt;|_",
    ] {
        assert!(page.contains(seen), "{seen}");
    }
    assert!(!page.contains("<b>|_"), "a name has become markup");
}

#[test]
fn files_are_written_whole_and_stdout_stays_empty() {
    let folder = folder();
    for format in ["table", "markdown", "json", "html"] {
        let call = format!("compare . --format {format}");
        let file = told(folder.path(), &format!("{call} --out new/{format}"));
        assert_eq!(file, "");
        let file = std::fs::read_to_string(folder.path().join("new").join(format)).unwrap();
        assert_eq!(file, told(folder.path(), &call), "{format}");
    }
    let left = std::fs::read_dir(folder.path().join("new")).unwrap();
    assert_eq!(left.count(), 4, "no temporary file is left");
}

#[test]
fn bad_folders_and_reports() {
    let all = tempfile::tempdir().unwrap();
    let case = |name: &str, spoil: fn(&mut Value)| {
        let folder = all.path().join(name);
        std::fs::create_dir(&folder).unwrap();
        let mut report = balance();
        spoil(&mut report);
        write(&folder, "b.report.json", &report);
        folder
    };
    let torn = case("torn", |_| {}).join("b.report.json");
    let text = std::fs::read_to_string(&torn).unwrap();
    std::fs::write(&torn, &text[..text.find("\"features\"").unwrap()]).unwrap();
    case("missing", |r| drop(r.as_object_mut().unwrap().remove("nn")));
    case("deep", |r| {
        drop(r["svm"].as_object_mut().unwrap().remove("auc"));
    });
    case("type", |r| r["seed"] = "seven".into());
    case("share", |r| r["manual"]["recall"] = 1.5.into());
    case("roc", |r| r["roc"] = json!([]));
    case("slice", |r| {
        r["slice"]["probability"] = json!([[0.5, 0.5, 0.5]])
    });
    std::fs::create_dir(all.path().join("empty")).unwrap();
    std::fs::create_dir_all(all.path().join("folder/x.report.json")).unwrap();
    insta::assert_snapshot!(refusals(
        all.path(),
        &[
            &["compare"],
            &["compare", "nowhere"],
            &["compare", "torn/b.report.json"],
            &["compare", "empty"],
            &["compare", "folder"],
            &["compare", "torn"],
            &["compare", "missing"],
            &["compare", "deep"],
            &["compare", "type"],
            &["compare", "share"],
            &["compare", "roc", "--format", "html"],
            &["compare", "slice", "--format", "html"],
            &["compare", "slice", "--format", "pdf"],
            &["compare", "slice", "--out", "."],
        ],
    ));
}

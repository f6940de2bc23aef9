//! `export`.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use crate::{called, json, refusals, scenario};

/// Columns of a CSV file by their names.
fn columns(path: &Path) -> BTreeMap<String, Vec<String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(Into::into).collect();
    let mut columns: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in reader.records() {
        let row = row.unwrap();
        for (name, text) in names.iter().zip(&row) {
            columns.entry(name.clone()).or_default().push(text.into());
        }
    }
    assert_eq!(columns.len(), names.len(), "two columns of a name");
    columns
}

/// A run with these arguments: its JSON, and its export with these options.
fn exported(run: &str, options: &str) -> (Value, BTreeMap<String, Vec<String>>) {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (recording, table) = (file("r.trajectory"), file("r.csv"));
    let told = json(&format!("run {run} --record {recording}"));
    let call = format!("export {recording} -o {table} {options}");
    called(&call).assert().success();
    (told, columns(Path::new(&table)))
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn a_row_a_step_tells_what_the_run_told() {
    let (run, table) = exported("--push 0.3:torso:20 --duration 1.2", "");
    assert_eq!(table["time"].len(), 1200);
    assert_eq!((&*table["time"][0], &*table["time"][1007]), ("0", "1.007"));
    let last = |name: &str| number(table[name].last().unwrap());
    // The last row is of the last step's beginning.
    for (name, key, i) in [
        ("com_x", "com", 0),
        ("com_y", "com", 1),
        ("com_vx", "com_velocity", 0),
    ] {
        let end = run["end"][key][i].as_f64().unwrap();
        assert!(
            (last(&format!("humanoid.{name}")) - end).abs() < 2e-3,
            "{name}"
        );
    }
    assert_eq!(run["end"]["active"], table["humanoid.active"][1199]);
    // The trunk's angle is the root's pitch and the waist's, and the root link is the root.
    let angle = last("humanoid.pitch") + last("humanoid.waist");
    assert!((last("humanoid.torso.angle") - angle).abs() < 1e-6);
    assert_eq!(table["humanoid.pelvis.x"], table["humanoid.x"]);
    // A foot stands where it is loaded.
    let [rear, cop, front] =
        ["support_rear", "cop_x", "support_front"].map(|n| last(&format!("humanoid.{n}")));
    assert!(rear < cop && cop < front);
    assert!(last("humanoid.grf_y") > 500.0);
    assert!(
        table["humanoid.v.knee_r"]
            .iter()
            .any(|v| number(v).abs() > 0.01)
    );
}

#[test]
fn rows_are_thinned() {
    let (_, all) = exported("--duration 0.3", "");
    let (_, some) = exported("--duration 0.3", "--every 25");
    assert_eq!(some["time"].len(), 12);
    assert_eq!(some["time"][2], "0.05");
    assert_eq!(some["humanoid.com_x"][2], all["humanoid.com_x"][50]);
}

#[test]
fn a_second_one_of_a_name_is_numbered() {
    let (run, table) = exported(&format!("{} --duration 0.7", scenario("two.ron")), "");
    let apart = number(&table["humanoid_2.x"][0]) - number(&table["humanoid.x"][0]);
    assert!((apart - 2.0).abs() < 1e-6);
    let active = table["humanoid_2.active"].last().unwrap();
    assert_eq!(run["ends"][1]["active"], *active);
    for (name, end) in [("humanoid", 0), ("humanoid_2", 1)] {
        let x = number(table[&format!("{name}.com_x")].last().unwrap());
        let told = run["ends"][end]["com"][0].as_f64().unwrap();
        assert!((x - told).abs() < 1e-6, "{name}: {x} {told}");
    }
}

#[test]
fn props_have_their_frames() {
    let (_, table) = exported("clips/catch_ball --duration 0.5", "--every 100");
    let x: Vec<f64> = table["ball.x"].iter().map(|x| number(x)).collect();
    assert!((x[0] - 7.52).abs() < 1e-6);
    assert!((x[1] - x[0] + 0.65).abs() < 0.02, "{x:?}");
    assert!(table["rail.angle"].iter().all(|a| number(a) == 0.0));
    assert!(table["humanoid.reference_x"].iter().any(|r| !r.is_empty()));
}

#[test]
fn what_is_not_there_is_empty() {
    // Dropped as a heap onto the floor: at first nothing carries it.
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (recording, table) = (file("r.trajectory"), file("r.csv"));
    let heap = "trials --fallen --only 0 --count 1 --duration 0.1";
    called(&format!("{heap} --record {recording}"))
        .assert()
        .success();
    called(&format!("export {recording} -o {table}"))
        .assert()
        .success();
    let table = columns(Path::new(&table));
    for name in ["cop_x", "support_rear", "support_front"] {
        assert_eq!(table[&format!("humanoid.{name}")][0], "", "{name}");
    }
}

#[test]
fn bad_usage() {
    let folder = tempfile::tempdir().unwrap();
    let run = "run --duration 0.05 --record r.trajectory";
    let mut call = called(run);
    call.current_dir(folder.path()).assert().success();
    std::fs::write(folder.path().join("no.trajectory"), "time,x\n").unwrap();
    insta::assert_snapshot!(refusals(
        folder.path(),
        &[
            &["export", "r.trajectory"],
            &["export", "r.trajectory", "-o", "r.parquet"],
            &["export", "r.trajectory", "-o", "r"],
            &["export", "r.trajectory", "-o", "r.csv", "--every", "0.5"],
            &["export", "r.trajectory", "-o", "r.csv", "--every", "nan"],
            &["export", "no.trajectory", "-o", "r.csv"],
        ],
    ));
    assert!(!folder.path().join("r.csv").exists());
}

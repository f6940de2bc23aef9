//! `train cmrt`, `train basis` and `clips`, on a clip that is short and quickly searched.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::{called, refusals};

/// A short deep bow with the arms ahead.
const CLIP: &str = r#"(
    kind: "cmrt",
    contract: (
        name: "dip", weight: 0, precondition: Always, postcondition: Always,
        expected: Posture([standing, crouching]),
        commands: [(name: "dip", parameters: [(name: "duration", default: 0.3, min: 0.2, max: 0.6)])],
    ),
    spec: (motions: [(
        length: 0.6, preparation: 0.2, task: 0.3,
        timed_by: Some("duration"), parameter: Some("duration"),
        keys: [(from: 1.0, to: 2.0, pose: {"waist": -1.2, "shoulder": 1.5})],
    )]),
)"#;
const REPERTOIRE: &str = r#"(name: "r", fallback: "rest", controllers: [
    File("skills/balance.ron"), File("dip.ron"), File("skills/rest.ron"),
])"#;
const SCENARIO: &str = r#"(
    name: "dip", duration: 0.6,
    characters: [(character: "humanoid", repertoire: "r.ron")],
    parameters: {"duration": (default: 0.3, min: 0.2, max: 0.6)},
    events: [Command(at: 0.0, text: "dip duration={duration}")],
    expect: [Balanced()],
)"#;
const SEARCH: &str = "train cmrt dip_clip.ron --seed 3 --starts 0";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("dip.ron"), CLIP).unwrap();
    fs::write(folder.path().join("r.ron"), REPERTOIRE).unwrap();
    fs::write(folder.path().join("dip_clip.ron"), SCENARIO).unwrap();
    folder
}

fn told(folder: &Path, arguments: &str) -> Value {
    let output = called(arguments)
        .current_dir(folder)
        .arg("--json")
        .output()
        .unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_search_is_the_same_for_any_number_of_jobs_and_its_output_is_the_clips_controller() {
    let folder = folder();
    let at = folder.path();
    let one = told(
        at,
        &format!("{SEARCH} --evaluations 21 --jobs 1 --out a.ron"),
    );
    let two = told(
        at,
        &format!("{SEARCH} --evaluations 21 --jobs 2 --out b.ron"),
    );
    for key in ["times", "displacements", "flat", "optimised", "course"] {
        assert_eq!(one[key], two[key], "{key}");
    }
    let text = |name: &str| fs::read_to_string(at.join(name)).unwrap();
    assert_eq!(text("a.ron"), text("b.ron"));
    let objective = |judged: &str| one[judged]["objective"].as_f64().unwrap();
    assert!(objective("optimised") <= objective("flat"));
    assert_eq!(one["times"].as_array().unwrap().len(), 4);
    assert_eq!(one["parameters"]["duration"], 0.3);
    // In the place of the clip's controller it does what the search has found.
    fs::copy(at.join("a.ron"), at.join("dip.ron")).unwrap();
    let clips = told(at, "clips dip_clip.ron --seed 3");
    assert_eq!(clips[0]["learned"], one["optimised"]);
    assert_eq!(clips[0]["flat"], one["flat"]);
}

#[test]
fn a_search_that_was_cut_short_goes_on_to_what_it_would_have_found() {
    let folder = folder();
    let at = folder.path();
    let whole = told(at, &format!("{SEARCH} --evaluations 31 --out whole.ron"));
    told(at, &format!("{SEARCH} --evaluations 11 --out part.ron"));
    // As after a kill in the middle of a generation.
    let journal = at.join("part.ron.journal");
    let mut text = fs::read_to_string(&journal).unwrap();
    text.push_str("0123456789abcdef:40");
    fs::write(&journal, text).unwrap();
    let resumed = told(
        at,
        &format!("{SEARCH} --evaluations 31 --resume --out part.ron"),
    );
    assert_eq!(resumed["course"], whole["course"]);
    assert_eq!(resumed["displacements"], whole["displacements"]);
    let told = refusals(
        at,
        &[&[
            "train",
            "cmrt",
            "dip_clip.ron",
            "--seed",
            "4",
            "--resume",
            "--out",
            "part.ron",
        ]],
    );
    assert!(told.contains("seed"), "{told}");
}

#[test]
fn a_basis_of_a_family_serves_a_search_in_few_dimensions() {
    let folder = folder();
    let at = folder.path();
    let basis = told(
        at,
        "train basis dip_clip.ron --over duration=0.2..0.4 --count 3 --components 1 --knots 1 \
         --evaluations 41 --starts 0 --seed 1 --out b.ron",
    );
    assert_eq!(basis["values"].as_array().unwrap().len(), 3);
    let explained: f64 = basis["explained"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .sum();
    assert!((explained - 1.0).abs() < 1e-9);
    let reduced = told(
        at,
        &format!("{SEARCH} --basis b.ron --evaluations 11 --out r2.ron"),
    );
    assert_eq!(reduced["dimensions"], 1);
    assert_eq!(reduced["times"].as_array().unwrap().len(), 1);
    fs::write(at.join("bad.ron"), "(clip: \"x\")").unwrap();
    let calls: &[&[&str]] = &[
        &["train", "cmrt", "dip_clip.ron", "--basis", "bad.ron"],
        &["train", "basis", "dip_clip.ron", "--over", "duration"],
        &["train", "basis", "dip_clip.ron", "--over", "duration=2..1"],
        &["train", "basis", "dip_clip.ron", "--over", "speed=1..2"],
    ];
    insta::assert_snapshot!(refusals(at, calls));
}

/// A clip's file with one thing changed.
fn spoilt(from: &str, to: &str) -> String {
    assert!(CLIP.contains(from), "{from}");
    CLIP.replace(from, to)
}

#[test]
fn bad_clips_end_in_clear_errors() {
    let folder = folder();
    let at = folder.path();
    let knots = |times: &str| {
        let cmrt = format!("cmrts: [(length: 0.6, times: {times}, displacements: [0.1, 0.0])],");
        spoilt("keys:", &format!("{cmrt} keys:"))
    };
    let bad = [
        ("joint", spoilt("waist", "wiast")),
        ("phases", spoilt("preparation: 0.2", "preparation: 2.0")),
        ("key", spoilt("from: 1.0, to: 2.0", "from: 2.0, to: 1.0")),
        ("unordered", knots("[0.4, 0.2]")),
        ("uneven", knots("[0.2]")),
        (
            "parameter",
            spoilt(
                "Some(\"duration\"), parameter",
                "Some(\"speed\"), parameter",
            ),
        ),
        ("kind", CLIP.replace("kind: \"cmrt\"", "kind: \"cmrtt\"")),
    ];
    let mut calls = Vec::new();
    for (name, text) in &bad {
        let file = format!("{name}.ron");
        fs::write(at.join(&file), text).unwrap();
        let repertoire = REPERTOIRE.replace("dip.ron", &file);
        fs::write(at.join(format!("{name}_r.ron")), repertoire).unwrap();
        let scenario = SCENARIO.replace("r.ron", &format!("{name}_r.ron"));
        fs::write(at.join(format!("{name}_clip.ron")), scenario).unwrap();
        calls.push(format!("{name}_clip.ron"));
    }
    let silent = SCENARIO.replace(
        "events: [Command(at: 0.0, text: \"dip duration={duration}\")],",
        "",
    );
    fs::write(at.join("silent.ron"), silent).unwrap();
    let other = SCENARIO.replace("dip duration={duration}", "balance");
    fs::write(at.join("other.ron"), other).unwrap();
    let mut calls: Vec<Vec<&str>> = calls.iter().map(|c| vec!["train", "cmrt", c]).collect();
    calls.push(vec!["train", "cmrt", "silent.ron"]);
    calls.push(vec!["train", "cmrt", "other.ron"]);
    calls.push(vec!["train", "cmrt", "bned"]);
    calls.push(vec!["train", "cmrt", "dip_clip.ron", "--set", "duration=9"]);
    calls.push(vec!["train", "cmrt", "dip_clip.ron", "--set", "mass=-1"]);
    calls.push(vec!["train", "cmrt", "dip_clip.ron", "--knots", "9"]);
    calls.push(vec![
        "train",
        "cmrt",
        "dip_clip.ron",
        "--evaluations",
        "10000000",
    ]);
    let calls: Vec<&[&str]> = calls.iter().map(Vec::as_slice).collect();
    insta::assert_snapshot!(refusals(at, &calls));
}

#[test]
fn help_of_train_cmrt_and_basis_and_clips() {
    let help =
        |arguments: &str| String::from_utf8(called(arguments).output().unwrap().stdout).unwrap();
    insta::assert_snapshot!("help_of_train_cmrt", help("train cmrt --help"));
    insta::assert_snapshot!("help_of_train_basis", help("train basis --help"));
    insta::assert_snapshot!("help_of_clips", help("clips --help"));
}

#[test]
fn every_shipped_clip_shows_what_it_expects() {
    for clip in aplomb::scenarios::clips() {
        let call = called(&format!("run clips/{clip}")).output().unwrap();
        let told = String::from_utf8_lossy(&call.stderr).into_owned();
        assert_eq!(call.status.code(), Some(0), "{clip}: {told}");
    }
}

#[test]
fn who_expected_a_lighter_and_slower_ball_falls_and_rises() {
    let call = called("run clips/catch_ball --set mass=15 --set speed=8 --duration 14 --json");
    let output = { call }.output().unwrap();
    // The ball was not held, as the scenario expects.
    assert_eq!(output.status.code(), Some(1));
    let run: Value = serde_json::from_slice(&output.stdout).unwrap();
    let events = run["events"].as_array().unwrap();
    let active: Vec<&str> = events.iter().filter_map(|e| e["to"].as_str()).collect();
    assert_eq!(
        (active[0], active[1]),
        ("catch", "protective_step"),
        "{active:?}"
    );
    assert!(active.contains(&"fall"), "{active:?}");
    assert_eq!(run["end"]["standing"], true, "{active:?}");
}

//! `aplomb train preconditions`: files, determinism, interruption, and what is refused.

use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

use predicates::prelude::*;
use serde_json::Value;
use tempfile::TempDir;

use super::{called, refusal};

/// Pushes of a standing character, half of which balance takes.
const PUSHES: &str = r#"(
    features: ["com_from_feet", "com_velocity_x", "capture_from_feet", "trunk_rate"],
    starts: [(spread: 0.05)],
    during: [Servos],
    force: (links: ["pelvis"], most: 600.0, rise: 0.2, time: (0.05, 0.2)),
    offset: 0.1,
    pause: (0.0, 0.05),
    within: 1.5,
)"#;

fn folder(disturbance: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pushes.ron"), disturbance).unwrap();
    folder
}

fn arguments(more: &str) -> String {
    format!("train preconditions balance --kernel poly2 --seed 5 --disturbance pushes.ron {more}")
}

fn trained(folder: &Path, more: &str) -> Value {
    let mut call = called(&arguments(more));
    let output = call.current_dir(folder).arg("--json").output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The files of a folder that must not depend on how they came about.
fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = [
        "train.csv",
        "train.ron",
        "test.csv",
        "test.ron",
        "boundary.ron",
    ];
    let read = |name: &str| {
        let name = format!("balance.{name}");
        let bytes = fs::read(folder.join(&name)).unwrap();
        (name, bytes)
    };
    names.into_iter().map(read).collect()
}

#[test]
fn datasets_boundary_and_report_are_written_whatever_the_number_of_threads() {
    let folder = folder(PUSHES);
    let sizes = "--samples 80 --test 50 --curve 40";
    let rows = trained(folder.path(), &format!("{sizes} --jobs 1 --out one"));
    let row = &rows[0];
    assert_eq!(row["controller"], "balance");
    assert_eq!((&row["train"], &row["test"]), (&80.into(), &50.into()));
    assert_eq!(row["rollouts"], 130);
    assert_eq!(row["svm"]["kernel"], "poly2");
    assert_eq!(row["curve"].as_array().unwrap().len(), 1);
    let rate = row["positive_rate"].as_f64().unwrap();
    assert!((0.1..0.9).contains(&rate), "{rate}");
    assert!(
        row["svm"]["balanced_accuracy"].as_f64().unwrap() > 0.7,
        "{row}"
    );
    let csv = fs::read_to_string(folder.path().join("one/balance.train.csv")).unwrap();
    let mut lines = csv.lines();
    let header = "com_from_feet,com_velocity_x,capture_from_feet,trunk_rate,success";
    assert_eq!(lines.next(), Some(header));
    assert_eq!(lines.clone().count(), 80);
    // No sample of one set is in the other.
    let test = fs::read_to_string(folder.path().join("one/balance.test.csv")).unwrap();
    assert!(lines.all(|line| !test.contains(line)));

    trained(folder.path(), &format!("{sizes} --jobs 2 --out two"));
    let [one, two] = ["one", "two"].map(|d| results(&folder.path().join(d)));
    assert_eq!(one, two);

    let mut compare = called("compare one --format json");
    let output = compare.current_dir(folder.path()).output().unwrap();
    let compared: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(compared[0]["svm"]["accuracy"], row["svm"]["accuracy"]);
}

#[test]
fn what_was_killed_goes_on_to_the_same_files() {
    let folder = folder(PUSHES);
    let sizes = "--samples 400 --test 40";
    trained(folder.path(), &format!("{sizes} --out whole"));
    let line = arguments(&format!("{sizes} --jobs 1 --out cut"));
    let mut child = Process::new(assert_cmd::cargo::cargo_bin!("aplomb"))
        .args(line.split_whitespace())
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let partial = folder.path().join("cut/balance.train.partial");
    let begun = || fs::read_to_string(&partial).is_ok_and(|t| t.lines().count() > 60);
    while !begun() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(partial.exists(), "it was killed in the middle");
    // Within a line, too.
    let text = fs::read(&partial).unwrap();
    fs::write(&partial, &text[..text.len() - 7]).unwrap();
    let resumed = trained(folder.path(), &format!("{sizes} --out cut --resume"));
    let fresh = resumed[0]["rollouts"].as_u64().unwrap();
    assert!(fresh > 0 && fresh < 440, "{fresh}");
    let [whole, cut] = ["whole", "cut"].map(|d| results(&folder.path().join(d)));
    assert_eq!(whole, cut);
    assert!(!partial.exists());

    // A set that is there is not gathered again; one that was cut short is.
    let again = trained(folder.path(), &format!("{sizes} --out cut --resume"));
    assert_eq!(again[0]["rollouts"], 0);
    let csv = folder.path().join("cut/balance.test.csv");
    let text = fs::read(&csv).unwrap();
    fs::write(&csv, &text[..text.len() / 2]).unwrap();
    trained(folder.path(), &format!("{sizes} --out cut --resume"));
    assert_eq!(results(&folder.path().join("cut")), whole);
}

#[test]
fn sets_and_distributions_that_teach_nothing_are_refused() {
    let refused = |text: &str, more: &str, why: &str| {
        let folder = folder(text);
        let line = arguments(more);
        let words: Vec<&str> = line.split_whitespace().collect();
        let error = refusal(folder.path(), &words);
        assert!(error.contains(why), "{error}");
    };
    let few = "--samples 12 --test 10 --out o";
    let lying = PUSHES.replace("spread: 0.05", "pitch: 1.57");
    refused(&lying, few, "a boundary needs both");
    let typo = PUSHES.replace("com_velocity_x", "com_velocity_z");
    refused(&typo, few, "com_velocity_x");
    let nowhere = PUSHES.replace("(spread: 0.05)", "(lift: (0.4, 0.5))");
    let nowhere = nowhere.replace("trunk_rate", "com_offset");
    refused(&nowhere, few, "com_offset");
    let link = PUSHES.replace("pelvis", "tail");
    refused(&link, few, "force.links[0] is 'tail'");
    refused(&PUSHES.replace("most: 600.0", "most: inf"), few, "most");
    refused(&PUSHES.replace("(0.05, 0.2)", "(0.2, 0.05)"), few, "time");
    refused(&PUSHES.replace("[Servos]", "[]"), few, "during");
    refused(&PUSHES.replace("within: 1.5", "within: 1e9"), few, "within");
    refused(PUSHES, "--samples 3 --out o", "--samples");
    refused(PUSHES, "rise --out o", "single controller");
    let mut call = called("train preconditions balance --kernel cubic");
    let known = predicate::str::contains("poly3");
    call.assert().code(2).stderr(known);
}

#[test]
fn another_set_is_not_gone_on_with() {
    let folder = folder(PUSHES);
    let out = folder.path().join("o");
    fs::create_dir(&out).unwrap();
    fs::write(
        out.join("balance.train.partial"),
        "aplomb-rollouts-1 controller=bow\n",
    )
    .unwrap();
    let line = arguments("--samples 12 --test 10 --out o --resume");
    let words: Vec<&str> = line.split_whitespace().collect();
    let error = refusal(folder.path(), &words);
    assert!(error.contains("controller=bow"), "{error}");
}

#[test]
fn controllers_without_a_distribution_say_which_have_one() {
    let mut call = called("train preconditions bow --samples 12 --out o");
    let known = predicate::str::contains("protective_step");
    call.assert().code(2).stderr(known);
}

#[test]
fn a_learned_boundary_takes_its_place_in_a_repertoire() {
    let folder = folder(PUSHES);
    trained(folder.path(), "--samples 80 --test 50 --out o");
    let repertoire = r#"(name: "mine", fallback: "rest", controllers: [
        Learned(controller: "skills/balance.ron", boundary: "o/balance.boundary.ron", confident: true),
        File("skills/rest.ron"),
    ])"#;
    fs::write(folder.path().join("mine.ron"), repertoire).unwrap();
    let mut call = called("controllers --repertoire mine.ron --json");
    let output = call.current_dir(folder.path()).output().unwrap();
    let pool: Value = serde_json::from_slice(&output.stdout).unwrap();
    let flags = |i: usize| (&pool[i]["learned"], &pool[i]["confident"]);
    assert_eq!(flags(0), (&true.into(), &true.into()));
    assert_eq!(flags(1), (&false.into(), &false.into()));
    let mut call = called("run --repertoire mine.ron --duration 1.5 --json");
    let output = call.current_dir(folder.path()).output().unwrap();
    let run: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(run["end"]["active"], "balance");
    assert_eq!(run["end"]["standing"], true);
}

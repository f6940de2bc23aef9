//! `train skill` and `robustness`, on a repertoire whose only skill is quickly found.

use std::path::Path;

use predicates::prelude::*;
use serde_json::Value;
use tempfile::TempDir;

use crate::{called, refusals};

/// A character that cannot stand and draws up its knees once it lies.
const REPERTOIRE: &str = r#"(name: "tuck", fallback: "rest", controllers: [
    File("tuck.ron"), File("skills/bow.ron"), File("skills/rest.ron"),
])"#;

const TUCK: &str = include_str!("../../training/src/exercise/skill/tuck.ron");

const SEARCH: &str = "train skill tuck --repertoire r.ron --starts 2 --sigma 0.2 --seed 3";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.ron"), REPERTOIRE).unwrap();
    std::fs::write(folder.path().join("tuck.ron"), TUCK).unwrap();
    folder
}

/// The JSON value that a call in a folder prints.
fn told(folder: &Path, arguments: &str) -> Value {
    let mut call = called(arguments);
    let output = call.current_dir(folder).arg("--json").output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{error}");
    assert_eq!(output.stdout.iter().filter(|b| **b == b'\n').count(), 1);
    serde_json::from_slice(&output.stdout).unwrap()
}

fn help(arguments: &str) -> String {
    String::from_utf8(called(arguments).output().unwrap().stdout).unwrap()
}

#[test]
fn help_of_train_skill() {
    insta::assert_snapshot!(help("train skill --help"));
}

#[test]
fn help_of_robustness() {
    insta::assert_snapshot!(help("robustness --help"));
}

#[test]
fn a_search_is_told_as_json_and_its_file_is_a_controller() {
    let folder = folder();
    let search = told(
        folder.path(),
        &format!("{SEARCH} --evaluations 12 --out better.ron"),
    );
    assert_eq!(
        (&search["controller"], &search["kind"], &search["out"]),
        (&"tuck".into(), &"pose".into(), &"better.ron".into())
    );
    assert_eq!((&search["seed"], &search["starts"]), (&3.into(), &2.into()));
    // The first, and two generations of eight.
    assert_eq!(search["evaluations"], 17);
    assert_eq!(search["interrupted"], false);
    let number = |key: &str| search[key].as_f64().unwrap();
    assert!(number("cost") < number("start_cost"));
    assert!(number("reached") >= number("start_reached") && number("reached") <= 2.0);
    assert!(number("wall_s") > 0.0);
    let file = folder.path().join("better.ron");
    let text = std::fs::read_to_string(&file).unwrap();
    let header = text.lines().next().unwrap();
    // The best was in the first generation.
    assert!(header.ends_with("seed 3, 9 evaluations."), "{header}");
    // Put in the place of the first, it begins where the search has come to.
    std::fs::copy(&file, folder.path().join("tuck.ron")).unwrap();
    let again =
        "train skill tuck --repertoire r.ron --evaluations 1 --starts 2 --seed 3 --out x.ron";
    let again = told(folder.path(), again);
    assert_eq!(again["start_cost"], search["cost"]);
}

#[test]
fn jobs_and_interruptions_change_nothing() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let read = |name: &str| std::fs::read(path(name)).unwrap();
    told(
        folder.path(),
        &format!("{SEARCH} --evaluations 12 --jobs 1 --out 1.ron"),
    );
    told(
        folder.path(),
        &format!("{SEARCH} --evaluations 12 --jobs 2 --out 2.ron"),
    );
    assert_eq!(read("1.ron"), read("2.ron"));
    let journal = read("1.ron.journal");
    assert_eq!(journal, read("2.ron.journal"));
    // Killed within the last generation, while its line was written.
    std::fs::write(path("2.ron.journal"), &journal[..journal.len() - 9]).unwrap();
    std::fs::remove_file(path("2.ron")).unwrap();
    told(
        folder.path(),
        &format!("{SEARCH} --evaluations 12 --out 2.ron --resume"),
    );
    assert_eq!(read("1.ron"), read("2.ron"));
    assert_eq!(journal, read("2.ron.journal"));
}

#[test]
fn falls_are_searched_over_pushes() {
    let folder = folder();
    let search = "train skill fall --evaluations 1 --starts 2 --out fall.ron";
    let search = told(folder.path(), search);
    assert_eq!(
        (&search["kind"], &search["starts"]),
        (&"fall".into(), &2.into())
    );
    let repertoire = r#"(name: "mine", fallback: "rest", controllers: [
        File("fall.ron"), File("skills/rest.ron"),
    ])"#;
    std::fs::write(folder.path().join("mine.ron"), repertoire).unwrap();
    let pool = told(folder.path(), "controllers --repertoire mine.ron");
    assert_eq!(pool[0]["kind"], "fall");
    // Nothing is left to do.
    let again = "train skill fall --evaluations 1 --starts 2 --out fall.ron --resume";
    assert_eq!(told(folder.path(), again)["cost"], search["cost"]);
}

#[test]
fn standing_is_searched_over_pushes_at_its_limit() {
    let folder = folder();
    let search = "train skill balance --evaluations 1 --starts 2 --out balance.ron";
    let search = told(folder.path(), search);
    assert_eq!(
        (&search["kind"], &search["starts"]),
        (&"balance".into(), &2.into())
    );
    let text = std::fs::read_to_string(folder.path().join("balance.ron")).unwrap();
    let header = "// Optimised by CMA-ES over 2 pushes of 8 to 30 N·s forward and 8 to 26 backward";
    assert!(text.starts_with(header), "{text}");
    // By its former name.
    let again = "train poses balance --evaluations 1 --starts 2 --out balance.ron --resume";
    assert_eq!(told(folder.path(), again)["cost"], search["cost"]);
}

#[test]
fn bad_usage() {
    let folder = folder();
    told(
        folder.path(),
        &format!("{SEARCH} --evaluations 1 --out old.ron"),
    );
    std::fs::write(folder.path().join("none.ron.journal"), "(none)\n").unwrap();
    let search = |more: &str| format!("train skill tuck --repertoire r.ron {more}");
    let calls = [
        "train skill".to_owned(),
        "train skill tcuk --repertoire r.ron".to_owned(),
        "train skill tuck".to_owned(),
        "train skill rest".to_owned(),
        "train skill stance --starts 0".to_owned(),
        "train skill bow".to_owned(),
        search("--evaluations 0"),
        search("--starts 0"),
        search("--sigma 0"),
        search("--sigma nan"),
        search("--jobs 0"),
        search("--out r.ron/x.ron"),
        search("--out ."),
        search("--out new.ron --resume"),
        search("--out none.ron --resume"),
        search("--out old.ron --resume"),
        search("--out old.ron --resume --seed 3"),
        search("--out old.ron --resume --seed 3 --starts 2"),
        "robustness --starts 0".to_owned(),
        "robustness nobody --repertoire r.ron".to_owned(),
        "robustness balance".to_owned(),
    ];
    let calls: Vec<Vec<&str>> = calls.iter().map(|c| c.split(' ').collect()).collect();
    let calls: Vec<&[&str]> = calls.iter().map(Vec::as_slice).collect();
    insta::assert_snapshot!(refusals(folder.path(), &calls));
}

#[test]
fn another_controller_or_repertoire_is_another_search() {
    let folder = folder();
    let resumed = format!("{SEARCH} --evaluations 1 --out x.ron --resume");
    told(
        folder.path(),
        &format!("{SEARCH} --evaluations 1 --out x.ron"),
    );
    told(folder.path(), &resumed);
    let refused = |name: &str, text: &str, why: &str| {
        let path = folder.path().join(name);
        let before = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text).unwrap();
        let error = predicate::str::contains(why);
        let mut call = called(&resumed);
        call.current_dir(folder.path())
            .assert()
            .code(2)
            .stderr(error);
        std::fs::write(&path, before).unwrap();
    };
    refused(
        "tuck.ron",
        &TUCK.replace("0.5", "0.6"),
        "controller is another",
    );
    let fewer = REPERTOIRE.replace(r#"File("skills/bow.ron"), "#, "");
    refused("r.ron", &fewer, "surroundings is ");
}

#[test]
fn robustness_is_a_table_of_worlds() {
    let folder = folder();
    let options = "robustness tuck --repertoire r.ron --starts 2";
    let all = told(folder.path(), &format!("{options} --jobs 1"));
    assert_eq!((&all["starts"], &all["seed"]), (&2.into(), &0.into()));
    let row = &all["controllers"][0];
    assert_eq!(row["controller"], "tuck");
    let cells = row["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 12);
    let number = |v: &Value| v.as_f64().unwrap();
    for cell in cells {
        assert_eq!(cell["starts"], 2);
        assert_eq!(number(&cell["fraction"]), number(&cell["reached"]) / 2.0);
        assert!(number(&row["least"]["fraction"]) <= number(&cell["fraction"]));
    }
    assert_eq!(number(&cells[3]["friction"]), 0.8);
    assert_eq!(number(&cells[3]["torque"]), 0.85);
    // Without names: all that have a goal and get a chance.
    let mut call = called("robustness --repertoire r.ron --starts 2 --jobs 2");
    let least = &row["least"];
    let line = format!(
        "least: {:.1} % ({}) of 2 at friction {}, torque {}\n",
        100.0 * number(&least["fraction"]),
        least["reached"],
        least["friction"],
        least["torque"]
    );
    call.current_dir(folder.path())
        .assert()
        .success()
        .stdout(predicate::str::starts_with(
            "2 starts in every world, seed 0\n\ntuck, to its ",
        ))
        .stdout(predicate::str::contains("torque 0.85"))
        .stdout(predicate::str::contains(line))
        .stdout(predicate::str::contains("bow").not());
}

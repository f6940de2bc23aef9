//! The figures of `train cmrt` and `train basis`.

use std::collections::BTreeMap;
use std::path::Path;

use predicates::prelude::*;

use crate::called;

/// Names and texts of the files of a folder.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let text = |e: std::fs::DirEntry| {
        let name = e.file_name().into_string().unwrap();
        (name, std::fs::read_to_string(e.path()).unwrap())
    };
    entries.map(|e| text(e.unwrap())).collect()
}

fn names(files: &BTreeMap<String, String>) -> Vec<&str> {
    files.keys().map(String::as_str).collect()
}

#[test]
fn a_clip_has_five_figures_that_a_resumed_search_draws_again() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        let search = "train cmrt bend --evaluations 12 --least 1 --out c.ron";
        let mut call = called(&format!("{search} {arguments}"));
        call.current_dir(folder.path()).assert().success();
    };
    run("--figures a");
    run("--figures b --resume");
    let drawn = files(&folder.path().join("a"));
    let expected = ["cmrt", "convergence", "cop", "with", "without"];
    let expected = expected.map(|n| format!("bend.{n}.svg"));
    assert_eq!(names(&drawn), expected);
    assert!(drawn["bend.with.svg"].contains("clips/bend, with anticipation"));
    assert!(drawn["bend.without.svg"].contains("clips/bend, without anticipation"));
    assert_eq!(drawn, files(&folder.path().join("b")));
}

#[test]
fn a_basis_has_three_figures() {
    let folder = tempfile::tempdir().unwrap();
    let search = "train basis bend --over duration=0.3..0.6 --count 3 --evaluations 22";
    let mut call = called(&format!("{search} --out b.ron --figures f"));
    call.current_dir(folder.path()).assert().success();
    let drawn = files(&folder.path().join("f"));
    let expected = ["components", "family", "variance"];
    let expected = expected.map(|n| format!("bend.{n}.svg"));
    assert_eq!(names(&drawn), expected);
}

#[test]
fn a_folder_that_cannot_be_written_into_is_refused_before_the_search() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let mut call = called("train cmrt bend --out c.ron --figures file");
    let call = call.current_dir(folder.path()).assert().failure();
    call.stderr(predicate::str::contains("cannot write"));
    assert_eq!(names(&files(folder.path())), ["file"]);
}

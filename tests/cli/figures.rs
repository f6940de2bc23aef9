//! The figures of `train cmrt` and `train basis`.

#[path = "../../src/render/seen.rs"]
mod seen;

use std::collections::BTreeMap;
use std::path::Path;

use predicates::prelude::*;

use seen::{Sight, assert_seen};

use crate::called;

/// Colours of the centre of pressure, of the reference trajectory, of a course, of a component that is
/// added to the mean.
const COP: &str = "#00845c";
const REFERENCE: &str = "#1f2933";
const COURSE: &str = "#0072b2";
const MORE: &str = "#d55e00";

/// Asserts that a figure has texts and a curve (colour, least points, least width in px), and that no
/// label overlaps another or leaves it.
#[track_caller]
fn assert_drawn(svg: &str, texts: &[&str], (colour, points, width): (&str, usize, f32)) {
    let mut sights: Vec<_> = texts.iter().map(|t| Sight::Text(t, 1)).collect();
    sights.push(Sight::Curve(colour, points, width));
    let crowded = assert_seen(svg, &sights).crowded();
    assert!(crowded.is_empty(), "{}", crowded.join("\n"));
}

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
    let figure = |name: &str| drawn[&format!("bend.{name}.svg")].as_str();
    let axes = ["(m)", "(s)"];
    let panels = ["without anticipation", "objective"];
    assert_drawn(figure("cop"), &[axes, panels].concat(), (COP, 100, 100.0));
    let phases = ["preparation", "decay"];
    assert_drawn(
        figure("cmrt"),
        &[axes, phases].concat(),
        (REFERENCE, 300, 400.0),
    );
    let course = ["evaluations", "best objective", "without anticipation:"];
    assert_drawn(figure("convergence"), &course, (COURSE, 1, 0.0));
    let films = ["with", "without"].map(|name| {
        let title = format!("clips/bend, {name} anticipation");
        let film = assert_seen(
            figure(name),
            &[Sight::Text(&title, 1), Sight::Text("0.00 s", 1)],
        );
        assert!(
            film.outlines.len() > 100,
            "{} outlines",
            film.outlines.len()
        );
        figure(name).replace(&title, "")
    });
    assert_ne!(films[0], films[1], "they differ in more than their titles");
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
    let figure = |name: &str| drawn[&format!("bend.{name}.svg")].as_str();
    let values = ["(m)", "(s)", "duration", "0.3", "0.6"];
    let mut sights = values.map(|v| Sight::Text(v, 1)).to_vec();
    // The grid, the frame and three curves with their knots are in other colours than a component.
    sights.push(Sight::Text("0.45", 1));
    assert_seen(figure("family"), &sights);
    assert_ne!(
        seen::Seen::of(figure("family")).coloured(REFERENCE).len(),
        0
    );
    let component = ["component 1", "displacement (m)", "time (s)", "mean"];
    assert_drawn(figure("components"), &component, (MORE, 300, 200.0));
    let variance = ["variance explained (%)", "principal component", "100"];
    assert_drawn(figure("variance"), &variance, (COURSE, 2, 20.0));
    // Three parts, each alone and with those before: a line, a mark each, a sample of line and mark.
    assert_seen(
        figure("variance"),
        &[Sight::Shapes(COURSE, 2 * (1 + 3 + 2))],
    );
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

//! The reports of a folder.
//!
//! folder → files in the order of their names → reports whose numbers are possible.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use aplomb::framework::input::{Error, read_bounded};
use aplomb::training::preconditions::report::{Metrics, Report};

/// How the files are called.
const ENDING: &str = ".report.json";
/// The largest report, bytes.
const LARGEST: u64 = 1 << 24;

/// A report and where it stands.
#[derive(Debug)]
pub(super) struct ReportFile {
    pub(super) path: PathBuf,
    pub(super) report: Report,
}

/// All reports of a folder, at least one.
pub(super) fn folder(folder: &Path) -> Result<Vec<ReportFile>> {
    let fail = |e: std::io::Error| Error::Read {
        path: folder.to_owned(),
        reason: e.to_string(),
    };
    let mut paths = Vec::new();
    for file in folder.read_dir().map_err(fail)? {
        let file = file.map_err(fail)?;
        let name = file.file_name();
        let name = name.to_string_lossy();
        if name.ends_with(ENDING) && !name.starts_with('.') {
            paths.push(file.path());
        }
    }
    paths.sort();
    ensure!(
        !paths.is_empty(),
        "{} has no *{ENDING}; `aplomb train preconditions` writes them",
        folder.display()
    );
    paths.into_iter().map(entry).collect()
}

fn entry(path: PathBuf) -> Result<ReportFile> {
    let bytes = read_bounded(&path, LARGEST)?;
    let report = serde_json::from_slice(&bytes).map_err(|e| syntax(&path, &e))?;
    check(&path, &report)?;
    Ok(ReportFile { path, report })
}

/// The parser's complaint with its place in front, as in messages of all other files.
fn syntax(path: &Path, error: &serde_json::Error) -> Error {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let place = format!(" at line {line} column {column}");
    Error::Syntax {
        origin: path.display().to_string(),
        line,
        column,
        message: message.strip_suffix(&place).unwrap_or(&message).to_owned(),
    }
}

/// Refuses shares that are none: tables and figures rely on them.
fn check(path: &Path, report: &Report) -> Result<(), Error> {
    let within = |field: String, value: f64, least: f64| {
        if (least..=1.0).contains(&value) {
            return Ok(());
        }
        let accepted = format!("{least} to 1");
        let place = path.display().to_string();
        Err(Error::invalid(place, field, value, accepted))
    };
    for (field, value) in [
        ("positive_rate", report.positive_rate),
        ("test_positive_rate", report.test_positive_rate),
        ("majority", report.majority),
        ("svm.auc", report.svm.auc),
    ] {
        within(field.to_owned(), value, 0.0)?;
    }
    let all: [(&str, &Metrics); 3] = [
        ("svm", &report.svm.metrics),
        ("nn", &report.nn.metrics),
        ("manual", &report.manual),
    ];
    for (rival, m) in all {
        for (field, value, least) in [
            ("accuracy", m.accuracy, 0.0),
            ("balanced_accuracy", m.balanced_accuracy, 0.0),
            ("precision", m.precision, 0.0),
            ("recall", m.recall, 0.0),
            ("mcc", m.mcc, -1.0),
        ] {
            within(format!("{rival}.{field}"), value, least)?;
        }
    }
    Ok(())
}

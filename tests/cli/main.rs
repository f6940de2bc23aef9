//! Drives the program as people and scripts do: arguments and files in; exit code, stdout and
//! stderr out.

#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

mod bad_files;
mod bad_usage;
mod bad_values;
mod cmrt;
mod compare;
mod export;
mod figures;
mod help;
mod numbers;
mod output;
mod preconditions;
mod reproduce;
mod run;
mod shell;
mod train;
mod trials;

use std::path::Path;

use assert_cmd::Command;
use numbers::assert_within;
use serde_json::Value;

/// The program, with everything that could change its words taken away.
fn aplomb() -> Command {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("aplomb");
    command.env("COLUMNS", "100").env("NO_COLOR", "1");
    command
}

/// The program with arguments, written as in a terminal (without quotes).
fn called(arguments: &str) -> Command {
    let mut command = aplomb();
    command.args(arguments.split_whitespace());
    command
}

/// The one JSON value that a call with `--json` prints.
fn json(arguments: &str) -> Value {
    let output = called(arguments).arg("--json").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    serde_json::from_str(&text).unwrap()
}

/// A scenario of the tests.
fn scenario(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenarios");
    folder.join(name).to_str().unwrap().to_owned()
}

/// What a call in a folder that must be refused says: exit code 2, nothing on stdout, no panic.
fn refusal(folder: &Path, arguments: &[&str]) -> String {
    let call = aplomb().current_dir(folder).args(arguments).output();
    let output = call.unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert!(!error.contains("panicked"), "{arguments:?}: {error}");
    assert!(error.starts_with("error: "), "{arguments:?}: {error}");
    error
}

/// Every refusal under the call that it answers to.
fn refusals(folder: &Path, calls: &[&[&str]]) -> String {
    let told = calls.iter().map(|arguments| {
        let error = refusal(folder, arguments);
        format!("$ aplomb {}\n{error}\n", arguments.join(" "))
    });
    told.collect()
}

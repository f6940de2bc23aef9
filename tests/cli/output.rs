//! Closed pipes and interrupts.
#![cfg(unix)]

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

fn spawned(arguments: &str) -> Child {
    Command::new(assert_cmd::cargo::cargo_bin!("aplomb"))
        .args(arguments.split_whitespace())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    for arguments in [
        "run --duration 0.2 --json",
        "trials --count 2 --duration 0.2",
        "controllers",
    ] {
        let mut child = spawned(arguments);
        drop(child.stdout.take());
        let mut error = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut error)
            .unwrap();
        assert!(child.wait().unwrap().success(), "{arguments}: {error}");
        assert_eq!(error, "", "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    let full = std::fs::File::create("/dev/full").unwrap();
    let output = Command::new(assert_cmd::cargo::cargo_bin!("aplomb"))
        .arg("controllers")
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(
        error.starts_with("error: cannot write the results"),
        "{error}"
    );
}

#[test]
fn an_interrupt_prints_the_trials_that_are_finished() {
    let child = spawned("trials --count 1000000 --duration 0.5 --json");
    std::thread::sleep(Duration::from_millis(1500));
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    let trials: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(trials["interrupted"], true);
    let count = trials["count"].as_u64().unwrap();
    assert!(count > 0 && count < 1_000_000, "{count}");
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        error,
        format!("interrupted: {count} of 1000000 trials were finished\n")
    );
}

//! Closed pipes and interrupts.
#![cfg(unix)]

use std::io::Read;
use std::process::{Child, Command, Stdio};
#[cfg(target_os = "linux")]
use std::time::{Duration, Instant};

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

/// Whether a process has a handler for SIGINT, and the s of processor time that it used.
#[cfg(target_os = "linux")]
fn watched(id: u32) -> (bool, f64) {
    let read = |file: &str| std::fs::read_to_string(format!("/proc/{id}/{file}")).unwrap();
    let status = read("status");
    let caught = status.lines().find_map(|l| l.strip_prefix("SigCgt:"));
    let caught = u64::from_str_radix(caught.unwrap().trim(), 16).unwrap();
    let stat = read("stat");
    // The name, in brackets, may hold spaces; user and system time are the 12th and 13th after it.
    let (_, numbers) = stat.rsplit_once(") ").unwrap();
    let ticks = numbers.split(' ').skip(11).take(2);
    let ticks: u32 = ticks.map(|t| t.parse::<u32>().unwrap()).sum();
    (caught & (1 << 1) != 0, f64::from(ticks) / 100.0)
}

/// Trials are under way when Ctrl-C is watched for and the program has since worked for as long as
/// several trials take.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_prints_the_trials_that_are_finished() {
    const WORK: f64 = 0.5;
    let mut child = spawned("trials --count 1000000 --duration 0.1 --json");
    let patience = Instant::now() + Duration::from_secs(120);
    let mut begun = None;
    while begun.is_none_or(|begun| watched(child.id()).1 < begun + WORK) {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        assert!(Instant::now() < patience, "no trial is under way");
        if let (None, (true, used)) = (begun, watched(child.id())) {
            begun = Some(used);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let id = child.id().to_string();
    let kill = Command::new("kill").args(["-INT", &id]).status();
    assert!(kill.unwrap().success());
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

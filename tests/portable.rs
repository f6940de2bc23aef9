//! The same digest on every processor: the C library's functions take no part in a run.
//!
//! The program runs twice, once with the variants masked that the C library picks for processors
//! with fused multiplication: what calls its sin, exp or pow then gets other last bits, and the
//! digests differ. A C library that does not know the mask ignores it; the test is then one of two
//! equal runs in two processes.

#![allow(clippy::unwrap_used)]

use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;

const MASK: &str = "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4";

/// The JSON of a command, with the processor's variants of functions or without.
fn json(arguments: &str, masked: bool) -> Value {
    let mut command = cargo_bin_cmd!("aplomb");
    command.env_remove("GLIBC_TUNABLES");
    if masked {
        command.env("GLIBC_TUNABLES", MASK);
    }
    let output = command
        .args(arguments.split(' '))
        .arg("--json")
        .output()
        .unwrap();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| {
        panic!(
            "{arguments}: {e}: {}",
            String::from_utf8_lossy(&output.stderr)
        )
    })
}

/// The digest of a command, which is the same with and without the mask.
fn digest(arguments: &str) -> String {
    let [plain, masked] = [false, true].map(|masked| json(arguments, masked));
    let digest = plain["digest"].as_str().unwrap();
    assert_eq!(digest, masked["digest"], "{arguments}");
    digest.to_owned()
}

#[test]
fn pushes_on_all_links_have_one_digest() {
    let trials = "trials --min-impulse 20 --max-impulse 300 --duration 9 --seed 1 --count";
    assert_ne!(
        digest(&format!("{trials} 20")),
        digest(&format!("{trials} 1"))
    );
    for impulse in [-133, -86, 97, 122] {
        digest(&format!("run --push 1:torso:{impulse} --duration 12"));
    }
}

#[test]
fn learned_boundaries_have_one_digest() {
    digest("trials --count 6 --max-impulse 300 --duration 8 --seed 2 --repertoire learned");
}

#[test]
fn clips_have_one_digest() {
    for clip in ["slow_bend", "catch_ball", "kick", "duck_twice"] {
        digest(&format!("run clips/{clip}"));
    }
}

//! `trials`.

use predicates::prelude::*;
use serde_json::Value;

use crate::{assert_within, called, json};

/// The names of all postures.
const POSTURES: [&str; 8] = [
    "standing",
    "crouching",
    "hands_and_feet",
    "kneeling",
    "sitting",
    "supine",
    "prone",
    "airborne",
];

/// Six pushes that nobody withstands, seen for 1.4 s after them.
#[test]
fn trials_are_told_as_json() {
    let trials = json("trials --count 6 --max-impulse 250 --min-impulse 150 --duration 2.5");
    assert_eq!(trials["count"], 6);
    assert_eq!(trials["seed"], 0);
    assert_eq!(trials["interrupted"], false);
    assert_eq!(trials["simulated_s"], 15.0);
    let digest = trials["digest"].as_str().unwrap();
    assert_eq!(digest.len(), 32, "{digest}");
    let number = |v: &Value| v.as_f64().unwrap();
    assert_within(
        &trials,
        &[
            ("wall_s", 1e-3, 600.0),
            ("standing", 0.0, 2.0),
            ("fell", 4.0, 6.0),
            ("stepped", 1.0, 6.0),
            // From one takeover in each of six trials of 2.5 s to one every 0.25 s.
            ("switches_per_minute", 24.0, 240.0),
            ("controllers.balance.activations", 6.0, 12.0),
            ("controllers.balance.failed", 4.0, 12.0),
            ("controllers.fall.activations", 4.0, 12.0),
        ],
    );
    let steps = number(&trials["steps_per_s"]) * number(&trials["wall_s"]);
    assert!((steps - 15_000.0).abs() < 1e-6 * steps, "{steps}");
    let fraction = number(&trials["standing"]) / 6.0;
    assert_eq!(number(&trials["fraction"]), fraction);
    let interval = &trials["interval95"];
    assert!(number(&interval[0]) <= fraction && fraction <= number(&interval[1]));
    // Half of the interval of a share of six is at least a fifth.
    assert!(number(&interval[1]) - number(&interval[0]) > 0.2);
    let pool = trials["controllers"].as_object().unwrap();
    let mut activations = 0.0;
    for (name, counts) in pool {
        let [began, succeeded, failed] =
            ["activations", "succeeded", "failed"].map(|key| number(&counts[key]));
        assert!(succeeded + failed <= began, "{name}: {counts}");
        activations += began;
    }
    // Every start and every switch is one.
    let switches = number(&trials["switches_per_minute"]) * 15.0 / 60.0;
    assert!((activations - 6.0 - switches).abs() < 1e-9, "{activations}");
    assert_within(&trials, &[("short_activations", 0.0, activations)]);
    let falls = &trials["falls"];
    let count = |way: &str| number(&falls[way]["count"]);
    assert_eq!(
        count("forward") + count("backward"),
        number(&trials["fell"])
    );
    for (way, well) in [
        ("forward", "hands_first"),
        ("backward", "hands_or_seat_first"),
    ] {
        assert_falls(&falls[way], count(way));
        assert_within(&falls[way], &[(well, 0.0, count(way))]);
    }
    assert_falls(falls, count("forward") + count("backward"));
    let hits = ["forward", "backward"].map(|way| number(&falls[way]["head_hits"]));
    assert_eq!(number(&falls["head_hits"]), hits[0] + hits[1]);
    // Nobody lies down, gets up and stands within 1.4 s.
    assert_eq!(trials["time_to_stand"], Value::Null);
    let failures = trials["failures"].as_array().unwrap();
    assert_eq!(failures.len() as f64, 6.0 - number(&trials["standing"]));
    for failure in failures {
        assert!(["pelvis", "torso", "head"].contains(&failure["link"].as_str().unwrap()));
        let impulse = number(&failure["impulse"]).abs();
        assert!((150.0..=250.0).contains(&impulse), "{impulse}");
        let posture = failure["posture"].as_str().unwrap();
        assert!(POSTURES.contains(&posture), "{posture}");
        assert!(number(&pool[failure["active"].as_str().unwrap()]["activations"]) >= 1.0);
    }
}

/// What falls from standing height can be: a stiff rod of 1.8 m that topples hits with √(3 g h), 7.3 m/s,
/// and a push of 250 N·s adds 3 m/s to 80 kg. Stopped within a hundredth of a second, these 80 kg press
/// with 80 kN.
fn assert_falls(falls: &Value, count: f64) {
    assert_within(
        falls,
        &[("head_hits", 0.0, count), ("median_trunk_force", 0.0, 80e3)],
    );
    if falls["head_hits"] == 0 {
        for what in [
            "median_head_hit_speed",
            "p95_head_hit_speed",
            "median_head_hit_force",
        ] {
            assert_eq!(falls[what], Value::Null, "{what}");
        }
    } else {
        let median = falls["median_head_hit_speed"].as_f64().unwrap();
        assert_within(
            falls,
            &[
                ("median_head_hit_speed", 1e-3, 10.3),
                ("p95_head_hit_speed", median, 10.3),
                ("median_head_hit_force", 0.0, 80e3),
            ],
        );
    }
}

#[test]
fn a_failed_trial_can_be_repeated_alone_and_recorded() {
    let options = "--count 4 --max-impulse 300 --min-impulse 250 --duration 2.5 --seed 9";
    let trials = json(&format!("trials {options}"));
    let failure = &trials["failures"][0];
    let index = failure["index"].as_u64().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let output = called(&format!(
        "trials {options} --only {index} --record x.trajectory --json"
    ))
    .current_dir(folder.path())
    .output()
    .unwrap();
    let alone: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(&alone["failures"][0], failure);
    assert_eq!(alone["count"], 1);
    assert_eq!(alone["run"]["end"]["posture"], failure["posture"]);
    assert_eq!(alone["run"]["end"]["active"], failure["active"]);
    assert!(folder.path().join("x.trajectory").exists());
    called(&format!("trials {options} --only {index}"))
        .assert()
        .success()
        .stdout(predicate::str::starts_with(format!("trial {index}: ")));
}

#[test]
fn a_trial_does_not_depend_on_how_many_there_are() {
    let digest = |count: u32| json(&format!("trials --count {count} --only 2 --duration 1.5"));
    assert_eq!(digest(3)["run"]["digest"], digest(300)["run"]["digest"]);
}

#[test]
fn heaps_lie_on_the_floor_and_are_not_pushed() {
    let trials = json("trials --fallen --count 4 --duration 0.5");
    assert_eq!(
        (&trials["standing"], &trials["fell"]),
        (&0.into(), &0.into())
    );
    assert_eq!(trials["failures"].as_array().unwrap().len(), 4);
    assert_eq!(trials["failures"][0]["link"], Value::Null);
    let one = json("trials --fallen --count 4 --duration 0.5 --only 1");
    // Above the floor, and lower than it stands.
    assert_within(&one, &[("run.end.com.1", 0.05, 0.9)]);
}

#[test]
fn joints_are_off_at_the_start() {
    let digest = |angle: f64| {
        let trial = json(&format!(
            "trials --max-angle {angle} --only 0 --duration 0.1"
        ));
        trial["run"]["digest"].as_str().unwrap().to_owned()
    };
    assert_ne!(digest(0.05), digest(0.1));
}

#[test]
fn times_to_stand_are_from_the_fall_to_standing() {
    let options = "trials --count 1 --min-impulse 150 --max-impulse 150";
    let trials = json(&format!("{options} --duration 12"));
    let one = json(&format!("{options} --duration 12 --only 0"));
    let at = |kind: &str| {
        let events = one["run"]["events"].as_array().unwrap();
        let event = events.iter().find(|e| e["kind"] == kind).unwrap();
        event["t"].as_f64().unwrap()
    };
    let took = at("stood") - 1.0 - at("fell");
    let times = &trials["time_to_stand"];
    assert_eq!(times["count"], 1);
    for key in ["median", "p90", "max"] {
        assert!((times[key].as_f64().unwrap() - took).abs() < 1e-9, "{key}");
    }
    called(&format!("{options} --duration 12"))
        .assert()
        .success()
        .stdout(predicate::str::contains("got up               1 after "));
    let short = json(&format!("{options} --duration 2"));
    assert_eq!(short["time_to_stand"], Value::Null);
}

#[test]
fn worlds_vary_and_disturbances_stay() {
    let options = "trials --count 3 --only 1 --duration 1.5";
    let told = |more: &str| {
        let output = called(&format!("{options} {more}")).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let (same, own) = (told(""), told("--vary"));
    let (same, own) = (same.lines().next().unwrap(), own.lines().next().unwrap());
    let world = own.strip_prefix(same).unwrap();
    assert!(world.starts_with("; friction "), "{world}");
    let digest = |more: &str| json(&format!("{options} {more}"))["run"]["digest"].clone();
    assert_ne!(digest(""), digest("--vary"));
    assert_eq!(digest("--vary"), digest("--vary"));
}

#[test]
fn failures_are_told_with_their_indices() {
    let output = called("trials --count 12 --duration 2 --max-impulse 300 --min-impulse 250")
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let told = text.lines().filter(|l| l.contains(" active  "));
    let indices: Vec<u32> = told
        .map(|l| l.split_whitespace().next().unwrap().parse().unwrap())
        .collect();
    assert_eq!(indices, (0..10).collect::<Vec<_>>());
    assert!(text.contains("          and 2 more"), "{text}");
    assert!(text.contains("N on trunk and root"), "{text}");
}

#[test]
fn results_are_told_in_words() {
    called("trials --count 2 --duration 2 --max-impulse 5")
        .assert()
        .success()
        .stdout(predicate::str::contains("pushes of 0 to 5 N·s either way"))
        .stdout(predicate::str::contains("standing at the end  2 (100.0 %;"))
        .stderr("");
}

#[test]
fn who_falls_limp_lets_go_and_breaks_no_fall() {
    let options = "--count 12 --max-impulse 250 --min-impulse 200 --duration 2";
    let trials = json(&format!("trials --repertoire limp {options}"));
    let pool = trials["controllers"].as_object().unwrap();
    assert_eq!(pool.keys().collect::<Vec<_>>(), ["balance", "rest"]);
    assert_eq!(
        (&trials["standing"], &trials["fell"]),
        (&0.into(), &12.into())
    );
    assert_eq!(trials["controllers"]["rest"]["activations"], 12);
    // Who lets go hits the head, and harder than with its weight.
    let falls = &trials["falls"];
    assert!(falls["head_hits"].as_u64().unwrap() >= 6, "{falls}");
    let more = |key: &str, least: f64| falls[key].as_f64().unwrap() > least;
    assert!(more("median_head_hit_force", 800.0) && more("median_trunk_force", 800.0));
    assert!(more("median_head_hit_speed", 1.0));
}

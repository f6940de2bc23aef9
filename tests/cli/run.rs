//! `aplomb`, `run`, `controllers`, `render`.

use predicates::prelude::*;
use serde_json::{Value, json as value};

use crate::{assert_within, called, json, scenario};

fn kinds(run: &Value) -> Vec<&str> {
    let events = run["events"].as_array().unwrap();
    events.iter().map(|e| e["kind"].as_str().unwrap()).collect()
}

#[test]
fn the_story_is_told_drawn_and_recorded() {
    let folder = tempfile::tempdir().unwrap();
    called("")
        .current_dir(folder.path())
        .assert()
        .success()
        .stdout(predicate::str::contains("push     torso -"))
        .stdout(predicate::str::contains("fell"))
        .stdout(predicate::str::contains("→ rise_prone (succeeded)"))
        .stdout(predicate::str::contains(
            "aplomb render out/story.trajectory -o story.gif",
        ));
    let picture = std::fs::read_to_string(folder.path().join("out/story.svg")).unwrap();
    assert!(picture.contains("<svg") && picture.len() > 20_000);
    called("render out/story.trajectory -o again.svg --plot")
        .current_dir(folder.path())
        .assert()
        .success();
    let again = std::fs::read_to_string(folder.path().join("again.svg")).unwrap();
    assert!(picture == again, "the recording is drawn as the run was");
}

#[test]
fn a_run_is_told_as_json() {
    let run = json("run --duration 2 --push 0.5:torso:-10 --command 0.2:rest --seed 7");
    let digest = run["digest"].as_str().unwrap();
    assert!(digest.len() == 32 && u128::from_str_radix(digest, 16).is_ok());
    assert_eq!(run["scenario"], "standing");
    assert_eq!(run["character"], "humanoid");
    assert_eq!((&run["seed"], &run["dt"]), (&value!(7), &value!(0.001)));
    assert_eq!(run["duration"], 2.0);
    // Every joint works, none beyond what its muscles can.
    let model = aplomb::framework::character::Model::load("humanoid").unwrap();
    let peaks = run["peak_torque"].as_object().unwrap();
    assert_eq!(peaks.len(), model.joint_count());
    for joint in model.joints() {
        let [least, greatest] = joint.muscles.limits();
        let most = greatest.max(-least) * (1.0 + 1e-9);
        assert_within(&run["peak_torque"], &[(&joint.name, 1e-3, most)]);
    }
    let events = run["events"].as_array().unwrap();
    let push = value!({"t": 0.5, "kind": "push", "link": "torso", "impulse": -10.0});
    let start = value!({"t": 0.0, "kind": "switch", "from": null, "to": "balance", "role": "balance", "why": "start"});
    let command = value!({"t": 0.2, "kind": "command", "text": "rest", "accepted": true});
    for expected in [&push, &start, &command] {
        assert!(events.contains(expected), "{expected}");
    }
    let called = |e: &Value| e["from"] == "balance" && e["to"] == "rest" && e["why"] == "command";
    assert!(events.iter().any(called));
    let end = &run["end"];
    assert_eq!(
        (&end["standing"], &end["posture"]),
        (&value!(true), &value!("standing"))
    );
    assert_eq!(end["active"], "balance");
    assert_eq!(end["com"].as_array().unwrap().len(), 2);
    assert_eq!(end["com_velocity"].as_array().unwrap().len(), 2);
    // At rest over its feet, a good half of its 1.8 m up.
    assert_within(
        &run,
        &[
            ("wall_s", 1e-3, 600.0),
            ("end.com.0", -0.1, 0.2),
            ("end.com.1", 0.9, 1.1),
            ("end.com_velocity.0", -0.1, 0.1),
            ("end.com_velocity.1", -0.1, 0.1),
        ],
    );
}

#[test]
fn a_refused_command_names_the_clause_and_the_value() {
    let run = json("run --duration 2.5 --push 0.2:torso:-200 --command 2.2:balance");
    let events = run["events"].as_array().unwrap();
    let refused = events.iter().find(|e| e["kind"] == "refused").unwrap();
    assert_eq!(refused["controller"], "balance");
    let (clause, posture) = (refused["clause"].as_str().unwrap(), &run["end"]["posture"]);
    assert!(clause.starts_with("posture standing (is "), "{clause}");
    assert_ne!(posture, "standing");
    // A posture is no number.
    assert_eq!(refused["value"], Value::Null);
    assert!(kinds(&run).contains(&"fell"));
    let given = value!({"t": 2.2, "kind": "command", "text": "balance", "accepted": false});
    assert!(events.contains(&given));
    let standing = run["end"]["standing"].as_bool();
    assert_eq!(standing, Some(false));
}

#[test]
fn explaining_adds_every_bid() {
    let run = json("run --duration 0.1 --explain");
    let bids = run["events"][0]["bids"].as_array().unwrap();
    assert!(bids.iter().any(|b| b["controller"] == "rest"));
    called("run --duration 0.1 --explain")
        .assert()
        .success()
        .stdout(predicate::str::is_match(" balance +bids 10\n").unwrap())
        .stdout(predicate::str::is_match(" fall +refuses: not capture_front ").unwrap());
}

#[test]
fn an_expectation_that_is_not_met_is_exit_code_1() {
    called("run")
        .arg(scenario("unmet.ron"))
        .assert()
        .code(1)
        .stderr("expectation not met: character 0 does not stand at the end\n");
    let run = json(&format!("run {}", scenario("unmet.ron")));
    assert_eq!(run["unmet"], "character 0 does not stand at the end");
    assert_eq!(json("run standing --duration 2")["unmet"], Value::Null);
}

#[test]
fn several_characters_have_an_end_each() {
    let run = json(&format!("run {} --set impulse=10", scenario("two.ron")));
    assert_eq!(run["ends"].as_array().unwrap().len(), 2);
    assert_eq!(run["ends"][0], run["end"]);
    let events = run["events"].as_array().unwrap();
    let push =
        value!({"t": 0.4, "kind": "push", "link": "pelvis", "impulse": -10.0, "character": 1});
    assert!(events.contains(&push));
    let of = |who: u32| events.iter().filter(|e| e["character"] == who).count();
    assert!(of(0) > 0 && of(1) > 0);
    assert_eq!(of(0) + of(1), events.len());
    called("run")
        .arg(scenario("two.ron"))
        .assert()
        .success()
        .stdout(predicate::str::contains("[1] push     pelvis -20 N·s"));
}

#[test]
fn a_push_after_the_end_is_noted() {
    called("run --duration 0.1 --push 5:torso:10")
        .assert()
        .success()
        .stderr("note: --push 5:torso:10 is after the end at 0.1 s\n");
}

#[test]
fn recordings_and_pictures_are_written() {
    let folder = tempfile::tempdir().unwrap();
    called("run --duration 0.5 --record deep/x.trajectory --render x.svg")
        .current_dir(folder.path())
        .assert()
        .success()
        .stderr("recorded in deep/x.trajectory\ndrawn into x.svg\n");
    called("render deep/x.trajectory -o x.png")
        .current_dir(folder.path())
        .assert()
        .success()
        .stdout("drawn into x.png\n");
    let png = std::fs::read(folder.path().join("x.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}

#[test]
fn a_recording_that_would_not_fit_into_memory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = "(name: \"x\", duration: 3600.0, settings: (dt: 1e-5), characters: [(character: \"humanoid\")])";
    std::fs::write(folder.path().join("x.ron"), text).unwrap();
    let error = crate::refusal(folder.path(), &["run", "x.ron", "--record", "x.trajectory"]);
    assert!(error.contains("GB"), "{error}");
}

#[test]
fn the_pool_is_listed() {
    let pool = json("controllers");
    let pool = pool.as_array().unwrap();
    let rest = pool.iter().find(|c| c["name"] == "rest").unwrap();
    assert_eq!(rest["kind"], "rest");
    assert_eq!(rest["weight"], 1);
    assert_eq!(rest["precondition"], "always");
    assert_eq!(rest["expected"], "always");
    assert_eq!(rest["learned"], false);
    assert_eq!(rest["commands"][0]["name"], "rest");
    called("controllers")
        .assert()
        .success()
        .stdout(predicate::str::contains("  takes over where  always"));
}

/// A learned pre-condition is listed as one, and told with its score when it refuses.
#[test]
fn what_was_learned_is_said_to_be() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let digest = aplomb::framework::character::Model::load("humanoid")
        .unwrap()
        .digest();
    // 0.2 − v: a probability of 1/2 at 0.2 m/s, the more the slower.
    let boundary = format!(
        r#"(controller: "balance", character: "humanoid", character_digest: "{digest}",
            features: ["com_velocity_x"], mean: [0], scale: [1],
            decision: Polynomial(degree: 1, coefficients: [0.2, -1]),
            calibration: (slope: -4, offset: 0), provenance: "Written by hand.")"#
    );
    write("balance.boundary.ron", &boundary);
    let pool = r#"(name: "x", fallback: "rest", controllers: [
        Learned(controller: "skills/balance.ron", boundary: "balance.boundary.ron", confident: true),
        File("skills/rest.ron"),
    ])"#;
    write("x.ron", pool);
    let told = |arguments: &str| {
        let run = called(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(run.status.success(), "{run:?}");
        String::from_utf8(run.stdout).unwrap()
    };
    let rows: Value = serde_json::from_str(&told("controllers --repertoire x.ron --json")).unwrap();
    assert_eq!(
        (&rows[0]["learned"], &rows[0]["confident"]),
        (&true.into(), &true.into())
    );
    assert_eq!(
        (&rows[1]["learned"], &rows[1]["confident"]),
        (&false.into(), &false.into())
    );
    let text = told("controllers --repertoire x.ron");
    assert!(text.contains("learned, bids by probability\n"), "{text}");
    assert!(
        text.contains("and svm of balance (1 feature, poly1))"),
        "{text}"
    );
    let text = told("run --repertoire x.ron --duration 1 --explain --json");
    let run: Value = serde_json::from_str(&text).unwrap();
    let bids = &run["events"][0]["bids"];
    let expected = 10.0 / (1.0 + (-0.8_f64).exp());
    let found = bids[0]["suitability"].as_f64().unwrap();
    assert!((found - expected).abs() < 0.1, "{bids}");
    assert_eq!(bids[1]["suitability"].to_string(), "1", "{bids}");
    let text = told("run --repertoire x.ron --duration 0.1 --explain");
    assert!(
        text.contains("balance  bids 6.9") && text.contains("rest     bids 1\n"),
        "{text}"
    );
    write(
        "balance.boundary.ron",
        &boundary.replace("0.2, -1", "-0.2, -1"),
    );
    let text = told("run --repertoire x.ron --duration 0.1 --explain");
    let refusal = "balance  refuses: svm of balance (1 feature, poly1) (is -0.2";
    assert!(text.contains(refusal), "{text}");
}

#[test]
fn a_repertoire_can_be_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"(name: "limp", fallback: "rest", controllers: [
        Here((kind: "rest", contract: (name: "rest", weight: 1, precondition: Always))),
    ])"#;
    std::fs::write(folder.path().join("limp.ron"), text).unwrap();
    let pool = called("controllers --repertoire limp.ron --json")
        .current_dir(folder.path())
        .output()
        .unwrap();
    let pool: Value = serde_json::from_slice(&pool.stdout).unwrap();
    assert_eq!(pool.as_array().unwrap().len(), 1);
    called("run --repertoire limp.ron --duration 2 --push 0.1:torso:-100")
        .current_dir(folder.path())
        .assert()
        .success()
        .stdout(predicate::str::contains("fell"));
}

#[test]
fn a_skill_in_a_file_works_in_another_folder() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["mine.ron", "nod.ron"] {
        let text = std::fs::read(format!("examples/mine/{name}")).unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let mine = folder.path().join("mine.ron");
    let run = json(&format!(
        "run --duration 5 --command 1:nod --repertoire {}",
        mine.display()
    ));
    let switches: Vec<&str> = run["events"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|e| e["to"].as_str())
        .collect();
    assert_eq!(switches, ["balance", "nod", "balance"]);
    assert_eq!(run["end"]["standing"], value!(true));
}

#[test]
fn pushes_inside_the_limits_are_stood_with_human_torques() {
    let model = aplomb::framework::character::Model::load("humanoid").unwrap();
    for impulse in [28, -26] {
        let run = json(&format!("run --duration 6 --push 1:torso:{impulse}"));
        assert_eq!(run["end"]["standing"], value!(true), "{impulse} N·s");
        assert_eq!(kinds(&run), ["switch", "push"], "{impulse} N·s");
        for joint in model.joints() {
            let peak = run["peak_torque"][&joint.name].as_f64().unwrap();
            let [least, greatest] = joint.muscles.limits();
            assert!(peak <= greatest.max(-least), "{}: {peak} N·m", joint.name);
        }
    }
}

#[test]
fn the_papers_own_formulation_stands_a_push() {
    let run = json("run --duration 6 --push 1:torso:20 --repertoire paper");
    assert_eq!(run["end"]["standing"], value!(true));
    assert_eq!(kinds(&run), ["switch", "push"]);
}

#[test]
fn the_vocabulary_of_conditions_is_listed() {
    let words = json("controllers --features");
    let names: Vec<&str> = words
        .as_array()
        .unwrap()
        .iter()
        .map(|w| w["name"].as_str().unwrap())
        .collect();
    assert!(
        names.contains(&"capture_front") && names.contains(&"angle.JOINT"),
        "{names:?}"
    );
    called("controllers --features")
        .assert()
        .success()
        .stdout(predicate::str::contains(
            "com_height         1        height",
        ));
}

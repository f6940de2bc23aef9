//! Bad files: exit code 2, one clear message with file, line and field.

use std::path::Path;

use aplomb::framework::character::Model;
use aplomb::framework::run::Trajectory;

use crate::{called, refusal, refusals, scenario};

/// The humanoid's file with one thing changed.
fn humanoid(from: &str, to: &str) -> String {
    let text = &Model::load("humanoid").unwrap().source;
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn characters() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("nan.ron", &humanoid("mass: 8.936", "mass: NaN"));
    write("inf.ron", &humanoid("torque: 350.0", "torque: inf"));
    let (from, to) = ("parent: \"pelvis\"", "parent: \"head\"");
    write("cycle.ron", &humanoid(from, to));
    let text = humanoid("    feet: [", "    /* feet: [");
    write(
        "footless.ron",
        &text.replacen("    ],\n    links", "    ], */\n    links", 1),
    );
    write("typo.ron", &humanoid("trunk:", "trnk:"));
    write("binary.ron", "\0\u{1}");
    std::fs::write(folder.path().join("latin.ron"), [0xff, 0xfe]).unwrap();
    insta::assert_snapshot!(refusals(
        folder.path(),
        &[
            &["run", "--character", "nan.ron"],
            &["run", "--character", "inf.ron"],
            &["run", "--character", "cycle.ron"],
            &["run", "--character", "footless.ron"],
            &["run", "--character", "typo.ron"],
            &["run", "--character", "binary.ron"],
            &["run", "--character", "latin.ron"],
            &["run", "--character", "."],
        ],
    ));
}

#[test]
fn repertoires() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let rest = |more: &str| {
        format!(
            "    Here((\n        kind: \"rest\",\n        contract: (name: \"rest\", weight: 1, \
             precondition: Always{more}),\n    )),\n"
        )
    };
    let pool = |fallback: &str, controllers: &str| {
        format!("(name: \"x\", {fallback}\n  controllers: [\n{controllers}])\n")
    };
    write("none.ron", &pool("", &rest("")));
    write("other.ron", &pool("fallback: \"stand\",", &rest("")));
    write(
        "fails.ron",
        &pool("fallback: \"rest\",", &rest(", expected: Never")),
    );
    write(
        "twice.ron",
        &pool("fallback: \"rest\",", &rest("").repeat(2)),
    );
    write(
        "kind.ron",
        &pool(
            "fallback: \"rest\",",
            &rest("").replace("kind: \"rest\"", "kind: \"nap\""),
        ),
    );
    let error = refusals(
        folder.path(),
        &[
            &["controllers", "--repertoire", "none.ron"],
            &["run", "--repertoire", "other.ron"],
            &["trials", "--repertoire", "fails.ron"],
            &["shell", "--repertoire", "twice.ron"],
        ],
    );
    insta::assert_snapshot!(error);
    let error = refusal(folder.path(), &["run", "--repertoire", "kind.ron"]);
    assert!(
        error.starts_with("error: kind.ron:4:15: controllers[0].kind is 'nap'; accepted: "),
        "{error}"
    );
}

#[test]
fn scenarios() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let forever = std::fs::read_to_string(scenario("forever.ron")).unwrap();
    write("forever.ron", &forever);
    let cast = "characters: [(character: \"humanoid\")]";
    let with = |more: &str| format!("(name: \"x\", duration: 1.0, {cast},\n  {more},\n)\n");
    write("nobody.ron", "(name: \"x\", duration: 1.0, characters: [])");
    write(
        "late.ron",
        &with("events: [Push(at: 1e9, link: \"torso\", impulse: 1.0)]"),
    );
    write(
        "unnamed.ron",
        &with("events: [Push(at: \"when\", link: \"torso\", impulse: 1.0)]"),
    );
    write("second.ron", &with("expect: [Standing(character: 1)]"));
    write("typo.ron", &with("evnts: []"));
    write("cut.ron", "(name: \"x\", duration: 1.0,");
    insta::assert_snapshot!(refusals(
        folder.path(),
        &[
            &["run", "forever.ron"],
            &["run", "nobody.ron"],
            &["run", "late.ron"],
            &["run", "unnamed.ron"],
            &["run", "second.ron"],
            &["run", "typo.ron"],
            &["trials", "cut.ron"],
            &["run", "missing.ron"],
        ],
    ));
}

#[test]
fn trajectories() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    called("run --duration 0.05 --record whole.trajectory")
        .current_dir(folder.path())
        .assert()
        .success();
    let whole = std::fs::read(path("whole.trajectory")).unwrap();
    std::fs::write(path("cut.trajectory"), &whole[..200]).unwrap();
    let mut damaged = whole;
    *damaged.last_mut().unwrap() ^= 1;
    std::fs::write(path("damaged.trajectory"), damaged).unwrap();
    std::fs::write(path("text.trajectory"), "hello").unwrap();
    let Trajectory { header, models, .. } = Trajectory::read(&path("whole.trajectory")).unwrap();
    let empty = Trajectory::new(header, models);
    empty.write(&path("empty.trajectory")).unwrap();
    let mut told = String::new();
    for name in ["cut", "damaged", "text", "empty", "missing"] {
        let file = format!("{name}.trajectory");
        let error = refusal(folder.path(), &["render", &file, "-o", "x.svg"]);
        assert!(!path("x.svg").exists());
        told.push_str(&error);
    }
    let error = told.lines().map(|l| match l.split_once(" of ") {
        Some((start, _)) => format!("{start} …\n"),
        None => format!("{l}\n"),
    });
    insta::assert_snapshot!(error.collect::<String>());
}

#[cfg(unix)]
#[test]
fn devices_are_not_read() {
    for arguments in [
        ["run", "/dev/zero"],
        ["run", "--character=/dev/zero"],
        ["run", "--repertoire=/dev/zero"],
    ] {
        let error = refusal(Path::new("."), &arguments);
        assert!(error.contains("no regular file"), "{error}");
    }
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    insta::assert_snapshot!(refusals(
        folder.path(),
        &[
            &["run", "--duration", "3600", "--record", "."],
            &["run", "--duration", "3600", "--record", "file/x.trajectory"],
            &["run", "--duration", "3600", "--render", "x.bmp"],
            &["run", "--duration", "3600", "--render", "x"],
            &[
                "trials",
                "--only",
                "0",
                "--duration",
                "3600",
                "--record",
                "file/x"
            ],
            &["shell", "--record", "file/x"],
            &["render", "x.trajectory", "-o", "x.jpg"],
        ],
    ));
}

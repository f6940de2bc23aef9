//! Values that a file gets wrong: line and column of the very value, its way, what was found, what is
//! accepted and the nearest name. The snapshots show the place in the file's text.

use std::path::Path;

use aplomb::controllers::registry;
use aplomb::framework::character::Model;

use crate::refusal;

/// A folder for files with one mistake each.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// Writes a file.
    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.path().join(name), text).unwrap();
    }

    /// Refusals, each with the text that its place points at.
    fn pointed(&self, calls: &[&[&str]]) -> String {
        let told = calls.iter().map(|arguments| {
            let error = refusal(self.0.path(), arguments);
            let place = pointed_at(self.0.path(), &error);
            format!("$ aplomb {}\n{error}{place}\n", arguments.join(" "))
        });
        told.collect()
    }
}

/// The text around `file:line:column` of a message, with a mark under the column.
fn pointed_at(folder: &Path, error: &str) -> String {
    const AROUND: usize = 60;
    let mut parts = error.strip_prefix("error: ").unwrap().split(':');
    let file = parts.next().unwrap();
    let mut number = || parts.next().unwrap().parse::<usize>().unwrap();
    let (line, column) = (number(), number());
    let text = std::fs::read_to_string(folder.join(file)).unwrap();
    let line: Vec<char> = text.lines().nth(line - 1).unwrap().chars().collect();
    let from = (column - 1).saturating_sub(AROUND);
    let shown = &line[from..line.len().min(column - 1 + AROUND)];
    let mark = " ".repeat(column - 1 - from);
    format!("  | {}\n  | {mark}^\n", shown.iter().collect::<String>())
}

/// The text with the last occurrence of `from` changed.
fn last(text: &str, from: &str, to: &str) -> String {
    let at = text.rfind(from).unwrap_or_else(|| panic!("{from}"));
    format!("{}{to}{}", &text[..at], &text[at + from.len()..])
}

fn shipped(name: &str) -> String {
    registry().file(name).unwrap().text
}

#[test]
fn of_characters() {
    let folder = Folder::new();
    let humanoid = &Model::load("humanoid").unwrap().source;
    let (mass, toe) = ("mass: 2.168", "toe: (0.1905218916427693, -0.06825)");
    folder.write("mass.ron", &last(humanoid, mass, "mass: NaN"));
    folder.write("toe.ron", &last(humanoid, toe, "toe: (-0.19, -0.06)"));
    folder.write("parent.ron", &last(humanoid, "\"torso\"", "\"torsso\""));
    folder.write("radius.ron", &last(humanoid, "radius: 0.035", "radius: -1"));
    insta::assert_snapshot!(folder.pointed(&[
        &["run", "--character", "mass.ron"],
        &["run", "--character", "toe.ron"],
        &["run", "--character", "parent.ron"],
        &["run", "--character", "radius.ron"],
    ]));
}

#[test]
fn of_repertoires() {
    let folder = Folder::new();
    let pool = |more: &str| {
        format!(
            "(\n    name: \"x\", fallback: \"rest\",\n    controllers: [\n        \
             File(\"skills/balance.ron\"),\n{more}\n        File(\"skills/rest.ron\"),\n    ],\n)\n"
        )
    };
    let twin = |name: &str, gain: &str| {
        format!(
            "        Here((kind: \"balance\", contract: (name: \"{name}\", weight: 2, \
             precondition: Always),\n            spec: (gains: (kl: {gain}, dl: 20.0)))),"
        )
    };
    let twins = format!("{}\n{}", twin("one", "60.0"), twin("two", "-60.0"));
    folder.write("gain.ron", &pool(&twins));
    folder.write("file.ron", &pool("        File(\"skills/stnce.ron\"),"));
    let learned = "        Learned(controller: \"skills/fall.ron\", boundary: \"fall.boundary\"),";
    folder.write("learned.ron", &pool(learned));
    let boundary = shipped("learned/fall.boundary.ron");
    folder.write(
        "fall.boundary",
        &last(&boundary, "\"humanoid\"", "\"sumo\""),
    );
    let joint = twin("one", "60.0").replace(
        "Always",
        "All([Posture([standing]), Not(Within(feature: \"angle.knee\", min: 0.1))])",
    );
    folder.write("joint.ron", &pool(&joint));
    insta::assert_snapshot!(folder.pointed(&[
        &["run", "--repertoire", "gain.ron"],
        &["run", "--repertoire", "file.ron"],
        &["run", "--repertoire", "learned.ron"],
        &["run", "--repertoire", "joint.ron"],
    ]));
}

#[test]
fn of_scenarios() {
    const SCENARIO: &str = r#"(
    name: "x", duration: 1.0,
    characters: [(character: "humanoid", start: (pitch: 0.0, angles: {"hip_r": 0.1}))],
    parameters: {"depth": 1.0, "kick": 30.0}, // "mass": -2.0
    props: [
        (name: "low", shape: Box(half: (0.1, 0.1), centre: (0, 0)), mass: 2.0, position: (1, 1)),
        (name: "high", shape: Box(half: (0.1, 0.1), centre: (0, 0)), mass: 2.0, position: (2, 1)),
    ],
    events: [
        Push(at: 0.1, link: "torso", impulse: "kick"),
        Push(at: 0.2, link: "torso", impulse: "-kick"), Command(at: 0.3, text: "bow depth={depth}"),
    ],
    expect: [Holds(condition: All([Always, Within(feature: "prop_ahead.low", min: 0)]), at: 0.5)],
)
"#;
    let folder = Folder::new();
    let files = [
        ("box", "half: (0.1, 0.1)", "half: (0.1, -0.1)"),
        ("link", "\"torso\"", "\"tosro\""),
        ("nan", "pitch: 0.0", "pitch: NaN"),
        ("angle", "\"hip_r\"", "\"hip\""),
        ("prop", "prop_ahead.low", "prop_ahead.lwo"),
        ("command", "bow depth={depth}", "bwo"),
        ("argument", "bow depth={depth}", "bow depth={-depth}"),
        ("parameter", "mass: 2.0", "mass: \"-depth\""),
        ("who", "\"humanoid\"", "\"humanoit\""),
    ];
    let files = files.map(|(name, from, to)| {
        folder.write(&format!("{name}.ron"), &last(SCENARIO, from, to));
        ["run".to_owned(), format!("{name}.ron")]
    });
    let told = files.map(|call| folder.pointed(&[&call.each_ref().map(String::as_str)]));
    insta::assert_snapshot!(told.concat());
}

#[test]
fn of_controllers() {
    let folder = Folder::new();
    let files = [
        ("bow", "\"hip\": 0.0", "\"hipp\": 0.0"),
        ("bow", "\"hip\": 0.0", "\"hip\": 8.0"),
        ("bow", "scaled_by: \"depth\"", "scaled_by: \"dept\""),
        (
            "bow",
            "capture_front\", min: 0.0",
            "capture_front\", min: 0.0, max: -1.0",
        ),
        ("fall", "lower: 0.8", "lower: 80"),
        ("rest", "stiffness: 0.05", "stiffness: inf"),
        ("rest", "damping: 0.3", "damping: much"),
    ];
    let told = files.into_iter().enumerate().map(|(i, (skill, from, to))| {
        let (file, pool) = (format!("{skill}{i}.ron"), format!("pool{i}.ron"));
        let text = shipped(&format!("skills/{skill}.ron"));
        folder.write(&file, &last(&text, from, to));
        let entry = format!("(name: \"x\", fallback: \"rest\", controllers: [File(\"{file}\")])");
        folder.write(&pool, &entry);
        folder.pointed(&[&["run", "--repertoire", &pool]])
    });
    let told: String = told.collect();
    insta::assert_snapshot!(told);
}

/// A misspelt prop in a controller's condition is no mistake of the controller's file: it may meet
/// that prop elsewhere. Where the props are known, the refusal says which one is nearest.
#[test]
fn of_conditions_on_props() {
    let folder = Folder::new();
    let bow = shipped("skills/bow.ron");
    let from = "Within(feature: \"com_height\", min: 0.95),";
    let to = "Within(feature: \"prop_ahead.bal\", min: 0.1),";
    folder.write("bow.ron", &bow.replacen(from, to, 1));
    folder.write(
        "pool.ron",
        "(name: \"x\", fallback: \"rest\", controllers: [\n    File(\"bow.ron\"),\n    \
         File(\"skills/balance.ron\"), File(\"skills/rest.ron\"),\n])\n",
    );
    folder.write(
        "x.ron",
        "(name: \"x\", duration: 0.2, characters: [(character: \"humanoid\", repertoire: \"pool.ron\")],\n\
         props: [(name: \"ball\", shape: Box(half: (0.1, 0.1), centre: (0, 0)), mass: 1, position: (2, 1))],\n\
         events: [Command(at: 0.1, text: \"bow\")])\n",
    );
    let mut run = crate::called("run x.ron");
    let known = "prop_ahead.bal ≥ 0.1 (there is no prop 'bal'; did you mean 'ball'?)";
    let told = predicates::str::contains(known);
    run.current_dir(folder.0.path()).assert().stdout(told);
}

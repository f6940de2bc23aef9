//! Bad files are refused with place, field and what would be accepted; good ones round trip.
#![allow(clippy::unwrap_used)]

#[allow(dead_code, reason = "each test uses a part of it")]
mod common;

use aplomb_framework::file::Source;
use aplomb_framework::model::Model;
use aplomb_framework::registry::Registry;
use aplomb_framework::repertoire;
use aplomb_framework::scenario::{MOST_ENTRIES, Scenario};
use aplomb_framework::simulation::Simulation;
use aplomb_framework::trajectory::Trajectory;
use common::{PuppetSpec, registry};

/// Two controllers, one of them written over several lines.
const REPERTOIRE: &str = r#"// A pool of two.
(
    name: "pair",
    fallback: "rest",
    controllers: [
        Here((
            kind: "puppet",
            contract: (
                name: "wave",
                weight: 3,
                precondition: Within(feature: "angle.knee_r", min: -0.5, max: 0.1),
            ),
            spec: (
                torque: 1.5,
            ),
        )),
        Here((
            kind: "puppet",
            contract: (name: "rest", weight: 1, precondition: Always),
        )),
    ],
)
"#;

fn refusal_of_repertoire(text: &str) -> String {
    let model = Model::load("humanoid").unwrap();
    let source = Source::new("pair.ron", text);
    repertoire::build(&source, None, &registry(), &model)
        .unwrap_err()
        .to_string()
}

fn changed(original: &str, from: &str, to: &str) -> String {
    assert!(original.contains(from), "{from}");
    original.replacen(from, to, 1)
}

/// `file:line` of the first line that contains `needle`.
fn line_of(origin: &str, text: &str, needle: &str) -> String {
    let line = 1 + text.lines().position(|l| l.contains(needle)).unwrap();
    format!("{origin}:{line}:")
}

#[test]
fn the_repertoire_itself_is_fine() {
    let model = Model::load("humanoid").unwrap();
    let source = Source::new("pair.ron", REPERTOIRE);
    let mind = repertoire::build(&source, None, &registry(), &model).unwrap();
    let names: Vec<&str> = mind
        .controllers()
        .map(|c| c.contract().name.as_str())
        .collect();
    assert_eq!(names, ["wave", "rest"]);
}

#[test]
fn bad_repertoires_name_line_and_remedy() {
    // (from, to, what the line contains, what the message contains)
    for (from, to, line, message) in [
        (
            "kind: \"puppet\"",
            "kind: \"pupet\"",
            "\"wave\"",
            "did you mean 'puppet'",
        ),
        ("weight: 3", "wieght: 3", "wieght", "`wieght`"),
        ("weight: 3", "weight: -3", "weight: -3", "out of bounds"),
        ("weight: 3", "weight: \"3\"", "weight: \"3\"", "integer"),
        ("weight: 3,", "", "            ),", "weight"),
        ("torque: 1.5", "torque: \"much\"", "much", "float"),
        ("torque: 1.5", "troque: 1.5", "troque", "`troque`"),
        ("torque: 1.5", "torque: 1.5 1.5", "1.5 1.5", "comma"),
        (
            "angle.knee_r",
            "angle.knee",
            "\"wave\"",
            "did you mean 'knee_",
        ),
        (
            "angle.knee_r",
            "com_hieght",
            "com_hieght",
            "did you mean 'com_height'",
        ),
        ("min: -0.5", "min: 0.5", "\"wave\"", "min ≤ max"),
        ("min: -0.5", "min: NaN", "\"wave\"", "min ≤ max"),
        ("Within(", "Witin(", "Witin", "Witin"),
        ("name: \"wave\"", "name: \"wave it\"", "wave it", "letters"),
        (
            "name: \"wave\"",
            "name: \"rest\"",
            "controllers",
            "a second time",
        ),
        (
            "weight: 3",
            "weight: 3, hold: -1.0",
            "\"wave\"",
            "0 to 60 s",
        ),
        (
            "weight: 3",
            "weight: 3, patience: 0.0",
            "\"wave\"",
            "above 0 s",
        ),
        (
            "fallback: \"rest\"",
            "fallback: \"wave\"",
            "fallback",
            "does not accept every state",
        ),
        (
            "fallback: \"rest\"",
            "fallback: \"rust\"",
            "fallback",
            "wave, rest",
        ),
    ] {
        let text = changed(REPERTOIRE, from, to);
        let refusal = refusal_of_repertoire(&text);
        let place = line_of("pair.ron", &text, line);
        assert!(
            refusal.starts_with(&place),
            "{to}: at {place} expected, got: {refusal}"
        );
        assert!(
            refusal.contains(message),
            "{to}: '{message}' expected, got: {refusal}"
        );
    }
}

#[test]
fn a_missing_fallback_is_told_where_the_repertoire_ends() {
    let refusal = refusal_of_repertoire(&changed(REPERTOIRE, "fallback: \"rest\",", ""));
    let last = REPERTOIRE.lines().count();
    assert!(
        refusal.starts_with(&format!("pair.ron:{last}:1:")),
        "{refusal}"
    );
    assert!(refusal.contains("`fallback`"), "{refusal}");
}

#[test]
fn a_mistake_in_a_nested_spec_is_told_with_its_column() {
    let deep = changed(REPERTOIRE, "torque: 1.5", "torque: much");
    let flat = "spec: (\n                torque: 1.5,";
    let flat = changed(REPERTOIRE, flat, "spec: (torque: much,");
    for text in [deep, flat] {
        let refusal = refusal_of_repertoire(&text);
        let line = text.lines().position(|l| l.contains("torque:")).unwrap();
        // The value begins behind its colon, with a space.
        let column = text.lines().nth(line).unwrap().find("torque:").unwrap() + "torque:".len();
        let place = format!("pair.ron:{}:{}:", line + 1, column + 1);
        assert!(
            refusal.starts_with(&place),
            "at {place} expected, got: {refusal}"
        );
    }
}

/// Of two controllers with the same text in their specs, the second one's mistake is the second's.
#[test]
fn a_mistake_is_told_where_it_stands_not_where_its_text_first_occurs() {
    let text = REPERTOIRE
        .replace("// A pool of two.", "// Not meant: (torque: much)")
        .replace(
            "spec: (\n                torque: 1.5,\n            )",
            "spec: (torque: much)",
        );
    let refusal = refusal_of_repertoire(&text);
    let place = line_of("pair.ron", &text, "spec:");
    assert!(
        refusal.starts_with(&place),
        "at {place} expected, got: {refusal}"
    );
}

#[test]
fn files_of_a_repertoire_are_looked_for_beside_it_and_among_the_shipped() {
    const WAVE: &str =
        "(kind: \"puppet\", contract: (name: \"wave\", weight: 3, precondition: Always))";
    const BROKEN: &str = "(\n  kind: \"puppet\",\n  contract: (name: \"wave\", weight: 3),\n)";
    let model = Model::load("humanoid").unwrap();
    let registry: Registry = registry()
        .with_file("skills/wave.ron", WAVE)
        .with_file("skills/broken.ron", BROKEN);
    let build = |file: &str, folder: Option<&std::path::Path>| {
        let text = format!(
            "(name: \"p\", fallback: \"rest\",\n controllers: [File(\"{file}\"), \
             Here((kind: \"puppet\", contract: (name: \"rest\", weight: 1, precondition: Always)))])"
        );
        repertoire::build(&Source::new("p.ron", text), folder, &registry, &model)
            .map(|mind| mind.arbitrate(&aplomb_framework::sensors::Sensors::new(&model, 9.81)))
            .map_err(|e| e.to_string())
    };
    assert_eq!(build("skills/wave.ron", None), Ok(0));
    let refusal = build("skills/wvae.ron", None).unwrap_err();
    assert!(
        refusal.starts_with("p.ron:2:") && refusal.contains("skills/wave.ron"),
        "{refusal}"
    );
    let refusal = build("skills/broken.ron", None).unwrap_err();
    assert!(
        refusal.starts_with("built-in skills/broken.ron:3:"),
        "{refusal}"
    );
    // What lies beside the repertoire comes before what is shipped.
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("skills")).unwrap();
    std::fs::write(
        folder.path().join("skills/wave.ron"),
        WAVE.replace("weight: 3", "weight: 0"),
    )
    .unwrap();
    assert_eq!(build("skills/wave.ron", Some(folder.path())), Ok(1));
    assert!(
        build("none.ron", Some(folder.path()))
            .unwrap_err()
            .starts_with("cannot read")
    );
}

#[test]
fn too_many_controllers_are_refused() {
    let one = "Here((kind: \"puppet\", contract: (name: \"a\", weight: 1, precondition: Always))),";
    let text = format!(
        "(name: \"p\", fallback: \"a\", controllers: [{}])",
        one.repeat(257)
    );
    let refusal = refusal_of_repertoire(&text);
    assert!(
        refusal.contains("a list of 257; accepted: at most 256"),
        "{refusal}"
    );
}

const SCENARIO: &str = r#"(
    name: "shove",
    duration: 0.6,
    seed: 7,
    settings: (dt: 0.001, friction: 0.9),
    characters: [
        (character: "humanoid", repertoire: Some("pair"), start: (lift: 0.001, angles: {"knee_r": -0.1})),
    ],
    props: [
        (name: "crate", shape: Box(half: (0.2, 0.2), centre: (0, 0)), mass: 4.0, position: (0.6, 0.5)),
    ],
    events: [
        Push(at: 0.1, link: "torso", impulse: "-impulse"),
        Command(at: 0.2, text: "wave"),
    ],
    expect: [Active(name: "wave")],
    parameters: {"impulse": 30.0},
)
"#;

fn scenario_registry() -> Registry {
    Registry::new()
        .with::<PuppetSpec>()
        .with_file("repertoires/pair.ron", REPERTOIRE)
}

/// Parses and sets up a scenario in text.
fn simulation(text: &str) -> aplomb_framework::Result<Simulation> {
    let scenario = Scenario::parse(&Source::new("shove.ron", text))?;
    Simulation::new(&scenario, &scenario_registry())
}

#[test]
fn bad_scenarios_name_line_and_remedy() {
    for (from, to, line, message) in [
        (
            "duration: 0.6",
            "duration: 1e9",
            "duration",
            "0.001 to 3600",
        ),
        (
            "duration: 0.6",
            "duration: NaN",
            "duration",
            "NaN; accepted: 0.001 to 3600",
        ),
        (
            "duration: 0.6",
            "duration: inf",
            "duration",
            "0.001 to 3600",
        ),
        ("duration: 0.6", "duration: \"long\"", "duration", "float"),
        (
            "duration: 0.6",
            "durration: 0.6",
            "durration",
            "`durration`",
        ),
        ("dt: 0.001", "dt: 0.0", "dt: 0.0", "settings.dt is 0"),
        (
            "friction: 0.9",
            "friction: -0.9",
            "friction",
            "settings.friction is -0.9",
        ),
        (
            "friction: 0.9",
            "iterations: 0",
            "iterations",
            "settings.iterations is 0",
        ),
        ("lift: 0.001", "lift: -1.0", "lift", "start.lift is -1"),
        (
            "\"knee_r\": -0.1",
            "\"knee_r\": 11.0",
            "knee_r",
            "angles.knee_r is 11",
        ),
        ("mass: 4.0", "mass: -4.0", "crate", "mass is -4"),
        (
            "position: (0.6, 0.5)",
            "position: (NaN, 0.5)",
            "crate",
            "position is (NaN, 0.5)",
        ),
        ("half: (0.2, 0.2)", "half: (0.2, 0.0)", "half", "half is 0"),
        ("at: 0.1", "at: -0.1", "at: -0.1", "at is -0.1"),
        (
            "at: 0.1",
            "at: true",
            "at: true",
            "a number or the name of a parameter",
        ),
        (
            "impulse: \"-impulse\"",
            "impulse: 1e6",
            "impulse: 1e6",
            "impulse is 1000000",
        ),
        (
            "\"wave\")]",
            "\"wave\", character: 3)]",
            "character: 3",
            "character is 3",
        ),
        ("30.0", "NaN", "NaN", "parameters.impulse is NaN"),
        ("seed: 7", "seed: -7", "seed", "out of bounds"),
    ] {
        let text = changed(SCENARIO, from, to);
        let refusal = simulation(&text).unwrap_err().to_string();
        let place = line_of("shove.ron", &text, line);
        assert!(
            refusal.starts_with(&place),
            "{to}: at {place} expected, got: {refusal}"
        );
        assert!(
            refusal.contains(message),
            "{to}: '{message}' expected, got: {refusal}"
        );
    }
}

#[test]
fn names_that_a_scenario_gets_wrong_are_refused_with_the_nearest() {
    for (from, to, message) in [
        ("\"-impulse\"", "\"-impluse\"", "did you mean 'impulse'"),
        ("\"torso\"", "\"tosro\"", "did you mean 'torso'"),
        ("text: \"wave\"", "text: \"wvae\"", "did you mean 'wave'"),
        ("text: \"wave\"", "text: \"wave x\"", "no key=value"),
        (
            "\"knee_r\": -0.1",
            "\"knee_x\": -0.1",
            "did you mean 'knee_",
        ),
        (
            "character: \"humanoid\"",
            "character: \"humanoit\"",
            "characters known by name: humanoid",
        ),
        ("Some(\"pair\")", "Some(\"pear\")", "cannot read pear"),
    ] {
        let refusal = simulation(&changed(SCENARIO, from, to))
            .unwrap_err()
            .to_string();
        assert!(
            refusal.contains(message),
            "{to}: '{message}' expected, got: {refusal}"
        );
    }
}

#[test]
fn floods_are_refused() {
    let prop =
        "(name: \"c\", shape: Box(half: (0.2, 0.2), centre: (0, 0)), mass: 4.0, position: (0, 5)),";
    let text = changed(
        SCENARIO,
        "props: [",
        &format!("props: [{}", prop.repeat(MOST_ENTRIES)),
    );
    let refusal = simulation(&text).unwrap_err().to_string();
    assert!(
        refusal.contains("props is 1001; accepted: 0 to 1000"),
        "{refusal}"
    );
    let text = format!("({}", "(".repeat(100_000));
    assert!(
        simulation(&text).is_err(),
        "deep nesting is no stack overflow"
    );
    let never = "Not(".repeat(50_000);
    let text = changed(REPERTOIRE, "Within(", &format!("{never}Within("));
    assert!(refusal_of_repertoire(&text).starts_with("pair.ron:"));
}

#[test]
fn a_run_is_recorded_and_read_back_bit_for_bit() {
    let mut simulation = simulation(SCENARIO).unwrap();
    simulation.record("shove", 7);
    simulation.run(0.6);
    let recorded = simulation.recording().unwrap();
    assert_eq!(recorded.len(), 600);
    assert!(recorded.events.len() >= 3, "{:?}", recorded.events);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.aplomb");
    recorded.write(&path).unwrap();
    let read = Trajectory::read(&path).unwrap();
    assert_eq!(
        (&read.header, &read.events),
        (&recorded.header, &recorded.events)
    );
    assert_eq!(read.models, recorded.models);
    assert_eq!(read.digest(), simulation.digest());
    // The last row is what was sensed last.
    let (moment, now) = (read.moment(599, 0), simulation.sensors(0));
    assert!(
        moment
            .q
            .iter()
            .zip(&now.state.q)
            .all(|(a, b)| f64::from(*a) == *b)
    );
    assert!(
        moment
            .qdot
            .iter()
            .zip(&now.state.qdot)
            .all(|(a, b)| f64::from(*a) == *b)
    );
    assert_eq!(
        read.controller(599, 0),
        simulation.actors()[0].mind.active().unwrap()
    );
    assert_eq!(moment.support.is_some(), now.base_of_support.is_some());
    let crate_fell = read.prop(599, 0)[1] < read.prop(0, 0)[1] - 0.2;
    assert!(
        crate_fell,
        "{:?} to {:?}",
        read.prop(0, 0),
        read.prop(599, 0)
    );

    // Any byte that is changed, and any cut, is noticed.
    let bytes = std::fs::read(&path).unwrap();
    let plain = 600 * 4 * 44; // a state, what was sensed, a prop
    assert!(
        bytes.len() < 2 * plain / 3,
        "compact: {} of {plain} bytes",
        bytes.len()
    );
    for at in (0..bytes.len()).step_by(bytes.len() / 50) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        std::fs::write(&path, &damaged).unwrap();
        assert!(Trajectory::read(&path).is_err(), "byte {at}");
        std::fs::write(&path, &bytes[..at]).unwrap();
        assert!(Trajectory::read(&path).is_err(), "cut at {at}");
    }
}

#[test]
fn a_run_is_the_same_every_time() {
    let digest = || {
        let mut simulation = simulation(SCENARIO).unwrap();
        simulation.run(0.3);
        let mut clone = simulation.clone();
        simulation.run(0.3);
        clone.run(0.3);
        assert_eq!(simulation.digest(), clone.digest());
        simulation.digest()
    };
    assert_eq!(digest(), digest());
}

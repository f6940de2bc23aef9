//! Bad files are refused with place, field and what would be accepted; good ones round trip.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

#[allow(dead_code, reason = "each test uses a part of it")]
#[path = "../common/mod.rs"]
mod common;

mod boundaries;
mod characters;
mod expectations;
mod props;
mod recordings;
mod repertoires;
mod scenarios;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Registry, repertoire};
use aplomb_framework::input::Source;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
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

/// Whether a mistake is told where it stands and with its remedy; `case` is the mistake.
fn check_refusal(refusal: &str, place: &str, message: &str, case: &str) {
    assert!(
        refusal.starts_with(place),
        "{case}: at {place} expected, got: {refusal}"
    );
    assert!(
        refusal.contains(message),
        "{case}: '{message}' expected, got: {refusal}"
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

//! Learned boundaries, alone and in repertoires.

use std::path::Path;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Boundary, Supervisor, repertoire};
use aplomb_framework::input::Source;
use aplomb_framework::sensing::Sensors;

use super::common::registry;
use super::{changed, check_refusal, line_of};

/// 1 − v − 0.5 ω, with v the velocity of the centre of mass and ω a knee's.
const POLYNOMIAL: &str = r#"(
    controller: "wave",
    character: "humanoid",
    character_digest: "DIGEST",
    features: ["com_velocity_x", "velocity.knee_l"],
    mean: [0.0, 0.0],
    scale: [1.0, 2.0],
    decision: Polynomial(
        degree: 1,
        coefficients: [1.0, -1.0, -1.0],
    ),
    calibration: (
        slope: -2.0,
        offset: 0.0,
    ),
    provenance: "Written by hand.",
)
"#;

const GAUSSIAN: &str = r#"Gaussian(
        gamma: 0.5,
        support: [[0.0, 0.0], [1.0, 1.0]],
        weights: [1.0, -1.0],
        offset: 0.25,
    )"#;

const WAVE: &str = r#"(
    kind: "puppet",
    contract: (
        name: "wave",
        weight: 8,
        precondition: Within(feature: "com_velocity_x", min: 0.0),
    ),
)"#;

fn with_digest(text: &str) -> String {
    text.replace("DIGEST", &Model::load("humanoid").unwrap().digest())
}

fn gaussian() -> String {
    let start = POLYNOMIAL.find("Polynomial(").unwrap();
    let end = POLYNOMIAL.find("    calibration").unwrap();
    let text = format!(
        "{}{GAUSSIAN},\n{}",
        &POLYNOMIAL[..start],
        &POLYNOMIAL[end..]
    );
    with_digest(&text)
}

/// A repertoire beside a controller file and this boundary file.
fn load(folder: &Path, boundary: &str, entry: &str) -> Result<Supervisor, String> {
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("wave.ron", WAVE);
    write("wave.boundary.ron", boundary);
    let pool = format!(
        "(name: \"p\", fallback: \"rest\", controllers: [\n{entry},\n\
         Here((kind: \"puppet\", contract: (name: \"rest\", weight: 1, precondition: Always)))])"
    );
    write("p.ron", &pool);
    let path = folder.join("p.ron");
    let model = Model::load("humanoid").unwrap();
    repertoire::load(path.to_str().unwrap(), &registry(), &model).map_err(|e| e.to_string())
}

const LEARNED: &str = "Learned(controller: \"wave.ron\", boundary: \"wave.boundary.ron\")";

#[test]
fn bad_boundaries_name_line_field_and_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let origin = folder.path().join("wave.boundary.ron");
    let check = |original: &str, from: &str, to: &str, message: &str| {
        let text = changed(original, from, to);
        let refusal = load(folder.path(), &text, LEARNED).unwrap_err();
        let line = line_of(origin.to_str().unwrap(), &text, to);
        check_refusal(&refusal, &line, message, to);
    };
    let digest = Model::load("humanoid").unwrap().digest();
    let twice = "features[1] is 'com_velocity_x' a second time";
    let nan = "mean[1] is NaN; accepted: a finite number";
    for (from, to, message) in [
        (
            "\"humanoid\"",
            "\"sumo\"",
            "character is 'sumo'; accepted: 'humanoid'",
        ),
        (&*digest, "0123", "character_digest is '0123'; accepted: '"),
        (
            "\"wave\"",
            "\"bow\"",
            "controller is 'bow'; accepted: 'wave'",
        ),
        (
            "com_velocity_x",
            "com_velocity_z",
            "did you mean 'com_velocity_",
        ),
        (
            "velocity.knee_l",
            "velocity.tail",
            "features[1] is 'tail'; accepted: a joint: waist",
        ),
        (
            "velocity.knee_l",
            "com_velocity_x\", \"com_velocity_x",
            twice,
        ),
        (
            "features: [\"com_velocity_x\", \"velocity.knee_l\"]",
            "features: []",
            "a list of 0",
        ),
        ("mean: [0.0, 0.0]", "mean: [0.0, NaN]", nan),
        (
            "mean: [0.0, 0.0]",
            "mean: [0.0]",
            "mean is a list of 1; accepted: 2 numbers",
        ),
        (
            "scale: [1.0, 2.0]",
            "scale: [1.0, 0.0]",
            "scale[1] is 0; accepted: above 0",
        ),
        ("scale: [1.0, 2.0]", "scale: [1.0, inf]", "scale[1] is inf"),
        (
            "scale: [1.0, 2.0]",
            "scale: [1.0, 2.0, 3.0]",
            "scale is a list of 3",
        ),
        (
            "degree: 1",
            "degree: 0",
            "decision.degree is 0; accepted: 1 to 3",
        ),
        (
            "[1.0, -1.0, -1.0]",
            "[1.0, -1.0]",
            "a list of 2; accepted: 3 numbers, all monomials",
        ),
        (
            "[1.0, -1.0, -1.0]",
            "[1.0, -inf, -1.0]",
            "decision.coefficients[1] is -inf",
        ),
        ("provenance", "providence", "'providence'"),
    ] {
        check(&with_digest(POLYNOMIAL), from, to, message);
    }
    for (from, to, message) in [
        (
            "gamma: 0.5",
            "gamma: 0.0",
            "decision.gamma is 0; accepted: above 0",
        ),
        ("gamma: 0.5", "gamma: NaN", "decision.gamma is NaN"),
        (
            "support: [[0.0, 0.0]",
            "support: [[0.0]",
            "support[0] is a list of 1; accepted: 2",
        ),
        ("[[0.0, 0.0]", "[[0.0, NaN]", "support[0][1] is NaN"),
        (
            "weights: [1.0, -1.0]",
            "weights: [1.0]",
            "decision.weights is a list of 1",
        ),
    ] {
        check(&gaussian(), from, to, message);
    }
}

#[test]
fn a_calibration_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (from, to, message) in [
        (
            "slope: -2.0",
            "slope: 2.0",
            "calibration.slope is 2; accepted: finite, 0 or less",
        ),
        ("slope: -2.0", "slope: NaN", "calibration.slope is NaN"),
        ("offset: 0.0", "offset: inf", "calibration.offset is inf"),
    ] {
        let text = changed(&with_digest(POLYNOMIAL), from, to);
        let refusal = load(folder.path(), &text, LEARNED).unwrap_err();
        let origin = folder.path().join("wave.boundary.ron");
        let place = line_of(origin.to_str().unwrap(), &text, to);
        check_refusal(&refusal, &place, message, to);
    }
}

#[test]
fn too_large_and_truncated_boundaries_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let whole = gaussian();
    for end in (0..whole.len() - 2).step_by(7) {
        let refusal = load(folder.path(), &whole[..end], LEARNED).unwrap_err();
        assert!(
            refusal.contains("wave.boundary.ron:"),
            "cut at {end}: {refusal}"
        );
    }
    let many = format!("support: [{}[0.0, 0.0]", "[0.5, 0.5], ".repeat(20_000));
    let text = changed(&whole, "support: [[0.0, 0.0]", &many);
    let refusal = load(folder.path(), &text, LEARNED).unwrap_err();
    assert!(
        refusal.contains("a list of 20002; accepted: at most 20000"),
        "{refusal}"
    );
    let names: Vec<String> = (0..65).map(|i| format!("\"angle.j{i}\"")).collect();
    let text = changed(
        &whole,
        "\"com_velocity_x\", \"velocity.knee_l\"",
        &names.join(", "),
    );
    let refusal = load(folder.path(), &text, LEARNED).unwrap_err();
    assert!(
        refusal.contains("features is a list of 65; accepted: 1 to 64"),
        "{refusal}"
    );
    let missing = LEARNED.replace("wave.boundary", "none");
    let refusal = load(folder.path(), &whole, &missing).unwrap_err();
    let place = format!("{}:2:", folder.path().join("p.ron").display());
    let message = "controllers[0].boundary is 'none.ron'; accepted: a boundary file";
    check_refusal(&refusal, &place, message, &missing);
}

/// Written into a controller's contract, it is told where it stands in there.
#[test]
fn a_boundary_in_place_is_checked_as_well() {
    let wave = |boundary: &str| {
        let condition = format!("Svm({boundary})");
        let text = WAVE.replace("Within(feature: \"com_velocity_x\", min: 0.0)", &condition);
        let pool = format!(
            "(name: \"p\", fallback: \"rest\", controllers: [\nHere({text}),\n\
             Here((kind: \"puppet\", contract: (name: \"rest\", weight: 1, precondition: Always)))])"
        );
        let model = Model::load("humanoid").unwrap();
        repertoire::build(&Source::new("p.ron", pool), None, &registry(), &model)
            .map_err(|e| e.to_string())
    };
    let text = with_digest(POLYNOMIAL);
    assert!(wave(&text).is_ok());
    let refusal = wave(&changed(&text, "degree: 1", "degree: 2")).unwrap_err();
    assert!(
        refusal.starts_with(
            "p.ron:16:23: controllers[0].contract.precondition.decision.coefficients is a list of 3"
        ),
        "{refusal}"
    );
    let refusal = wave(&changed(&text, "\"humanoid\"", "\"sumo\"")).unwrap_err();
    assert!(refusal.contains("character is 'sumo'"), "{refusal}");
}

/// What the controller bids, and why not.
fn bid(supervisor: &Supervisor, velocity: f64) -> (f64, Option<String>) {
    let mut now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
    now.com_velocity[0] = velocity;
    let bid = supervisor.bids(&now).remove(0);
    let place = if bid.suitability > 1.0 { 0 } else { 1 };
    assert_eq!(supervisor.arbitrate(&now), place);
    (bid.suitability, bid.refusal.map(|r| r.to_string()))
}

#[test]
fn what_was_learned_refines_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let supervisor = load(folder.path(), &with_digest(POLYNOMIAL), LEARNED).unwrap();
    assert_eq!(bid(&supervisor, 0.5), (8.0, None));
    let by_hand = "com_velocity_x ≥ 0 (is -0.500)".to_owned();
    assert_eq!(bid(&supervisor, -0.5), (0.0, Some(by_hand)));
    let learned = "svm of wave (2 features, poly1) (is -0.250)".to_owned();
    assert_eq!(bid(&supervisor, 1.25), (0.0, Some(learned)));
    assert_eq!(bid(&supervisor, f64::NAN).0, 0.0);
    let names: Vec<bool> = supervisor
        .controllers()
        .map(|c| c.contract().precondition.is_learned())
        .collect();
    assert_eq!(names, [true, false]);
}

#[test]
fn who_is_confident_bids_by_the_probability_of_success() {
    let folder = tempfile::tempdir().unwrap();
    let confident = LEARNED.replace("ron\")", "ron\", confident: true)");
    let supervisor = load(folder.path(), &with_digest(POLYNOMIAL), &confident).unwrap();
    let (suitability, refusal) = bid(&supervisor, 0.5);
    assert!((suitability - 8.0 / (1.0 + (-1.0_f64).exp())).abs() < 1e-12);
    assert_eq!(refusal, None);
    assert_eq!(bid(&supervisor, 1.25).0, 0.0);
}

#[test]
fn a_boundary_is_shipped_or_read_alone() {
    let text = with_digest(POLYNOMIAL);
    let shipped: &'static str = text.clone().leak();
    let registry = registry()
        .with_file("skills/wave.ron", WAVE)
        .with_file("learned/wave.boundary.ron", shipped);
    let pool = "(name: \"p\", fallback: \"rest\", controllers: [\n\
                Learned(controller: \"skills/wave.ron\", boundary: \"learned/wave.boundary.ron\"),\n\
                Here((kind: \"puppet\", contract: (name: \"rest\", weight: 1, precondition: Always)))])";
    let model = Model::load("humanoid").unwrap();
    let build = |text: &str| {
        repertoire::build(&Source::new("p.ron", text), None, &registry, &model)
            .map_err(|e| e.to_string())
    };
    assert_eq!(bid(&build(pool).unwrap(), 0.5), (8.0, None));
    let refusal = build(&pool.replace("wave.boundary", "wvae.boundary")).unwrap_err();
    assert!(
        refusal.starts_with("p.ron:2:50: controllers[0].boundary is 'learned/wvae")
            && refusal.contains("did you mean"),
        "{refusal}"
    );
    assert!(
        build(&pool.replace("boundary:", "bound:"))
            .unwrap_err()
            .contains("'bound'")
    );

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.ron");
    std::fs::write(&path, &text).unwrap();
    let mut boundary = Boundary::read(&path).unwrap();
    boundary.resolve(&model).unwrap();
    assert_eq!(boundary.score_of(&[0.5, 0.5]), 0.25);
    // It holds for weaker and heavier variants of the character that it was learned with.
    boundary.resolve(&model.varied(0.7, 1.2)).unwrap();
}

//! Repertoires and the controllers in them.

use aplomb_framework::character::Model;
use aplomb_framework::control::{Registry, repertoire};
use aplomb_framework::input::Source;

use super::common::registry;
use super::{REPERTOIRE, changed, check_refusal, line_of, refusal_of_repertoire};

#[test]
fn the_repertoire_itself_is_fine() {
    let model = Model::load("humanoid").unwrap();
    let source = Source::new("pair.ron", REPERTOIRE);
    let supervisor = repertoire::build(&source, None, &registry(), &model).unwrap();
    let names: Vec<&str> = supervisor
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
            "\"pupet\"",
            "did you mean 'puppet'",
        ),
        ("weight: 3", "wieght: 3", "wieght", "'wieght'"),
        ("weight: 3", "weight: -3", "weight: -3", "out of bounds"),
        ("weight: 3", "weight: \"3\"", "weight: \"3\"", "integer"),
        ("weight: 3,", "", "            ),", "weight"),
        ("torque: 1.5", "torque: \"much\"", "much", "float"),
        ("torque: 1.5", "troque: 1.5", "troque", "'troque'"),
        ("torque: 1.5", "torque: 1.5 1.5", "1.5 1.5", "comma"),
        (
            "angle.knee_r",
            "angle.knee",
            "\"angle.knee\"",
            "did you mean 'knee_",
        ),
        (
            "angle.knee_r",
            "com_hieght",
            "com_hieght",
            "did you mean 'com_height'",
        ),
        (
            "min: -0.5",
            "min: 0.5",
            "min: 0.5",
            "min ≤ max, which is 0.1",
        ),
        (
            "min: -0.5",
            "min: NaN",
            "min: NaN",
            "precondition.min is NaN",
        ),
        ("Within(", "Witin(", "Witin", "Witin"),
        ("name: \"wave\"", "name: \"wave it\"", "wave it", "letters"),
        (
            "name: \"wave\"",
            "name: \"rest\"",
            "contract: (name: \"rest\"",
            "controllers[1].contract.name is 'rest' a second time",
        ),
        (
            "weight: 3",
            "weight: 3, hold: -1.0",
            "hold: -1.0",
            "contract.hold is -1; accepted: 0 to 60",
        ),
        (
            "weight: 3",
            "weight: 3, patience: 0.0",
            "patience: 0.0",
            "contract.patience is 0; accepted: above 0",
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
        check_refusal(&refusal, &place, message, to);
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
    assert!(refusal.contains("'fallback'"), "{refusal}");
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
            .map(|supervisor| {
                supervisor.arbitrate(&aplomb_framework::sensing::Sensors::new(&model, 9.81))
            })
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
    let refusal = build("none.ron", Some(folder.path())).unwrap_err();
    assert!(
        refusal
            .starts_with("p.ron:2:21: controllers[0] is 'none.ron'; accepted: a controller file"),
        "{refusal}"
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

//! The shipped scenarios, and how a scenario is found: by name or by path.
//!
//! name or file → [`Scenario`]. A character or repertoire that a scenario file names is looked for
//! beside that file first.

use std::path::Path;

use aplomb_framework::input::{self, Error, Result, Source};
use aplomb_framework::scenario::Scenario;
use include_dir::{Dir, include_dir};

static SCENARIOS: Dir = include_dir!("$CARGO_MANIFEST_DIR/scenarios");

/// The shipped scenarios: name and text, by name. A clip's is `clips/` and the name of its controller
/// file and command.
#[must_use]
pub fn shipped() -> Vec<(&'static str, &'static str)> {
    input::shipped(&SCENARIOS)
}

/// A name that a scenario had before, and the parameters that are set under it.
struct Former {
    name: &'static str,
    now: &'static str,
    set: &'static [(&'static str, f64)],
}

/// Scripts may still use these.
const FORMER: [Former; 5] = [
    former("clips/catch_ball", "clips/catch", &[]),
    former("clips/fast_bend", "clips/bend", &[]),
    former("clips/punch_bag", "clips/punch", &[]),
    former("clips/push_dominoes", "clips/push", &[]),
    former("clips/slow_bend", "clips/bend", &[("duration", 1.2)]),
];

const fn former(
    name: &'static str,
    now: &'static str,
    set: &'static [(&'static str, f64)],
) -> Former {
    Former { name, now, set }
}

/// The folder of the scenarios that `train cmrt` knows by name alone.
const CLIPS: &str = "clips";

/// A shipped scenario by name, or a scenario file by path.
///
/// # Errors
/// An unknown name, with the nearest; an unreadable or invalid file, with the place of what is refused.
///
/// ```
/// let story = aplomb::scenarios::load("story")?;
/// assert_eq!(story.characters[0].character, "humanoid");
/// assert!(aplomb::scenarios::load("stroy").unwrap_err().to_string().contains("'story'"));
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
pub fn load(name_or_path: &str) -> Result<Scenario> {
    let shipped = shipped();
    let former = FORMER.iter().find(|f| f.name == name_or_path);
    let name = former.map_or(name_or_path, |f| f.now);
    if let Some((name, text)) = shipped.iter().find(|(n, _)| *n == name) {
        let mut scenario = Scenario::parse(&Source::new(format!("built-in {name}"), *text))?;
        for (key, value) in former.into_iter().flat_map(|f| f.set) {
            scenario.set(key, *value)?;
        }
        return Ok(scenario);
    }
    let path = Path::new(name_or_path);
    let is_name = path.components().count() == 1 || path.starts_with(CLIPS);
    if !path.exists() && path.extension().is_none() && is_name {
        let known = shipped.iter().map(|(n, _)| *n);
        return Err(Error::unknown("scenario", name_or_path, known));
    }
    let mut scenario = Scenario::read(path)?;
    let folder = path.parent().unwrap_or_else(|| Path::new("."));
    for role in &mut scenario.characters {
        beside(folder, &mut role.character);
        if let Some(repertoire) = &mut role.repertoire {
            beside(folder, repertoire);
        }
    }
    Ok(scenario)
}

/// A shipped clip by its name with or without the folder, or a scenario file by path.
///
/// # Errors
/// As [`load`].
pub fn load_clip(name_or_path: &str) -> Result<Scenario> {
    let clip = format!("{CLIPS}/{name_or_path}");
    let known = shipped().iter().any(|(n, _)| *n == clip);
    if known || FORMER.iter().any(|f| f.name == clip) {
        return load(&clip);
    }
    if !Path::new(name_or_path).exists() && !name_or_path.contains(['/', '.']) {
        return Err(Error::unknown("clip", name_or_path, clips()));
    }
    load(name_or_path)
}

/// Names of the shipped clips, as [`load_clip`] takes them.
pub fn clips() -> impl Iterator<Item = &'static str> {
    let names = shipped().into_iter().map(|(n, _)| n);
    names.filter_map(|n| n.strip_prefix(CLIPS)?.strip_prefix('/'))
}

/// Makes `name` the path of the file of this name in `folder`, if there is one.
fn beside(folder: &Path, name: &mut String) {
    let path = folder.join(&*name);
    if path.is_file() {
        *name = path.to_string_lossy().into_owned();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_scenario_is_valid_and_carries_its_name() {
        for (name, _) in shipped() {
            assert_eq!(load(name).unwrap().name, name);
        }
    }

    #[test]
    fn every_shipped_scenario_can_be_written_and_read_again() {
        for (name, _) in shipped() {
            let scenario = load(name).unwrap();
            let text = scenario.to_text().unwrap();
            let again = Scenario::parse(&Source::new("again", text.as_str()));
            assert_eq!(again.unwrap(), scenario, "{text}");
        }
    }

    #[test]
    fn a_clips_command_and_controller_file_have_its_name() {
        let registry = aplomb_controllers::registry();
        for clip in clips() {
            assert!(
                registry.file(&format!("clips/{clip}.ron")).is_some(),
                "{clip}"
            );
            let text = shipped()
                .into_iter()
                .find(|(n, _)| n.ends_with(clip))
                .unwrap()
                .1;
            assert!(
                text.contains(&format!("Command(at: 0.0, text: \"{clip}")),
                "{clip}"
            );
        }
    }

    #[test]
    fn former_names_are_understood() {
        for Former { name, now, .. } in FORMER {
            assert_eq!(load(name).unwrap().name, now);
            let clip = load_clip(name.strip_prefix("clips/").unwrap()).unwrap();
            assert_eq!(clip.name, now);
        }
        let seconds = |name| load_clip(name).unwrap().parameter("duration");
        assert_eq!(["slow_bend", "bend"].map(seconds), [1.2, 0.4].map(Some));
    }

    #[test]
    fn characters_are_found_beside_their_scenario() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"(name: "x", duration: 1.0, characters: [(character: "mine.ron")])"#;
        std::fs::write(folder.path().join("x.ron"), text).unwrap();
        std::fs::write(folder.path().join("mine.ron"), "").unwrap();
        let scenario = load(folder.path().join("x.ron").to_str().unwrap()).unwrap();
        let found = Path::new(&scenario.characters[0].character);
        assert_eq!(found, folder.path().join("mine.ron"));
    }
}

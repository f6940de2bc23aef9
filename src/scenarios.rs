//! The shipped scenarios, and how a scenario is found: by name or by path.
//!
//! name or file → [`Scenario`]. A character or repertoire that a scenario file names is looked for
//! beside that file first.

use std::path::Path;

use aplomb_framework::input::{Error, Result, Source};
use aplomb_framework::scenario::Scenario;

/// Every scenario of the folder under its name.
macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../scenarios/", $name, ".ron")))),*]
    };
}

/// The shipped scenarios: name and text.
pub const SHIPPED: &[(&str, &str)] = shipped![
    "clips/catch_ball",
    "clips/dodge_tire",
    "clips/duck_twice",
    "clips/fast_bend",
    "clips/hit_tire",
    "clips/kick",
    "clips/pull_box",
    "clips/punch_bag",
    "clips/push_dominoes",
    "clips/slow_bend",
    "push",
    "standing",
    "story",
];

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
    if let Some((name, text)) = SHIPPED.iter().find(|(n, _)| *n == name_or_path) {
        return Scenario::parse(&Source::new(format!("built-in {name}"), *text));
    }
    let path = Path::new(name_or_path);
    let is_name = path.components().count() == 1 || path.starts_with(CLIPS);
    if !path.exists() && path.extension().is_none() && is_name {
        let known = SHIPPED.iter().map(|(n, _)| *n);
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
    if SHIPPED.iter().any(|(n, _)| *n == clip) {
        return load(&clip);
    }
    if !Path::new(name_or_path).exists() && !name_or_path.contains(['/', '.']) {
        return Err(Error::unknown("clip", name_or_path, clips()));
    }
    load(name_or_path)
}

/// Names of the shipped clips, as [`load_clip`] takes them.
pub fn clips() -> impl Iterator<Item = &'static str> {
    let names = SHIPPED.iter().map(|(n, _)| *n);
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
        for (name, _) in SHIPPED {
            assert_eq!(load(name).unwrap().name, *name);
        }
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

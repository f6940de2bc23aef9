//! A controller in its place: with the repertoire around it and the character that it is for.
//!
//! repertoire → [`Skill`] of each controller → exercises and searches.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, ControllerFile, Registry, Supervisor, repertoire};
use aplomb_framework::input::{Error, Result};
use xxhash_rust::xxh3::Xxh3;

/// A controller of a repertoire.
///
/// ```
/// # use aplomb_framework::Model;
/// # use aplomb_training::exercise::Skill;
/// let registry = aplomb_controllers::registry();
/// let all = Skill::all("humanoid", &registry, &Model::load("humanoid")?)?;
/// let roll = Skill::find(&all, "roll")?;
/// assert_eq!((roll.name(), roll.kind()), ("roll", "pose"));
/// assert!(Skill::find(&all, "role").is_err()); // says which there are
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Skill {
    /// As it stands in its file.
    pub file: ControllerFile,
    /// Its contract, for the character.
    pub contract: Contract,
    /// The whole repertoire.
    pub supervisor: Supervisor,
    /// The character.
    pub model: Arc<Model>,
    /// Hash of the character's file and of the other controllers of the repertoire, in their order.
    pub surroundings: u64,
}

impl Skill {
    /// Every controller of a repertoire, in its order.
    ///
    /// # Errors
    /// What makes a repertoire invalid.
    pub fn all(name_or_path: &str, registry: &Registry, model: &Arc<Model>) -> Result<Vec<Self>> {
        let supervisor = repertoire::load(name_or_path, registry, model)?;
        let files = repertoire::read(name_or_path, registry)?;
        let one = |(place, file): (usize, &ControllerFile)| {
            let mut contract = file.contract.clone();
            contract.resolve(model)?;
            Ok(Self {
                file: file.clone(),
                contract,
                supervisor: supervisor.clone(),
                model: Arc::clone(model),
                surroundings: surroundings(&files, place, model),
            })
        };
        files.iter().enumerate().map(one).collect()
    }

    /// The one of this name.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the names that there are.
    pub fn find<'a>(all: &'a [Self], name: &str) -> Result<&'a Self> {
        let found = all.iter().find(|s| s.name() == name);
        found.ok_or_else(|| Error::unknown("controller", name, all.iter().map(Self::name)))
    }

    /// The controller's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.contract.name
    }

    /// Its kind: `pose`, `step`, `fall`.
    #[must_use]
    pub fn kind(&self) -> &str {
        &self.file.kind
    }
}

fn surroundings(files: &[ControllerFile], but: usize, model: &Model) -> u64 {
    let mut hash = Xxh3::new();
    hash.update(model.source.as_bytes());
    for (place, file) in files.iter().enumerate() {
        let text = if place == but {
            String::new()
        } else {
            file.whole_text()
        };
        hash.update(&(text.len() as u64).to_le_bytes());
        hash.update(text.as_bytes());
    }
    hash.digest()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A character that cannot stand and draws up its knees once it lies.
    pub(crate) const TUCK: &str = concat!(
        r#"(name: "tuck", fallback: "rest", controllers: [Here("#,
        include_str!("skill/tuck.ron"),
        r#"),
        Here((
            kind: "pose",
            contract: (
                name: "never", weight: 5,
                precondition: Within(feature: "com_height", min: 50.0, max: 60.0),
                postcondition: Posture([prone]),
            ),
            exercise: Rise(goal: Reach(posture: prone), heaps: 0.5, impulse: (70.0, 260.0)),
            spec: (states: [(pose: {"knee": -0.9}, duration: 0.4)]),
        )),
        File("skills/rest.ron"),
    ])"#
    );

    /// A controller of the humanoid's repertoire.
    pub(crate) fn shipped(name: &str) -> Skill {
        let model = Model::load("humanoid").unwrap();
        let all = Skill::all("humanoid", &aplomb_controllers::registry(), &model).unwrap();
        Skill::find(&all, name).unwrap().clone()
    }

    /// The controllers of a repertoire in text, in a folder of their own.
    pub(crate) fn skills(text: &str) -> (tempfile::TempDir, Vec<Skill>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("repertoire.ron");
        std::fs::write(&path, text).unwrap();
        let model = Model::load("humanoid").unwrap();
        let registry = aplomb_controllers::registry();
        let all = Skill::all(path.to_str().unwrap(), &registry, &model).unwrap();
        (folder, all)
    }

    #[test]
    fn what_is_around_a_controller_does_not_change_with_its_own_numbers() {
        let around = |text: &str, name: &str| {
            let (_folder, skills) = skills(text);
            Skill::find(&skills, name).unwrap().surroundings
        };
        let other = TUCK.replace(r#""hip": 0.5"#, r#""hip": 0.6"#);
        assert_eq!(around(TUCK, "tuck"), around(&other, "tuck"));
        assert_ne!(around(TUCK, "rest"), around(&other, "rest"));
        assert_ne!(around(TUCK, "tuck"), around(TUCK, "never"));
        let (_folder, all) = skills(TUCK);
        let told = Skill::find(&all, "tukc").unwrap_err().to_string();
        assert!(told.contains("did you mean 'tuck'?"), "{told}");
    }
}

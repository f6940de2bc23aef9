//! Who takes part in a live run, and where.
//!
//! names or texts → [`LiveScene`] → simulation.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{ControllerFile, Registry, Supervisor, repertoire};
use aplomb_framework::input::{Error, Result, Source};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;

use crate::live::opened::Opened;
use crate::scenarios;

/// s that a scene lasts in a file if no scenario says.
const OTHERWISE: f64 = 10.0;

/// What a scene is made of, by name or path.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SceneNames {
    /// A scenario; somebody standing if left out.
    pub scenario: Option<String>,
    /// The first character; the scenario's own if left out.
    pub character: Option<String>,
    /// The first character's repertoire; its own if left out.
    pub repertoire: Option<String>,
}

/// A scenario with its characters and their supervisors, ready to begin.
#[derive(Debug, Clone)]
pub struct LiveScene {
    /// What happens by itself.
    pub scenario: Scenario,
    /// One pair a character of the scenario.
    pub(super) cast: Vec<(Arc<Model>, Supervisor)>,
}

impl SceneNames {
    /// Refuses what is not shipped: a watcher may not have the session read files.
    ///
    /// # Errors
    /// Another name, with the nearest.
    pub(super) fn check_shipped(&self, registry: &Registry) -> Result<()> {
        if let Some(name) = &self.scenario {
            let known = scenarios::shipped().into_iter().map(|(n, _)| n);
            if !known.clone().any(|n| n == name) {
                return Err(Error::unknown("scenario", name, known));
            }
        }
        let character = self.character.as_deref().unwrap_or("humanoid");
        shipped_only(character, self.repertoire.as_deref(), registry)
    }

    /// Reads and builds what is named.
    ///
    /// # Errors
    /// Unknown names, unreadable or invalid files, with the place of what is refused.
    pub fn scene(&self, registry: &Registry) -> Result<LiveScene> {
        let mut scenario = match &self.scenario {
            Some(name) => scenarios::load(name)?,
            None => Scenario::standing("humanoid", OTHERWISE),
        };
        scenario.recast(self.character.as_deref(), self.repertoire.as_deref());
        LiveScene::new(scenario, registry)
    }
}

/// Refuses what is not shipped: a watcher may not have the session read files.
fn shipped_only(character: &str, repertoire: Option<&str>, registry: &Registry) -> Result<()> {
    let known = Model::built_in().into_iter().map(|(n, _)| n);
    if !known.clone().any(|n| n == character) {
        return Err(Error::unknown("character", character, known).inside("character"));
    }
    match repertoire {
        Some(name) if registry.repertoire(name).is_none() => {
            let known = registry.repertoires();
            Err(Error::unknown("repertoire", name, known).inside("repertoire"))
        }
        _ => Ok(()),
    }
}

impl LiveScene {
    /// A scenario with the characters and repertoires that it names.
    ///
    /// # Errors
    /// As [`Simulation::cast`]. What only beginning shows is found in [`Self::begin`].
    pub fn new(scenario: Scenario, registry: &Registry) -> Result<Self> {
        let cast = Simulation::cast(&scenario, registry)?;
        Ok(Self { scenario, cast })
    }

    /// The run before its first step.
    ///
    /// # Errors
    /// Links, joints or commands that the characters lack.
    pub fn begin(&self) -> Result<Simulation> {
        Simulation::with_cast(&self.scenario, self.cast.clone())
    }

    /// The same scene with what somebody has opened.
    ///
    /// # Errors
    /// A text that is none of these files, or an invalid one, with the place of what is refused.
    pub fn with(&self, source: &Source, registry: &Registry) -> Result<Self> {
        let mut scene = self.clone();
        let (model, supervisor) = &mut scene.cast[0];
        match Opened::of(source)? {
            Opened::Scenario => {
                let scenario = Scenario::parse(source)?;
                for (i, role) in scenario.characters.iter().enumerate() {
                    let shipped = shipped_only(
                        role.character.as_str(),
                        role.repertoire.as_deref(),
                        registry,
                    );
                    shipped.map_err(|e| scenario.locate(e.inside(("characters", i))))?;
                }
                return Self::new(scenario, registry);
            }
            Opened::Character => {
                let new = Arc::new(Model::parse(source)?);
                // A character without a repertoire of its own is tried with the one in use.
                let in_use = scene.scenario.characters[0].repertoire(model);
                let own = registry.repertoire(&new.name);
                let text = own
                    .or_else(|| registry.repertoire(in_use))
                    .unwrap_or_default();
                *supervisor = repertoire::build(&text, None, registry, &new)?;
                *model = new;
            }
            Opened::Repertoire => {
                *supervisor = repertoire::build(source, None, registry, model)?;
            }
            Opened::Controller => {
                let file = ControllerFile::parse(source.clone())?;
                let controller = registry.build(&file, model)?;
                *supervisor = supervisor.with(controller)?;
            }
        }
        Ok(scene)
    }
}

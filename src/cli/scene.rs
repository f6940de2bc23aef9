//! The arguments that say who takes part and where, shared by the subcommands that simulate.
//!
//! arguments → [`Scenario`] → [`Simulation`].

use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use aplomb::framework::character::Model;
use aplomb::framework::control::Registry;
use aplomb::framework::input::Error;
use aplomb::framework::run::{Simulation, row_width};
use aplomb::framework::scenario::{Participant, Scenario};
use clap::Args;

use super::values::{Setting, whole};

/// The longest recording in memory, bytes.
const LARGEST_RECORDING: f64 = 1e9;

/// Who takes part, where, with which parameters.
#[derive(Debug, Args)]
pub(super) struct SceneArgs {
    /// A shipped scenario (push, standing, story, clips/NAME: see `aplomb clips`) or a scenario
    /// file; the humanoid standing on level ground if left out
    scenario: Option<String>,
    #[command(flatten)]
    cast: CastArgs,
    /// Sets a parameter of the scenario, or friction, gravity (m/s²), torque, mass (relative to the
    /// character's) or duration (s); repeatable
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    set: Vec<Setting>,
    /// Fixes everything random; the scenario's if left out
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_negative_numbers = true)]
    seed: Option<u64>,
}

/// Who takes part.
#[derive(Debug, Default, Args)]
pub(super) struct CastArgs {
    /// The first character: built-in name or character file
    #[arg(long, value_name = "NAME|FILE")]
    character: Option<String>,
    /// The first character's repertoire: shipped name or repertoire file; the character's own if
    /// left out
    #[arg(long, value_name = "NAME|FILE")]
    repertoire: Option<String>,
}

impl SceneArgs {
    /// The scenario that was asked for, `otherwise` s long if none was.
    pub(super) fn load(&self, otherwise: f64, registry: &Registry) -> Result<Scenario> {
        let name = self.scenario.as_deref();
        let mut scenario = self.cast.apply(name, otherwise, registry)?;
        set_all(&mut scenario, &self.set)?;
        if let Some(seed) = self.seed {
            scenario.seed = seed;
        }
        Ok(scenario)
    }
}

impl SceneArgs {
    /// All that was named: scenario, characters, repertoires, by shipped name or path.
    pub(super) fn names(&self, scenario: &Scenario) -> Vec<String> {
        let roles = scenario.characters.iter();
        let cast = roles.flat_map(|r| [Some(r.character.clone()), r.repertoire.clone()]);
        cast.flatten().chain(self.scenario.clone()).collect()
    }
}

impl CastArgs {
    /// A scenario by name or path, or someone standing for `otherwise` s, with this cast.
    pub(super) fn apply(
        &self,
        scenario: Option<&str>,
        otherwise: f64,
        registry: &Registry,
    ) -> Result<Scenario> {
        let mut scenario = match scenario {
            Some(name) => aplomb::scenarios::load(name)?,
            None => Scenario::standing("humanoid", otherwise),
        };
        scenario.recast(self.character.as_deref(), self.repertoire.as_deref());
        for (i, role) in scenario.characters.iter().enumerate() {
            // What an argument has put there stands nowhere in the scenario's file.
            let told = |field, by_argument: bool, e: Error| {
                if (i == 0 && by_argument) || scenario.origin.is_nowhere() {
                    return e;
                }
                scenario.locate(e.inside(field).inside(("characters", i)))
            };
            let model = Model::load(&role.character);
            let model = model.map_err(|e| told("character", self.character.is_some(), e))?;
            let unknown = unknown_repertoire(role, &model, registry);
            if let Some(unknown) = unknown {
                let by_argument = self.repertoire.is_some();
                match &role.repertoire {
                    Some(_) => bail!(told("repertoire", by_argument, unknown)),
                    None => bail!(
                        "character '{}' has no repertoire of its own, name one: {unknown}",
                        model.name
                    ),
                }
            }
        }
        Ok(scenario)
    }
}

/// Sets parameters of a scenario.
pub(super) fn set_all(scenario: &mut Scenario, settings: &[Setting]) -> Result<()> {
    for Setting { key, value } in settings {
        let option = || format!("--set {key}={value}");
        scenario.set(key, *value).with_context(option)?;
    }
    Ok(())
}

/// What is known when a repertoire is neither shipped nor a file.
fn unknown_repertoire(role: &Participant, model: &Model, registry: &Registry) -> Option<Error> {
    let name = role.repertoire(model);
    if registry.repertoire(name).is_some() || Path::new(name).exists() {
        return None;
    }
    Some(Error::unknown("repertoire", name, registry.repertoires()))
}

/// Begins to record, unless the whole run would not fit into memory.
pub(super) fn record(simulation: &mut Simulation, scenario: &Scenario) -> Result<()> {
    let models = simulation.world().characters().iter();
    let width = row_width(models.map(|c| c.body.model()), scenario.props.len());
    let bytes = 4.0 * width as f64 * scenario.duration / scenario.settings.dt;
    ensure!(
        bytes <= LARGEST_RECORDING,
        "a recording of {} s would take {:.1} GB; accepted: at most {} GB, so shorten the run",
        scenario.duration,
        bytes / 1e9,
        LARGEST_RECORDING / 1e9,
    );
    simulation.record(&scenario.name, scenario.seed);
    Ok(())
}

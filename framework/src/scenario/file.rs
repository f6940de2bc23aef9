//! A scenario file: characters, props, timed pushes and commands, duration, seed, and what is
//! expected of the run.
//!
//! RON → [`Scenario`] → simulation. Parameters that the file declares can be set from outside.

use std::collections::BTreeMap;
use std::path::Path;

use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};

use crate::character::Model;
use crate::input::{Error, FieldPath, Result, Source, check, options};
use crate::scenario::expectation::Expectation;
use crate::scenario::number::Adjustable;
use crate::scenario::origin::Origin;
use crate::scenario::props::{HingeEntry, PropEntry};
use crate::scenario::scheduled::ScheduledInput;
use crate::world::Settings;

/// How a character begins.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Start {
    /// World x of the root's origin, m.
    pub x: f64,
    /// Gap between the lowest point of the character and the ground, m.
    pub lift: f64,
    /// Pitch of the root, rad; π/2 lies on its back.
    pub pitch: f64,
    /// Joint angles by name, rad; the others are 0.
    pub angles: BTreeMap<String, f64>,
}

/// A character of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Participant {
    /// Built-in name or file.
    pub character: String,
    /// Shipped name or file; the character's own by default.
    #[serde(default)]
    pub repertoire: Option<String>,
    /// Standing by default.
    #[serde(default)]
    pub start: Start,
}

impl Participant {
    /// Its repertoire: the one that is named, or the character's own.
    #[must_use]
    pub fn repertoire<'a>(&'a self, model: &'a Model) -> &'a str {
        self.repertoire.as_deref().unwrap_or(&model.name)
    }
}

/// A validated scenario.
///
/// ```
/// # use aplomb_framework::{input::Source, scenario::Scenario};
/// let text = r#"(name: "hit", duration: 2, characters: [(character: "humanoid")],
///     parameters: {"impulse": (default: -20, min: -50, max: 50)},
///     events: [Push(at: 1, link: "torso", impulse: "impulse")], expect: [Standing()])"#;
/// let mut scenario = Scenario::parse(&Source::new("hit", text))?;
/// scenario.set("impulse", 30.0)?;
/// assert!(scenario.set("impulse", 300.0).is_err());
/// assert_eq!(scenario.parameters["impulse"].value, 30.0); // as it was
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// For messages and recordings.
    pub name: String,
    /// s
    pub duration: f64,
    /// Fixes everything random.
    #[serde(default)]
    pub seed: u64,
    /// Physical settings.
    #[serde(default)]
    pub settings: Settings,
    /// Who takes part.
    pub characters: Vec<Participant>,
    /// What stands or flies about.
    #[serde(default)]
    pub props: Vec<PropEntry>,
    /// Hinges between props, and between props and the world.
    #[serde(default)]
    pub joints: Vec<HingeEntry>,
    /// What is done, when.
    #[serde(default)]
    pub events: Vec<ScheduledInput>,
    /// What the run is expected to show.
    #[serde(default)]
    pub expect: Vec<Expectation>,
    /// Numbers that can be set from outside, with their defaults and what they may be set to.
    #[serde(default)]
    pub parameters: BTreeMap<String, Adjustable>,
    /// Where it was read, for what is found only when it runs.
    #[serde(skip)]
    pub origin: Origin,
}

impl Scenario {
    /// A character standing on level ground with its whole repertoire.
    #[must_use]
    pub fn standing(character: &str, duration: f64) -> Self {
        Self {
            name: "standing".to_owned(),
            duration,
            seed: 0,
            settings: Settings::default(),
            characters: vec![Participant {
                character: character.to_owned(),
                repertoire: None,
                start: Start::default(),
            }],
            props: Vec::new(),
            joints: Vec::new(),
            events: Vec::new(),
            expect: Vec::new(),
            parameters: BTreeMap::new(),
            origin: Origin::default(),
        }
    }

    /// Reads and validates a scenario file.
    ///
    /// # Errors
    /// an unreadable or invalid file, with the place of what is refused.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Source::read(path)?)
    }

    /// Reads and validates a scenario in text.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(source: &Source) -> Result<Self> {
        let mut scenario: Self = source.parse()?;
        scenario.origin = Origin::new(source);
        scenario.validate().map_err(|e| source.locate(e))?;
        Ok(scenario)
    }

    /// The scenario as a file, as it now stands: a parameter's value is its default.
    ///
    /// # Errors
    /// [`Error::Invalid`] for what no file can say.
    pub fn to_text(&self) -> Result<String> {
        let pretty = PrettyConfig::new().depth_limit(3).indentor("    ");
        let text = options().to_string_pretty(self, pretty);
        text.map_err(|e| Error::invalid(&self.name, "", e, "what a scenario file can say"))
    }

    /// The same refusal of one of the scenario's values with its line and column; of a scenario that
    /// was not read from a file, with the scenario's name.
    #[must_use]
    pub fn locate(&self, error: Error) -> Error {
        self.origin.locate(error, &self.name)
    }

    /// Puts another character (which then has a repertoire of its own) and another repertoire in the
    /// place of the first one's; what is left out stays.
    pub fn recast(&mut self, character: Option<&str>, repertoire: Option<&str>) {
        let first = &mut self.characters[0];
        if let Some(character) = character {
            character.clone_into(&mut first.character);
            first.repertoire = None;
        }
        if let Some(repertoire) = repertoire {
            first.repertoire = Some(repertoire.to_owned());
        }
    }

    /// Sets a parameter: one that the scenario declares, or `friction`, `gravity`, `torque`, `mass`
    /// (of [`Settings`]), `duration`.
    ///
    /// # Errors
    /// An unknown name, or a value that is out of bounds or puts anything else out of its bounds;
    /// the scenario is then as it was.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        let mut changed = self.clone();
        let own = changed.parameters.get_mut(name);
        if let Some(p) = &own {
            let field = FieldPath::from("parameters").then(FieldPath::entry(name));
            check::within(field, value, p.min..=p.max).map_err(|e| e.at(&self.name))?;
        }
        let own = own.map(|p| &mut p.value);
        let settings = &mut changed.settings;
        *match name {
            _ if own.is_some() => own,
            "friction" => Some(&mut settings.friction),
            "gravity" => Some(&mut settings.gravity),
            "torque" => Some(&mut settings.torque),
            "mass" => Some(&mut settings.mass),
            "duration" => Some(&mut changed.duration),
            _ => None,
        }
        .ok_or_else(|| {
            let own = self.parameters.keys().map(String::as_str);
            let known = own.chain(["friction", "gravity", "torque", "mass", "duration"]);
            Error::unknown("parameter", name, known)
        })? = value;
        changed.validate().map_err(|e| e.at(&self.name))?;
        *self = changed;
        Ok(())
    }
}

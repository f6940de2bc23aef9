//! A scenario file: characters, props, timed pushes and commands, duration, seed, and what is
//! expected of the run.
//!
//! RON → [`Scenario`] → simulation. Parameters that the file declares can be set from outside.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

use crate::error::{Error, Result};
use crate::file::Source;
use crate::sensors::Posture;
use crate::world::{Prop, Settings};

/// The longest run, s.
pub const LONGEST: f64 = 3600.0;
/// s over which a push is spread unless it says otherwise.
pub const PUSH_DURATION: f64 = 0.1;
/// At most this many props, events or expectations.
pub const MOST_ENTRIES: usize = 1000;
/// At most this many characters.
pub const MOST_CHARACTERS: usize = 16;

/// A number in a scenario: written out, or the name of one of the scenario's parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Number {
    /// Written out.
    Value(f64),
    /// The parameter's value, times a factor (`"-impulse"`).
    Parameter(String, f64),
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct AnyNumber;
        impl Visitor<'_> for AnyNumber {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or the name of a parameter in quotes")
            }
            fn visit_f64<E: de::Error>(self, v: f64) -> std::result::Result<Number, E> {
                Ok(Number::Value(v))
            }
            fn visit_i64<E: de::Error>(self, v: i64) -> std::result::Result<Number, E> {
                Ok(Number::Value(v as f64))
            }
            fn visit_u64<E: de::Error>(self, v: u64) -> std::result::Result<Number, E> {
                Ok(Number::Value(v as f64))
            }
            fn visit_str<E: de::Error>(self, v: &str) -> std::result::Result<Number, E> {
                let (name, factor) = v.strip_prefix('-').map_or((v, 1.0), |n| (n, -1.0));
                Ok(Number::Parameter(name.to_owned(), factor))
            }
        }
        deserializer.deserialize_any(AnyNumber)
    }
}

/// How a character begins.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
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
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Role {
    /// Built-in name or file.
    pub character: String,
    /// Shipped name or file; the character's own by default.
    #[serde(default)]
    pub repertoire: Option<String>,
    /// Standing by default.
    #[serde(default)]
    pub start: Start,
}

/// Something done to a character at a time.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Happening {
    /// A push at a link's centre of mass.
    Push {
        /// s
        at: Number,
        /// Name of the link.
        link: String,
        /// Horizontal impulse, N·s, forward positive.
        impulse: Number,
        /// s over which it is spread evenly.
        #[serde(default = "push_duration")]
        over: f64,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A command string.
    Command {
        /// s
        at: Number,
        /// For the supervisor.
        text: String,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
}

impl Happening {
    /// Place of the character that it happens to.
    pub(crate) fn character(&self) -> usize {
        let (Self::Push { character, .. } | Self::Command { character, .. }) = self;
        *character
    }
}

fn push_duration() -> f64 {
    PUSH_DURATION
}

/// What a run is expected to show.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Expectation {
    /// Standing (as a run's end is judged) at the end.
    Standing {
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// A controller becomes active.
    Active {
        /// Its name.
        name: String,
        /// At this time at the latest, s.
        #[serde(default = "longest")]
        before: f64,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
    /// The character takes on a posture.
    Posture {
        /// Which.
        posture: Posture,
        /// At this time at the latest, s.
        #[serde(default = "longest")]
        before: f64,
        /// Place of the character.
        #[serde(default)]
        character: usize,
    },
}

fn longest() -> f64 {
    LONGEST
}

/// A validated scenario.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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
    pub characters: Vec<Role>,
    /// What stands or flies about.
    #[serde(default)]
    pub props: Vec<Prop>,
    /// What is done, when.
    #[serde(default)]
    pub events: Vec<Happening>,
    /// What the run is expected to show.
    #[serde(default)]
    pub expect: Vec<Expectation>,
    /// Numbers that can be set from outside, with their defaults.
    #[serde(default)]
    pub parameters: BTreeMap<String, f64>,
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
            characters: vec![Role {
                character: character.to_owned(),
                repertoire: None,
                start: Start::default(),
            }],
            props: Vec::new(),
            events: Vec::new(),
            expect: Vec::new(),
            parameters: BTreeMap::new(),
        }
    }

    /// Reads and validates a scenario file.
    ///
    /// # Errors
    /// An unreadable or invalid file, named with line and field.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Source::read(path)?)
    }

    /// Reads and validates a scenario in text.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(source: &Source) -> Result<Self> {
        let scenario: Self = source.parse()?;
        scenario.validate(source)?;
        Ok(scenario)
    }

    /// Sets a parameter: one that the scenario declares, or `friction`, `gravity`, `torque`, `mass`
    /// (of [`Settings`]), `duration`.
    ///
    /// # Errors
    /// An unknown name, or a value out of bounds.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            _ if self.parameters.contains_key(name) => {
                self.parameters.insert(name.to_owned(), value);
            }
            "friction" => self.settings.friction = value,
            "gravity" => self.settings.gravity = value,
            "torque" => self.settings.torque = value,
            "mass" => self.settings.mass = value,
            "duration" => self.duration = value,
            _ => {
                let own = self.parameters.keys().map(String::as_str);
                let known = own.chain(["friction", "gravity", "torque", "mass", "duration"]);
                return Err(Error::unknown("parameter", name, known));
            }
        }
        self.validate(&Source::new(self.name.clone(), ""))
    }

    /// The value of a number of this scenario.
    ///
    /// # Errors
    /// A parameter that the scenario does not declare.
    pub fn number(&self, number: &Number) -> Result<f64> {
        match number {
            Number::Value(v) => Ok(*v),
            Number::Parameter(name, factor) => {
                let known = self.parameters.keys().map(String::as_str);
                let value = self.parameters.get(name);
                value
                    .map(|v| v * factor)
                    .ok_or_else(|| Error::unknown("parameter", name, known))
            }
        }
    }
}

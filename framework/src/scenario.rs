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
use crate::model::Point;
use crate::sensors::Posture;
use crate::world::{Prop, Settings};

/// The longest run, s.
pub const LONGEST: f64 = 3600.0;
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

fn push_duration() -> f64 {
    0.1
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

    /// Sets a parameter: one that the scenario declares, or `friction`, `gravity`, `duration`.
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
            "duration" => self.duration = value,
            _ => {
                let own = self.parameters.keys().map(String::as_str);
                let known = own.chain(["friction", "gravity", "duration"]);
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

    /// Checks every bound.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the field and what is accepted.
    pub fn validate(&self, source: &Source) -> Result<()> {
        let check = |field: &str, value: f64, low: f64, high: f64| {
            if value >= low && value <= high {
                Ok(())
            } else {
                let needle = field.rsplit('.').next().unwrap_or(field);
                Err(Error::Invalid {
                    place: source.place_of(needle, value),
                    field: field.to_owned(),
                    problem: value.to_string(),
                    accepted: format!("{low} to {high}"),
                })
            }
        };
        check("duration", self.duration, 1e-3, LONGEST)?;
        let s = &self.settings;
        check("settings.dt", s.dt, 1e-5, 0.01)?;
        check("settings.gravity", s.gravity, 0.0, 100.0)?;
        check("settings.friction", s.friction, 0.0, 10.0)?;
        check(
            "settings.contact_frequency",
            s.contact_frequency,
            1.0,
            1000.0,
        )?;
        check("settings.contact_damping", s.contact_damping, 0.0, 100.0)?;
        check("settings.iterations", s.iterations as f64, 1.0, 64.0)?;
        check(
            "characters",
            self.characters.len() as f64,
            1.0,
            MOST_CHARACTERS as f64,
        )?;
        for (field, len) in [
            ("props", self.props.len()),
            ("events", self.events.len()),
            ("expect", self.expect.len()),
            ("parameters", self.parameters.len()),
        ] {
            check(field, len as f64, 0.0, MOST_ENTRIES as f64)?;
        }
        for (name, value) in &self.parameters {
            check(&format!("parameters.{name}"), *value, -1e6, 1e6)?;
        }
        for role in &self.characters {
            let start = &role.start;
            check("start.x", start.x, -1e3, 1e3)?;
            check("start.lift", start.lift, 0.0, 100.0)?;
            check("start.pitch", start.pitch, -10.0, 10.0)?;
            for (joint, angle) in &start.angles {
                check(&format!("angles.{joint}"), *angle, -10.0, 10.0)?;
            }
        }
        for prop in &self.props {
            validate_prop(source, prop, &check)?;
        }
        let who = |field: &str, character: usize| {
            check(
                &format!("{field}.character"),
                character as f64,
                0.0,
                self.characters.len() as f64 - 1.0,
            )
        };
        let number = |number: &Number| {
            self.number(number).map_err(|e| match number {
                Number::Parameter(name, _) => e.at(&source.place(&format!("{name}\""))),
                Number::Value(_) => e,
            })
        };
        for (i, event) in self.events.iter().enumerate() {
            let field = |name: &str| format!("events[{i}].{name}");
            match event {
                Happening::Push {
                    at,
                    impulse,
                    over,
                    character,
                    ..
                } => {
                    check(&field("at"), number(at)?, 0.0, LONGEST)?;
                    check(&field("impulse"), number(impulse)?, -1e5, 1e5)?;
                    check(&field("over"), *over, 1e-4, 60.0)?;
                    who(&format!("events[{i}]"), *character)?;
                }
                Happening::Command { at, character, .. } => {
                    check(&field("at"), number(at)?, 0.0, LONGEST)?;
                    who(&format!("events[{i}]"), *character)?;
                }
            }
        }
        for (i, expectation) in self.expect.iter().enumerate() {
            let field = format!("expect[{i}]");
            match expectation {
                Expectation::Standing { character } => who(&field, *character)?,
                Expectation::Active {
                    before, character, ..
                }
                | Expectation::Posture {
                    before, character, ..
                } => {
                    check(&format!("{field}.before"), *before, 0.0, LONGEST)?;
                    who(&field, *character)?;
                }
            }
        }
        Ok(())
    }
}

fn validate_prop(
    source: &Source,
    prop: &Prop,
    check: &impl Fn(&str, f64, f64, f64) -> Result<()>,
) -> Result<()> {
    use crate::model::Shape;
    let finite = |field: &str, p: Point| {
        if p.iter().all(|c| c.is_finite() && c.abs() <= 1e3) {
            Ok(())
        } else {
            let field = format!("props.{}.{field}", prop.name);
            Err(source.invalid(
                &prop.name,
                field,
                format!("({}, {})", p[0], p[1]),
                "finite, at most 1000 either way",
            ))
        }
    };
    check("mass", prop.mass, 0.0, 1e6)?;
    check("friction", prop.friction, 0.0, 10.0)?;
    check("restitution", prop.restitution, 0.0, 1.0)?;
    check("angle", prop.angle, -10.0, 10.0)?;
    finite("position", prop.position)?;
    finite("velocity", prop.velocity)?;
    match prop.shape {
        Shape::Capsule { radius, from, to } => {
            check("radius", radius, 1e-3, 100.0)?;
            finite("shape.from", from)?;
            finite("shape.to", to)
        }
        Shape::Box { half, centre } => {
            check("half", half[0], 1e-3, 100.0)?;
            check("half", half[1], 1e-3, 100.0)?;
            finite("shape.centre", centre)
        }
    }
}

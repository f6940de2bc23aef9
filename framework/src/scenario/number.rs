//! Numbers of a scenario that its parameters can stand for.
//!
//! RON → [`Number`], [`Adjustable`]

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// What a parameter may be set to if the scenario does not say.
const WIDEST: f64 = 1e6;

/// A number in a scenario: written out, or the name of one of the scenario's parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Number {
    /// Written out.
    Value(f64),
    /// The parameter's value, times a factor (`"-impulse"`).
    Parameter(String, f64),
}

impl Number {
    /// A parameter's value by its name, or its negative (`-impulse`).
    #[must_use]
    pub fn named(name: &str) -> Self {
        let (name, factor) = name.strip_prefix('-').map_or((name, 1.0), |n| (n, -1.0));
        Self::Parameter(name.to_owned(), factor)
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self::Value(value)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        match self {
            Self::Value(v) => serializer.serialize_f64(*v),
            Self::Parameter(name, factor) if *factor < 0.0 => {
                serializer.collect_str(&format_args!("-{name}"))
            }
            Self::Parameter(name, _) => serializer.serialize_str(name),
        }
    }
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
                Ok(Number::named(v))
            }
        }
        deserializer.deserialize_any(AnyNumber)
    }
}

/// A number that can be set from outside. In files its default alone, or
/// `(default: 7, min: 0.5, max: 20)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adjustable {
    /// Now: the default until it is set.
    pub value: f64,
    /// Lowest accepted value.
    pub min: f64,
    /// Highest accepted value.
    pub max: f64,
}

impl From<f64> for Adjustable {
    /// One that may be set to anything up to a million either way.
    fn from(value: f64) -> Self {
        Self {
            value,
            min: -WIDEST,
            max: WIDEST,
        }
    }
}

impl Serialize for Adjustable {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let Self { value, min, max } = *self;
        Ranged {
            default: value,
            min,
            max,
        }
        .serialize(serializer)
    }
}

/// As it is written with its bounds.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ranged {
    default: f64,
    #[serde(default = "lowest")]
    min: f64,
    #[serde(default = "highest")]
    max: f64,
}

fn lowest() -> f64 {
    -WIDEST
}

fn highest() -> f64 {
    WIDEST
}

impl<'de> Deserialize<'de> for Adjustable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct AnyParameter;
        impl<'de> Visitor<'de> for AnyParameter {
            type Value = Adjustable;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or (default: …, min: …, max: …)")
            }
            fn visit_f64<E: de::Error>(self, v: f64) -> std::result::Result<Adjustable, E> {
                Ok(v.into())
            }
            fn visit_i64<E: de::Error>(self, v: i64) -> std::result::Result<Adjustable, E> {
                Ok((v as f64).into())
            }
            fn visit_u64<E: de::Error>(self, v: u64) -> std::result::Result<Adjustable, E> {
                Ok((v as f64).into())
            }
            fn visit_map<A: MapAccess<'de>>(
                self,
                map: A,
            ) -> std::result::Result<Adjustable, A::Error> {
                let r = Ranged::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Adjustable {
                    value: r.default,
                    min: r.min,
                    max: r.max,
                })
            }
        }
        deserializer.deserialize_any(AnyParameter)
    }
}

//! What kind of file a text is, by the fields that only one kind has.
//!
//! RON → [`Opened`].

use std::fmt;

use aplomb_framework::input::{Error, Result, Source};
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Opened {
    /// Characters, props, events.
    Scenario,
    /// Links and joints.
    Character,
    /// A pool of controllers.
    Repertoire,
    /// A skill.
    Controller,
}

impl Opened {
    /// The kind of a text.
    ///
    /// # Errors
    /// A text that is no RON, or none of these.
    pub fn of(source: &Source) -> Result<Self> {
        let Fields(fields) = source.parse()?;
        let has = |name: &str| fields.iter().any(|f| f == name);
        if has("characters") {
            Ok(Self::Scenario)
        } else if has("links") {
            Ok(Self::Character)
        } else if has("controllers") {
            Ok(Self::Repertoire)
        } else if has("kind") {
            Ok(Self::Controller)
        } else {
            let accepted = "a scenario, a character, a repertoire or a controller";
            Err(Error::invalid(&source.origin, "", "another file", accepted))
        }
    }
}

/// The names of a struct's fields.
struct Fields(Vec<String>);

impl<'de> Deserialize<'de> for Fields {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Names;
        impl<'de> Visitor<'de> for Names {
            type Value = Fields;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("named fields in parentheses")
            }

            fn visit_map<A: MapAccess<'de>>(
                self,
                mut map: A,
            ) -> std::result::Result<Fields, A::Error> {
                let mut names = Vec::new();
                while let Some(name) = map.next_key()? {
                    names.push(name);
                    map.next_value::<IgnoredAny>()?;
                }
                Ok(Fields(names))
            }
        }
        deserializer.deserialize_any(Names)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_apart() {
        let registry = aplomb_controllers::registry();
        let shipped = |name: &str| registry.file(name).unwrap();
        for (name, kind) in [
            ("repertoires/humanoid.ron", Opened::Repertoire),
            ("skills/balance.ron", Opened::Controller),
            ("skills/rise_supine.ron", Opened::Controller),
        ] {
            assert_eq!(Opened::of(&shipped(name)).unwrap(), kind, "{name}");
        }
        for (name, text) in crate::scenarios::shipped() {
            let kind = Opened::of(&Source::new(name, text)).unwrap();
            assert_eq!(kind, Opened::Scenario, "{name}");
        }
        for text in ["", "(", "3", "(name: \"x\")", "[1]"] {
            assert!(Opened::of(&Source::new("x", text)).is_err(), "{text}");
        }
    }
}

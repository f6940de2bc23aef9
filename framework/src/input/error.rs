//! Everything that can go wrong with input, each with the place, the field and what would be accepted.

use std::path::PathBuf;

/// The result of the framework's fallible calls.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// A rejected input or a failed read or write. Control itself cannot fail: models, conditions,
/// controllers and scenarios are validated when they are built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why, and what would be accepted.
        reason: String,
    },
    /// A file could not be written; what stood there before is untouched.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A data file is no well-formed RON or does not follow its schema.
    #[error("{origin}:{line}:{column}: {message}")]
    Syntax {
        /// File name, or what stands for it (`built-in humanoid`).
        origin: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the parser found and expected.
        message: String,
    },
    /// A field's value is outside what is accepted.
    #[error("{place}: {field} is {problem}; accepted: {accepted}")]
    Invalid {
        /// `file:line`, or the file alone.
        place: String,
        /// The field, with its path.
        field: String,
        /// The value found.
        problem: String,
        /// What would be accepted.
        accepted: String,
    },
    /// A name that nothing answers to.
    #[error(
        "unknown {kind} '{name}'{}; known: {}",
        suggestion(nearest),
        listed(known)
    )]
    Unknown {
        /// What was looked up: `joint`, `link`, `command`, `controller kind`.
        kind: &'static str,
        /// The name as given.
        name: String,
        /// The most similar known name, if one is similar.
        nearest: Option<String>,
        /// All the names that would have been accepted.
        known: Vec<String>,
    },
    /// A command string that is no command.
    #[error("command '{text}': {problem}")]
    Command {
        /// The text, shortened if it is long.
        text: String,
        /// What is wrong and what would be accepted.
        problem: String,
    },
}

impl Error {
    /// An [`Error::Unknown`] that suggests the most similar of the known names.
    pub fn unknown<'a>(
        kind: &'static str,
        name: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<String> = known.into_iter().map(str::to_owned).collect();
        Self::Unknown {
            kind,
            name: shortened(name),
            nearest: nearest(name, known.iter().map(String::as_str)).map(str::to_owned),
            known,
        }
    }

    /// An [`Error::Invalid`].
    pub fn invalid(
        place: impl Into<String>,
        field: impl Into<String>,
        problem: impl ToString,
        accepted: impl Into<String>,
    ) -> Self {
        Self::Invalid {
            place: place.into(),
            field: field.into(),
            problem: problem.to_string(),
            accepted: accepted.into(),
        }
    }

    /// The same invalid field or unknown name, said to stand in the file or field `place`.
    #[must_use]
    pub(crate) fn placed(self, place: &str) -> Self {
        match self {
            Self::Invalid {
                field,
                problem,
                accepted,
                ..
            } => Self::invalid(place, field, problem, accepted),
            other => other.at(place),
        }
    }

    /// The same unknown name, said to stand in the file or field `place`.
    #[must_use]
    pub fn at(self, place: &str) -> Self {
        match self {
            Self::Unknown { .. } | Self::Command { .. } => Self::Invalid {
                place: place.to_owned(),
                field: match &self {
                    Self::Unknown { kind, .. } => (*kind).to_owned(),
                    _ => "command".to_owned(),
                },
                problem: match &self {
                    Self::Unknown { name, .. } => format!("'{name}'"),
                    other => other.to_string(),
                },
                accepted: match &self {
                    Self::Unknown { nearest, known, .. } => {
                        format!("{}{}", listed(known), suggestion(nearest))
                    }
                    _ => "name key=value …".to_owned(),
                },
            },
            other => other,
        }
    }
}

fn listed(known: &[String]) -> String {
    if known.is_empty() {
        "none".to_owned()
    } else {
        known.join(", ")
    }
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or_else(String::new, |n| format!(" (did you mean '{n}'?)"))
}

/// Text that a message can quote without flooding the terminal: at most 60 characters.
#[must_use]
pub fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().count() <= LONGEST {
        text.to_owned()
    } else {
        text.chars().take(LONGEST).chain("…".chars()).collect()
    }
}

/// The known name most similar to `name`, if any is similar: by the letters they share in order
/// (Jaro–Winkler, at least 0.75), or by few slips of the finger (Damerau–Levenshtein, at least 0.6).
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = shortened(name);
    let similarity = |k: &str| {
        let letters = strsim::jaro_winkler(&name, k);
        let slips = strsim::normalized_damerau_levenshtein(&name, k);
        (letters >= 0.75 || slips >= 0.6).then_some(letters + slips)
    };
    known
        .into_iter()
        .filter_map(|k| similarity(k).map(|s| (s, k)))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_the_nearest_name_only_when_one_is_near() {
        assert_eq!(nearest("torsoo", ["head", "torso"]), Some("torso"));
        assert_eq!(nearest("bwo", ["balance", "bow"]), Some("bow"));
        assert_eq!(nearest("xyzzy", ["head", "torso"]), None);
        let text = Error::unknown("link", "tosro", ["head", "torso"]).to_string();
        assert_eq!(
            text,
            "unknown link 'tosro' (did you mean 'torso'?); known: head, torso"
        );
    }

    #[test]
    fn long_names_are_quoted_in_short() {
        assert_eq!(shortened(&"a".repeat(1000)).chars().count(), 61);
    }
}

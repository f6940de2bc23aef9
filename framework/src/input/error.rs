//! Everything that can go wrong with input, each with the place, the field and what would be accepted.

use std::path::PathBuf;

use crate::input::path::FieldPath;

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
    #[error("{}{field} is {problem}; accepted: {accepted}", before(place))]
    Invalid {
        /// `file:line:column` of the value; the origin alone of what is no file; empty until
        /// [`Source::locate`](crate::input::Source::locate) has looked it up.
        place: String,
        /// The way to the value: from the outermost value of the file once the place is known.
        field: FieldPath,
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

    /// An [`Error::Invalid`] of what stands in no file: `place` is what messages call it.
    pub fn invalid(
        place: impl Into<String>,
        field: impl Into<FieldPath>,
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

    /// An [`Error::Invalid`] whose place is still to be looked up: `field` is the way from the value
    /// that is being checked, and those who know where that stands add it ([`Self::inside`]).
    pub fn refused(
        field: impl Into<FieldPath>,
        problem: impl ToString,
        accepted: impl Into<String>,
    ) -> Self {
        Self::invalid("", field, problem, accepted)
    }

    /// The same refusal, said of a value inside `outer`. Unknown names, commands and files that
    /// cannot be read become values that are refused. What has its place already stays.
    ///
    /// ```
    /// # use aplomb_framework::input::Error;
    /// let error = Error::unknown("link", "tosro", ["head", "torso"]).inside("link");
    /// assert_eq!(
    ///     error.inside(("events", 1)).to_string(),
    ///     "events[1].link is 'tosro' (did you mean 'torso'?); accepted: a link: head, torso",
    /// );
    /// ```
    #[must_use]
    pub fn inside(self, outer: impl Into<FieldPath>) -> Self {
        match self {
            Self::Invalid {
                place,
                field,
                problem,
                accepted,
            } if place.is_empty() => Self::Invalid {
                place,
                field: outer.into().then(field),
                problem,
                accepted,
            },
            Self::Unknown {
                kind,
                name,
                nearest,
                known,
            } => {
                let article = if kind.starts_with(['a', 'e', 'i', 'o', 'u']) {
                    "an"
                } else {
                    "a"
                };
                let (known, nearest) = (listed(&known), suggestion(&nearest));
                let accepted = format!("{article} {kind}: {known}");
                Self::refused(outer, format!("'{name}'{nearest}"), accepted)
            }
            Self::Command { text, problem } => {
                // What the problem says of what is accepted is not said twice.
                let told = problem.split_once("; accepted: ");
                let (problem, accepted) = told.unwrap_or((&problem, "a command: name key=value …"));
                Self::refused(outer, format!("'{text}' ({problem})"), accepted)
            }
            Self::Read { path, reason } => {
                let problem = format!("'{}', which cannot be read: {reason}", path.display());
                Self::refused(outer, problem, "a file that can be read")
            }
            other => other,
        }
    }

    /// The same refusal with a remark on the value that was found.
    #[must_use]
    pub fn noted(mut self, remark: &str) -> Self {
        if let Self::Invalid { problem, .. } = &mut self {
            *problem = format!("{problem} ({remark})");
        }
        self
    }

    /// The same refusal of what stands in no file: `origin` is what messages call it.
    #[must_use]
    pub fn at(self, origin: &str) -> Self {
        match self.inside("") {
            Self::Invalid {
                place,
                field,
                problem,
                accepted,
            } if place.is_empty() => Self::invalid(origin, field, problem, accepted),
            other => other,
        }
    }
}

/// A place with what separates it from the message.
fn before(place: &str) -> String {
    if place.is_empty() {
        String::new()
    } else {
        format!("{place}: ")
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
    fn what_a_command_accepts_is_told_once() {
        let command = |problem: &str| Error::Command {
            text: "bow depth=9".into(),
            problem: problem.into(),
        };
        let told = |problem: &str| command(problem).inside("text").to_string();
        assert_eq!(
            told("depth is 9; accepted: 0.2 to 1.2"),
            "text is 'bow depth=9' (depth is 9); accepted: 0.2 to 1.2"
        );
        assert_eq!(
            told("it is wrong"),
            "text is 'bow depth=9' (it is wrong); accepted: a command: name key=value …"
        );
    }

    #[test]
    fn long_names_are_quoted_in_short() {
        assert_eq!(shortened(&"a".repeat(1000)).chars().count(), 61);
    }
}

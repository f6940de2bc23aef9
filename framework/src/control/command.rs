//! Command strings: `bow`, `step_forward length=0.4`.
//!
//! text → [`Command`] → supervisor → the controller that answers to the name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::input::{Error, Result, shortened};

/// The longest command string, in bytes.
pub const LONGEST_COMMAND: usize = 256;

/// A parsed command string: a name, then any number of `key=value`.
///
/// ```
/// # use aplomb_framework::control::Command;
/// let command: Command = "step_forward length=0.4".parse()?;
/// assert_eq!(command.name, "step_forward");
/// assert_eq!(command.argument("length"), Some(0.4));
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// What to do.
    pub name: String,
    /// How: names and finite numbers, in the order given, each name once.
    pub arguments: Vec<(String, f64)>,
}

impl Command {
    /// A command without arguments.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            arguments: Vec::new(),
        }
    }

    /// The value of an argument, if it was given.
    #[must_use]
    pub fn argument(&self, key: &str) -> Option<f64> {
        self.arguments
            .iter()
            .find(|(k, _)| k == key)
            .map(|(_, v)| *v)
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

impl FromStr for Command {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let fail = |problem: String| Error::Command {
            text: shortened(text),
            problem,
        };
        if text.len() > LONGEST_COMMAND {
            return Err(fail(format!("longer than {LONGEST_COMMAND} bytes")));
        }
        let mut words = text.split_whitespace();
        let name = words
            .next()
            .ok_or_else(|| fail("it is empty; expected: name key=value …".to_owned()))?;
        if !is_name(name) {
            return Err(fail(format!(
                "'{}' is no name; expected a letter, then letters, digits and '_'",
                shortened(name)
            )));
        }
        let mut command = Self::named(name);
        for word in words {
            let Some((key, value)) = word.split_once('=') else {
                return Err(fail(format!("'{}' is no key=value", shortened(word))));
            };
            if !is_name(key) {
                return Err(fail(format!(
                    "'{}' is no name of a parameter",
                    shortened(key)
                )));
            }
            let number = value.parse::<f64>().ok().filter(|v| v.is_finite());
            let number = number.ok_or_else(|| {
                fail(format!("{key}: '{}' is no finite number", shortened(value)))
            })?;
            if command.argument(key).is_some() {
                return Err(fail(format!("{key} is given twice")));
            }
            command.arguments.push((key.to_owned(), number));
        }
        Ok(command)
    }
}

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)?;
        for (key, value) in &self.arguments {
            write!(f, " {key}={value}")?;
        }
        Ok(())
    }
}

/// A number that a command can set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// As in `name=value`.
    pub name: String,
    /// Lowest accepted value.
    pub min: f64,
    /// Highest accepted value.
    pub max: f64,
    /// The value when the command does not give it.
    pub default: f64,
}

/// A command that a controller answers to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The command's name.
    pub name: String,
    /// What it can be told.
    #[serde(default)]
    pub parameters: Vec<Parameter>,
}

impl Answer {
    /// Checks a command of this name against the parameters.
    ///
    /// # Errors
    /// An unknown parameter, or a value out of its range.
    pub fn check(&self, command: &Command) -> Result<()> {
        for (key, value) in &command.arguments {
            let known = self.parameters.iter().map(|p| p.name.as_str());
            let Some(p) = self.parameters.iter().find(|p| p.name == *key) else {
                let problem = if self.parameters.is_empty() {
                    format!("'{}' takes no parameters", self.name)
                } else {
                    Error::unknown("parameter", key, known).to_string()
                };
                return Err(Error::Command {
                    text: command.to_string(),
                    problem,
                });
            };
            if *value < p.min || *value > p.max {
                return Err(Error::Command {
                    text: command.to_string(),
                    problem: format!("{key} is {value}; accepted: {} to {}", p.min, p.max),
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn malformed_commands_say_what_is_wrong() {
        let refusal = |t: &str| t.parse::<Command>().unwrap_err().to_string();
        assert!(refusal("").contains("it is empty"));
        assert!(refusal("9lives").contains("no name"));
        assert!(refusal("step length").contains("no key=value"));
        assert!(refusal("step length=inf").contains("no finite number"));
        assert!(refusal("step a=1 a=2").contains("given twice"));
        assert!(refusal(&"x".repeat(300)).contains("longer than"));
    }

    #[test]
    fn parameters_are_checked_against_their_ranges() {
        let p = Parameter {
            name: "length".into(),
            min: 0.1,
            max: 0.6,
            default: 0.3,
        };
        let answer = Answer {
            name: "step".into(),
            parameters: vec![p],
        };
        let check = |t: &str| answer.check(&t.parse().unwrap()).map_err(|e| e.to_string());
        assert!(check("step length=0.4").is_ok());
        assert!(check("step length=4").unwrap_err().contains("0.1 to 0.6"));
        assert!(
            check("step lenght=0.4")
                .unwrap_err()
                .contains("did you mean 'length'")
        );
    }

    proptest! {
        #[test]
        fn a_printed_command_parses_to_itself(
            name in "[a-z][a-z0-9_]{0,20}",
            arguments in prop::collection::btree_map("[a-z][a-z0-9_]{0,8}", -1e9..1e9_f64, 0..4),
        ) {
            let command = Command { name, arguments: arguments.into_iter().collect() };
            prop_assert_eq!(command.to_string().parse::<Command>().unwrap(), command);
        }
    }

    /// So many cases as the environment asks for, else as many as are soon tried.
    fn many() -> ProptestConfig {
        let asked = std::env::var("PROPTEST_CASES").ok();
        let cases = asked.and_then(|cases| cases.parse().ok());
        ProptestConfig::with_cases(cases.unwrap_or(20_000))
    }

    proptest! {
        #![proptest_config(many())]

        #[test]
        fn any_text_is_parsed_or_refused(text in ".{0,40}") {
            match text.parse::<Command>() {
                Ok(command) => prop_assert!(!command.name.is_empty()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }

        #[test]
        fn text_that_looks_like_commands_is_parsed_or_refused(
            text in "([a-z_=0-9.e+ -]|nan|inf|\u{a0}|=){0,24}",
        ) {
            if let Ok(command) = text.parse::<Command>() {
                prop_assert!(command.arguments.iter().all(|(_, v)| v.is_finite()));
            }
        }
    }
}

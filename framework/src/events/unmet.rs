//! A clause that does not hold, and what was found instead.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A clause that does not hold. As text: `com_height ≥ 0.9 (is 0.812)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unmet {
    /// The clause, as it is printed.
    pub clause: String,
    /// What was found instead.
    pub found: Found,
}

/// What was found in the place of what a clause asks for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Found {
    /// The clause says it all.
    Nothing,
    /// The value of the clause's feature, in its unit, or the score of a learned boundary.
    Value(f64),
    /// What is instead, in a word: a posture.
    State(String),
    /// The feature has no value now; why.
    Absent(String),
}

impl Unmet {
    /// A clause that says it all.
    #[must_use]
    pub fn plain(clause: impl Into<String>) -> Self {
        Self {
            clause: clause.into(),
            found: Found::Nothing,
        }
    }

    /// The value that was refused, if it is a number.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        match self.found {
            Found::Value(v) => Some(v),
            _ => None,
        }
    }
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.clause, self.found)
    }
}

/// With a space before it, to stand behind the clause; empty for [`Found::Nothing`].
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => Ok(()),
            Self::Value(v) => write!(f, " (is {v:.3})"),
            Self::State(state) => write!(f, " (is {state})"),
            Self::Absent(why) => write!(f, " ({why})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_found_stands_behind_the_clause() {
        let text = |found| {
            Unmet {
                clause: "c ≥ 1".into(),
                found,
            }
            .to_string()
        };
        assert_eq!(text(Found::Nothing), "c ≥ 1");
        assert_eq!(text(Found::Value(0.8125)), "c ≥ 1 (is 0.812)");
        assert_eq!(text(Found::State("prone".into())), "c ≥ 1 (is prone)");
        let absent = Found::Absent("there is no prop 'ball'".into());
        assert_eq!(text(absent), "c ≥ 1 (there is no prop 'ball')");
    }
}

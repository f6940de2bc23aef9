//! A clause that does not hold, and what was found instead.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A clause that does not hold. As text: `com_height ≥ 0.9 (is 0.812)`; of alternatives each with
/// what was found: `capture_rear ≥ 0.08 (is 0.041) or trunk_rate ≤ 2 (is 6.372)`.
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
    /// None of the clause's alternatives holds; why each does not.
    NoneOf(Vec<Unmet>),
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

    /// The same with words before it: `after kneel: expected …`.
    #[must_use]
    pub fn after(mut self, words: &str) -> Self {
        self.clause = format!("{words} {}", self.clause);
        if let Found::NoneOf(alternatives) = &mut self.found
            && let Some(first) = alternatives.first_mut()
        {
            *first = std::mem::replace(first, Self::plain("")).after(words);
        }
        self
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
        let Found::NoneOf(alternatives) = &self.found else {
            return write!(f, "{}{}", self.clause, self.found);
        };
        for (i, alternative) in alternatives.iter().enumerate() {
            write!(f, "{}{alternative}", if i > 0 { " or " } else { "" })?;
        }
        Ok(())
    }
}

/// Decimals of a value: three, or up to five if it takes them to tell it from a bound of two.
fn decimals(v: f64) -> usize {
    let round = format!("{v:.2}");
    let tells = |d: &usize| format!("{v:.d$}").trim_end_matches('0') != round.trim_end_matches('0');
    (3..=5).find(tells).unwrap_or(3)
}

/// With a space before it, to stand behind the clause; empty for [`Found::Nothing`] and for
/// alternatives, which say it themselves.
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing | Self::NoneOf(_) => Ok(()),
            Self::Value(v) => write!(f, " (is {v:.0$})", decimals(*v)),
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
        assert_eq!(text(Found::Value(0.9997)), "c ≥ 1 (is 0.9997)");
        assert_eq!(text(Found::Value(0.5)), "c ≥ 1 (is 0.500)");
        assert_eq!(text(Found::State("prone".into())), "c ≥ 1 (is prone)");
        let absent = Found::Absent("there is no prop 'ball'".into());
        assert_eq!(text(absent), "c ≥ 1 (there is no prop 'ball')");
    }
}

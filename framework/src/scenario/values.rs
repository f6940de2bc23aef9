//! The values of a scenario's numbers, also in the texts of its commands.
//!
//! [`Number`], parameters → values.

use std::ops::RangeInclusive;

use crate::character::Point;
use crate::input::{Error, Result, check};
use crate::scenario::file::Scenario;
use crate::scenario::number::Number;

impl Scenario {
    /// The value of a parameter now, if the scenario declares it.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.parameters.get(name).map(|p| p.value)
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
                self.parameter(name)
                    .map(|v| v * factor)
                    .ok_or_else(|| Error::unknown("parameter", name, known))
            }
        }
    }

    /// The values of two numbers of this scenario.
    ///
    /// # Errors
    /// As [`Self::number`].
    pub fn point(&self, [x, y]: &[Number; 2]) -> Result<Point> {
        let of = |i: usize| move |e: Error| e.inside(i);
        let (x, y) = (self.number(x).map_err(of(0)), self.number(y).map_err(of(1)));
        Ok([x?, y?])
    }

    /// Checks the value of a number, be it written out or a parameter's.
    pub(super) fn check_number(
        &self,
        field: &str,
        number: &Number,
        accepted: RangeInclusive<f64>,
    ) -> Result<()> {
        let value = self.number(number).map_err(|e| e.inside(field))?;
        check::within(field, value, accepted).map_err(|e| match number {
            Number::Value(_) => e,
            Number::Parameter(name, _) => e.noted(&format!("by the parameter '{name}'")),
        })
    }

    /// Checks the values of two numbers: at most `most` either way.
    pub(super) fn check_point(&self, field: &str, point: &[Number; 2], most: f64) -> Result<()> {
        for (i, number) in point.iter().enumerate() {
            let coordinate = self.check_number("", number, -most..=most);
            coordinate.map_err(|e| e.inside((field, i)))?;
        }
        Ok(())
    }

    /// A command's text with the values of parameters in the places of their names: `{depth}`,
    /// `{-depth}`.
    ///
    /// # Errors
    /// A parameter that the scenario does not declare; a brace without its other.
    pub fn filled(&self, text: &str) -> Result<String> {
        let unpaired = || Error::Command {
            text: text.to_owned(),
            problem: "a brace has no other; expected: {PARAMETER}".to_owned(),
        };
        let (mut filled, mut rest) = (String::with_capacity(text.len()), text);
        while let Some((before, after)) = rest.split_once(['{', '}']) {
            if !rest[before.len()..].starts_with('{') {
                return Err(unpaired());
            }
            let (name, after) = after.split_once('}').ok_or_else(unpaired)?;
            let value = self.number(&Number::named(name))?;
            filled.push_str(before);
            filled.push_str(&value.to_string());
            rest = after;
        }
        filled.push_str(rest);
        Ok(filled)
    }
}

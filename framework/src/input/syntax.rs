//! What is wrong with a text that does not follow its schema, in words.

use ron::Error;

use crate::input::error::{nearest, shortened};

/// The parser's complaint. Names that are not known come with those that are and the nearest; where
/// a sign is missing the line is quoted, since the parser may find it out only later.
pub(super) fn message(code: &Error, line: &str) -> String {
    let unknown = |what: &str, found: &str, known: &[&str]| {
        let near = nearest(found, known.iter().copied());
        let near = near.map_or(String::new(), |n| format!(" (did you mean '{n}'?)"));
        let found = shortened(found);
        format!(
            "unknown {what} '{found}'; accepted: {}{near}",
            known.join(", ")
        )
    };
    match code {
        Error::NoSuchStructField {
            expected, found, ..
        } => unknown("field", found, expected),
        Error::NoSuchEnumVariant {
            expected, found, ..
        } => unknown("value", found, expected),
        Error::MissingStructField { field, .. } => format!("the field '{field}' is missing"),
        Error::DuplicateStructField { field, .. } => format!("the field '{field}' stands twice"),
        Error::Message(_) | Error::InvalidValueForType { .. } => code.to_string(),
        _ => {
            let printable = |c: char| if c.is_control() { '·' } else { c };
            let line: String = line.trim().chars().map(printable).collect();
            format!("{code}, in: {}", shortened(&line))
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::input::Source;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "only its refusals are read")]
    struct Step {
        duration: f64,
        #[serde(default)]
        ease: Ease,
    }

    #[derive(Debug, Default, Deserialize)]
    enum Ease {
        #[default]
        Linear,
        Smooth,
    }

    #[test]
    fn a_complaint_names_what_is_accepted_and_the_nearest() {
        let refusals = [
            (
                "(duraton: 1)",
                "x:1:2: unknown field 'duraton'; accepted: duration, ease (did you mean 'duration'?)",
            ),
            (
                "(duration: 1, ease: Smoth)",
                "x:1:21: unknown value 'Smoth'; accepted: Linear, Smooth (did you mean 'Smooth'?)",
            ),
            ("(ease: Smooth)", "x:1:14: the field 'duration' is missing"),
            (
                "(duration: 1, duration: 2)",
                "x:1:15: the field 'duration' stands twice",
            ),
            ("(\n duration 1)", "x:2:10: Expected colon, in: duration 1)"),
        ];
        for (text, told) in refusals {
            let refusal = Source::new("x", text).parse::<Step>().unwrap_err();
            assert_eq!(refusal.to_string(), told);
        }
    }
}

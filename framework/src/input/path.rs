//! Where a value stands inside a file: `props[1].shape.half[0]`.
//!
//! Names of fields, places in lists → [`FieldPath`], which messages print and `locate` follows.

use std::fmt;

/// A step from a value to one of its parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PathStep {
    /// The value of a field of a struct, or of an entry of a map.
    Field(String),
    /// An item of a list or tuple.
    Item(usize),
    /// The name of an entry of a map, instead of its value.
    Name(String),
    /// What a variant such as `Here(…)` or `All(…)` wraps. It is not printed.
    Inner,
}

/// The way from a file's outermost value to a value inside it.
///
/// ```
/// # use aplomb_framework::input::FieldPath;
/// let half = FieldPath::from(("props", 1)).then("shape").then(("half", 0));
/// assert_eq!(half.to_string(), "props[1].shape.half[0]");
/// assert_eq!(FieldPath::from("shape.half"), FieldPath::from("shape").then("half"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FieldPath(Vec<PathStep>);

impl FieldPath {
    /// The value of an entry of a map; the name may be anything.
    #[must_use]
    pub fn entry(name: &str) -> Self {
        Self(vec![PathStep::Field(name.to_owned())])
    }

    /// The name of an entry of a map, where the name itself is refused.
    #[must_use]
    pub fn name(name: &str) -> Self {
        Self(vec![PathStep::Name(name.to_owned())])
    }

    /// What a variant such as `Here(…)` or `All(…)` wraps.
    #[must_use]
    pub fn inner() -> Self {
        Self(vec![PathStep::Inner])
    }

    /// The part `more` of this value.
    #[must_use]
    pub fn then(mut self, more: impl Into<Self>) -> Self {
        self.0.append(&mut more.into().0);
        self
    }

    pub(super) fn steps(&self) -> &[PathStep] {
        &self.0
    }
}

/// Fields inside each other, with dots between them; nothing for an empty text.
impl From<&str> for FieldPath {
    fn from(fields: &str) -> Self {
        let named = fields.split('.').filter(|f| !f.is_empty());
        Self(named.map(|f| PathStep::Field(f.to_owned())).collect())
    }
}

/// One field, whatever its name.
impl From<String> for FieldPath {
    fn from(field: String) -> Self {
        Self(vec![PathStep::Field(field)])
    }
}

/// An item of a list or tuple.
impl From<usize> for FieldPath {
    fn from(item: usize) -> Self {
        Self(vec![PathStep::Item(item)])
    }
}

/// An item of the list or tuple in a field.
impl From<(&str, usize)> for FieldPath {
    fn from((field, item): (&str, usize)) -> Self {
        Self::from(field).then(item)
    }
}

impl fmt::Display for FieldPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((PathStep::Name(_), map)) = self.0.split_last() {
            return write!(f, "a name in {}", Self(map.to_vec()));
        }
        let mut first = true;
        for step in &self.0 {
            match step {
                PathStep::Field(name) if first => f.write_str(name)?,
                PathStep::Field(name) | PathStep::Name(name) => write!(f, ".{name}")?,
                PathStep::Item(item) => write!(f, "[{item}]")?,
                PathStep::Inner => continue,
            }
            first = false;
        }
        if first { f.write_str("it") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_read_as_in_code() {
        let here = FieldPath::from(("controllers", 2)).then(FieldPath::inner());
        let pose = here.then("spec.pose");
        assert_eq!(pose.to_string(), "controllers[2].spec.pose");
        let odd = pose.clone().then(FieldPath::entry("a.b"));
        assert_eq!(odd.to_string(), "controllers[2].spec.pose.a.b");
        let name = pose.then(FieldPath::name("hipp"));
        assert_eq!(name.to_string(), "a name in controllers[2].spec.pose");
        assert_eq!(FieldPath::default().to_string(), "it");
    }
}

//! Finds where a value stands in a file's text. Only messages need it, so the text is read once more
//! when something is refused, and never otherwise.
//!
//! text, [`FieldPath`] → byte offset, by RON's own deserializer: at each step it reads the parts of a
//! value, skips those that are not asked for, and keeps the other's slice of the text.

use std::fmt;

use ron::value::RawValue;
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::input::path::{FieldPath, PathStep};

/// Byte offset of the value at `path`, or of the innermost value around it that stands in the text
/// (a field may have been left out).
pub(super) fn locate(text: &str, path: &FieldPath) -> usize {
    let found = raw(text, path);
    if let Some(PathStep::Name(_)) = path.steps().last() {
        // The slice of a name has no quotes, but it begins at one.
        let at = offset(text, found);
        return at - usize::from(text[..at].ends_with('"'));
    }
    offset(text, trimmed(found))
}

/// Byte offset at which the text of the value at `path` begins, comments before it included.
pub(super) fn start(text: &str, path: &FieldPath) -> usize {
    offset(text, raw(text, path))
}

/// (line, column) of a byte offset, both from 1, in characters.
pub(super) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let column = before.chars().rev().take_while(|c| *c != '\n').count();
    (1 + before.matches('\n').count(), 1 + column)
}

/// The slice of the text that is the value at `path`, or what of the way there is found.
fn raw<'a>(text: &'a str, path: &FieldPath) -> &'a str {
    let mut here = text;
    for step in path.steps() {
        match part(here, step) {
            Some(part) => here = part,
            None => break,
        }
    }
    here
}

fn offset(text: &str, part: &str) -> usize {
    part.as_ptr() as usize - text.as_ptr() as usize
}

/// Without comments and white space around it. A whole file that begins with extensions stays.
fn trimmed(value: &str) -> &str {
    RawValue::from_ron(value).map_or(value, |v| v.trim().get_ron())
}

/// One part of the value in `text`.
fn part<'a>(text: &'a str, step: &PathStep) -> Option<&'a str> {
    let mut deserializer = ron::Deserializer::from_str(text).ok()?;
    deserializer.deserialize_any(ValuePart(step)).ok().flatten()
}

/// Looks for the part of a value that a step leads to.
struct ValuePart<'s>(&'s PathStep);

impl<'de> Visitor<'de> for ValuePart<'_> {
    type Value = Option<&'de str>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = None;
        while let Some(name) = map.next_key_seed(NameSeed)? {
            match self.0 {
                PathStep::Field(field) if *field == name.name => {
                    found = Some(map.next_value::<&RawValue>()?.get_ron());
                }
                PathStep::Name(field) if *field == name.name => {
                    // A name with escapes is no slice of the text: its value is nearest.
                    let value = map.next_value::<&RawValue>()?.get_ron();
                    found = Some(name.slice.unwrap_or(value));
                }
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        Ok(found)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let place = match self.0 {
            PathStep::Item(item) => *item,
            PathStep::Inner => 0,
            PathStep::Field(_) | PathStep::Name(_) => usize::MAX,
        };
        let (mut found, mut i) = (None, 0);
        while let Some(item) = list.next_element::<&RawValue>()? {
            if i == place {
                found = Some(item.get_ron());
            }
            i += 1;
        }
        Ok(found)
    }

    /// `Some(…)` is as good as what it wraps.
    fn visit_some<D: Deserializer<'de>>(self, value: D) -> Result<Self::Value, D::Error> {
        value.deserialize_any(self)
    }
}

/// A field's or entry's name, and its slice of the text if it is one.
struct Name<'de> {
    name: String,
    slice: Option<&'de str>,
}

struct NameSeed;

impl<'de> DeserializeSeed<'de> for NameSeed {
    type Value = Name<'de>;

    fn deserialize<D: Deserializer<'de>>(self, name: D) -> Result<Self::Value, D::Error> {
        name.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for NameSeed {
    type Value = Name<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_borrowed_str<E: de::Error>(self, name: &'de str) -> Result<Self::Value, E> {
        Ok(Name {
            name: name.to_owned(),
            slice: Some(name),
        })
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        Ok(Name {
            name: name.to_owned(),
            slice: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r##"// A comment: name: "no",
(
    name: "x", // mass: 1
    props: [
        Box(half: (0.1, /* half: */ 0.2)),
        Some((mass: NaN, r: r#"mass: "2" ("#, shape: Capsule(radius : -0.5))),
    ],
    list: [Here((kind: "a", spec: (gains: (kl: 7.0)))), File("b.ron"), Always],
    all: All([Not(Within(min: 3)), Posture([standing, prone])]),
    maß: {"hip": 0.1, "kn\"ee": 0.2, "a.b": (1, 2)}, last: 'c', unit: (),
)
"##;

    /// What stands at a path, up to the end of its line, and its line and column.
    fn at(path: impl Into<FieldPath>) -> (&'static str, (usize, usize)) {
        let offset = locate(TEXT, &path.into());
        let rest = TEXT[offset..].lines().next().unwrap();
        (rest, line_and_column(TEXT, offset))
    }

    #[track_caller]
    fn check(path: impl Into<FieldPath>, begins: &str, place: (usize, usize)) {
        let (found, found_place) = at(path);
        assert!(found.starts_with(begins), "{begins} expected, got {found}");
        assert_eq!(found_place, place, "{begins}");
    }

    #[test]
    fn values_are_found_in_structs_lists_and_variants() {
        let prop = |i: usize| FieldPath::from(("props", i));
        check("name", "\"x\"", (3, 11));
        check(prop(0).then(("half", 0)), "0.1", (5, 20));
        check(prop(0).then(("half", 1)), "0.2", (5, 37));
        check(prop(1).then("mass"), "NaN", (6, 21));
        check(prop(1).then("shape.radius"), "-0.5", (6, 71));
        check("last", "'c'", (10, 60));
    }

    #[test]
    fn what_variants_wrap_is_a_step_of_its_own() {
        let list = |i: usize| FieldPath::from(("list", i)).then(FieldPath::inner());
        check(list(0).then("spec.gains.kl"), "7.0", (8, 48));
        check(list(1), "\"b.ron\"", (8, 62));
        let all = |i: usize| FieldPath::from("all").then(FieldPath::inner()).then(i);
        check(all(0).then(FieldPath::inner()).then("min"), "3", (9, 31));
        check(all(1).then(FieldPath::inner()).then(1), "prone", (9, 55));
    }

    #[test]
    fn entries_of_maps_are_found_by_name_and_their_names_as_well() {
        let map = FieldPath::entry("maß");
        let value = |name: &str| map.clone().then(FieldPath::entry(name));
        check(value("hip"), "0.1", (10, 18));
        check(value("a.b").then(1), "2", (10, 49));
        check(value("kn\"ee"), "0.2", (10, 33));
        let name = |name: &str| map.clone().then(FieldPath::name(name));
        check(name("hip"), "\"hip\"", (10, 11));
        // Escapes: the value is as near as it gets.
        check(name("kn\"ee"), "0.2", (10, 33));
    }

    #[test]
    fn what_is_not_there_is_told_where_it_should_be() {
        check("seed", "(", (2, 1));
        check(("props", 7), "[", (4, 12));
        check(FieldPath::from(("props", 0)).then("mass"), "Box", (5, 9));
        check(FieldPath::from(("list", 2)).then("kind"), "Always", (8, 72));
        check("unit.x", "()", (10, 71));
        assert_eq!(locate("", &"a".into()), 0);
        assert_eq!(locate("(a: [(b: 1", &"a".into()), 0);
    }
}

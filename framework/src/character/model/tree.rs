//! Whether the links of a character file form one tree.
//!
//! links as they stand in the file → nothing, or the first that is out of place.

use crate::character::model::schema::LinkEntry;
use crate::input::{Error, Result, Source, shortened};

/// One root, unique names, every parent known, no cycle, parents before their children.
pub(crate) fn check(source: &Source, links: &[LinkEntry]) -> Result<()> {
    let at = |l: &LinkEntry| quoted(&l.name);
    let place_of = |name: &str| links.iter().position(|l| l.name == name);
    for (i, l) in links.iter().enumerate() {
        name(source, &format!("links[{i}].name"), &l.name)?;
        if place_of(&l.name) != Some(i) {
            return Err(source.invalid(
                &at(l),
                format!("links[{i}].name"),
                format!("'{}' a second time", l.name),
                "a name of its own for each link",
            ));
        }
        let Some(joint) = &l.joint else { continue };
        name(source, &format!("links[{i}].joint.name"), &joint.name)?;
        let twin = links[..i]
            .iter()
            .filter_map(|o| o.joint.as_ref())
            .any(|o| o.name == joint.name);
        if twin {
            return Err(source.invalid(
                &quoted(&joint.name),
                format!("links[{i}].joint.name"),
                format!("'{}' a second time", joint.name),
                "a name of its own for each joint",
            ));
        }
        if place_of(&joint.parent).is_none() {
            let field = format!("{}: links[{i}].joint.parent", source.place(&at(l)));
            return Err(Error::unknown(
                "link",
                &joint.parent,
                links.iter().map(|l| l.name.as_str()),
            )
            .at(&field));
        }
    }
    // Cycles are looked for before the root, since a cyclic tree often has none.
    for start in 0..links.len() {
        let mut here = start;
        let mut path = vec![links[start].name.as_str()];
        while let Some(parent) = links[here].joint.as_ref().and_then(|j| place_of(&j.parent)) {
            path.push(&links[parent].name);
            if parent == start {
                return Err(source.invalid(
                    &at(&links[start]),
                    "links",
                    format!("a cycle ({})", path.join(" → ")),
                    "a tree with one root",
                ));
            }
            if path.len() > links.len() {
                break; // leads into a cycle that does not hold `start`; its own members report it
            }
            here = parent;
        }
    }
    let roots: Vec<&str> = links
        .iter()
        .filter(|l| l.joint.is_none())
        .map(|l| l.name.as_str())
        .collect();
    if roots.len() != 1 {
        return Err(source.invalid(
            "links",
            "links",
            format!("a forest with roots [{}]", roots.join(", ")),
            "exactly one link without a joint, the root",
        ));
    }
    for (i, l) in links.iter().enumerate() {
        let late = l
            .joint
            .as_ref()
            .and_then(|j| place_of(&j.parent))
            .is_some_and(|p| p >= i);
        if late || (i == 0) != l.joint.is_none() {
            return Err(source.invalid(
                &at(l),
                format!("links[{i}]"),
                format!("'{}' before its parent", l.name),
                "the root first and every parent before its children",
            ));
        }
    }
    Ok(())
}

pub(super) fn quoted(name: &str) -> String {
    format!("\"{name}\"")
}

pub(super) fn name(source: &Source, field: &str, name: &str) -> Result<()> {
    let fine = !name.is_empty()
        && name.len() <= 64
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if fine {
        Ok(())
    } else {
        Err(source.invalid(
            &quoted(name),
            field,
            format!("'{}'", shortened(name)),
            "1 to 64 letters, digits, '_' or '-'",
        ))
    }
}

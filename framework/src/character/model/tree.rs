//! Whether the links of a character file form one tree.
//!
//! links as they stand in the file → nothing, or the first that is out of place.

use crate::character::model::schema::LinkEntry;
use crate::input::{Error, Result, shortened};

/// One root, unique names, every parent known, no cycle, parents before their children.
pub(crate) fn check(links: &[LinkEntry]) -> Result<()> {
    let index = |name: &str| links.iter().position(|l| l.name == name);
    for (i, l) in links.iter().enumerate() {
        name(&l.name).map_err(|e| e.inside("name").inside(("links", i)))?;
        if index(&l.name) != Some(i) {
            let problem = format!("'{}' a second time", l.name);
            let error = Error::refused("name", problem, "a name of its own for each link");
            return Err(error.inside(("links", i)));
        }
        let Some(joint) = &l.joint else { continue };
        let of_joint = |e: Error| e.inside("joint").inside(("links", i));
        name(&joint.name).map_err(|e| of_joint(e.inside("name")))?;
        let twin = links[..i]
            .iter()
            .filter_map(|o| o.joint.as_ref())
            .any(|o| o.name == joint.name);
        if twin {
            let problem = format!("'{}' a second time", joint.name);
            let accepted = "a name of its own for each joint";
            return Err(of_joint(Error::refused("name", problem, accepted)));
        }
        if index(&joint.parent).is_none() {
            let known = links.iter().map(|l| l.name.as_str());
            let error = Error::unknown("link", &joint.parent, known);
            return Err(of_joint(error.inside("parent")));
        }
    }
    // Cycles are looked for before the root, since a cyclic tree often has none.
    for start in 0..links.len() {
        let mut here = start;
        let mut path = vec![links[start].name.as_str()];
        while let Some(parent) = links[here].joint.as_ref().and_then(|j| index(&j.parent)) {
            path.push(&links[parent].name);
            if parent == start {
                let problem = format!("a cycle ({})", path.join(" → "));
                let error = Error::refused("joint.parent", problem, "a tree with one root");
                return Err(error.inside(("links", start)));
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
        let problem = format!("a forest with roots [{}]", roots.join(", "));
        let accepted = "exactly one link without a joint, the root";
        return Err(Error::refused("links", problem, accepted));
    }
    for (i, l) in links.iter().enumerate() {
        let parent = l.joint.as_ref().and_then(|j| index(&j.parent));
        if parent.is_some_and(|p| p >= i) || (i == 0) != l.joint.is_none() {
            let problem = format!("'{}' before its parent", l.name);
            let accepted = "the root first and every parent before its children";
            return Err(Error::refused(("links", i), problem, accepted));
        }
    }
    Ok(())
}

/// Whether it can name a character, link or joint.
pub(super) fn name(name: &str) -> Result<()> {
    let fine = !name.is_empty()
        && name.len() <= 64
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if fine {
        return Ok(());
    }
    let problem = format!("'{}'", shortened(name));
    let accepted = "1 to 64 letters, digits, '_' or '-'";
    Err(Error::refused("", problem, accepted))
}

//! What a file uses and declares, read as text.
//!
//! text of a file → paths of its `use` lines, names of its types.

/// The paths that a `use` tree names, each split at `::`.
fn leaves(tree: &str, before: &[String], found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let names = |text: &str| -> Vec<String> {
        let parts = text.split("::").map(str::trim);
        parts.filter(|p| !p.is_empty()).map(str::to_owned).collect()
    };
    let Some(open) = tree.find('{') else {
        let mut path = names(tree.split(" as ").next().unwrap());
        // `{self, …}` names what the braces stand behind.
        path.retain(|name| before.is_empty() || name != "self");
        found.push([before, &path].concat());
        return;
    };
    let head = [before, &names(&tree[..open])].concat();
    let inner = &tree[open + 1..tree.rfind('}').unwrap()];
    let (mut depth, mut start) = (0, 0);
    for (i, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = &inner[start..i];
                if !part.trim().is_empty() {
                    leaves(part, &head, found);
                }
                start = i + 1;
            }
            _ => {}
        }
    }
}

/// A text without its comments.
fn code(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("//").into_iter().chain(rest.find("/*")).min() {
        code.push_str(&rest[..at]);
        let (end, after) = if rest[at..].starts_with("//") {
            ("\n", 0)
        } else {
            ("*/", 2)
        };
        let end = rest[at..].find(end).map_or(rest.len(), |e| at + e + after);
        rest = &rest[end..];
    }
    code + rest
}

/// What a line that begins a `use` has after that word.
fn tree(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let public = line.strip_prefix("pub").map(str::trim_start);
    let line = match public.and_then(|l| l.strip_prefix('(')) {
        Some(scope) => scope.split_once(')')?.1.trim_start(),
        None => public.unwrap_or(line),
    };
    line.strip_prefix("use ")
}

/// The paths within this crate that the `use` lines of a text name, as places below `src`; `here` is
/// the module of the text.
pub(crate) fn named(text: &str, here: &[String]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let code = code(text);
    for statement in code.split(';') {
        let starts = statement.match_indices('\n').map(|(i, _)| i + 1);
        let starts = [0].into_iter().chain(starts);
        if let Some(tree) = starts.map(|i| &statement[i..]).find_map(tree) {
            leaves(tree, &[], &mut found);
        }
    }
    let inside = |path: &Vec<String>| -> Option<Vec<String>> {
        let mut base: Vec<String> = here.to_vec();
        let mut rest = path.as_slice();
        match path.first()?.as_str() {
            "crate" => {
                base.clear();
                rest = &rest[1..];
            }
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|p| p == "super") {
                    base.pop();
                    rest = &rest[1..];
                }
            }
            _ => return None,
        }
        Some([base, rest.to_vec()].concat())
    };
    found.iter().filter_map(inside).collect()
}

/// Names of the types that a text declares.
pub(crate) fn declared(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let line = line.trim_start();
        let line = line.strip_prefix("pub ").unwrap_or_else(|| {
            let restricted = line.strip_prefix("pub(").and_then(|l| l.split_once(") "));
            restricted.map_or(line, |(_, rest)| rest)
        });
        let kinds = ["struct ", "enum ", "trait ", "type "];
        let rest = kinds.iter().find_map(|kind| line.strip_prefix(kind))?;
        let end = rest
            .find(|c: char| !c.is_alphanumeric())
            .unwrap_or(rest.len());
        Some(&rest[..end])
    })
}

/// What the `use` lines of a text in `control/boundary/mod.rs` name, sorted, joined by blanks.
fn read_uses(text: &str) -> String {
    let here = ["control", "boundary"].map(str::to_owned);
    let paths = named(text, &here);
    let mut paths: Vec<String> = paths.iter().map(|p| p.join("::")).collect();
    paths.sort();
    paths.join(" ")
}

#[test]
fn use_trees_are_read() {
    for (text, expected) in [
        ("use crate::a::B;", "a::B"),
        ("use crate::a::B as C;", "a::B"),
        ("use crate::a::*;", "a::*"),
        (
            "use crate::{a::{B, c::{self, D as E}}, f::G};",
            "a::B a::c a::c::D f::G",
        ),
        ("use crate::a::{\n    B,\n    c::D,\n};", "a::B a::c::D"),
        ("pub use crate::a::B;", "a::B"),
        (
            "pub(crate) use crate::a::B;\npub(super) use crate::c::D;",
            "a::B c::D",
        ),
        ("pub(in crate::control) use crate::a::B;", "a::B"),
        ("#[cfg(unix)]\nuse crate::a::B;", "a::B"),
        (
            "mod x {\n    use crate::a::B;\n}\nfn f() {}\nuse crate::c::D;",
            "a::B c::D",
        ),
        (
            "use self::a::B;\nuse super::c::D;",
            "control::boundary::a::B control::c::D",
        ),
        ("use super::super::a::{self, B};", "a a::B"),
        ("use std::fmt;\nuse serde::{Deserialize, self};", ""),
    ] {
        assert_eq!(read_uses(text), expected, "{text}");
    }
}

#[test]
fn comments_are_no_use_lines_and_hide_none() {
    for (text, expected) in [
        ("// use crate::a::B;\n/* use crate::c::D; */\nfn f() {}", ""),
        ("//! How to use it; and when.\n\nuse crate::a::B;", "a::B"),
        (
            "use crate::{\n    // of use to it;\n    a::B, // and use that\n};",
            "a::B",
        ),
        ("use crate::{a::B, /* c::D; */ e::F};", "a::B e::F"),
        ("/// We use crate::x::Y;\nfn f() { g(); }", ""),
        ("let reuse = 1;\nlet cause = reuse ;", ""),
    ] {
        assert_eq!(read_uses(text), expected, "{text}");
    }
}

#[test]
fn declarations_are_read() {
    let text = "pub struct A;\n  pub(super) enum B {\ntype C<T> = Vec<T>;\nlet structure = 1;\npub(in crate::x) trait D: E {}\n";
    assert_eq!(declared(text).collect::<Vec<_>>(), ["A", "B", "C", "D"]);
}

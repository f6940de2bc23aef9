//! The layout: folders depend downwards only, and neither folders nor files in circles.
//!
//! `use` lines of every crate → arrows between files and folders → what is upward or circular.
#![allow(clippy::unwrap_used)]

mod reading;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use reading::{declared, named};

/// The folders of each crate, lowest first; files beside them belong to the room of their name.
const CRATES: [(&str, &[&str]); 5] = [
    (
        "framework/src",
        &[
            "math",
            "input",
            "events",
            "character",
            "sensing",
            "world",
            "control",
            "scenario",
            "run",
        ],
    ),
    ("controllers/src", &["target", "servo", "momentum", "kinds"]),
    (
        "training/src",
        &[
            "situations",
            "exercise",
            "search",
            "preconditions",
            "anticipation",
        ],
    ),
    (
        "src",
        &["scenarios", "table", "figure", "render", "live", "cli"],
    ),
    ("web/src", &["playground"]),
];

/// Arrows from a file (or folder) to those whose items it uses.
type Arrows = BTreeMap<String, BTreeSet<String>>;

/// Every file below a folder with its text up to its tests.
fn files(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let end = text.find("#[cfg(test)]\nmod tests").unwrap_or(text.len());
            found.push((path, text[..end].to_owned()));
        }
    }
}

/// The module of a file below `src`: `control/boundary/mod.rs` is `[control, boundary]`.
fn module(relative: &Path) -> Vec<String> {
    let text = relative.with_extension("");
    let mut parts: Vec<String> = text
        .iter()
        .map(|p| p.to_str().unwrap().to_owned())
        .collect();
    if parts.last().is_some_and(|p| p == "mod") {
        parts.pop();
    }
    parts
}

/// Arrows between the modules of a crate, apart from re-exports by a folder's own `mod.rs`.
fn arrows(files: &[(PathBuf, String)], root: &Path) -> Arrows {
    let relative = |path: &PathBuf| path.strip_prefix(root).unwrap().to_owned();
    let modules: BTreeSet<Vec<String>> = files.iter().map(|(p, _)| module(&relative(p))).collect();
    let mut arrows = Arrows::new();
    for (path, text) in files {
        let path = relative(path);
        let here = module(&path);
        if here.is_empty() || path == Path::new("lib.rs") || path == Path::new("prelude.rs") {
            continue;
        }
        for mut target in named(text, &here) {
            while !target.is_empty() && !modules.contains(&target) {
                target.pop();
            }
            let own = target == here || (path.ends_with("mod.rs") && target.starts_with(&here));
            if !target.is_empty() && !own {
                let from = arrows.entry(here.join("::")).or_default();
                from.insert(target.join("::"));
            }
        }
    }
    arrows
}

/// The same between the folders right below `src`.
fn between_folders(arrows: &Arrows) -> Arrows {
    let folder = |module: &str| module.split("::").next().unwrap().to_owned();
    let mut folders = Arrows::new();
    for (from, targets) in arrows {
        for to in targets.iter().map(|t| folder(t)) {
            if to != folder(from) {
                folders.entry(folder(from)).or_default().insert(to);
            }
        }
    }
    folders
}

/// A circle of arrows, if there is one.
fn circle(arrows: &Arrows) -> Option<Vec<String>> {
    fn visit(arrows: &Arrows, path: &mut Vec<String>, done: &mut BTreeSet<String>) -> bool {
        let here = path.last().unwrap().clone();
        if path[..path.len() - 1].contains(&here) {
            return true;
        }
        if done.contains(&here) {
            return false;
        }
        for to in arrows.get(&here).into_iter().flatten() {
            path.push(to.clone());
            if visit(arrows, path, done) {
                return true;
            }
            path.pop();
        }
        done.insert(here);
        false
    }
    let mut done = BTreeSet::new();
    arrows.keys().find_map(|start| {
        let mut path = vec![start.clone()];
        visit(arrows, &mut path, &mut done).then_some(path)
    })
}

/// What is wrong with the layout of a crate; `order` has its folders, lowest first.
fn complaints(files: &[(PathBuf, String)], root: &Path, order: &[&str]) -> Vec<String> {
    let mut complaints = Vec::new();
    let files_to_files = arrows(files, root);
    let rank = |folder: &str| order.iter().position(|o| *o == folder);
    for (from, targets) in &files_to_files {
        let folder = |module: &str| module.split("::").next().unwrap().to_owned();
        for to in targets {
            match (rank(&folder(from)), rank(&folder(to))) {
                (Some(a), Some(b)) if b > a => {
                    complaints.push(format!("{from} uses {to}, above it"))
                }
                (None, _) => complaints.push(format!("{from} is in a folder that has no place")),
                _ => {}
            }
        }
    }
    complaints.extend(
        circle(&between_folders(&files_to_files))
            .map(|c| format!("a circle of folders: {}", c.join(" → "))),
    );
    complaints
        .extend(circle(&files_to_files).map(|c| format!("a circle of files: {}", c.join(" → "))));
    complaints
}

fn read(root: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    files(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join(root),
        &mut found,
    );
    found
}

#[test]
fn folders_depend_downwards_and_nothing_goes_in_circles() {
    for (root, order) in CRATES {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(root);
        let complaints = complaints(&read(root), &folder, order);
        assert!(complaints.is_empty(), "{root}:\n{}", complaints.join("\n"));
    }
}

#[test]
fn planted_violations_are_found() {
    let (root, order) = CRATES[0];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(root);
    let planted = |file: &str, line: &str| {
        let mut files = read(root);
        let path = folder.join(file);
        let (_, text) = files.iter_mut().find(|(p, _)| *p == path).unwrap();
        text.insert_str(0, line);
        complaints(&files, &folder, order).join("\n")
    };
    let upward = planted(
        "sensing/sensors.rs",
        "use crate::control::{Contract, repertoire::load};\n",
    );
    assert!(
        upward.contains("sensing::sensors uses control, above it"),
        "{upward}"
    );
    assert!(upward.contains("a circle of folders: "), "{upward}");
    let circle = planted("character/state.rs", "use super::kinematics::Kinematics;\n");
    assert!(
        circle.contains("a circle of files: character::"),
        "{circle}"
    );
    let reexport = planted(
        "input/file.rs",
        "pub(crate) use crate::world::{\n    World,\n    Prop\n};\n",
    );
    assert!(
        reexport.contains("input::file uses world, above it"),
        "{reexport}"
    );
}

/// ARCHITECTURE.md has the drawing that follows from the code.
#[test]
fn the_drawing_of_the_rooms_is_that_of_the_code() {
    let mut drawing = String::from("```mermaid\nflowchart BT\n");
    for (root, order) in CRATES {
        let name = root.trim_end_matches("/src").replace("src", "aplomb");
        drawing += &format!("  subgraph {name}\n");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(root);
        let arrows = between_folders(&arrows(&read(root), &folder));
        for place in order {
            drawing += &format!("    {name}_{place}[{place}]");
            let to: Vec<String> = arrows
                .get(*place)
                .into_iter()
                .flatten()
                .map(|to| format!("{name}_{to}"))
                .collect();
            if !to.is_empty() {
                drawing += &format!(" --> {}", to.join(" & "));
            }
            drawing += "\n";
        }
        drawing += "  end\n";
    }
    drawing += "  controllers --> framework\n  training --> controllers\n  aplomb --> training\n  web --> aplomb\n```\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("ARCHITECTURE.md");
    let text = std::fs::read_to_string(&path).unwrap();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        let start = text.find("```mermaid\n").unwrap_or(text.len());
        let end = text[start..]
            .find("\n```\n")
            .map_or(text.len(), |e| start + e + 5);
        let changed = format!("{}{drawing}{}", &text[..start], &text[end..]);
        std::fs::write(&path, changed).unwrap();
        return;
    }
    assert!(
        text.contains(&drawing),
        "run it with UPDATE_GOLDEN=1 to draw anew:\n{drawing}"
    );
}

/// The associated types that traits of others ask for.
const ASSOCIATED: [&str; 2] = ["Err", "Value"];

#[test]
fn a_type_name_stands_once_in_the_workspace() {
    let mut found: BTreeMap<String, BTreeSet<PathBuf>> = BTreeMap::new();
    for (root, _) in CRATES {
        for (path, text) in read(root) {
            for name in declared(&text) {
                found
                    .entry(name.to_owned())
                    .or_default()
                    .insert(path.clone());
            }
        }
    }
    assert!(found.len() > 200, "{} types", found.len());
    found.retain(|name, files| files.len() > 1 && !ASSOCIATED.contains(&name.as_str()));
    assert!(found.is_empty(), "{found:#?}");
}

//! Finished parts of studies, so that none is done twice.
//!
//! build of the program, command → result; one file, written whole after every part.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use aplomb::framework::input::{read_bounded, write_atomically};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_64;

/// The largest file that is read, bytes.
const LARGEST: u64 = 1 << 28;

/// A finished part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptPart {
    /// When it was finished, as 2026-01-31.
    pub(super) date: String,
    /// s
    pub(super) wall_s: f64,
    /// Threads that worked on it.
    pub(super) jobs: usize,
    /// What its command prints with `--json`.
    pub(super) value: Value,
}

#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
struct Content {
    build: String,
    parts: BTreeMap<String, KeptPart>,
}

/// The file of finished parts.
#[derive(Debug)]
pub(super) struct Kept {
    path: PathBuf,
    content: Content,
}

impl Kept {
    /// What a file has of this build of the program; nothing of another's, since its figures may differ.
    pub(super) fn open(path: &Path, build: &str) -> Self {
        let read = || -> Option<Content> {
            let bytes = read_bounded(path, LARGEST).ok()?;
            let content: Content = serde_json::from_slice(&bytes).ok()?;
            (content.build == build).then_some(content)
        };
        Self {
            path: path.to_owned(),
            content: read().unwrap_or_else(|| Content {
                build: build.to_owned(),
                ..Content::default()
            }),
        }
    }

    /// The result of a command, if there is one.
    pub(super) fn part(&self, command: &str) -> Option<&KeptPart> {
        self.content.parts.get(command)
    }

    /// Keeps the result of a command, and writes the file.
    pub(super) fn keep(&mut self, command: &str, part: KeptPart) -> Result<()> {
        self.content.parts.insert(command.to_owned(), part);
        let bytes = serde_json::to_vec(&self.content)?;
        Ok(write_atomically(&self.path, &bytes)?)
    }
}

/// The running program, as a hash of its file.
pub(super) fn build() -> Result<String> {
    let path = std::env::current_exe().context("cannot find the running program")?;
    let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(format!("{:016x}", xxh3_64(&bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_found_again_by_the_same_build_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/state.json");
        let part = KeptPart {
            date: "2026-01-31".to_owned(),
            wall_s: 1.5,
            jobs: 2,
            value: 7.into(),
        };
        let mut kept = Kept::open(&path, "a");
        kept.keep("aplomb x", part.clone()).unwrap();
        assert_eq!(Kept::open(&path, "a").part("aplomb x"), Some(&part));
        assert_eq!(Kept::open(&path, "a").part("aplomb y"), None);
        assert_eq!(Kept::open(&path, "b").part("aplomb x"), None);
        std::fs::write(&path, "{").unwrap();
        assert_eq!(Kept::open(&path, "a").part("aplomb x"), None);
    }
}

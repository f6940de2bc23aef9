//! The work of one study: its parts, each done or found.
//!
//! command → kept part, or the work now → typed figures; what was used goes to the page.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Instant, SystemTime};

use anyhow::{Context, Result};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::command;
use super::kept::{Kept, KeptPart};
use crate::cli::output::message;

/// How large a study is, and what fixes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct StudySettings {
    /// Small counts.
    pub(super) quick: bool,
    /// Fixes everything random.
    pub(super) seed: u64,
}

/// The user has ended the work; what is finished is kept.
#[derive(Debug)]
pub(super) struct Interrupted;

impl std::fmt::Display for Interrupted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("interrupted")
    }
}

impl std::error::Error for Interrupted {}

/// A part that a page is made from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Used {
    pub(super) command: String,
    pub(super) date: String,
    pub(super) wall_s: f64,
    pub(super) jobs: usize,
}

/// What a study works with.
#[derive(Debug)]
pub(super) struct Work<'a> {
    pub(super) settings: StudySettings,
    pub(super) study: &'static str,
    pub(super) kept: &'a mut Kept,
    pub(super) stop: &'a AtomicBool,
    /// So far.
    pub(super) used: Vec<Used>,
}

impl Work<'_> {
    /// With --quick the first, otherwise the second.
    pub(super) fn size<T>(&self, quick: T, full: T) -> T {
        if self.settings.quick { quick } else { full }
    }

    /// What a command of the program prints with `--json`, read as these figures.
    pub(super) fn command<T: DeserializeOwned>(&mut self, line: &str) -> Result<T> {
        self.part(line, |stop| command::value(line, stop))
    }

    /// The result of a part, found by its command or made now and kept. `make` runs in the threads of
    /// the whole work.
    pub(super) fn part<T: DeserializeOwned>(
        &mut self,
        command: &str,
        make: impl FnOnce(&AtomicBool) -> Result<Value>,
    ) -> Result<T> {
        let part = match self.kept.part(command) {
            Some(part) => part.clone(),
            None => self.make(command, make)?,
        };
        self.used.push(Used {
            command: command.to_owned(),
            date: part.date,
            wall_s: part.wall_s,
            jobs: part.jobs,
        });
        serde_json::from_value(part.value).with_context(|| format!("the result of {command}"))
    }

    fn make(
        &mut self,
        command: &str,
        make: impl FnOnce(&AtomicBool) -> Result<Value>,
    ) -> Result<KeptPart> {
        self.check()?;
        message(format_args!("{}: {command}", self.study));
        let begun = Instant::now();
        let value = make(self.stop).with_context(|| command.to_owned());
        // What was stopped may be incomplete, or have failed for that.
        self.check()?;
        let part = KeptPart {
            date: today(),
            wall_s: begun.elapsed().as_secs_f64(),
            jobs: rayon::current_num_threads(),
            value: value?,
        };
        self.kept.keep(command, part.clone())?;
        Ok(part)
    }

    fn check(&self) -> Result<()> {
        if self.stop.load(Ordering::Relaxed) {
            anyhow::bail!(Interrupted);
        }
        Ok(())
    }
}

/// The date in UTC, as 2026-01-31.
fn today() -> String {
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    now.chars().take(10).collect()
}

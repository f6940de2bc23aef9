//! What a study is: a name, what it shows, and the work that makes its page.

use anyhow::Result;

use super::page::Page;
use super::work::Work;

/// One study. Its file declares it; the table of [`super::studies`] names it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Study {
    /// As in `aplomb reproduce NAME` and docs/results/NAME.md.
    pub(super) name: &'static str,
    /// In one line.
    pub(super) about: &'static str,
    /// About how long it takes on two cores: with --quick, in full.
    pub(super) takes: [&'static str; 2],
    /// Does the work that is not kept already, and makes the page.
    pub(super) run: fn(&mut Work<'_>) -> Result<Page>,
}

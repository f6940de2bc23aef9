//! `aplomb compare`: learned pre-conditions beside the nearest neighbour and those made by hand.
//!
//! folder → reports → tables, JSON or a page with figures.

mod html;
mod json;
mod markdown;
mod read;
mod table;
mod text;

use std::io::Write;
use std::path::PathBuf;

use anyhow::Result;
use aplomb::framework::input::write_atomically;
use clap::{Args, ValueEnum};

use super::Ending;
use super::output::{check_writable, message};

/// How the comparison is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Aligned text
    Table,
    /// Tables in Markdown
    Markdown,
    /// One JSON value: a list, an entry for each report
    Json,
    /// One page with tables and figures that needs nothing else
    Html,
}

/// Compare learned pre-conditions with their rivals
///
/// Reads every *.report.json of a folder, as `aplomb train preconditions` writes them: how often the
/// support vector machine, the nearest neighbour, the hand-made pre-condition and the more frequent
/// answer were right about rollouts that none of them had seen. Intervals are Wilson's of 95 %. The
/// page also has ROC curves, confusion matrices, accuracy against training size and the learned
/// boundary over position and velocity of the centre of mass, where a report has them.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb compare out/preconditions
  aplomb compare out/preconditions --format json
  aplomb compare out/preconditions --format html --out comparison.html")]
pub(super) struct CompareArgs {
    /// A folder with *.report.json files
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// How the comparison is told
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Writes into a file instead of to stdout
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl CompareArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        if let Some(path) = &self.out {
            check_writable(path)?;
        }
        let entries = read::folder(&self.folder)?;
        let reports = || entries.iter().map(|e| &e.report);
        let text = match self.format {
            Format::Table => text::told(&table::both(reports())),
            Format::Markdown => markdown::told(&table::both(reports())),
            Format::Json => json::told(reports())?,
            Format::Html => html::page(&entries)?,
        };
        match &self.out {
            Some(path) => {
                write_atomically(path, text.as_bytes())?;
                message(format_args!("written into {}", path.display()));
            }
            None => out.write_all(text.as_bytes())?,
        }
        Ok(Ending::Done)
    }
}

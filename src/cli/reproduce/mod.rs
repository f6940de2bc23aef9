//! `aplomb reproduce`: the studies behind docs/results, and their pages.
//!
//! names → studies → parts, each a command of the program → figures → pages, README's table. A part that
//! is finished is kept and not done again.

mod command;
mod kept;
mod page;
mod readme;
mod studies;
mod study;
mod work;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use aplomb::framework::input::{Error, Source, write_atomically};
use clap::Args;

use super::output::{check_writable, message};
use super::values::whole;
use super::{Ending, work as threads};
use kept::Kept;
use page::Page;
use study::Study;
use work::{Interrupted, StudySettings, Work};

/// Where finished parts are kept.
const STATE: &str = "out/reproduce/state.json";
/// Where pages are written.
const PAGES: &str = "docs/results";

/// Run the studies behind docs/results, and write their pages
///
/// Runs studies, all or those that are named, and writes a page for each: its figures with seed, version,
/// date, cores and the commands that made them. Every part that is finished is kept in
/// out/reproduce/state.json; the same program with the same settings does not do it again, so that a run
/// that was interrupted goes on. A full run into docs/results also renews the figures of README.md in the
/// current folder, between its marks <!-- results --> and <!-- /results -->.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb reproduce --list
  aplomb reproduce push_limits trials
  aplomb reproduce --quick --out /tmp/results")]
pub(super) struct ReproduceArgs {
    /// Names of studies; all if left out
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Lists the studies, what they show, and about how long they take
    #[arg(long)]
    list: bool,
    /// Small counts: minutes for all, to see that everything works
    #[arg(long)]
    quick: bool,
    /// Folder of the pages
    #[arg(long, value_name = "DIR", default_value = PAGES)]
    out: PathBuf,
    /// Fixes everything random
    #[arg(long, value_name = "N", default_value = "61",
          value_parser = whole(0, u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    jobs: threads::Jobs,
}

impl ReproduceArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        if self.list {
            return list(out);
        }
        let chosen = self.chosen()?;
        for study in &chosen {
            check_writable(&self.page(study))?;
        }
        let mut kept = Kept::open(Path::new(STATE), &kept::build()?);
        let stop = threads::stop_on_interrupt()?;
        let settings = StudySettings {
            quick: self.quick,
            seed: self.seed,
        };
        let threads = self.jobs.threads()?;
        for study in chosen {
            let name = study.name;
            let mut work = Work {
                settings,
                study: name,
                kept: &mut kept,
                stop: &stop,
                used: Vec::new(),
            };
            let page = match threads.install(|| (study.run)(&mut work)) {
                Err(e) if e.is::<Interrupted>() => {
                    message(format_args!(
                        "interrupted in {name}; the same command goes on"
                    ));
                    break;
                }
                page => page.with_context(|| format!("study {name}"))?,
            };
            let text = page.markdown(name, settings, &work.used);
            let path = self.page(study);
            write_atomically(&path, text.as_bytes())?;
            writeln!(out, "{}", path.display())?;
            out.flush()?;
            // Quick figures are no results, and README links to these pages alone.
            if !self.quick && self.out == Path::new(PAGES) {
                self.renew(Path::new("README.md"), study, &page)?;
            }
        }
        Ok(Ending::Done)
    }

    fn chosen(&self) -> Result<Vec<&'static Study>> {
        if self.names.is_empty() {
            return Ok(studies::ALL.iter().collect());
        }
        let find = |name: &String| {
            let found = studies::ALL.iter().find(|s| s.name == name);
            let known = studies::ALL.iter().map(|s| s.name);
            Ok(found.ok_or_else(|| Error::unknown("study", name, known))?)
        };
        self.names.iter().map(find).collect()
    }

    fn page(&self, study: &Study) -> PathBuf {
        self.out.join(format!("{}.md", study.name))
    }

    /// Puts the figures of a page into README's table, if there is one.
    fn renew(&self, readme: &Path, study: &Study, page: &Page) -> Result<()> {
        if page.highlights.is_empty() || !readme.exists() {
            return Ok(());
        }
        let text = Source::read(readme)?.text;
        let link = self.page(study).display().to_string();
        match readme::updated(&text, &link, &page.highlights) {
            Some(renewed) => Ok(write_atomically(readme, renewed.as_bytes())?),
            None => Ok(()),
        }
    }
}

fn list(out: &mut dyn Write) -> Result<Ending> {
    let wide = studies::ALL.iter().map(|s| s.name.len()).max();
    let wide = wide.unwrap_or(0);
    for Study {
        name, about, takes, ..
    } in studies::ALL
    {
        let [quick, full] = takes;
        writeln!(out, "{name:wide$}  {about}")?;
        writeln!(out, "{:wide$}  about {full}; with --quick {quick}", "")?;
    }
    Ok(Ending::Done)
}

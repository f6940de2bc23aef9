//! `aplomb train basis`: trajectories of a clip over a parameter, and their principal components.
//!
//! arguments → one search a value → singular value decomposition → basis file.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Result, ensure};
use aplomb::controllers::kinds::cmrt::Cmrt;
use aplomb::training::anticipation::basis::Basis;
use aplomb::training::anticipation::search::{FoundTrajectory, Keep};
use clap::Args;
use serde::Serialize;

use super::cmrt::{SearchArgs, shown};
use super::figures::Figures;
use crate::cli::arguments::{Json, Resume};
use crate::cli::output::{check_writable, message, write_json};
use crate::cli::values::{Setting, whole};
use crate::cli::{Ending, work};

/// Learn what the trajectories of a clip over a parameter have in common
///
/// Optimises the clip for values of a parameter at equal distances, each search beginning with the
/// trajectory found for the value before, and reduces knots, control points and length to their
/// principal components. `train cmrt --basis` then searches in few dimensions.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb train basis push --over mass=30..150 --count 11 --components 3 --out push.basis.ron
  aplomb train cmrt push --set mass=100 --basis push.basis.ron")]
pub(in crate::cli) struct BasisArgs {
    /// A shipped clip or a scenario file
    clip: String,
    /// The clip's parameter and its range
    #[arg(long, value_name = "KEY=LOW..HIGH")]
    over: OverRange,
    /// Number of trajectories
    #[arg(long, value_name = "N", default_value = "11",
          value_parser = whole(2, 1000), allow_negative_numbers = true)]
    count: u64,
    /// Number of principal components that are kept
    #[arg(long, value_name = "K", default_value = "3",
          value_parser = whole(1, 17), allow_negative_numbers = true)]
    components: u64,
    #[command(flatten)]
    search: SearchArgs,
    /// The basis file that is written [default: CLIP.basis.ron]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draws figures into this folder, as SVG: the trajectories, their principal components, the variance
    /// that these explain
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    #[command(flatten)]
    resume: Resume,
    #[command(flatten)]
    json: Json,
}

/// A parameter with its range.
#[derive(Debug, Clone, PartialEq)]
struct OverRange {
    key: String,
    low: f64,
    high: f64,
}

impl FromStr for OverRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let accepted = || "accepted: KEY=LOW..HIGH, for example mass=30..150".to_owned();
        let (key, range) = text.split_once('=').ok_or_else(accepted)?;
        let (low, high) = range.split_once("..").ok_or_else(accepted)?;
        let number = |t: &str| t.parse().ok().filter(|x: &f64| x.is_finite());
        match (number(low), number(high)) {
            (Some(low), Some(high)) if low < high && !key.is_empty() => Ok(Self {
                key: key.to_owned(),
                low,
                high,
            }),
            _ => Err(accepted()),
        }
    }
}

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(in crate::cli) struct BasisReport {
    clip: String,
    parameter: String,
    values: Vec<f64>,
    objectives: Vec<f64>,
    evaluations: Vec<usize>,
    components: usize,
    explained: Vec<f64>,
    wall_s: f64,
    out: String,
}

impl BasisArgs {
    pub(in crate::cli) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let stop = work::stop_on_interrupt()?;
        let report = self
            .search
            .jobs
            .threads()?
            .install(|| self.measure(&stop))?;
        if self.json.wanted {
            write_json(out, &report)?;
        } else {
            print(out, &report)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints; it is searched in the threads of the caller, and all files are written.
    pub(in crate::cli) fn measure(&self, stop: &AtomicBool) -> Result<BasisReport> {
        let stem = Path::new(&self.clip).file_stem().unwrap_or_default();
        let usual = || PathBuf::from(format!("{}.basis.ron", stem.to_string_lossy()));
        let file = self.out.clone().unwrap_or_else(usual);
        check_writable(&file)?;
        let figures = match &self.figures {
            Some(folder) => Some(Figures::new(
                folder,
                &self.search.clip(&self.clip)?.scenario,
            )?),
            None => None,
        };
        let begun = Instant::now();
        let mut family: Vec<Cmrt> = Vec::new();
        let (mut objectives, mut evaluations) = (Vec::new(), Vec::new());
        for i in 0..self.count {
            let part = i as f64 / (self.count - 1) as f64;
            let value = self.over.low + part * (self.over.high - self.over.low);
            let value = (1e9 * value).round() / 1e9;
            let found = self.member(i, value, family.last(), &file, stop)?;
            ensure!(
                work::going_on(stop).is_continue(),
                "interrupted at {} = {value}; --resume goes on",
                self.over.key
            );
            message(format_args!(
                "{} = {value}: objective {:.3}, {} evaluations",
                self.over.key, found.objective, found.evaluations
            ));
            objectives.push(found.objective);
            evaluations.push(found.evaluations);
            family.push(Cmrt {
                value,
                ..found.cmrt
            });
        }
        let values = family.iter().map(|c| c.value).collect();
        let (key, seed) = (&self.over.key, self.search.seed.value);
        let components = self.components as usize;
        let basis = Basis::new(&self.clip, key, seed, family, components)?;
        basis.write(&file)?;
        if let Some(figures) = figures {
            figures.basis(&basis)?;
        }
        Ok(BasisReport {
            clip: self.clip.clone(),
            parameter: key.clone(),
            values,
            objectives,
            evaluations,
            components: basis.components.len(),
            explained: basis.explained.clone(),
            wall_s: begun.elapsed().as_secs_f64(),
            out: file.display().to_string(),
        })
    }

    /// The trajectory for one value, beginning with that for the value before.
    fn member(
        &self,
        place: u64,
        value: f64,
        before: Option<&Cmrt>,
        file: &Path,
        stop: &AtomicBool,
    ) -> Result<FoundTrajectory> {
        let key = self.over.key.clone();
        let clip = self
            .search
            .clip_with(&self.clip, &[Setting { key, value }])?;
        let mut plan = self.search.plan(self.search.encoding(&clip));
        plan.start = before.cloned();
        let journal = file.with_extension(format!("{place}.journal"));
        let keep = Keep {
            journal: &journal,
            // The search that was interrupted may not have come to this one.
            resume: self.resume.wanted && journal.exists(),
        };
        shown(&clip, &plan, keep, stop)
    }
}

fn print(out: &mut dyn Write, r: &BasisReport) -> std::io::Result<()> {
    writeln!(
        out,
        "{} over {}: {} trajectories, {:.1} s",
        r.clip,
        r.parameter,
        r.values.len(),
        r.wall_s
    )?;
    let mut sum = 0.0;
    for (i, part) in r.explained.iter().enumerate() {
        sum += part;
        let kept = if i < r.components { "kept" } else { "left out" };
        writeln!(
            out,
            "component {:2}: {:5.1} % of the variance, {:5.1} % with those before, {kept}",
            i + 1,
            100.0 * part,
            100.0 * sum
        )?;
    }
    writeln!(out, "written to {}", r.out)
}

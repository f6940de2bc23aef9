//! `aplomb train skill`: CMA-ES over the numbers of a controller.
//!
//! arguments → skill → search → controller file and journal. The number of threads changes nothing.

use std::io::{IsTerminal, Write, stderr};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::{Context, Result, anyhow};
use aplomb::training::exercise::Score;
use aplomb::training::exercise::skill::Skill;
use aplomb::training::search::improve::{FoundNumbers, SearchPlan, SearchStage};
use aplomb::training::search::{improve, journal};
use clap::Args;
use indicatif::ProgressBar;
use serde::Serialize;

use super::skills;
use crate::cli::arguments::{Json, Resume, Seed};
use crate::cli::output::{check_writable, message, write_json};
use crate::cli::scene::CastArgs;
use crate::cli::values::{number, whole};
use crate::cli::{Ending, progress, work};

/// Search for better numbers of a controller: angles, durations, gains
///
/// CMA-ES over many rollouts. The controller's file declares in `exercise` where they begin and what
/// the controller has to do, its numbers what is searched. In random worlds (friction 0.6 to 1.2,
/// torque 0.85 to 1.15, mass 0.95 to 1.05): `Rise` takes over where the repertoire hands over to it, in
/// heaps on the floor and in falls after a push (where that is too rare, it also begins as its
/// rollouts for train preconditions do), and has to come to its goal without any failure; `Step` is
/// pushed and has to stand again; `Fall` is pushed and has to keep head and trunk from hitting the
/// ground first, and hard. `Stand` takes pushes at its limit alone, and has to keep its feet.
///
/// The best controller so far is always in the output; beside it is a journal with which --resume
/// goes on, also after the program was killed, to what it would have found. Ctrl-C ends the search
/// after the running generation.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb train skill rise_supine --evaluations 2000 --starts 40
  aplomb train skill rise_supine --evaluations 4000 --starts 40 --resume
  aplomb train skill fall --starts 42
  aplomb train skill balance --starts 24
  aplomb train skill tuck --repertoire mine.ron --out better.ron --json")]
pub(in crate::cli) struct SkillArgs {
    /// Name of a controller of the repertoire, of kind pose, step, fall, balance or stance
    controller: String,
    #[command(flatten)]
    cast: CastArgs,
    /// Ends with the generation that reaches N evaluations, each of all starts
    #[arg(long, value_name = "N", default_value = "1000",
          value_parser = whole(1, 10_000_000), allow_negative_numbers = true)]
    evaluations: u64,
    /// Number of starts; of pushes for `Stand`
    #[arg(long, value_name = "N", default_value = "32",
          value_parser = whole(1, 10_000), allow_negative_numbers = true)]
    starts: u64,
    #[command(flatten)]
    seed: Seed,
    /// Width of the search at its beginning, relative to the ranges of the numbers
    #[arg(long, value_name = "S", default_value = "0.1",
          value_parser = number(0.001, 1.0, "of the ranges"), allow_negative_numbers = true)]
    sigma: f64,
    #[command(flatten)]
    jobs: work::Jobs,
    /// The controller file that is written [default: CONTROLLER.ron]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    resume: Resume,
    #[command(flatten)]
    json: Json,
}

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
struct SkillReport<'a> {
    controller: &'a str,
    kind: &'a str,
    seed: u64,
    evaluations: usize,
    starts: usize,
    reached: usize,
    cost: f64,
    start_reached: usize,
    start_cost: f64,
    wall_s: f64,
    interrupted: bool,
    out: String,
}

impl SkillArgs {
    pub(in crate::cli) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let skills = skills(&self.cast)?;
        let skill = Skill::find(&skills, &self.controller)?;
        improve::check(skill)?;
        let file = self.out.clone();
        let file = file.unwrap_or_else(|| PathBuf::from(format!("{}.ron", self.controller)));
        check_writable(&file)?;
        check_writable(&journal::beside(&file))?;
        let stop = work::stop_on_interrupt()?;
        let begun = Instant::now();
        let threads = self.jobs.threads()?;
        let found = threads.install(|| self.search(skill, &file, &stop))?;
        let interrupted = stop.load(Ordering::Relaxed);
        if interrupted {
            let n = found.evaluations;
            message(format_args!(
                "interrupted after {n} evaluations; --resume goes on"
            ));
        }
        let report = SkillReport {
            controller: skill.name(),
            kind: skill.kind(),
            seed: self.seed.value,
            evaluations: found.evaluations,
            starts: found.starts,
            reached: found.best.reached,
            cost: found.best.cost,
            start_reached: found.start.reached,
            start_cost: found.start.cost,
            wall_s: begun.elapsed().as_secs_f64(),
            interrupted,
            out: file.display().to_string(),
        };
        if self.json.wanted {
            write_json(out, &report)?;
        } else {
            print(out, &report)?;
        }
        Ok(Ending::Done)
    }

    fn search(&self, skill: &Skill, file: &Path, stop: &AtomicBool) -> Result<FoundNumbers> {
        let plan = SearchPlan {
            evaluations: self.evaluations as usize,
            starts: self.starts as usize,
            seed: self.seed.value,
            sigma: self.sigma,
            out: file,
            resume: self.resume.wanted,
        };
        let mut bars = Bars::new(self);
        let found = improve::improve(skill, plan, |stage| {
            bars.show(stage);
            work::going_on(stop)
        });
        bars.bar.finish_and_clear();
        let found = if self.resume.wanted {
            found.context("--resume")?
        } else {
            found?
        };
        found.ok_or_else(|| anyhow!("interrupted before the first evaluation: nothing was found"))
    }
}

/// A bar for the starts, then one for the evaluations; where stderr is no terminal, a line for every
/// improvement instead.
struct Bars {
    bar: ProgressBar,
    evaluations: u64,
    starts: u64,
    searching: bool,
    told: Option<Score>,
}

impl Bars {
    fn new(args: &SkillArgs) -> Self {
        Self {
            bar: progress::bar(args.starts, "starts"),
            evaluations: args.evaluations,
            starts: args.starts,
            searching: false,
            told: None,
        }
    }

    fn show(&mut self, stage: SearchStage) {
        let found = match stage {
            SearchStage::Gathering(found) => return self.bar.set_position(found as u64),
            SearchStage::Searching(found) => found,
        };
        let (n, of) = (found.evaluations, found.starts);
        let Score { cost, reached } = found.best;
        if !self.searching {
            self.searching = true;
            self.bar.finish_and_clear();
            if of as u64 != self.starts {
                let asked = self.starts;
                message(format_args!(
                    "only {of} of {asked} starts: the repertoire seldom hands over to the controller"
                ));
            }
            self.bar = progress::bar(self.evaluations, "evaluations");
        }
        self.bar.set_position((n as u64).min(self.evaluations));
        let best = format!("cost {cost:.4}, {reached} of {of} reached");
        if self.told != Some(found.best) && !stderr().is_terminal() {
            message(format_args!("{n} evaluations: {best}"));
        }
        self.told = Some(found.best);
        self.bar.set_message(format!("; {best}"));
    }
}

fn print(out: &mut dyn Write, r: &SkillReport<'_>) -> std::io::Result<()> {
    let (n, starts) = (r.evaluations, r.starts);
    let SkillReport {
        controller, seed, ..
    } = r;
    writeln!(
        out,
        "{controller}: {n} evaluations over {starts} starts, seed {seed}, {:.1} s",
        r.wall_s
    )?;
    let line = |reached, cost| format!("cost {cost:.4}, {reached} of {starts} starts reached");
    writeln!(out, "began with  {}", line(r.start_reached, r.start_cost))?;
    writeln!(out, "came to     {}", line(r.reached, r.cost))?;
    writeln!(out, "written to {}", r.out)
}

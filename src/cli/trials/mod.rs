//! `aplomb trials`: many randomised runs, in parallel, summed up.
//!
//! arguments → plan → trial i with random stream i → tally. The number of threads changes nothing.

mod falls;
mod falls_report;
mod plan;
mod report;
mod rising;
mod tally;

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Result, anyhow, bail, ensure};
use clap::Args;
use rayon::prelude::*;

use super::json::RunJson;
use super::output::{check_writable, message, write_recording};
use super::scene::{SceneArgs, record};
use super::values::{STRONGEST, duration, number, whole};
use super::{Ending, progress, timeline, work};
use crate::cli::arguments::Json;
use plan::{FinishedTrial, TrialPlan};
use report::TrialsReport;
use tally::Tally;

/// The most trials of one call.
const MOST_TRIALS: u64 = 10_000_000;
/// N·s; the strongest push if neither pushes nor another disturbance were asked for.
const DEFAULT_IMPULSE: f64 = 60.0;
/// The largest offset of a joint at the start, rad.
const LARGEST_ANGLE: f64 = std::f64::consts::PI;

/// Run many randomised trials and count how they end
///
/// Each trial is a run with a random disturbance: one push over 0.1 s at 1 s on the pelvis, torso
/// or head, joint angles that are off at the start, or a start as a random heap on the floor; with
/// --vary also in a world of its own.
/// A fall lasts until the character lies still; the head is hit if it touches anything before.
/// Trial i depends on the seed and on i only, so that --only i repeats it. Ctrl-C prints the result
/// of the trials that are finished.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb trials --count 200 --max-impulse 80
  aplomb trials --count 200 --max-impulse 80 --only 17 --record 17.trajectory
  aplomb trials --count 200 --vary --repertoire limp
  aplomb trials --fallen --duration 5 --json")]
pub(super) struct TrialsArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of trials
    #[arg(long, value_name = "N", default_value = "100",
          value_parser = whole(1, MOST_TRIALS), allow_negative_numbers = true)]
    count: u64,
    /// Pushes are uniform in ±I, N·s [default: 60; 0 with --max-angle or --fallen]
    #[arg(long, value_name = "I",
          value_parser = number(0.0, STRONGEST, "N·s"), allow_negative_numbers = true)]
    max_impulse: Option<f64>,
    /// Leaves out pushes weaker than I either way, N·s
    #[arg(long, value_name = "I", default_value = "0",
          value_parser = number(0.0, STRONGEST, "N·s"), allow_negative_numbers = true)]
    min_impulse: f64,
    /// Joint angles at the start are off by up to A either way, rad
    #[arg(long, value_name = "A", default_value = "0",
          value_parser = number(0.0, LARGEST_ANGLE, "rad"), allow_negative_numbers = true)]
    max_angle: f64,
    /// Starts as a random heap, dropped from just above the floor
    #[arg(long, conflicts_with = "max_angle")]
    fallen: bool,
    /// Each trial in a world of its own: friction 0.6 to 1.2, torque 0.85 to 1.15, mass 0.95 to 1.05
    /// times the scenario's. Pushes and starts stay the same
    #[arg(long)]
    vary: bool,
    /// Length of each trial, s
    #[arg(long, value_name = "S", default_value = "20",
          value_parser = duration, allow_negative_numbers = true)]
    duration: f64,
    /// Runs trial I alone, counted from 0, and prints its timeline
    #[arg(long, value_name = "I",
          value_parser = whole(0, MOST_TRIALS - 1), allow_negative_numbers = true)]
    only: Option<u64>,
    /// Records the trial that --only names into a trajectory file
    #[arg(long, value_name = "FILE", requires = "only")]
    record: Option<PathBuf>,
    #[command(flatten)]
    jobs: work::Jobs,
    #[command(flatten)]
    json: Json,
}

impl TrialsArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let plan = self.plan()?;
        if let Some(index) = self.only {
            return self.one(&plan, index, out);
        }
        let stop = work::stop_on_interrupt()?;
        let threads = self.jobs.threads()?;
        let report = threads.install(|| self.sum_up(&plan, &stop))?;
        if report.interrupted {
            message(format_args!(
                "interrupted: {} of {} trials were finished",
                report.count, self.count
            ));
        }
        if self.json.wanted {
            report.write_json(out, None)?;
        } else {
            report.print(out, &plan)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints of all trials, which run in the threads of the caller.
    pub(super) fn measure(&self, stop: &AtomicBool) -> Result<TrialsReport> {
        self.sum_up(&self.plan()?, stop)
    }

    fn sum_up(&self, plan: &TrialPlan, stop: &AtomicBool) -> Result<TrialsReport> {
        let begun = Instant::now();
        let tally = self.all(plan, stop)?;
        let wall_s = begun.elapsed().as_secs_f64();
        let interrupted = tally.count() < self.count;
        Ok(TrialsReport::new(plan, tally, wall_s, interrupted))
    }

    fn plan(&self) -> Result<TrialPlan> {
        let registry = aplomb::controllers::registry();
        let mut scenario = self.scene.load(self.duration, &registry)?;
        scenario.duration = self.duration;
        let calm = self.fallen || self.max_angle > 0.0;
        let otherwise = if calm { 0.0 } else { DEFAULT_IMPULSE };
        let max_impulse = self.max_impulse.unwrap_or(otherwise);
        ensure!(
            self.min_impulse <= max_impulse,
            "--min-impulse is {}; accepted: 0 to --max-impulse, {max_impulse} N·s",
            self.min_impulse
        );
        if let Some(only) = self.only.filter(|i| *i >= self.count) {
            bail!(
                "--only is {only}; accepted: 0 to {} (--count less 1)",
                self.count - 1
            );
        }
        self.record.as_deref().map_or(Ok(()), check_writable)?;
        let disturbance = plan::TrialStart {
            impulse: [self.min_impulse, max_impulse],
            max_angle: self.max_angle,
            fallen: self.fallen,
            vary: self.vary,
        };
        TrialPlan::new(scenario, registry, disturbance)
    }

    fn all(&self, plan: &TrialPlan, stop: &AtomicBool) -> Result<Tally> {
        let bar = progress::bar(self.count, "trials");
        let take = |mut tally: Tally, index: u64| {
            if let Some(trial) = plan.run(index, stop)? {
                tally.take(&trial);
                bar.inc(1);
            }
            Ok::<_, anyhow::Error>(tally)
        };
        let empty = || Tally::new(plan.pool());
        let trials = (0..self.count).into_par_iter();
        let parts = trials.try_fold(empty, take);
        let tally = parts.try_reduce(empty, |a, b| Ok(a.merged(b)));
        bar.finish_and_clear();
        tally
    }

    /// One trial alone: its timeline, or its JSON within the JSON of all trials.
    fn one(&self, plan: &TrialPlan, index: u64, out: &mut dyn Write) -> Result<Ending> {
        let begun = Instant::now();
        let mut staged = plan.stage(index)?;
        if self.record.is_some() {
            record(&mut staged.simulation, &staged.scenario)?;
        }
        let never = AtomicBool::new(false);
        let trial = plan.watch(&mut staged, &never);
        let trial: FinishedTrial = trial.ok_or_else(|| anyhow!("the trial was interrupted"))?;
        let wall_s = begun.elapsed().as_secs_f64();
        let plan::Staged {
            scenario,
            simulation,
            ..
        } = staged;
        // Told once the recording is written: a reader that leaves early does not lose it.
        let mut told = Vec::new();
        if self.json.wanted {
            let mut tally = Tally::new(plan.pool());
            tally.take(&trial);
            let run = RunJson::new(&simulation, &scenario, wall_s, false);
            TrialsReport::new(plan, tally, wall_s, false).write_json(&mut told, Some(run))?;
        } else {
            write!(told, "trial {index}: {}", trial.disturbance())?;
            if self.vary {
                let world = &scenario.settings;
                let (friction, torque, mass) = (world.friction, world.torque, world.mass);
                write!(
                    told,
                    "; friction {friction:.2}, torque {torque:.2}, mass {mass:.2}"
                )?;
            }
            writeln!(told)?;
            timeline::print(&mut told, &simulation, &scenario, false)?;
        }
        if let Some(recording) = simulation.into_recording() {
            write_recording(&recording, self.record.as_deref(), None)?;
        }
        out.write_all(&told)?;
        Ok(Ending::Done)
    }
}

//! The result of trials, as JSON and as text.

use std::collections::BTreeMap;
use std::io::Write;

use anyhow::Result;
use serde::Serialize;

use crate::cli::json::RunJson;
use crate::cli::output::write_json;

use super::falls_report::FallsReport;
use super::plan::TrialPlan;
use super::tally::{Activations, FailedTrial, Tally};
use crate::cli::statistics::{median, percentile, wilson};

/// So many failures are told in text.
const FAILURES_TOLD: usize = 10;

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(in crate::cli) struct TrialsReport {
    pub(super) count: u64,
    standing: u64,
    fraction: f64,
    /// Wilson's, of the fraction that stands.
    interval95: [f64; 2],
    fell: u64,
    stepped: u64,
    /// None if nobody got up.
    time_to_stand: Option<TimeToStand>,
    seed: u64,
    wall_s: f64,
    simulated_s: f64,
    steps_per_s: f64,
    pub(super) interrupted: bool,
    /// Of the trials that are finished: equal if and only if every step of each is.
    digest: String,
    controllers: BTreeMap<String, Activations>,
    switches_per_minute: f64,
    short_activations: u64,
    falls: FallsReport,
    failures: Vec<FailedTrial>,
}

/// From the first fall, or of heaps from the start, to standing, s.
#[derive(Debug, Serialize)]
struct TimeToStand {
    /// Trials that got up.
    count: u64,
    median: f64,
    p90: f64,
    max: f64,
}

#[derive(Debug, Serialize)]
struct WithRun<'a> {
    #[serde(flatten)]
    report: &'a TrialsReport,
    run: RunJson,
}

impl TimeToStand {
    /// None if nobody got up.
    fn new(times: &[f64]) -> Option<Self> {
        Some(Self {
            count: times.len() as u64,
            median: median(times)?,
            p90: percentile(times, 90)?,
            max: times.iter().copied().fold(0.0, f64::max),
        })
    }
}

impl TrialsReport {
    /// Of a tally that took `wall_s` s.
    pub(super) fn new(plan: &TrialPlan, mut tally: Tally, wall_s: f64, interrupted: bool) -> Self {
        let count = tally.count();
        let simulated_s = tally.steps as f64 * plan.dt();
        Self {
            count,
            standing: tally.standing,
            fraction: tally.standing as f64 / count.max(1) as f64,
            interval95: wilson(tally.standing, count),
            fell: tally.fell,
            stepped: tally.stepped,
            time_to_stand: TimeToStand::new(&tally.times_to_stand),
            seed: plan.scenario.seed,
            wall_s,
            simulated_s,
            steps_per_s: tally.steps as f64 / wall_s.max(1e-9),
            interrupted,
            digest: tally.digest(),
            switches_per_minute: tally.switches as f64 * 60.0 / simulated_s.max(1e-9),
            short_activations: tally.short_activations,
            falls: FallsReport::new(&tally.forward, &tally.backward),
            failures: tally.failures().to_vec(),
            controllers: tally.controllers,
        }
    }

    /// As one JSON value; with the run of a single trial within.
    pub(super) fn write_json(&self, out: &mut dyn Write, run: Option<RunJson>) -> Result<()> {
        match run {
            None => write_json(out, self),
            Some(run) => write_json(out, &WithRun { report: self, run }),
        }
    }

    /// As text.
    pub(super) fn print(&self, out: &mut dyn Write, plan: &TrialPlan) -> Result<()> {
        let d = &plan.disturbance;
        let scenario = &plan.scenario;
        write!(
            out,
            "{}: {} trials of {} s, seed {}",
            scenario.name, self.count, scenario.duration, self.seed
        )?;
        if d.impulse[1] > 0.0 {
            let [least, most] = d.impulse;
            write!(out, "; pushes of {least} to {most} N·s either way")?;
        }
        if d.fallen {
            write!(out, "; from a heap on the floor")?;
        } else if d.max_angle > 0.0 {
            write!(out, "; joints off by up to {} rad", d.max_angle)?;
        }
        if d.vary {
            write!(out, "; each in a world of its own")?;
        }
        let [low, high] = self.interval95.map(|x| 100.0 * x);
        writeln!(
            out,
            "\nstanding at the end  {} ({:.1} %; 95 % interval {low:.1} to {high:.1} %)",
            self.standing,
            100.0 * self.fraction
        )?;
        writeln!(out, "fell                 {}", self.fell)?;
        writeln!(out, "stepped              {}", self.stepped)?;
        if let Some(t) = &self.time_to_stand {
            writeln!(
                out,
                "got up               {} after {:.2} s (median), nine of ten within {:.2} s, all within {:.2} s",
                t.count, t.median, t.p90, t.max
            )?;
        }
        self.falls.print(out)?;
        self.print_controllers(out)?;
        self.print_failures(out)?;
        Ok(writeln!(
            out,
            "\n{:.0} s simulated in {:.1} s: {:.0} steps/s",
            self.simulated_s, self.wall_s, self.steps_per_s
        )?)
    }

    fn print_controllers(&self, out: &mut dyn Write) -> Result<()> {
        let names = self.controllers.keys().map(String::len).max();
        let width = names.unwrap_or(0).max(10);
        writeln!(
            out,
            "\n{:width$}  activations  succeeded   failed",
            "controller"
        )?;
        for (name, c) in &self.controllers {
            let (a, s, f) = (c.activations, c.succeeded, c.failed);
            writeln!(out, "{name:width$}  {a:11}  {s:9}  {f:7}")?;
        }
        writeln!(
            out,
            "{:.1} switches a minute; {} activations shorter than 50 ms that neither a failure nor a command ended",
            self.switches_per_minute, self.short_activations
        )?;
        Ok(())
    }

    fn print_failures(&self, out: &mut dyn Write) -> Result<()> {
        if self.failures.is_empty() {
            return Ok(());
        }
        writeln!(out, "\nnot standing at the end (--only I repeats trial I):")?;
        for failure in self.failures.iter().take(FAILURES_TOLD) {
            let (index, posture, active) = (failure.index, failure.posture, &failure.active);
            let push = match (&failure.link, failure.impulse) {
                (Some(link), Some(impulse)) => format!("  {link} {impulse:+.2} N·s"),
                _ => String::new(),
            };
            writeln!(out, "{index:8}  {posture}, {active} active{push}")?;
        }
        let more = self.failures.len().saturating_sub(FAILURES_TOLD);
        if more > 0 {
            writeln!(out, "          and {more} more")?;
        }
        Ok(())
    }
}

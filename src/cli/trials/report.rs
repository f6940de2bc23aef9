//! The result of trials, as JSON and as text.

use std::collections::BTreeMap;
use std::io::Write;

use anyhow::Result;
use serde::Serialize;

use crate::cli::json::RunJson;

use super::plan::Plan;
use super::tally::{Activations, Failure, Falls, Tally};

/// So many failures are told in text.
const FAILURES_TOLD: usize = 10;

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    count: u64,
    standing: u64,
    fraction: f64,
    /// Wilson's, of the fraction that stands.
    interval95: [f64; 2],
    fell: u64,
    stepped: u64,
    seed: u64,
    wall_s: f64,
    simulated_s: f64,
    steps_per_s: f64,
    interrupted: bool,
    controllers: BTreeMap<String, Activations>,
    switches_per_minute: f64,
    short_activations: u64,
    falls: FallsReport,
    failures: Vec<Failure>,
}

#[derive(Debug, Serialize)]
struct FallsReport {
    forward: Forward,
    backward: Backward,
    #[serde(flatten)]
    head: Head,
}

/// The head in falls.
#[derive(Debug, Serialize)]
struct Head {
    /// m/s, of all falls; 0 for those in which the head did not touch.
    median_head_impact_speed: Option<f64>,
    /// m/s, of the falls in which the head touched.
    median_head_hit_speed: Option<f64>,
    /// Falls in which the head touched.
    head_hits: u64,
}

#[derive(Debug, Serialize)]
struct Forward {
    count: u64,
    hands_first: u64,
    #[serde(flatten)]
    head: Head,
}

#[derive(Debug, Serialize)]
struct Backward {
    count: u64,
    hands_or_seat_first: u64,
    #[serde(flatten)]
    head: Head,
}

#[derive(Debug, Serialize)]
struct WithRun<'a> {
    #[serde(flatten)]
    report: &'a Report,
    run: RunJson,
}

/// The middle value, or the mean of the two in the middle.
fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let half = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n.is_multiple_of(2) => Some(0.5 * (sorted[half - 1] + sorted[half])),
        _ => Some(sorted[half]),
    }
}

/// The 95 % interval of a share (Wilson 1927); everything if there were no trials.
fn wilson(hits: u64, count: u64) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    if count == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (count as f64, hits as f64 / count as f64);
    let middle = p + Z * Z / (2.0 * n);
    let spread = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + Z * Z / n;
    // Exact at the ends, where rounding would leave the share outside of its interval.
    let low = if hits == 0 { 0.0 } else { middle - spread };
    let high = if hits == count {
        scale
    } else {
        middle + spread
    };
    [low / scale, high / scale]
}

impl Head {
    fn new(falls: u64, hits: &[f64]) -> Self {
        let mut all = hits.to_vec();
        all.resize((falls as usize).max(hits.len()), 0.0);
        Self {
            median_head_impact_speed: median(&all),
            median_head_hit_speed: median(hits),
            head_hits: hits.len() as u64,
        }
    }

    fn text(&self) -> String {
        match (self.median_head_impact_speed, self.median_head_hit_speed) {
            (Some(all), Some(hits)) => format!(
                "head touched in {} at {hits:.2} m/s (median; {all:.2} over all falls)",
                self.head_hits
            ),
            _ => "head never touched".to_owned(),
        }
    }
}

impl FallsReport {
    fn new(forward: &Falls, backward: &Falls) -> Self {
        let hits = [&forward.head_speeds[..], &backward.head_speeds].concat();
        Self {
            forward: Forward {
                count: forward.count,
                hands_first: forward.broken_well,
                head: Head::new(forward.count, &forward.head_speeds),
            },
            backward: Backward {
                count: backward.count,
                hands_or_seat_first: backward.broken_well,
                head: Head::new(backward.count, &backward.head_speeds),
            },
            head: Head::new(forward.count + backward.count, &hits),
        }
    }
}

impl Report {
    /// Of a tally that took `wall_s` s.
    pub(super) fn new(plan: &Plan, mut tally: Tally, wall_s: f64, interrupted: bool) -> Self {
        let count = tally.count();
        let simulated_s = tally.steps as f64 * plan.dt();
        Self {
            count,
            standing: tally.standing,
            fraction: tally.standing as f64 / count.max(1) as f64,
            interval95: wilson(tally.standing, count),
            fell: tally.fell,
            stepped: tally.stepped,
            seed: plan.scenario.seed,
            wall_s,
            simulated_s,
            steps_per_s: tally.steps as f64 / wall_s.max(1e-9),
            interrupted,
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
            None => serde_json::to_writer(&mut *out, self)?,
            Some(run) => serde_json::to_writer(&mut *out, &WithRun { report: self, run })?,
        }
        Ok(writeln!(out)?)
    }

    /// As text.
    pub(super) fn print(&self, out: &mut dyn Write, plan: &Plan) -> Result<()> {
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
        let [low, high] = self.interval95.map(|x| 100.0 * x);
        writeln!(
            out,
            "\nstanding at the end  {} ({:.1} %; 95 % interval {low:.1} to {high:.1} %)",
            self.standing,
            100.0 * self.fraction
        )?;
        writeln!(out, "fell                 {}", self.fell)?;
        writeln!(out, "stepped              {}", self.stepped)?;
        self.print_falls(out)?;
        self.print_controllers(out)?;
        self.print_failures(out)?;
        Ok(writeln!(
            out,
            "\n{:.0} s simulated in {:.1} s: {:.0} steps/s",
            self.simulated_s, self.wall_s, self.steps_per_s
        )?)
    }

    fn print_falls(&self, out: &mut dyn Write) -> Result<()> {
        let FallsReport {
            forward, backward, ..
        } = &self.falls;
        if forward.count + backward.count == 0 {
            return Ok(());
        }
        writeln!(
            out,
            "falls forward        {}: hands first in {}, {}",
            forward.count,
            forward.hands_first,
            forward.head.text()
        )?;
        writeln!(
            out,
            "falls backward       {}: hands or seat first in {}, {}",
            backward.count,
            backward.hands_or_seat_first,
            backward.head.text()
        )?;
        Ok(())
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
            let (index, posture) = (failure.index, failure.posture);
            let push = match (&failure.link, failure.impulse) {
                (Some(link), Some(impulse)) => format!("  {link} {impulse:+.2} N·s"),
                _ => String::new(),
            };
            writeln!(out, "{index:8}  {posture}{push}")?;
        }
        let more = self.failures.len().saturating_sub(FAILURES_TOLD);
        if more > 0 {
            writeln!(out, "          and {more} more")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_gives_the_published_interval() {
        // Newcombe (1998), table I: 81 of 263.
        let [low, high] = wilson(81, 263);
        assert!((low - 0.2553).abs() < 1e-4 && (high - 0.3662).abs() < 1e-4);
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
        assert_eq!((wilson(0, 10)[0], wilson(10, 10)[1]), (0.0, 1.0));
    }

    #[test]
    fn the_median_of_an_even_number_is_the_mean_of_two() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
    }
}

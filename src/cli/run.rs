//! `aplomb run`: one run of a scenario.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::Scenario;
use clap::Args;

use super::arguments::{Json, Record};
use super::json::RunJson;
use super::output::{check_picture, check_writable, message, write_json, write_recording};
use super::scene::{SceneArgs, record};
use super::values::{PushArgument, Timed, TimedCommand, duration};
use super::{Ending, progress, timeline};

/// Run a scenario once
///
/// Simulates a scenario and prints what happened, with times in s, and how it ended. The exit code
/// is 1 if the scenario expects something that did not happen.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb run --push 1:torso:-40 --explain
  aplomb run push --set impulse=25 --render push.svg
  aplomb run --command \"2:balance\" --duration 5 --json")]
pub(super) struct RunArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// How long to simulate, s [default: the scenario's, or 10]
    #[arg(long, value_name = "S", value_parser = duration, allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Pushes the first character at T s with a horizontal impulse in N·s on a link's centre of
    /// mass, + forward, spread over 0.1 s; repeatable
    #[arg(long, value_name = "T:LINK:IMPULSE", allow_hyphen_values = true)]
    push: Vec<PushArgument>,
    /// Gives the first character a command at T s; repeatable
    #[arg(long, value_name = "T:STRING", allow_hyphen_values = true)]
    command: Vec<TimedCommand>,
    #[command(flatten)]
    record: Record,
    /// Draws the run: film strip (.svg, .png) or animation (.gif, .mp4)
    #[arg(long, value_name = "FILE")]
    render: Option<PathBuf>,
    /// Tells who bid what at each switch, and which clause refused
    #[arg(long)]
    explain: bool,
    #[command(flatten)]
    json: Json,
}

impl RunArgs {
    /// What `--json` prints, without recording.
    pub(super) fn measure(&self) -> Result<RunJson> {
        let (scenario, mut simulation) = self.begin()?;
        let begun = Instant::now();
        simulation.run(scenario.duration);
        let wall_s = begun.elapsed().as_secs_f64();
        Ok(RunJson::new(&simulation, &scenario, wall_s, self.explain))
    }

    /// The scenario with all that the options ask for, and its run at its beginning.
    fn begin(&self) -> Result<(Scenario, Simulation)> {
        let registry = aplomb::controllers::registry();
        let mut scenario = self.scene.load(10.0, &registry)?;
        if let Some(duration) = self.duration {
            scenario.duration = duration;
        }
        let mut simulation = Simulation::new(&scenario, &registry)?;
        schedule(&mut simulation, &scenario, &self.push)?;
        schedule(&mut simulation, &scenario, &self.command)?;
        Ok((scenario, simulation))
    }

    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let (scenario, mut simulation) = self.begin()?;
        self.record.file.as_deref().map_or(Ok(()), check_writable)?;
        self.render.as_deref().map_or(Ok(()), check_picture)?;
        if self.record.file.is_some() || self.render.is_some() {
            record(&mut simulation, &scenario)?;
        }

        let begun = Instant::now();
        progress::run(&mut simulation, scenario.duration);
        let wall_s = begun.elapsed().as_secs_f64();

        // Told once the files are written: a reader that leaves early does not lose them.
        let mut told = Vec::new();
        if self.json.wanted {
            let json = RunJson::new(&simulation, &scenario, wall_s, self.explain);
            write_json(&mut told, &json)?;
        } else {
            timeline::print(&mut told, &simulation, &scenario, self.explain)?;
        }
        let unmet = simulation.unmet(&scenario.expect);
        if let Some(recording) = simulation.into_recording() {
            let (record, render) = (self.record.file.as_deref(), self.render.as_deref());
            write_recording(&recording, record, render)?;
        }
        out.write_all(&told)?;
        match unmet {
            None => Ok(Ending::Done),
            Some(unmet) => {
                message(format_args!("expectation not met: {unmet}"));
                Ok(Ending::Unmet)
            }
        }
    }
}

/// Adds what the options ask for to what will happen.
fn schedule(simulation: &mut Simulation, scenario: &Scenario, asked: &[impl Timed]) -> Result<()> {
    for timed in asked {
        let happening = timed.happening();
        let scheduled = simulation.schedule(scenario, &happening);
        scheduled.with_context(|| timed.option())?;
        if timed.at() >= scenario.duration {
            let (option, end) = (timed.option(), scenario.duration);
            message(format_args!("note: {option} is after the end at {end} s"));
        }
    }
    Ok(())
}

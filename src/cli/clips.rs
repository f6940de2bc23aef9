//! `aplomb clips`: what the clips do without and with their reference trajectories.
//!
//! arguments → clips → rollouts → table. The number of threads changes nothing.

use std::collections::BTreeMap;
use std::io::Write;

use anyhow::Result;
use aplomb::training::anticipation::clip::Clip;
use aplomb::training::anticipation::objective::Judged;
use clap::Args;
use serde::Serialize;

use super::arguments::{ClipSettings, Json, Seed};
use super::output::write_json;
use super::scene::set_all;
use super::values::Setting;
use super::{Ending, work};

/// List the clips, and measure them without and with anticipation
///
/// For every clip: its phases in s, and the objective, the 2-norm of the centre of pressure's error
/// and how many of 20 slightly different starts succeed, without a reference trajectory of the centre
/// of mass and with the one that its controller has for its parameters (interpolated between those
/// that were learned).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb clips
  aplomb clips bend --set duration=0.5 --json")]
pub(super) struct ClipsArgs {
    /// Shipped clips (bend for the scenario clips/bend) or scenario files; all shipped ones
    /// if left out
    clips: Vec<String>,
    #[command(flatten)]
    settings: ClipSettings,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    jobs: work::Jobs,
    #[command(flatten)]
    json: Json,
}

/// One clip. Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(super) struct ClipRow {
    clip: String,
    character: String,
    parameters: BTreeMap<String, f64>,
    length: f64,
    preparation: f64,
    task: f64,
    decay: f64,
    flat: Judged,
    /// None without a trajectory.
    learned: Option<Judged>,
}

impl ClipsArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let rows = self.jobs.threads()?.install(|| self.measure())?;
        if self.json.wanted {
            write_json(out, &rows)?;
        } else {
            print(out, &rows)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints; it is measured in the threads of the caller.
    pub(super) fn measure(&self) -> Result<Vec<ClipRow>> {
        let names: Vec<String> = if self.clips.is_empty() {
            aplomb::scenarios::clips().map(str::to_owned).collect()
        } else {
            self.clips.clone()
        };
        let row =
            |name: &String| ClipRow::new(&load(name, &self.settings.set, None)?, self.seed.value);
        names.iter().map(row).collect()
    }
}

/// The clip of this name with parameters set, and which of its motions is optimised.
pub(super) fn load(name: &str, set: &[Setting], motion: Option<usize>) -> Result<Clip> {
    let mut scenario = aplomb::scenarios::load_clip(name)?;
    set_all(&mut scenario, set)?;
    Ok(Clip::new(
        scenario,
        motion,
        &aplomb::controllers::registry(),
    )?)
}

impl ClipRow {
    fn new(clip: &Clip, seed: u64) -> Result<Self> {
        let [preparation, task, decay] = clip.phases();
        let shipped = clip.shipped();
        let learned = shipped.map(|c| Judged::new(clip, Some(&c), seed));
        Ok(Self {
            clip: clip.scenario.name.clone(),
            character: clip.model().name.clone(),
            parameters: clip.parameters(),
            length: clip.length(),
            preparation,
            task,
            decay,
            flat: Judged::new(clip, None, seed)?,
            learned: learned.transpose()?,
        })
    }
}

fn print(out: &mut dyn Write, rows: &[ClipRow]) -> std::io::Result<()> {
    let wide = rows.iter().map(|r| r.clip.len()).max().unwrap_or(0);
    writeln!(
        out,
        "{:wide$}  {:9} {:>17}   {:^28}   {:^28}",
        "", "", "phases (s)", "without", "with"
    )?;
    let columns = format!("{:>9} {:>7} {:>10}", "objective", "CoP", "successes");
    writeln!(
        out,
        "{:wide$}  {:9} {:>5} {:>5} {:>5}   {columns}   {columns}",
        "clip", "character", "prep", "task", "decay"
    )?;
    for r in rows {
        let judged = |j: &Judged| {
            let successes = format!("{}/{}", j.successes, j.starts);
            format!("{:9.3} {:7.3} {successes:>10}", j.objective, j.cop_norm)
        };
        let with = r.learned.as_ref().map_or("–".to_owned(), judged);
        writeln!(
            out,
            "{:wide$}  {:9} {:5.2} {:5.2} {:5.2}   {}   {with}",
            r.clip,
            r.character,
            r.preparation,
            r.task,
            r.decay,
            judged(&r.flat)
        )?;
    }
    Ok(())
}

//! `aplomb robustness`: each skill alone in a grid of worlds.
//!
//! arguments → skills → starts and rollouts in every world → table. The number of threads changes
//! nothing.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::Result;
use aplomb::framework::input::Error;
use aplomb::training::exercise::rising::Goal;
use aplomb::training::exercise::skill::Skill;
use aplomb::training::exercise::{Drill, Exercise, Task};
use aplomb::training::situations::Worlds;
use clap::Args;
use serde::Serialize;

use super::arguments::{Json, Seed};
use super::output::{message, write_json};
use super::scene::CastArgs;
use super::train::skills;
use super::values::whole;
use super::{Ending, progress, work};

/// Friction coefficients of the ground: the rows.
const FRICTIONS: [f64; 4] = [0.6, 0.8, 1.0, 1.2];
/// Torque limits, relative to the character's: the columns.
const TORQUES: [f64; 3] = [0.85, 1.0, 1.15];

/// Measure each skill alone over friction and strength
///
/// For every friction 0.6, 0.8, 1, 1.2 and torque 0.85, 1, 1.15 (relative to the character's): from
/// how many starts a controller, followed by the rest of the repertoire, comes to its goal without
/// any failure. Its file declares both in `exercise`. `Rise` takes over where the repertoire hands
/// over to it, in heaps on the floor and in falls after a push; where that is too rare, the other
/// starts begin as its rollouts for `train preconditions` do. `Step` is pushed instead, and has to
/// stand again within 6 s. `Fall` is pushed over, and has to touch the ground with the hands, or
/// backward with hands or seat, before head and trunk.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb robustness
  aplomb robustness rise_supine rise_prone --starts 50
  aplomb robustness --repertoire mine.ron --json")]
pub(super) struct RobustnessArgs {
    /// Names of controllers of the repertoire; all that declare a goal if left out
    controllers: Vec<String>,
    #[command(flatten)]
    cast: CastArgs,
    /// Number of starts in every world
    #[arg(long, value_name = "N", default_value = "200",
          value_parser = whole(1, 10_000), allow_negative_numbers = true)]
    starts: u64,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    jobs: work::Jobs,
    #[command(flatten)]
    json: Json,
}

/// One world.
#[derive(Debug, Clone, Copy, Serialize)]
struct Cell {
    friction: f64,
    torque: f64,
    /// As asked for, or fewer where the repertoire seldom hands over to the controller.
    starts: usize,
    /// Of these, how many begin as the controller's own rollouts do, not in a heap or a fall.
    own_starts: usize,
    reached: usize,
    /// None without starts.
    fraction: Option<f64>,
}

/// One controller.
#[derive(Debug, Serialize)]
struct RobustnessRow {
    controller: String,
    kind: String,
    goal: String,
    cells: Vec<Cell>,
    /// The cell with the smallest fraction.
    least: Option<Cell>,
}

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(super) struct RobustnessReport {
    starts: u64,
    seed: u64,
    wall_s: f64,
    interrupted: bool,
    controllers: Vec<RobustnessRow>,
}

impl RobustnessArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let stop = work::stop_on_interrupt()?;
        let report = self.jobs.threads()?.install(|| self.measure(&stop))?;
        if report.interrupted {
            message(format_args!("interrupted: the table is not complete"));
        }
        if self.json.wanted {
            write_json(out, &report)?;
        } else {
            print(out, &report)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints; it is measured in the threads of the caller.
    pub(super) fn measure(&self, stop: &AtomicBool) -> Result<RobustnessReport> {
        let all = skills(&self.cast)?;
        let chosen = self.choose(&all)?;
        let begun = Instant::now();
        let controllers = self.rows(&chosen, stop)?;
        Ok(RobustnessReport {
            starts: self.starts,
            seed: self.seed.value,
            wall_s: begun.elapsed().as_secs_f64(),
            interrupted: stop.load(Ordering::Relaxed),
            controllers,
        })
    }

    /// The controllers that were asked for, or all that there is something to measure of.
    fn choose<'a>(&self, all: &'a [Skill]) -> Result<Vec<(&'a Skill, Task)>> {
        let task = |skill: &'a Skill| match Task::of(skill)? {
            Task::Stand { .. } => {
                let accepted = "Rise, Step or Fall: what withstands pushes alone has no starts";
                let refusal = Error::invalid(skill.name(), "exercise", "Stand", accepted);
                Err(anyhow::Error::from(refusal))
            }
            task => Ok((skill, task)),
        };
        if self.controllers.is_empty() {
            return Ok(all.iter().filter_map(|s| task(s).ok()).collect());
        }
        let named = |name: &String| task(Skill::find(all, name)?);
        self.controllers.iter().map(named).collect()
    }

    /// A row for each, without the worlds that were not finished.
    fn rows(&self, chosen: &[(&Skill, Task)], stop: &AtomicBool) -> Result<Vec<RobustnessRow>> {
        let skills: Vec<&Skill> = chosen.iter().map(|(skill, _)| *skill).collect();
        let row = |(skill, task): &(&Skill, Task)| RobustnessRow {
            controller: skill.name().to_owned(),
            kind: skill.kind().to_owned(),
            goal: goal(task),
            cells: Vec::with_capacity(FRICTIONS.len() * TORQUES.len()),
            least: None,
        };
        let mut rows: Vec<RobustnessRow> = chosen.iter().map(row).collect();
        // The starts of a world, and as many rollouts from them.
        let world = 2 * skills.len() as u64 * self.starts;
        let bar = progress::bar(grid().count() as u64 * world, "starts and rollouts");
        for (done, (friction, torque)) in grid().enumerate() {
            let before = done as u64 * world;
            bar.set_message(format!("; friction {friction}, torque {torque}"));
            let drill = Drill::cell(
                Worlds::single(friction, torque),
                self.starts as usize,
                self.seed.value,
            );
            let exercises = Exercise::all(&skills, drill, |found| {
                bar.set_position(before + found as u64);
                work::going_on(stop)
            })?;
            if stop.load(Ordering::Relaxed) {
                break;
            }
            bar.set_position(before + world / 2);
            for ((row, exercise), skill) in rows.iter_mut().zip(exercises).zip(&skills) {
                let (starts, reached) =
                    (exercise.starts(), exercise.judge(&skill.supervisor).reached);
                row.cells.push(Cell {
                    friction,
                    torque,
                    starts,
                    own_starts: exercise.own_starts(),
                    reached,
                    fraction: (starts > 0).then(|| reached as f64 / starts as f64),
                });
                bar.inc(self.starts);
            }
        }
        bar.finish_and_clear();
        rows.retain(|row| !row.cells.is_empty());
        for row in &mut rows {
            row.least = least(&row.cells);
        }
        Ok(rows)
    }
}

fn grid() -> impl Iterator<Item = (f64, f64)> {
    FRICTIONS
        .into_iter()
        .flat_map(|friction| TORQUES.into_iter().map(move |torque| (friction, torque)))
}

/// The first of those with the smallest fraction.
fn least(cells: &[Cell]) -> Option<Cell> {
    let known = cells.iter().filter_map(|c| Some((c.fraction?, *c)));
    let least = known.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, cell)| cell)
}

fn goal(task: &Task) -> String {
    match task {
        Task::Stand { .. } => "standing".to_owned(),
        Task::Step { .. } => "standing after a push".to_owned(),
        Task::Fall { .. } => "hands or seat first".to_owned(),
        Task::Rise {
            goal: Goal::Stand, ..
        } => "standing".to_owned(),
        Task::Rise { .. } => "its post-condition".to_owned(),
    }
}

fn print(out: &mut dyn Write, report: &RobustnessReport) -> std::io::Result<()> {
    let RobustnessReport { starts, seed, .. } = report;
    writeln!(out, "{starts} starts in every world, seed {seed}")?;
    for row in &report.controllers {
        writeln!(out, "\n{}, to {}", row.controller, row.goal)?;
        write!(out, "friction")?;
        for torque in TORQUES {
            write!(out, "{:>18}", format!("torque {torque:.2}"))?;
        }
        for line in row.cells.chunks(TORQUES.len()) {
            write!(out, "\n{:8.1}", line[0].friction)?;
            for cell in line {
                write!(out, "{:>18}", told(cell))?;
            }
        }
        match row.least {
            Some(cell) => writeln!(
                out,
                "\nleast: {} of {} at friction {}, torque {}",
                told(&cell),
                cell.starts,
                cell.friction,
                cell.torque
            )?,
            None => writeln!(out, "\nthe repertoire never hands over to it")?,
        }
        let own: usize = row.cells.iter().map(|c| c.own_starts).sum();
        if own > 0 {
            let all: usize = row.cells.iter().map(|c| c.starts).sum();
            writeln!(out, "{own} of {all} starts begin as its rollouts do")?;
        }
    }
    writeln!(out, "\n{:.1} s", report.wall_s)
}

/// `97.5 % (195)`.
fn told(cell: &Cell) -> String {
    cell.fraction.map_or("no starts".to_owned(), |f| {
        format!("{:.1} % ({})", 100.0 * f, cell.reached)
    })
}

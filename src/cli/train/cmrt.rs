//! `aplomb train cmrt`: the centre-of-mass reference trajectory of a clip.
//!
//! arguments → clip → search → controller file with the trajectory, and journal. The number of threads
//! changes nothing.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context, Result};
use aplomb::framework::input::write_atomically;
use aplomb::training::anticipation::basis::Basis;
use aplomb::training::anticipation::clip::Clip;
use aplomb::training::anticipation::encoding::Encoding;
use aplomb::training::anticipation::objective::Judged;
use aplomb::training::anticipation::search::{FoundTrajectory, Keep, TrajectoryPlan, search};
use aplomb::training::search::journal;
use clap::Args;
use cpu_time::ProcessTime;
use serde::Serialize;

use super::figures::Figures;
use crate::cli::arguments::{ClipSettings, Json, Resume, Seed};
use crate::cli::output::{check_writable, message, write_json};
use crate::cli::values::{Setting, number, whole};
use crate::cli::{Ending, clips, progress, work};

/// Learn to anticipate a task: the centre-of-mass reference trajectory of a clip
///
/// CMA-ES over the knots and control points of the reference's horizontal displacement. The objective
/// is the 2-norm of the centre of pressure's distance from the middle of the base of support, with
/// what is charged for poses that are missed, for expectations of the clip that are not met and for
/// falling. A clip succeeds if it does from at least 18 of 20 starts that differ by up to 0.5° and
/// 2 mm/s. A search ends when 100 evaluations bring less than 5 %, but not before 700.
///
/// The output is the clip's controller with the trajectory in it; beside it is a journal with which
/// --resume goes on, also after the program was killed. Ctrl-C ends the search after the running
/// generation and keeps the best so far.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb train cmrt bend --figures figures
  aplomb train cmrt push --set mass=110 --out push.ron
  aplomb train cmrt push --set mass=110 --basis push.basis.ron --json")]
pub(in crate::cli) struct CmrtArgs {
    /// A shipped clip (bend for the scenario clips/bend) or a scenario file
    clip: String,
    #[command(flatten)]
    search: SearchArgs,
    /// Searches in the space of a basis (see `train basis`) instead of all knots and control points
    #[arg(long, value_name = "FILE")]
    basis: Option<PathBuf>,
    /// Begins with the trajectory that the clip's controller has, instead of none
    #[arg(long)]
    warm: bool,
    /// The controller file that is written [default: CLIP.ron]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draws figures into this folder, as SVG: the centre of pressure without and with the trajectory, the
    /// trajectory, the search's convergence, a film strip of either run
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    #[command(flatten)]
    resume: Resume,
    #[command(flatten)]
    json: Json,
}

/// What searches for trajectories have in common.
#[derive(Debug, Args)]
pub(super) struct SearchArgs {
    #[command(flatten)]
    pub(super) settings: ClipSettings,
    /// Place of the motion that is optimised, where the clip has several in a row; those after it do
    /// not count
    #[arg(long, value_name = "N", default_value = "0",
          value_parser = whole(0, 15), allow_negative_numbers = true)]
    pub(super) motion: u64,
    /// Number of knots and of control points
    #[arg(long, value_name = "4|8", default_value = "4",
          value_parser = whole(1, 8), allow_negative_numbers = true)]
    pub(super) knots: u64,
    /// Ends with the generation that reaches N evaluations
    #[arg(long, value_name = "N", default_value = "3000",
          value_parser = whole(1, 1_000_000), allow_negative_numbers = true)]
    pub(super) evaluations: u64,
    /// Evaluations before slow convergence may end the search
    #[arg(long, value_name = "N", default_value = "700",
          value_parser = whole(1, 1_000_000), allow_negative_numbers = true)]
    pub(super) least: u64,
    /// Number of slightly different starts that the objective is averaged over, beside the clip's own
    #[arg(long, value_name = "N", default_value = "1",
          value_parser = whole(0, 100), allow_negative_numbers = true)]
    pub(super) starts: u64,
    /// Ends the search when the objective is below this
    #[arg(long, value_name = "X", default_value = "0",
          value_parser = number(0.0, 1e6, ""), allow_negative_numbers = true)]
    pub(super) threshold: f64,
    #[command(flatten)]
    pub(super) seed: Seed,
    #[command(flatten)]
    pub(super) jobs: work::Jobs,
}

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(in crate::cli) struct CmrtReport {
    clip: String,
    parameters: BTreeMap<String, f64>,
    seed: u64,
    knots: usize,
    dimensions: usize,
    /// Perturbed starts that the objective was averaged over.
    starts: usize,
    evaluations: usize,
    wall_s: f64,
    cpu_s: f64,
    interrupted: bool,
    flat: Judged,
    optimised: Judged,
    times: Vec<f64>,
    displacements: Vec<f64>,
    /// (evaluations, best objective so far)
    course: Vec<(usize, f64)>,
    out: String,
}

impl CmrtArgs {
    pub(in crate::cli) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let stop = work::stop_on_interrupt()?;
        let threads = self.search.jobs.threads()?;
        let report = threads.install(|| self.measure(&stop))?;
        if report.interrupted {
            let n = report.evaluations;
            message(format_args!(
                "interrupted after {n} evaluations; --resume goes on"
            ));
        }
        if self.json.wanted {
            write_json(out, &report)?;
        } else {
            print(out, &report)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints; it is searched in the threads of the caller, and all files are written.
    pub(in crate::cli) fn measure(&self, stop: &AtomicBool) -> Result<CmrtReport> {
        let clip = self.search.clip(&self.clip)?;
        let file = self.out.clone();
        let file = file.unwrap_or_else(|| PathBuf::from(format!("{}.ron", clip.contract().name)));
        let journal = journal::beside(&file);
        check_writable(&file)?;
        check_writable(&journal)?;
        let figures = self.figures.as_deref();
        let figures = figures.map(|f| Figures::of_clip(f, &clip)).transpose()?;
        let encoding = match &self.basis {
            None => self.search.encoding(&clip),
            Some(path) => Encoding::Reduced {
                basis: Basis::read(path).context("--basis")?,
                length: clip.length(),
            },
        };
        let plan = TrajectoryPlan {
            start: clip.shipped().filter(|_| self.warm),
            ..self.search.plan(encoding)
        };
        let (begun, cpu) = (Instant::now(), ProcessTime::now());
        let keep = Keep {
            journal: &journal,
            resume: self.resume.wanted,
        };
        let seed = self.search.seed.value;
        let flat = Judged::new(&clip, None, seed)?;
        let found = shown(&clip, &plan, keep, stop)?;
        let optimised = Judged::new(&clip, Some(&found.cmrt), seed)?;
        let report = CmrtReport {
            clip: clip.scenario.name.clone(),
            parameters: clip.parameters(),
            seed,
            knots: found.cmrt.times.len(),
            dimensions: plan.encoding.dimensions(),
            starts: plan.starts,
            evaluations: found.evaluations,
            wall_s: begun.elapsed().as_secs_f64(),
            cpu_s: cpu.elapsed().as_secs_f64(),
            interrupted: work::going_on(stop).is_break(),
            flat,
            optimised,
            times: found.cmrt.times.clone(),
            displacements: found.cmrt.displacements.clone(),
            course: found.course.clone(),
            out: file.display().to_string(),
        };
        let text = clip.text(&found.cmrt, &comment(&report));
        write_atomically(&file, text.as_bytes())?;
        if let Some(figures) = figures {
            figures.found(&clip, &found, &report.flat, &report.optimised)?;
        }
        Ok(report)
    }
}

impl SearchArgs {
    /// The clip of this name with the parameters that were asked for.
    pub(super) fn clip(&self, name: &str) -> Result<Clip> {
        self.clip_with(name, &[])
    }

    /// The same with further parameters.
    pub(super) fn clip_with(&self, name: &str, further: &[Setting]) -> Result<Clip> {
        let all: Vec<Setting> = self.settings.set.iter().chain(further).cloned().collect();
        clips::load(name, &all, Some(self.motion as usize))
    }

    /// All knots and control points.
    pub(super) fn encoding(&self, clip: &Clip) -> Encoding {
        Encoding::full(self.knots as usize, clip.length(), clip.model())
    }

    /// A search from the middle of the cube.
    pub(super) fn plan(&self, encoding: Encoding) -> TrajectoryPlan {
        TrajectoryPlan {
            encoding,
            evaluations: self.evaluations as usize,
            least: self.least as usize,
            threshold: self.threshold,
            starts: self.starts as usize,
            seed: self.seed.value,
            start: None,
        }
    }
}

/// A search under a bar.
pub(super) fn shown(
    clip: &Clip,
    plan: &TrajectoryPlan,
    keep: Keep<'_>,
    stop: &AtomicBool,
) -> Result<FoundTrajectory> {
    let bar = progress::bar(plan.evaluations as u64, "evaluations");
    let found = search(clip, plan, keep, |found| {
        bar.set_position((found.evaluations as u64).min(plan.evaluations as u64));
        bar.set_message(format!("; objective {:.4}", found.objective));
        work::going_on(stop)
    });
    bar.finish_and_clear();
    Ok(found?)
}

fn comment(r: &CmrtReport) -> String {
    let parameters: Vec<String> = r
        .parameters
        .iter()
        .map(|(k, v)| format!("{k} = {v}"))
        .collect();
    format!(
        "The trajectory{} was found by CMA-ES in {} dimensions, seed {}, {} evaluations.",
        if parameters.is_empty() {
            String::new()
        } else {
            format!(" for {}", parameters.join(", "))
        },
        r.dimensions,
        r.seed,
        r.evaluations,
    )
}

fn print(out: &mut dyn Write, r: &CmrtReport) -> std::io::Result<()> {
    let CmrtReport {
        clip,
        evaluations,
        seed,
        ..
    } = r;
    writeln!(
        out,
        "{clip}: {evaluations} evaluations, seed {seed}, {:.1} s ({:.1} s of processor)",
        r.wall_s, r.cpu_s
    )?;
    let line = |j: &Judged| {
        format!(
            "objective {:8.3}  centre of pressure {:6.3}  pose {:5.3} rad  {:2} of {} starts succeed",
            j.objective, j.cop_norm, j.tracking, j.successes, j.starts
        )
    };
    writeln!(out, "without     {}", line(&r.flat))?;
    writeln!(out, "with        {}", line(&r.optimised))?;
    let points = r.times.iter().zip(&r.displacements);
    let points: Vec<String> = points.map(|(t, d)| format!("{t:.3} s {d:+.3} m")).collect();
    writeln!(out, "trajectory  {}", points.join(", "))?;
    writeln!(out, "written to  {}", Path::new(&r.out).display())
}

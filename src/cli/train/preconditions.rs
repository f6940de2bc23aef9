//! `aplomb train preconditions`: rollouts, datasets, learned boundaries.
//!
//! arguments → controllers → training and test set → boundary, report. The number of threads changes
//! nothing.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use aplomb::framework::control::Boundary;
use aplomb::framework::input::{Source, write_atomically};
use aplomb::training::exercise::skill::Skill;
use aplomb::training::preconditions::boundary::boundary;
use aplomb::training::preconditions::learning::learn::{LearnSettings, Stage, Subject, learn};
use aplomb::training::preconditions::learning::machine::Kernel;
use aplomb::training::preconditions::report::Report;
use aplomb::training::preconditions::rollout::Trial;
use aplomb::training::preconditions::set::{Files, Gathered, SetPart, SetPlan, gather, header};
use aplomb::training::situations::disturbance;
use aplomb::training::situations::disturbance::Disturbance;
use clap::Args;
use rayon::ThreadPool;
use serde::Serialize;

use super::skills;
use crate::cli::arguments::{Json, Seed};
use crate::cli::output::{message, write_json};
use crate::cli::scene::CastArgs;
use crate::cli::values::whole;
use crate::cli::{Ending, progress, work};

/// Learn where controllers can take over, from rollouts
///
/// From a nominal start a random disturbance (a force on a link, strayed targets of the servos, or
/// the repertoire itself at work) brings the character to some state; there its features are
/// recorded and the controller takes over alone. The label is whether it reaches its post-condition
/// in time, or, if it has none, stands for the last second. A support vector machine then learns the
/// boundary between successes and failures, its kernel and constants chosen by cross-validation on
/// the training set; another set, of other random streams, judges it beside the nearest neighbour
/// and the hand-made pre-condition.
///
/// `rise` stands for every controller whose name begins with `rise_` and for which a disturbance is
/// shipped. Writes CONTROLLER.train.csv and CONTROLLER.test.csv with a header file beside each,
/// CONTROLLER.boundary.ron and CONTROLLER.report.json. Ctrl-C ends the work after the running
/// rollouts; --resume goes on, also after the program was killed, to the same files.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb train preconditions balance --samples 10000 --test 5000 --seed 1 --out learned
  aplomb train preconditions balance protective_step fall roll rise --out learned --resume
  aplomb train preconditions nod --repertoire mine.ron --disturbance nod.disturbance.ron
  aplomb compare learned")]
pub(in crate::cli) struct PreconditionsArgs {
    /// Names of controllers of the repertoire, or the beginning of some, such as rise
    #[arg(required = true, value_name = "CONTROLLER")]
    controllers: Vec<String>,
    #[command(flatten)]
    cast: CastArgs,
    /// Size of the training set
    #[arg(long, value_name = "N", default_value = "5000",
          value_parser = whole(10, 1_000_000), allow_negative_numbers = true)]
    samples: u64,
    /// Size of the test set
    #[arg(long, value_name = "N", default_value = "2000",
          value_parser = whole(10, 1_000_000), allow_negative_numbers = true)]
    test: u64,
    /// linear, poly2, poly3, rbf, or auto, which chooses by cross-validation
    #[arg(long, value_name = "KERNEL", default_value = "auto", value_parser = kernels)]
    kernel: Kernels,
    /// Sizes of smaller training sets, to report accuracy against size: 500,1000,2000
    #[arg(long, value_name = "N,N", value_delimiter = ',',
          value_parser = whole(10, 1_000_000))]
    curve: Vec<u64>,
    /// Distribution of starts and disturbances [default: the shipped one of the controller]
    #[arg(long, value_name = "FILE")]
    disturbance: Option<PathBuf>,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    jobs: work::Jobs,
    /// Folder that is written to
    #[arg(long, value_name = "DIR", default_value = "out/preconditions")]
    out: PathBuf,
    /// Goes on with what is in the folder
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    json: Json,
}

/// Kernels to choose from.
#[derive(Debug, Clone)]
struct Kernels(Vec<Kernel>);

fn kernels(text: &str) -> Result<Kernels, String> {
    Kernel::allowed(text)
        .map(Kernels)
        .map_err(|e| e.to_string())
}

/// What was done for a controller.
#[derive(Debug, Serialize)]
pub(in crate::cli) struct PreconditionRow {
    #[serde(flatten)]
    report: Report,
    /// Rollouts of this run; the others were found.
    rollouts: usize,
    /// s that they took.
    rollouts_s: f64,
    rollouts_per_s: Option<f64>,
    boundary: String,
}

impl PreconditionsArgs {
    pub(in crate::cli) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let stop = work::stop_on_interrupt()?;
        let threads = self.jobs.threads()?;
        let tell = |row: &PreconditionRow| {
            if !self.json.wanted {
                print(out, row)?;
                out.flush()?;
            }
            anyhow::Ok(())
        };
        let rows = self.rows(Some(&threads), &stop, tell)?;
        if self.json.wanted {
            write_json(out, &rows)?;
        }
        Ok(Ending::Done)
    }

    /// What `--json` prints; the work is done in the threads of the caller.
    pub(in crate::cli) fn measure(&self, stop: &AtomicBool) -> Result<Vec<PreconditionRow>> {
        self.rows(None, stop, |_| Ok(()))
    }

    /// A row for each controller, in these threads or those of the caller; `tell` sees each at once.
    fn rows(
        &self,
        threads: Option<&ThreadPool>,
        stop: &AtomicBool,
        mut tell: impl FnMut(&PreconditionRow) -> Result<()>,
    ) -> Result<Vec<PreconditionRow>> {
        let skills = skills(&self.cast)?;
        let chosen = chosen(&skills, &self.controllers, self.disturbance.is_some())?;
        if self.disturbance.is_some() && chosen.len() != 1 {
            bail!(
                "--disturbance is for a single controller, not for {}",
                chosen.len()
            );
        }
        let registry = aplomb::controllers::registry();
        let mut trials = Vec::with_capacity(chosen.len());
        for skill in chosen {
            let source = match &self.disturbance {
                Some(path) => Source::read(path)?,
                None => disturbance::shipped(skill.name())?,
            };
            let disturbance = Disturbance::parse(&source, &skill.model)?;
            trials.push((skill, Trial::new(skill, disturbance, &registry)?, source));
        }
        fs::create_dir_all(&self.out)
            .with_context(|| format!("{} cannot be made", self.out.display()))?;
        let mut rows = Vec::with_capacity(trials.len());
        for (skill, trial, source) in &trials {
            let work = || self.learn(skill, trial, source, stop);
            let done = threads.map_or_else(work, |t| t.install(work))?;
            let Some(row) = done else {
                message(format_args!("interrupted; --resume goes on"));
                break;
            };
            tell(&row)?;
            rows.push(row);
        }
        Ok(rows)
    }

    /// Everything for one controller; none if it was interrupted.
    fn learn(
        &self,
        skill: &Skill,
        trial: &Trial,
        source: &Source,
        stop: &AtomicBool,
    ) -> Result<Option<PreconditionRow>> {
        let begun = Instant::now();
        let gather = |part| self.gather(skill, trial, source, part, stop);
        let Some(train) = gather(SetPart::Train)? else {
            return Ok(None);
        };
        let Some(test) = gather(SetPart::Test)? else {
            return Ok(None);
        };
        let rollouts_s = begun.elapsed().as_secs_f64();
        let subject = Subject {
            controller: skill.name(),
            character: &skill.model.name,
            seed: self.seed.value,
        };
        let settings = LearnSettings {
            kernels: self.kernel.0.clone(),
            curve_sizes: self.curve.iter().map(|n| *n as usize).collect(),
        };
        let bar = progress::bar(1, "steps");
        let learned = learn(
            subject,
            &train.data,
            &test.data,
            &test.manual,
            &settings,
            |at| {
                bar.set_length(at.of as u64);
                bar.set_position(at.done as u64);
                bar.set_message(match at.stage {
                    Stage::Choice => "; choosing kernel, C and gamma",
                    Stage::Training => "; training",
                    Stage::Testing => "; testing",
                    Stage::Curve => "; training on parts",
                });
                work::going_on(stop)
            },
        );
        bar.finish_and_clear();
        let Some((learned, report)) = learned? else {
            return Ok(None);
        };
        let digest = skill.model.digest();
        let boundary = boundary(&learned, &report, &digest)?;
        let path = self.out.join(format!("{}.boundary.ron", skill.name()));
        write_boundary(&boundary, &path)?;
        let json = serde_json::to_vec_pretty(&report)?;
        let beside = self.out.join(format!("{}.report.json", skill.name()));
        write_atomically(&beside, &json)?;
        let rollouts = train.fresh + test.fresh;
        Ok(Some(PreconditionRow {
            report,
            rollouts,
            rollouts_s,
            rollouts_per_s: (rollouts > 0).then(|| rollouts as f64 / rollouts_s),
            boundary: path.display().to_string(),
        }))
    }

    fn gather(
        &self,
        skill: &Skill,
        trial: &Trial,
        source: &Source,
        part: SetPart,
        stop: &AtomicBool,
    ) -> Result<Option<Gathered>> {
        let count = match part {
            SetPart::Train => self.samples,
            SetPart::Test => self.test,
        };
        let plan = SetPlan {
            trial,
            header: header(skill, source, part, self.seed.value, count as usize),
            files: Files::of(&self.out, skill.name(), part),
            resume: self.resume,
        };
        let bar = progress::bar(count, "rollouts");
        let begun = Instant::now();
        let mut found = None;
        let set = gather(&plan, |n| {
            bar.set_position(n as u64);
            let fresh = n - *found.get_or_insert(n);
            let rate = fresh as f64 / begun.elapsed().as_secs_f64().max(1e-3);
            let name = skill.name();
            bar.set_message(format!("; {name}, to {}, {rate:.0} a second", part.name()));
            work::going_on(stop)
        });
        bar.finish_and_clear();
        if self.resume {
            set.context("--resume")
        } else {
            Ok(set?)
        }
    }
}

/// The controllers that are asked for, in the order of the asking, none twice.
fn chosen<'a>(skills: &'a [Skill], names: &[String], own: bool) -> Result<Vec<&'a Skill>> {
    let mut all: Vec<&Skill> = Vec::new();
    for name in names {
        let family = format!("{name}_");
        let is_whole = skills.iter().any(|s| s.name() == name);
        let of_family = |s: &&Skill| {
            s.name().starts_with(&family) && (own || disturbance::is_shipped(s.name()))
        };
        let members: Vec<&Skill> = if is_whole {
            vec![Skill::find(skills, name)?]
        } else {
            skills.iter().filter(of_family).collect()
        };
        if members.is_empty() {
            Skill::find(skills, name)?;
        }
        for skill in members {
            if all.iter().all(|s| s.name() != skill.name()) {
                all.push(skill);
            }
        }
    }
    Ok(all)
}

fn write_boundary(boundary: &Boundary, path: &Path) -> Result<()> {
    let style = ron::ser::PrettyConfig::default().compact_arrays(true);
    let text = ron::ser::to_string_pretty(boundary, style)?;
    let note = "// Learned by `aplomb train preconditions`.\n";
    Ok(write_atomically(
        path,
        format!("{note}{text}\n").as_bytes(),
    )?)
}

fn print(out: &mut dyn Write, row: &PreconditionRow) -> std::io::Result<()> {
    let r = &row.report;
    let percent = |x: f64| format!("{:.1} %", 100.0 * x);
    writeln!(
        out,
        "{}: {} samples, {} successes; {} to test with, {}",
        r.controller,
        r.train,
        percent(r.positive_rate),
        r.test,
        percent(r.test_positive_rate)
    )?;
    if let Some(rate) = row.rollouts_per_s {
        writeln!(
            out,
            "  rollouts  {} in {:.1} s, {rate:.1} a second",
            row.rollouts, row.rollouts_s
        )?;
    }
    let line = |name: &str, m: &aplomb::training::preconditions::report::Metrics| {
        format!(
            "  {name:9} {} right, {} balanced",
            percent(m.accuracy),
            percent(m.balanced_accuracy)
        )
    };
    let svm = &r.svm;
    writeln!(
        out,
        "{}  ({}, C {}, gamma {:.3}, {} support vectors, {:.1} s, {:.2} µs a query)",
        line("svm", &svm.metrics),
        svm.kernel,
        svm.c,
        svm.gamma,
        svm.support_vectors,
        svm.train_s + svm.choice_s,
        svm.query_us
    )?;
    writeln!(out, "{}", line("nearest", &r.nn.metrics))?;
    writeln!(out, "{}", line("by hand", &r.manual))?;
    writeln!(out, "  majority  {} right", percent(r.majority))?;
    writeln!(out, "  written to {}", row.boundary)
}

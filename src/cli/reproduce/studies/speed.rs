//! Simulated seconds per second of processor, beside MuJoCo's on the same body.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::atomic::AtomicBool;

use anyhow::{Context, Result, ensure};
use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use serde::{Deserialize, Serialize};
use serde_json::to_value;
use tempfile::TempDir;

use crate::cli::reproduce::command;
use crate::cli::reproduce::page::{Page, decimals};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;
use crate::cli::statistics::{median, sorted};

pub(super) const STUDY: Study = Study {
    name: "speed",
    about: "simulated seconds per second of processor, as a ratio to MuJoCo's bare step",
    takes: ["10 s", "30 s"],
    run,
};

const SCRIPT: &str = include_str!("../../../../training/scripts/speed/bare_steps.py");
const MODEL: &str = include_str!("../../../../training/scripts/speed/humanoid.xml");

/// One repeat of both, simulated s per CPU s.
#[derive(Debug, Serialize, Deserialize)]
struct Pair {
    ours: f64,
    mujoco: f64,
}

#[derive(Debug, Serialize, Deserialize)]
struct Speeds {
    version: String,
    pairs: Vec<Pair>,
}

/// The script's first line.
#[derive(Debug, Deserialize)]
struct Ready {
    version: String,
    dt: f64,
}

/// The script that times MuJoCo's steps, waiting for requests.
#[derive(Debug)]
struct Rival {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    ready: Ready,
    _files: TempDir,
}

impl Rival {
    /// None where Python or its `mujoco` is missing.
    fn start() -> Result<Option<Self>> {
        let files = tempfile::tempdir()?;
        let path = |name: &str| files.path().join(name);
        std::fs::write(path("bare_steps.py"), SCRIPT)?;
        std::fs::write(path("humanoid.xml"), MODEL)?;
        let mut python = Command::new("python3");
        python.arg(path("bare_steps.py")).arg(path("humanoid.xml"));
        python.stdin(Stdio::piped()).stdout(Stdio::piped());
        let Ok(mut child) = python.stderr(Stdio::null()).spawn() else {
            return Ok(None);
        };
        let requests = child.stdin.take().context("no pipe to python3")?;
        let mut answers = BufReader::new(child.stdout.take().context("no pipe from python3")?);
        let mut line = String::new();
        answers.read_line(&mut line)?;
        let Ok(ready) = serde_json::from_str(&line) else {
            child.wait()?;
            return Ok(None);
        };
        Ok(Some(Self {
            child,
            requests,
            answers,
            ready,
            _files: files,
        }))
    }

    /// Simulated s per CPU s over so many steps.
    fn repeat(&mut self, steps: u32) -> Result<f64> {
        writeln!(self.requests, "{steps}")?;
        self.requests.flush()?;
        let mut line = String::new();
        self.answers.read_line(&mut line)?;
        let took: f64 = line.trim().parse().context("bare_steps.py has ended")?;
        Ok(f64::from(steps) * self.ready.dt / took)
    }
}

impl Drop for Rival {
    fn drop(&mut self) {
        // It may have ended by itself.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// Simulated s per CPU s of trials in one thread.
fn ours(line: &str, stop: &AtomicBool) -> Result<f64> {
    let one = ThreadPoolBuilder::new().num_threads(1).build()?;
    let begun = ProcessTime::now();
    let trials = one.install(|| command::value(line, stop))?;
    let took = begun.elapsed().as_secs_f64();
    let simulated = trials["simulated_s"].as_f64().unwrap_or(0.0);
    ensure!(simulated > 0.0 && took > 0.0, "nothing was simulated");
    Ok(simulated / took)
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Speed",
        "The humanoid in `aplomb trials`, with engine, sensing, supervisor and controllers, in one thread, against
         MuJoCo's bare step on the same planar body, standing under position servos: both with steps of 1 ms, in s
         simulated per s of CPU time. The two alternate, repeat by repeat, since machines change their speed within
         minutes; the median of the ratios is what to read, not the speeds. The work is not the same: ours has
         control and pushes and falls, MuJoCo's another contact model and nothing around the step. The processes
         are not pinned to a core.",
    );
    let seed = work.settings.seed;
    let (repeats, count, steps) = work.size((3, 4, 10_000), (9, 8, 25_000));
    let line = format!(
        "aplomb trials --count {count} --max-impulse 80 --duration 5 --seed {seed} --jobs 1"
    );
    let part = format!("{line} ({repeats} times, in turn with {steps} bare steps of MuJoCo)");
    let mut rival = None;
    if work.kept.part(&part).is_none() {
        rival = Rival::start()?;
        if rival.is_none() {
            page.paragraph(
                "**Skipped**: Python's `mujoco` is missing here. `pip install mujoco numpy`, then run this again.",
            );
            return Ok(page);
        }
    }
    let speeds: Speeds = work.part(&part, |stop| {
        let mut rival = rival.context("MuJoCo is not running")?;
        let mut pairs = Vec::with_capacity(repeats);
        for _ in 0..repeats {
            pairs.push(Pair {
                ours: ours(&line, stop)?,
                mujoco: rival.repeat(steps)?,
            });
        }
        let version = rival.ready.version.clone();
        Ok(to_value(Speeds { version, pairs })?)
    })?;
    let ratios: Vec<f64> = speeds.pairs.iter().map(|p| p.ours / p.mujoco).collect();
    let of = |value: fn(&Pair) -> f64| speeds.pairs.iter().map(value).collect::<Vec<f64>>();
    let ratio = decimals(median(&ratios), 2);
    let row = |name: String, values: &[f64], digits: usize| {
        let all = sorted(values);
        let ends = [all.first(), all.last()].map(|x| decimals(x.copied(), digits));
        [vec![name, decimals(median(values), digits)], ends.to_vec()].concat()
    };
    page.table(
        &["simulated s per CPU s", "median", "least", "most"],
        &[
            row("aplomb".to_owned(), &of(|p| p.ours), 1),
            row(format!("MuJoCo {}", speeds.version), &of(|p| p.mujoco), 1),
            row("**ratio**".to_owned(), &ratios, 2),
        ],
    );
    page.paragraph(&format!(
        "The ratio is of {repeats} repeats; above 1 aplomb is faster."
    ));
    page.highlight(
        "Speed with control against MuJoCo's bare step (above 1 is faster)",
        ratio,
    );
    Ok(page)
}

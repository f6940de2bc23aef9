//! The clips without and with the reference trajectories that were learned for them.

use anyhow::Result;
use serde::Deserialize;

use crate::cli::reproduce::page::{Page, decimals};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;

pub(super) const STUDY: Study = Study {
    name: "clips",
    about: "tasks without and with their learned trajectories of the centre of mass, from 20 starts",
    takes: ["10 s", "2 minutes"],
    run,
};

/// What `aplomb clips --json` tells of a clip.
#[derive(Debug, Deserialize)]
pub(super) struct ClipFigures {
    clip: String,
    character: String,
    flat: JudgedFigures,
    pub(super) learned: Option<JudgedFigures>,
}

/// How a clip went without or with a trajectory.
#[derive(Debug, Deserialize)]
pub(super) struct JudgedFigures {
    pub(super) succeeds: bool,
    pub(super) successes: u64,
    starts: u64,
    pub(super) objective: f64,
    pub(super) cop_norm: f64,
}

impl JudgedFigures {
    /// `18 of 20`.
    pub(super) fn told(&self) -> String {
        format!("{} of {}", self.successes, self.starts)
    }
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Clips",
        "A clip is a task: a bend, a kick, something to catch, push or pull. *Without* is its controller with the
         same gains and no reference trajectory of the centre of mass, *with* the one along the trajectory that is
         shipped. Successes are counted from 20 starts that differ by up to 0.5° a joint and 2 mm/s; these starts
         were not searched over, but they are close to the one that was. CoP is the 2-norm of the centre of
         pressure's distance from the middle of the base of support (m, over steps of 1 ms; of a run that falls,
         until then). The objective, least is best, adds what a missed pose, an unmet expectation or a fall is
         charged. Without a trajectory the gains are not tuned for the task, so this is no comparison with the best
         that is possible without one.",
    );
    let seed = work.settings.seed;
    let all: Vec<&str> = aplomb::scenarios::clips().collect();
    let names = work.size(vec!["bend", "catch"], all);
    let mut rows = Vec::new();
    for name in names {
        let found: [ClipFigures; 1] =
            work.command(&format!("aplomb clips {name} --seed {seed}"))?;
        let [clip] = found;
        let with = clip.learned.as_ref();
        rows.push(vec![
            format!("`{}`", clip.clip.trim_start_matches("clips/")),
            clip.character,
            clip.flat.told(),
            with.map_or("–".to_owned(), JudgedFigures::told),
            format!("{:.2}", clip.flat.objective),
            decimals(with.map(|j| j.objective), 2),
            format!("{:.2}", clip.flat.cop_norm),
            decimals(with.map(|j| j.cop_norm), 2),
        ]);
    }
    page.table(
        &[
            "clip",
            "character",
            "succeed without",
            "succeed with",
            "objective without",
            "objective with",
            "CoP without",
            "CoP with",
        ],
        &rows,
    );
    Ok(page)
}

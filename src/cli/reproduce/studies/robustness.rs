//! Each skill alone over grounds and strengths.

use anyhow::Result;
use serde::Deserialize;

use crate::cli::reproduce::page::{Page, percent};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;

pub(super) const STUDY: Study = Study {
    name: "robustness",
    about: "each skill alone in twelve worlds of other friction and strength",
    takes: ["20 s", "15 minutes"],
    run,
};

/// What `aplomb robustness --json` tells.
#[derive(Debug, Deserialize)]
struct Robustness {
    controllers: Vec<SkillFigures>,
}

#[derive(Debug, Deserialize)]
struct SkillFigures {
    controller: String,
    goal: String,
    cells: Vec<CellFigures>,
    least: Option<CellFigures>,
}

#[derive(Debug, Deserialize)]
struct CellFigures {
    friction: f64,
    torque: f64,
    starts: u64,
    own_starts: u64,
    reached: u64,
    fraction: Option<f64>,
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Robustness",
        "Each skill, followed by the rest of the repertoire, in twelve worlds: friction 0.6, 0.8, 1 and 1.2, torque
         limits 0.85, 1 and 1.15 of the character's. It starts where the repertoire hands over to it, in heaps and
         in falls, or after a push; *own* are the starts that begin as the skill's rollouts for learning do, since
         the repertoire seldom hands over to it. A start is reached if the skill's goal is, without any failure on
         the way. The least world is the one with the smallest share, the first of equals: over few starts it is
         low by chance too. Masses, shapes and the slope of the ground stay the same.",
    );
    let (starts, seed) = (work.size(4, 40), work.settings.seed);
    let names = work.size(" protective_step fall", "");
    let found: Robustness = work.command(&format!(
        "aplomb robustness{names} --starts {starts} --seed {seed}"
    ))?;
    let rows: Vec<Vec<String>> = found.controllers.iter().map(row).collect();
    page.table(
        &[
            "skill",
            "goal",
            "starts",
            "own",
            "reached",
            "least world",
            "friction, torque there",
        ],
        &rows,
    );
    Ok(page)
}

fn row(skill: &SkillFigures) -> Vec<String> {
    let sum = |value: fn(&CellFigures) -> u64| skill.cells.iter().map(value).sum::<u64>();
    let starts = sum(|c| c.starts);
    let reached = sum(|c| c.reached) as f64 / starts.max(1) as f64;
    let least = skill.least.as_ref();
    let share = least.and_then(|c| {
        c.fraction
            .map(|f| format!("{} of {}", percent(f), c.starts))
    });
    vec![
        format!("`{}`", skill.controller),
        skill.goal.clone(),
        starts.to_string(),
        sum(|c| c.own_starts).to_string(),
        if starts > 0 {
            percent(reached)
        } else {
            "–".to_owned()
        },
        share.unwrap_or_else(|| "–".to_owned()),
        match least {
            None => "–".to_owned(),
            Some(c) if c.fraction == Some(1.0) => "every world".to_owned(),
            Some(c) => format!("{}, {}", c.friction, c.torque),
        },
    ]
}

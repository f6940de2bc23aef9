//! How many of many random pushes and heaps end in standing.

use anyhow::Result;
use serde::Deserialize;

use crate::cli::reproduce::page::{Page, decimals, percent};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;

pub(super) const STUDY: Study = Study {
    name: "trials",
    about: "how many of many random pushes, and of random heaps on the floor, end in standing",
    takes: ["30 s", "7 minutes"],
    run,
};

/// What `aplomb trials --json` tells.
#[derive(Debug, Deserialize)]
pub(super) struct Trials {
    pub(super) count: u64,
    standing: u64,
    interval95: [f64; 2],
    fell: u64,
    stepped: u64,
    time_to_stand: Option<StandingTimes>,
    short_activations: u64,
    pub(super) falls: FallFigures,
}

#[derive(Debug, Deserialize)]
struct StandingTimes {
    count: u64,
    median: f64,
    p90: f64,
    max: f64,
}

/// Falls both ways.
#[derive(Debug, Deserialize)]
pub(super) struct FallFigures {
    pub(super) forward: WayFigures,
    pub(super) backward: WayFigures,
}

/// Falls one way.
#[derive(Debug, Deserialize)]
pub(super) struct WayFigures {
    pub(super) count: u64,
    #[serde(alias = "hands_or_seat_first")]
    pub(super) hands_first: u64,
    pub(super) head_hits: u64,
    pub(super) median_head_hit_speed: Option<f64>,
    pub(super) p95_head_hit_speed: Option<f64>,
    pub(super) median_trunk_force: Option<f64>,
}

/// The pushes of this study, also for others.
pub(super) fn pushed(work: &mut Work<'_>) -> Result<Trials> {
    let (count, seed) = (work.size(60, 1000), work.settings.seed);
    work.command(&format!(
        "aplomb trials --count {count} --max-impulse 300 --seed {seed}"
    ))
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Trials",
        "Random runs of 20 s. *Pushes*: one at 1 s for 0.1 s, uniform in ±300 N·s, on pelvis, torso or head.
         *Heaps*: a start in a random pose just above the floor. A trial stands if for its last second only feet
         support the humanoid and it is upright, balanced and at rest; whether it fell in between does not count
         against it. The interval is Wilson's of 95 % for this distribution of pushes or heaps, on level ground of
         one friction; other grounds and bodies are not in it.",
    );
    let (heaps, seed) = (work.size(20, 500), work.settings.seed);
    let pushes = pushed(work)?;
    let heaps: Trials = work.command(&format!(
        "aplomb trials --count {heaps} --fallen --seed {seed}"
    ))?;
    let both = [("pushes", &pushes), ("heaps", &heaps)];
    let row = |(name, t): &(&str, &Trials)| {
        vec![
            (*name).to_owned(),
            t.count.to_string(),
            t.standing.to_string(),
            interval(t),
            t.fell.to_string(),
            t.stepped.to_string(),
            t.short_activations.to_string(),
        ]
    };
    page.table(
        &[
            "start",
            "trials",
            "standing at the end",
            "95 % interval",
            "fell",
            "stepped",
            "activations under 50 ms",
        ],
        &both.each_ref().map(row),
    );
    page.paragraph(
        "*Fell*: something other than feet supported it after it had stood. Activations are those that neither a
         failure nor a command ended. Time to stand, s: from the first fall, of heaps from the start, until it has
         stood up; those that do not get up in time are not in it.",
    );
    let row = |(name, t): &(&str, &Trials)| {
        let time =
            |value: fn(&StandingTimes) -> f64| decimals(t.time_to_stand.as_ref().map(value), 2);
        let count = t.time_to_stand.as_ref().map_or(0, |t| t.count);
        let times = [time(|t| t.median), time(|t| t.p90), time(|t| t.max)];
        [vec![(*name).to_owned(), count.to_string()], times.to_vec()].concat()
    };
    page.table(
        &[
            "start",
            "got up",
            "median",
            "nine of ten within",
            "all within",
        ],
        &both.each_ref().map(row),
    );
    page.highlight(
        "Standing 20 s after a random push of up to ±300 N·s",
        format!(
            "{} of {} ({})",
            pushes.standing,
            pushes.count,
            interval(&pushes)
        ),
    );
    Ok(page)
}

fn interval(trials: &Trials) -> String {
    let [low, high] = trials.interval95.map(percent);
    format!("{low} to {high}")
}

//! How falls are broken: what touches first, and whether and how fast the head does.

use anyhow::Result;

use super::trials::{Trials, WayFigures, pushed};
use crate::cli::reproduce::page::{Page, decimals, percent};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;
use crate::cli::statistics::wilson;

pub(super) const STUDY: Study = Study {
    name: "falls",
    about: "how often a fall hits the head and how fast, beside a body that goes limp",
    takes: ["5 s, after trials", "1 minute, after trials"],
    run,
};

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Falls",
        "The falls of the pushes of `trials`, with the repertoire's skills (*skilled*), and those of a repertoire
         that lets all joints go once it cannot stand (*limp*) under pushes of 100 to 300 N·s. A fall lasts from the
         first touch of anything but feet until the humanoid lies still or stands again. The head is hit if it
         touches anything in that time; its speed is that of its centre of mass just before. *Hands first*: forward
         the hands touch before head and trunk, backward hands or seat before the head, or these do not touch at
         all. Contact is rigid and the ground hard; injuries are not modelled, so forces are for comparison only.",
    );
    let skilled = pushed(work)?;
    let (count, seed) = (work.size(20, 200), work.settings.seed);
    let limp: Trials = work.command(&format!(
        "aplomb trials --count {count} --min-impulse 100 --max-impulse 300 --duration 4 --repertoire limp --seed {seed}"
    ))?;
    let mut rows = Vec::new();
    for (name, trials) in [("skilled", &skilled), ("limp", &limp)] {
        rows.push(row(&format!("{name}, forward"), &trials.falls.forward));
        rows.push(row(&format!("{name}, backward"), &trials.falls.backward));
    }
    page.table(
        &[
            "falls",
            "count",
            "hands first",
            "head hits",
            "95 % interval",
            "speed of the head, median, m/s",
            "95th percentile, m/s",
            "force on trunk and root, median, kN",
        ],
        &rows,
    );
    page.paragraph("Speeds are of the falls that hit the head alone, forces the peaks filtered over 10 ms of all.");
    let ways = [
        ("forward", &skilled.falls.forward),
        ("backward", &skilled.falls.backward),
    ];
    let told = ways.map(|(way, w)| format!("{} of {} {way}", w.head_hits, w.count));
    page.highlight("Falls of these pushes that hit the head", told.join(", "));
    Ok(page)
}

fn row(name: &str, way: &WayFigures) -> Vec<String> {
    let [low, high] = wilson(way.head_hits, way.count).map(percent);
    vec![
        name.to_owned(),
        way.count.to_string(),
        way.hands_first.to_string(),
        way.head_hits.to_string(),
        format!("{low} to {high}"),
        decimals(way.median_head_hit_speed, 2),
        decimals(way.p95_head_hit_speed, 2),
        decimals(way.median_trunk_force.map(|f| 1e-3 * f), 1),
    ]
}

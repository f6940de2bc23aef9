//! How hard the humanoid can be pushed before it has to step, and before it falls.

use std::sync::atomic::AtomicBool;

use anyhow::Result;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, to_value};

use crate::cli::reproduce::command;
use crate::cli::reproduce::page::{Page, decimals};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;
use crate::cli::statistics::median;

pub(super) const STUDY: Study = Study {
    name: "push_limits",
    about: "the hardest push of the chest stood in place, and with steps; time until balance is back",
    takes: ["10 s", "1 minute"],
    run,
};

/// Degrees; who bends the trunk further in place does not look as if he stood.
const UPRIGHT: f64 = 35.0;
/// s; when the push begins.
const AT: f64 = 1.0;

/// How one push was taken.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct TakenPush {
    /// N·s, forward positive.
    impulse: f64,
    fell: bool,
    stepped: bool,
    standing: bool,
    /// How far the trunk bent either way, degrees.
    bend: f64,
    /// s from the push until a controller that balances in place has taken over for good; 0 if no
    /// other was ever active, none if it has not.
    settled: Option<f64>,
}

/// Pushes of `step`, 2 `step` … up to `most` N·s, forward or backward.
#[derive(Debug, Clone, Copy)]
struct Sweep {
    step: f64,
    most: f64,
    forward: bool,
}

impl Sweep {
    fn impulses(&self) -> impl Iterator<Item = f64> {
        let Self {
            step,
            most,
            forward,
        } = *self;
        let sign = if forward { 1.0 } else { -1.0 };
        (1..=(most / step).round() as u32).map(move |i| sign * step * f64::from(i))
    }

    fn taken(&self, work: &mut Work<'_>) -> Result<Vec<TakenPush>> {
        let line = |impulse: &str| format!("aplomb run --push {AT}:torso:{impulse} --duration 12");
        let first: Vec<String> = self.impulses().take(2).map(|i| i.to_string()).collect();
        let sign = if self.forward { "" } else { "-" };
        let all = format!(
            "{} (I = {} … {sign}{})",
            line("I"),
            first.join(", "),
            self.most
        );
        work.part(&all, |stop: &AtomicBool| {
            let one = |i: f64| Ok(taken(i, &command::value(&line(&i.to_string()), stop)?));
            let impulses: Vec<f64> = self.impulses().collect();
            let all: Result<Vec<TakenPush>> = impulses.into_par_iter().map(one).collect();
            Ok(to_value(all?)?)
        })
    }
}

/// What the JSON of a run tells of its push.
fn taken(impulse: f64, run: &Value) -> TakenPush {
    let events = || run["events"].as_array().into_iter().flatten();
    let after = || events().filter(|e| e["kind"] == "switch" && e["t"].as_f64() > Some(AT));
    let settled = match after().next_back() {
        None => Some(0.0),
        Some(last) if last["role"] == "balance" => last["t"].as_f64().map(|t| t - AT),
        Some(_) => None,
    };
    TakenPush {
        impulse,
        fell: events().any(|e| e["kind"] == "fell"),
        stepped: after().any(|e| e["role"] == "step"),
        standing: run["end"]["standing"] == true,
        bend: bend(&run["trunk_pitch"]),
        settled,
    }
}

/// The greatest of two angles either way, rad, in degrees.
fn bend(pitch: &Value) -> f64 {
    let angles = pitch.as_array().into_iter().flatten();
    let either = angles.filter_map(Value::as_f64).map(f64::abs);
    either.fold(0.0, f64::max).to_degrees()
}

/// The strongest push before the first that does not hold, N·s, and whether one did not.
fn last_before(pushes: &[TakenPush], holds: impl Fn(&TakenPush) -> bool) -> (f64, bool) {
    let good = pushes.iter().take_while(|p| holds(p)).count();
    let last = good.checked_sub(1).map_or(0.0, |i| pushes[i].impulse.abs());
    (last, good < pushes.len())
}

fn told((last, found): (f64, bool)) -> String {
    if found {
        last.to_string()
    } else {
        format!("{last} or more")
    }
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Push limits",
        "The humanoid of 80 kg stands and is pushed once on the chest, at 1 s, for 0.1 s. *In place* is the last
         push, counted up in even steps, before the first after which it moves a foot, falls or does not stand
         after 12 s; *with steps* the last before the first after which it falls or does not stand. So a limit
         says that every weaker push that was tried was stood. *Upright* asks besides that the trunk bends by at most
         35° either way: near the limit in place the humanoid bows deeply with its feet planted, which is balance
         by number and not by eye; *deepest bow* is the furthest that the trunk bent in these pushes. Nothing is random here: one moment, one world and one link are tried;
         `trials` and `robustness` vary them.",
    );
    let (in_place, stepping) =
        work.size(((10.0, 60.0), (30.0, 150.0)), ((1.0, 60.0), (2.5, 150.0)));
    let mut rows = Vec::new();
    let mut limits = Vec::new();
    let mut times = Vec::new();
    for forward in [true, false] {
        let sweep = |(step, most)| Sweep {
            step,
            most,
            forward,
        };
        let weak = sweep(in_place).taken(work)?;
        let strong = sweep(stepping).taken(work)?;
        let stays = |p: &TakenPush| p.standing && !p.fell && !p.stepped;
        let last = last_before(&weak, stays);
        let bows = weak.iter().take_while(|p| stays(p)).map(|p| p.bend);
        let bow = decimals(bows.reduce(f64::max), 0);
        let place = told(last);
        let upright = told(last_before(&weak, |p| stays(p) && p.bend <= UPRIGHT));
        let steps = told(last_before(&strong, |p| p.standing && !p.fell));
        let way = if forward { "forward" } else { "backward" };
        rows.push(vec![way.to_owned(), upright.clone(), place, bow, steps]);
        limits.push(format!("{upright} {way}"));
        times.push(settling(way, &strong));
    }
    page.table(
        &[
            "push",
            "in place, upright, N·s",
            "in place, N·s",
            "deepest bow, °",
            "with steps, N·s",
        ],
        &rows,
    );
    page.paragraph(&format!(
        "Steps between pushes: {} N·s in place, {} N·s with steps.",
        in_place.0, stepping.0
    ));
    page.paragraph(
        "Of the pushes of the second kind after which it stepped and did not fall: s from the push until
         `balance` has taken over for good.",
    );
    page.table(
        &[
            "push",
            "stepped and stood",
            "median, s",
            "longest, s",
            "not within 11 s",
        ],
        &times,
    );
    page.highlight(
        "Hardest push of the chest that is stood in place with the trunk within 35°, N·s",
        limits.join(", "),
    );
    Ok(page)
}

/// How long it took to balance in place again.
fn settling(way: &str, pushes: &[TakenPush]) -> Vec<String> {
    let stood: Vec<&TakenPush> = pushes.iter().filter(|p| p.stepped && !p.fell).collect();
    let times: Vec<f64> = stood.iter().filter_map(|p| p.settled).collect();
    vec![
        way.to_owned(),
        stood.len().to_string(),
        decimals(median(&times), 2),
        decimals(times.iter().copied().reduce(f64::max), 2),
        (stood.len() - times.len()).to_string(),
    ]
}

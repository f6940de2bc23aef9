//! Runs as text: one line an event, the bids behind a switch, the end.

use std::io::{Result, Write};

use aplomb::framework::events::{Bid, Event, EventKind, Refusal};
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::Scenario;
use aplomb::framework::sensing::Posture;

/// How much is told.
#[derive(Debug, Clone, Copy)]
pub(super) struct Detail {
    /// Who bid what at each switch.
    pub(super) explain: bool,
    /// Whether to say which character an event is about.
    pub(super) several: bool,
}

/// A whole run: heading, events, ends.
pub(super) fn print(
    out: &mut dyn Write,
    simulation: &Simulation,
    scenario: &Scenario,
    explain: bool,
) -> Result<()> {
    let characters = simulation.world().characters();
    let detail = Detail {
        explain,
        several: characters.len() > 1,
    };
    let names: Vec<&str> = characters
        .iter()
        .map(|c| c.body.model().name.as_str())
        .collect();
    let (name, cast) = (&scenario.name, names.join(", "));
    let (duration, seed) = (scenario.duration, scenario.seed);
    writeln!(out, "{name}: {cast}; {duration} s, seed {seed}")?;
    for event in simulation.events() {
        print_event(out, event, detail)?;
    }
    for character in 0..characters.len() {
        writeln!(out, "{}", end(simulation, character))?;
    }
    Ok(())
}

/// One event, and with `explain` the bids behind it.
pub(super) fn print_event(out: &mut dyn Write, event: &Event, detail: Detail) -> Result<()> {
    let who = if detail.several {
        format!("[{}] ", event.character)
    } else {
        String::new()
    };
    writeln!(out, "{:9.3} s  {who}{}", event.time, event.kind)?;
    if let (true, EventKind::Switch { bids, .. }) = (detail.explain, &event.kind) {
        print_bids(out, bids, "             ")?;
    }
    Ok(())
}

/// A line for each controller of the pool: its bid, or why it bid 0. Those that only wait for their
/// command share one.
pub(super) fn print_bids(out: &mut dyn Write, bids: &[Bid], indent: &str) -> Result<()> {
    let (waiting, bids): (Vec<&Bid>, Vec<&Bid>) = bids
        .iter()
        .partition(|b| b.refusal == Some(Refusal::OnCommandOnly));
    let width = bids.iter().map(|b| b.controller.len()).max().unwrap_or(0);
    for bid in bids {
        let name = &bid.controller;
        let suitability = (1e3 * bid.suitability).round() / 1e3;
        match &bid.refusal {
            None => writeln!(out, "{indent}{name:width$}  bids {suitability}")?,
            Some(why) => writeln!(out, "{indent}{name:width$}  refuses: {why}")?,
        }
    }
    if !waiting.is_empty() {
        let names: Vec<&str> = waiting.iter().map(|b| b.controller.as_str()).collect();
        writeln!(out, "{indent}only on command: {}", names.join(", "))?;
    }
    Ok(())
}

/// The state of a character in a line.
pub(super) fn end(simulation: &Simulation, character: usize) -> String {
    let outcome = simulation.outcome(character);
    let who = if simulation.actors().len() > 1 {
        format!("[{character}] ")
    } else {
        String::new()
    };
    let steady = match (outcome.standing, outcome.posture) {
        (true, _) => ", steady for 1 s",
        (false, Posture::Standing) => ", not steady",
        (false, _) => "",
    };
    let posture = outcome.posture.name();
    let active = if outcome.active.is_empty() {
        "nothing".to_owned()
    } else {
        outcome.active
    };
    format!(
        "{:9.3} s  {who}{posture}{steady}; active: {active}; centre of mass ({:.3}, {:.3}) m at ({:.3}, {:.3}) m/s",
        simulation.time(),
        outcome.com[0],
        outcome.com[1],
        outcome.com_velocity[0],
        outcome.com_velocity[1],
    )
}

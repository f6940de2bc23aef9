//! `aplomb controllers`: the pool of a repertoire, with every controller's contract.

use std::collections::BTreeMap;
use std::io::Write;

use anyhow::Result;
use aplomb::framework::control::{Answer, Contract, repertoire};
use aplomb::framework::run::Simulation;
use aplomb::framework::sensing::Feature;
use clap::Args;
use serde::Serialize;

use super::Ending;
use super::arguments::Json;
use super::output::write_json;
use super::scene::CastArgs;

/// List the controllers of a repertoire
///
/// Lists the controllers of a character's repertoire: name, kind, weight (0: only on command), the
/// commands that it answers to, where it can take over (pre-condition), where it has succeeded
/// (post-condition), what it expects while it is active, and whether its pre-condition is learned.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb controllers
  aplomb controllers --repertoire mine.ron --json
  aplomb controllers --features")]
pub(super) struct ControllersArgs {
    #[command(flatten)]
    cast: CastArgs,
    /// Lists the features that conditions can speak of, instead of the controllers
    #[arg(long)]
    features: bool,
    #[command(flatten)]
    json: Json,
}

/// A word of the conditions' vocabulary.
#[derive(Debug, Serialize)]
struct Word {
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
}

#[derive(Debug, Serialize)]
struct ControllerRow {
    name: String,
    kind: Option<String>,
    weight: u32,
    learned: bool,
    /// Whether it bids weight × probability of success.
    confident: bool,
    commands: Vec<Answer>,
    precondition: String,
    postcondition: String,
    expected: String,
    /// s for which the post-condition must hold.
    hold: f64,
    /// s after which it has failed; none without limit.
    patience: Option<f64>,
    /// s of stillness after which it has failed; none without limit.
    stalls: Option<f64>,
}

impl ControllersArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        if self.features {
            return list_features(out, self.json.wanted);
        }
        let registry = aplomb::controllers::registry();
        let scenario = self.cast.apply(None, 1.0, &registry)?;
        let simulation = Simulation::new(&scenario, &registry)?;
        let model = simulation.world().characters()[0].body.model();
        let role = &scenario.characters[0];
        let repertoire = role.repertoire(model);
        let files = repertoire::read(repertoire, &registry)?;
        let kinds: BTreeMap<_, _> = files
            .into_iter()
            .map(|f| (f.contract.name, f.kind))
            .collect();
        let pool = simulation.actors()[0].supervisor.controllers();
        let rows: Vec<ControllerRow> = pool.map(|c| row(c.contract(), &kinds)).collect();
        if self.json.wanted {
            write_json(out, &rows)?;
        } else {
            print(out, &rows)?;
        }
        Ok(Ending::Done)
    }
}

fn list_features(out: &mut dyn Write, json: bool) -> Result<Ending> {
    let words: Vec<Word> = Feature::vocabulary()
        .chain(Feature::FAMILIES)
        .map(|(name, unit, meaning)| Word {
            name,
            unit,
            meaning,
        })
        .collect();
    if json {
        write_json(out, &words)?;
    } else {
        for Word {
            name,
            unit,
            meaning,
        } in words
        {
            writeln!(out, "{name:18} {unit:8} {meaning}")?;
        }
    }
    Ok(Ending::Done)
}

fn row(contract: &Contract, kinds: &BTreeMap<String, String>) -> ControllerRow {
    ControllerRow {
        name: contract.name.clone(),
        kind: kinds.get(&contract.name).cloned(),
        weight: contract.weight,
        learned: contract.precondition.is_learned(),
        confident: contract.confident,
        commands: contract.commands.clone(),
        precondition: contract.precondition.to_string(),
        postcondition: contract.postcondition.to_string(),
        expected: contract.expected.to_string(),
        hold: contract.hold,
        patience: Some(contract.patience).filter(|p| p.is_finite()),
        stalls: Some(contract.stalls).filter(|s| s.is_finite()),
    }
}

fn print(out: &mut dyn Write, rows: &[ControllerRow]) -> std::io::Result<()> {
    let width = |of: fn(&ControllerRow) -> &str| rows.iter().map(|r| of(r).chars().count()).max();
    let kind = |r: &ControllerRow| r.kind.as_deref().map_or("-", |k| k).to_owned();
    let names = width(|r| &r.name).unwrap_or(0).max(10);
    let kinds = width(|r| r.kind.as_deref().unwrap_or("-"))
        .unwrap_or(0)
        .max(4);
    writeln!(
        out,
        "{:names$}  {:kinds$}  weight  pre-condition is",
        "controller", "kind"
    )?;
    for row in rows {
        let origin = match (row.learned, row.confident) {
            (true, true) => "learned, bids by probability",
            (true, false) => "learned",
            (false, _) => "manual",
        };
        let (name, kind, weight) = (&row.name, kind(row), row.weight);
        writeln!(out, "{name:names$}  {kind:kinds$}  {weight:6}  {origin}")?;
    }
    for row in rows {
        writeln!(out, "\n{}", row.name)?;
        writeln!(out, "  takes over where  {}", row.precondition)?;
        let hold = match row.hold {
            0.0 => String::new(),
            hold => format!(", for {hold} s"),
        };
        writeln!(out, "  has succeeded at  {}{hold}", row.postcondition)?;
        writeln!(out, "  expects           {}", row.expected)?;
        if let Some(patience) = row.patience {
            writeln!(out, "  gives up after    {patience} s")?;
        }
        if let Some(stalls) = row.stalls {
            writeln!(out, "  and after         {stalls} s without moving")?;
        }
        let commands: Vec<String> = row.commands.iter().map(usage).collect();
        writeln!(out, "  answers to        {}", commands.join("; "))?;
    }
    Ok(())
}

/// A command with its parameters: `step_forward length=0.1..0.6 (0.3)`.
pub(super) fn usage(answer: &Answer) -> String {
    let mut text = answer.name.clone();
    for p in &answer.parameters {
        let (name, min, max, default) = (&p.name, p.min, p.max, p.default);
        text.push_str(&format!(" {name}={min}..{max} ({default})"));
    }
    text
}

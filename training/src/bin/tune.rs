//! `tune FILE OUT SEED EVALUATIONS SIGMA LOW HIGH [LOW HIGH]`: optimises the numbers of a
//! controller's file over pushes of the trunk.
//!
//! For `balance` and `stance`: pushes (N·s) around the limits forward and backward. For `fall`:
//! pushes either way.

use std::path::Path;

use aplomb_controllers::balance::BalanceSpec;
use aplomb_controllers::fall::FallSpec;
use aplomb_controllers::stance::StanceSpec;
use aplomb_framework::Result;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::registry::ControllerFile;
use aplomb_training::cma_es::{Best, Search};
use aplomb_training::tune::{self, Tunable};
use aplomb_training::{falling, standing};

const USAGE: &str = "tune FILE OUT SEED EVALUATIONS SIGMA LOW HIGH [LOW HIGH]";

/// Optimises one file; returns the new file's text.
fn optimise<T: Tunable>(
    source: &Source,
    others: &[&str],
    search: Search,
    what: &str,
    cost: impl Fn(&str) -> Result<f64> + Sync,
) -> Result<String> {
    let watch = |n: usize, best: &Best| eprintln!("{n} evaluations: {:.4}", best.cost);
    let (contract, spec, best) = tune::search::<T>(source, others, cost, search, watch)?;
    let Search {
        seed, evaluations, ..
    } = search;
    let header = format!(
        "Optimised by CMA-ES over {what}, seed {seed}, {evaluations} evaluations: cost {:.4}.",
        best.cost
    );
    Ok(tune::text_of(&contract, &spec, &header))
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<f64> = args.iter().skip(2).map_while(|a| a.parse().ok()).collect();
    let (Some(file), Some(out), [seed, evaluations, sigma, low, high, rest @ ..]) =
        (args.first(), args.get(1), numbers.as_slice())
    else {
        return Err(USAGE.into());
    };
    let search = Search {
        sigma: *sigma,
        population: 16,
        evaluations: *evaluations as usize,
        seed: *seed as u64,
    };
    let registry = aplomb_controllers::registry();
    let source = Source::read(Path::new(file))?;
    let kind = source.parse::<ControllerFile>()?.kind;
    let text = if kind == "fall" {
        let pushes = falling::pushes(*low, *high, 24);
        let cost = |text: &str| falling::cost(text, &registry, &pushes);
        let what = format!("{} pushes of {low} to {high} N·s either way", pushes.len());
        optimise::<FallSpec>(&source, &["skills/balance.ron"], search, &what, cost)?
    } else {
        let [low2, high2] = rest else {
            return Err(USAGE.into());
        };
        let pushes = standing::pushes([*low, *high], [*low2, *high2], 2.0);
        let cost = |text: &str| standing::cost(text, &registry, &pushes);
        let what = format!(
            "{} pushes of {low} to {high} N·s forward and {low2} to {high2} backward",
            pushes.len()
        );
        match kind.as_str() {
            "stance" => optimise::<StanceSpec>(&source, &[], search, &what, cost)?,
            _ => optimise::<BalanceSpec>(&source, &[], search, &what, cost)?,
        }
    };
    write_atomically(Path::new(out), text.as_bytes())?;
    Ok(())
}

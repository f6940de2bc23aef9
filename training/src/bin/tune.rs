//! `tune FILE OUT SEED EVALUATIONS FORWARD_LOW FORWARD_HIGH BACKWARD_LOW BACKWARD_HIGH [SIGMA]`:
//! optimises the numbers of a standing controller's file over pushes (N·s) around its limits.

use std::path::Path;

use aplomb_controllers::balance::BalanceSpec;
use aplomb_controllers::stance::StanceSpec;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::registry::ControllerFile;
use aplomb_training::cma_es::{Best, Search};
use aplomb_training::{standing, tune};

const USAGE: &str = "tune FILE OUT SEED EVALUATIONS FORWARD_LOW FORWARD_HIGH BACKWARD_LOW \
                     BACKWARD_HIGH [SIGMA]";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize| args.get(i).and_then(|a| a.parse::<f64>().ok());
    let (Some(file), Some(out), Some(seed), Some(evaluations)) =
        (args.first(), args.get(1), number(2), number(3))
    else {
        return Err(USAGE.into());
    };
    let range = |i, low, high| [number(i).unwrap_or(low), number(i + 1).unwrap_or(high)];
    let pushes = standing::pushes(range(4, 30.0, 50.0), range(6, 26.0, 42.0), 4.0);
    let search = Search {
        sigma: number(8).unwrap_or(0.15),
        population: 16,
        evaluations: evaluations as usize,
        seed: seed as u64,
    };
    let registry = aplomb_controllers::registry();
    let watch = |n: usize, best: &Best| eprintln!("{n} evaluations: {:.4}", best.cost);
    let header = |cost: f64| {
        format!(
            "Optimised by CMA-ES over {} pushes of the trunk, seed {seed}, {evaluations} \
             evaluations: cost {cost:.4}.",
            pushes.len()
        )
    };
    let source = Source::read(Path::new(file))?;
    let text = if source.parse::<ControllerFile>()?.kind == "stance" {
        let (contract, spec, best) =
            tune::search::<StanceSpec>(&source, &registry, &pushes, search, watch)?;
        tune::text_of(&contract, &spec, &header(best.cost))
    } else {
        let (contract, spec, best) =
            tune::search::<BalanceSpec>(&source, &registry, &pushes, search, watch)?;
        tune::text_of(&contract, &spec, &header(best.cost))
    };
    write_atomically(Path::new(out), text.as_bytes())?;
    Ok(())
}

//! `tune FILE OUT SEED EVALUATIONS SIGMA LOW HIGH LOW HIGH`: optimises the numbers of a standing
//! controller's file, of kind `balance` or `stance`, over pushes (N·s) of the trunk around its limits
//! forward and backward.

use std::path::Path;

use aplomb_controllers::kinds::balance::BalanceSpec;
use aplomb_controllers::kinds::stance::StanceSpec;
use aplomb_framework::control::ControllerFile;
use aplomb_framework::input::{Result, Source, write_atomically};
use aplomb_training::exercise::standing;
use aplomb_training::search::cma_es::Search;
use aplomb_training::search::tune;
use aplomb_training::search::tune::Tunable;

const USAGE: &str = "tune FILE OUT SEED EVALUATIONS SIGMA LOW HIGH LOW HIGH";

/// Optimises one file; every improvement is written at once.
fn optimise<T: Tunable>(
    source: &Source,
    out: &Path,
    search: Search,
    what: &str,
    cost: impl Fn(&str) -> Result<f64> + Sync,
) -> Result<()> {
    let (mut least, mut written) = (f64::INFINITY, Ok(()));
    tune::search::<T>(source, cost, search, |evaluations, cost, text| {
        eprintln!("{evaluations} evaluations: {cost:.4}");
        if cost < least {
            least = cost;
            let header = format!(
                "Optimised by CMA-ES over {what}, seed {}, {evaluations} evaluations: cost {cost:.4}.",
                search.seed
            );
            written = write_atomically(out, text(&header).as_bytes());
        }
    })?;
    written
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<f64> = args.iter().skip(2).map_while(|a| a.parse().ok()).collect();
    let (Some(file), Some(out), [seed, evaluations, sigma, low, high, low2, high2]) =
        (args.first(), args.get(1), numbers.as_slice())
    else {
        return Err(USAGE.into());
    };
    let range = |low: f64, high: f64| low >= 0.0 && low <= high && high <= 1000.0;
    let fine = (0.0..=1e15).contains(seed)
        && (1.0..=1e6).contains(evaluations)
        && (1e-3..=1.0).contains(sigma)
        && range(*low, *high)
        && range(*low2, *high2);
    if !fine {
        return Err(format!(
            "{USAGE}: up to 1e6 evaluations, SIGMA 0.001 to 1, LOW to HIGH within 0 to 1000 N·s"
        )
        .into());
    }
    let search = Search {
        sigma: *sigma,
        population: 16,
        evaluations: *evaluations as usize,
        seed: *seed as u64,
    };
    let registry = aplomb_controllers::registry();
    let source = Source::read(Path::new(file))?;
    let kind = source.parse::<ControllerFile>()?.kind;
    let out = Path::new(out);
    let pushes = standing::pushes([*low, *high], [*low2, *high2], 2.0);
    let cost = |text: &str| standing::cost(text, &registry, &pushes);
    let what = format!(
        "{} pushes of {low} to {high} N·s forward and {low2} to {high2} backward",
        pushes.len()
    );
    match kind.as_str() {
        "stance" => optimise::<StanceSpec>(&source, out, search, &what, cost)?,
        _ => optimise::<BalanceSpec>(&source, out, search, &what, cost)?,
    }
    Ok(())
}

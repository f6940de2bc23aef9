//! scratch
use std::path::Path;
use aplomb_controllers::step::StepSpec;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::repertoire;
use aplomb_training::cma_es::{Search, minimise};
use aplomb_training::stepping::{cost, pushed, step};
use aplomb_training::tune::{at, point_of, spec_of, text_of};
use aplomb_training::worlds::Worlds;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let (rep, file, out) = (&a[0], &a[1], &a[2]);
    let n: Vec<f64> = a[3..].iter().map(|x| x.parse().unwrap()).collect();
    let (seed, evals, sigma, count, low, high) = (n[0] as u64, n[1] as usize, n[2], n[3] as usize, n[4], n[5]);
    let registry = aplomb_controllers::registry();
    let model = Model::load("humanoid")?;
    let mind = repertoire::load(rep, &registry, &model)?;
    let (mut contract, base) = spec_of::<StepSpec>(&Source::read(Path::new(file))?)?;
    contract.resolve(&model)?;
    let s = pushed(&model, &mind, [low, high], count, Worlds::VARIED, seed)?;
    let with = |spec: &StepSpec| mind.with_replaced(spec.clone().build(contract.clone(), &model).unwrap()).unwrap();
    let start = point_of(&base, &model);
    let population = 14;
    let mut least = f64::INFINITY;
    minimise(&start, Search { sigma, population, evaluations: evals, seed }, |p| {
        let spec = at(&base, &model, p);
        match spec.build(contract.clone(), &model).and_then(|c| mind.with_replaced(c)) {
            Ok(m) => cost(&s, &m),
            Err(_) => f64::INFINITY,
        }
    }, |e, best| {
        if best.cost < least {
            least = best.cost;
            let spec = at(&base, &model, &best.point);
            let m = with(&spec);
            let r: Vec<_> = s.iter().map(|x| step(x, &m)).collect();
            let ok = r.iter().filter(|r| r.stood).count();
            let time = r.iter().filter(|r| r.stood).map(|r| r.time).sum::<f64>() / ok.max(1) as f64;
            eprintln!("{e}: {:.4} stood {ok}/{} in {time:.2} s", best.cost, s.len());
            let head = format!("Optimised by CMA-ES over {} pushes of {low} to {high} N·s either way in varied worlds, seed {seed}, {e} evaluations: {ok} stood, cost {:.4}.", s.len(), best.cost);
            write_atomically(Path::new(out), text_of(&contract, &spec, &head).as_bytes()).unwrap();
        }
    });
    Ok(())
}

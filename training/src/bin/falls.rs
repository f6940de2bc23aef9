//! scratch
use std::path::Path;
use aplomb_controllers::fall::FallSpec;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::repertoire;
use aplomb_training::cma_es::{Search, minimise};
use aplomb_training::stepping::pushed;
use aplomb_training::falling::{land_from, Landing};
use aplomb_framework::simulation::Simulation;
use aplomb_framework::supervisor::Supervisor;
use aplomb_training::tune::{at, point_of, spec_of, text_of};
use aplomb_training::worlds::Worlds;

fn arms(run: &Simulation) -> f64 { let _ = run; 0.0 }
fn land(s: &[Simulation], m: &Supervisor) -> Vec<Landing> {
    s.iter().enumerate().map(|(i, x)| { let mut r = x.clone(); r.set_mind(0, m.clone()); let _ = arms(&r); land_from(r, i % 2 == 0, 2.6) }).collect()
}
fn cost(s: &[Simulation], m: &Supervisor) -> f64 {
    land(s, m).iter().map(|l| {
        (if l.protected { 0.0 } else { 1.0 }) + 0.3 * l.head_speed + (l.head_force / 2000.0).min(4.0) + (l.trunk_force / 5000.0).min(4.0) + if l.settled { 0.0 } else { 0.2 }
    }).sum::<f64>() / s.len() as f64
}
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let (rep, file, out) = (&a[0], &a[1], &a[2]);
    let n: Vec<f64> = a[3..].iter().map(|x| x.parse().unwrap()).collect();
    let (seed, evals, sigma, count, low, high) = (n[0] as u64, n[1] as usize, n[2], n[3] as usize, n[4], n[5]);
    let registry = aplomb_controllers::registry();
    let model = Model::load("humanoid")?;
    let mind = repertoire::load(rep, &registry, &model)?;
    let (mut contract, base) = spec_of::<FallSpec>(&Source::read(Path::new(file))?)?;
    contract.resolve(&model)?;
    let s = pushed(&model, &mind, [low, high], count, Worlds::VARIED, seed)?;
    let with = |spec: &FallSpec| mind.with_replaced(spec.clone().build(contract.clone(), &model).unwrap()).unwrap();
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
            let r = land(&s, &m);
            let ok = r.iter().filter(|r| r.protected).count();
            let med = |f: fn(&Landing) -> f64, k: usize| { let mut v: Vec<f64> = r.iter().enumerate().filter(|(i, _)| i % 2 == k).map(|(_, l)| f(l)).collect(); v.sort_by(f64::total_cmp); v[v.len() / 2] };
            eprintln!("{e}: {:.4} protected {ok}/{}; medians f/b head {:.0} {:.0} N trunk {:.0} {:.0} N", best.cost, s.len(), med(|l| l.head_force, 0), med(|l| l.head_force, 1), med(|l| l.trunk_force, 0), med(|l| l.trunk_force, 1));
            let head = format!("Optimised by CMA-ES over {} pushes of {low} to {high} N·s either way in varied worlds, seed {seed}, {e} evaluations: {ok} well broken, cost {:.4}.", s.len(), best.cost);
            write_atomically(Path::new(out), text_of(&contract, &spec, &head).as_bytes()).unwrap();
        }
    });
    Ok(())
}

//! scratch
use std::path::Path;
use aplomb_controllers::pose::PoseSpec;
use aplomb_framework::file::{Source, write_atomically};
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::repertoire;
use aplomb_training::cma_es::{Search, minimise};
use aplomb_training::rising::{Goal, cost, rise};
use aplomb_training::starts::{self, starts};
use aplomb_training::tune::{at, point_of, spec_of, text_of};
use aplomb_training::worlds::Worlds;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let kind = Source::read(Path::new(&a[1]))?.parse::<aplomb_framework::registry::ControllerFile>()?.kind;
    if kind == "pose" { go::<PoseSpec>(&a) } else { go::<aplomb_controllers::step::StepSpec>(&a) }
}

fn go<T: aplomb_training::tune::Tunable + Spec>(a: &[String]) -> Result<(), Box<dyn std::error::Error>> {
    let (rep, file, out) = (&a[0], &a[1], &a[2]);
    let n: Vec<f64> = a[3..].iter().map(|x| x.parse().unwrap()).collect();
    let (seed, evals, sigma, count, heaps, longest, vary) = (n[0] as u64, n[1] as usize, n[2], n[3] as usize, n[4], n[5], n[6]);
    let registry = aplomb_controllers::registry();
    let model = Model::load("humanoid")?;
    let mind = repertoire::load(rep, &registry, &model)?;
    let (mut contract, base) = spec_of::<T>(&Source::read(Path::new(file))?)?;
    contract.resolve(&model)?;
    let mind = mind.with_replaced(base.clone().build(contract.clone(), &model)?)?;
    let worlds = if vary > 0.0 { Worlds::VARIED } else { Worlds { friction: [1.0; 2], torque: [1.0; 2], mass: [1.0; 2] } };
    let s = starts(starts::Source { worlds, heaps, seed }, count, &model, &contract, &mind)?;
    let goal = Goal::of(&contract);
    eprintln!("{} starts, goal {goal:?}", s.len());
    let report = |spec: &T| {
        let m = mind.with_replaced(spec.clone().build(contract.clone(), &model).unwrap()).unwrap();
        let r: Vec<_> = s.iter().map(|x| rise(x, &m, &contract, goal, longest)).collect();
        let ok = r.iter().filter(|r| r.reached).count();
        let time = r.iter().filter(|r| r.reached).map(|r| r.time).sum::<f64>() / ok.max(1) as f64;
        (ok, time)
    };
    eprintln!("base {:?}", report(&base));
    if evals == 0 {
        for x in &s {
            let now = x.sensors(0);
            let f = |n: &str| { let mut f: aplomb_framework::feature::Feature = n.parse().unwrap(); f.resolve(&model).unwrap(); f.value(now) };
            let mut run = x.clone();
            run.set_mind(0, mind.clone());
            let n0 = run.events().len();
            let b = run.time();
            while run.time() < b + longest { run.step(); }
            let ev: Vec<String> = run.events()[n0..].iter().filter_map(|e| match &e.kind { aplomb_framework::trajectory::EventKind::Switch { to, why, .. } => Some(format!("{:.2}:{to}({why})", e.time - b)), _ => None }).take(3).collect();
            println!("t={:.2} fr{:.2} tq{:.2} cf{:.2} cr{:.2} h{:.2} tp{:.2} sup{:.2} apart{:.2} vx{:.2} vy{:.2} feet{} H{:.1} | {}", b, x.world().settings().friction, x.world().settings().torque, f("capture_front"), f("capture_rear"), f("com_height"), f("trunk_pitch"), f("support_length"), f("feet_apart"), f("com_velocity_x"), f("com_velocity_y"), f("feet_touching"), f("angular_momentum"), ev.join(" "));
        }
    }
    if evals < 2 { return Ok(()); }
    let start = point_of(&base, &model);
    let dims = start.len();
    let population = (4 + (3.0 * (dims as f64).ln()) as usize + 1) / 2 * 2;
    let mut least = f64::INFINITY;
    let mut last = 0;
    minimise(&start, Search { sigma, population, evaluations: evals, seed }, |p| {
        let spec = at(&base, &model, p);
        match spec.build(contract.clone(), &model).and_then(|c| mind.with_replaced(c)) {
            Ok(m) => cost(&s, &m, &contract, goal, longest),
            Err(_) => f64::INFINITY,
        }
    }, |e, best| {
        if best.cost < least - 1e-9 || e >= last + 200 {
            if e < last + 40 && e > 1 { return; }
            last = e;
            least = best.cost;
            let spec = at(&base, &model, &best.point);
            let (ok, time) = report(&spec);
            eprintln!("{e}: {:.4} reached {ok}/{} in {time:.2} s", best.cost, s.len());
            let head = format!("Optimised by CMA-ES over {} starts, seed {seed}, {e} evaluations: {ok} reached, cost {:.4}.", s.len(), best.cost);
            write_atomically(Path::new(out), text_of(&contract, &spec, &head).as_bytes()).unwrap();
        }
    });
    Ok(())
}

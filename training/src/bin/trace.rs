use aplomb_framework::{feature::Feature, model::Model, registry::Registry, repertoire, scenario::Scenario, simulation::Simulation};
fn main() {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let registry: Registry = aplomb_controllers::registry();
    let model = Model::load("humanoid").unwrap();
    let mind = repertoire::load(&a[0], &registry, &model).unwrap();
    let sc = Scenario::standing("humanoid", 10.0);
    let mut run = Simulation::with_cast(&sc, vec![(model.clone(), mind)]).unwrap();
    run.run(1.0);
    run.push(0, &a[1], a[2].parse().unwrap()).unwrap();
    let (t1, every): (f64, u64) = (a[3].parse().unwrap(), a[4].parse().unwrap());
    let f: Vec<Feature> = a[5..].iter().map(|n| { let mut f: Feature = n.parse().unwrap(); f.resolve(&model).unwrap(); f }).collect();
    let mut k = 0;
    while run.time() < t1 {
        run.step();
        if k % every == 0 {
            let now = run.sensors(0);
            print!("{:.3} {:12}", run.time(), run.actors()[0].mind.active().unwrap());
            for f in &f { print!(" {:8.3}", f.value(now)); }
            println!();
        }
        k += 1;
    }
}

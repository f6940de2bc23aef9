//! scratch
use aplomb_framework::{scenario::Scenario, simulation::Simulation};
fn main() {
    let r = aplomb_controllers::registry();
    let args: Vec<String> = std::env::args().collect();
    let mut sc = Scenario::standing("humanoid", 8.0);
    if args.len() > 1 {
        sc.characters[0].repertoire = Some(args[1].clone());
    }
    let t0 = std::time::Instant::now();
    let mut steps = 0.0;
    for sign in [1.0, -1.0] {
        for i in (10..64).step_by(2) {
            let mut s = Simulation::new(&sc, &r).unwrap();
            s.run(1.0);
            s.push(0, "torso", sign * i as f64).unwrap();
            s.run(7.0);
            steps += 8000.0;
            let o = s.outcome(0);
            let n = s.sensors(0);
            println!(
                "{} {} {:?} com {:.3} {:.3} feet {:?}",
                sign * i as f64,
                o.standing,
                o.posture,
                o.com[0],
                o.com[1],
                n.base_of_support
            );
            if !o.standing {
                for e in s.events() {
                    println!(
                        "   {:.3} {:?}",
                        e.time,
                        format!("{:?}", e.kind)
                            .chars()
                            .take(150)
                            .collect::<String>()
                    );
                }
                break;
            }
        }
    }
    println!("{:.0} steps/s", steps / t0.elapsed().as_secs_f64());
}

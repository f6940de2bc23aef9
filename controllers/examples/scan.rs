//! scratch
use aplomb_framework::{scenario::Scenario, simulation::Simulation};
fn main() {
    let r = aplomb_controllers::registry();
    let args: Vec<String> = std::env::args().collect();
    let mut sc = Scenario::standing("humanoid", 8.0);
    match args[1].as_str() {
        "scan" => {
            if args.len() > 2 {
                sc.characters[0].repertoire = Some(args[2].clone());
            }
            for sign in [1.0, -1.0] {
                let mut last = 0.0;
                let mut maxout: f64 = 0.0;
                for i in (20..64).step_by(2) {
                    let mut s = Simulation::new(&sc, &r).unwrap();
                    if args.len() > 3 {
                        s.step();
                        s.command(0, &args[3]).unwrap();
                    }
                    s.run(1.0);
                    s.push(0, "torso", sign * i as f64).unwrap();
                    let mut out: f64 = 0.0;
                    let mut minh: f64 = 2.0;
                    let mut minp: f64 = 0.0;
                    for _ in 0..7000 {
                        s.step();
                        let n = s.sensors(0);
                        if let Some(b) = n.base_of_support {
                            out = out.max((n.capture_point - b[1]).max(b[0] - n.capture_point));
                        }
                        minh = minh.min(n.com_height());
                        minp = minp.min(n.trunk_pitch());
                    }
                    let o = s.outcome(0);
                    if !o.standing
                        || s.events()
                            .iter()
                            .any(|e| format!("{:?}", e.kind).contains("Fell"))
                    {
                        println!("fail {} out {:.3} {:?}", sign * i as f64, out, o);
                        for e in s.events() {
                            println!(
                                "   {:.3} {:?}",
                                e.time,
                                format!("{:?}", e.kind)
                                    .chars()
                                    .take(110)
                                    .collect::<String>()
                            );
                        }
                        break;
                    }
                    last = i as f64;
                    maxout = out;
                    println!(
                        "  {} out {:.3} minh {:.3} minpitch {:.2}",
                        sign * i as f64,
                        out,
                        minh,
                        minp
                    );
                }
                println!("{} last {} maxout {:.3}", sign, last, maxout);
            }
        }
        "run" => {
            let mut s = Simulation::new(&sc, &r).unwrap();
            if args.len() > 2 {
                sc.characters[0].repertoire = Some(args[2].clone());
                s = Simulation::new(&sc, &r).unwrap();
            }
            s.record("x", 0);
            s.run(1.0);
            for a in &args[3..] {
                if let Some(i) = a.strip_prefix("push=") {
                    s.push(0, "torso", i.parse().unwrap()).unwrap();
                } else {
                    s.command(0, a).unwrap();
                }
            }
            for _ in 0..24 {
                s.run(0.25);
                let n = s.sensors(0);
                println!(
                    "{:.2} {} {:?} com {:.3} h {:.3} cap {:.3} pitch {:.2} bos {:?}",
                    n.time,
                    s.actors()[0].mind.active().unwrap(),
                    n.posture,
                    n.com[0],
                    n.com_height(),
                    n.capture_point,
                    n.trunk_pitch(),
                    n.base_of_support
                        .map(|b| [(b[0] * 1000.0).round(), (b[1] * 1000.0).round()])
                );
            }
            for e in s.events() {
                println!(
                    "   {:.3} {:?}",
                    e.time,
                    format!("{:?}", e.kind)
                        .chars()
                        .take(130)
                        .collect::<String>()
                );
            }
            s.recording()
                .unwrap()
                .write(std::path::Path::new("/tmp/x.trajectory"))
                .unwrap();
        }
        _ => {}
    }
}

//! Figures of the server, printed: frames with many clients, memory after half an hour.
//!
//! `cargo test --release --test live measure -- --ignored --nocapture --test-threads 1`

use std::time::{Duration, Instant};

use aplomb::live::{Request, SceneNames, Session, View};

use super::Served;

/// What a process keeps in memory, MB.
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|l| l.trim().strip_suffix("kB")?.trim().parse().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}

#[test]
#[ignore = "prints figures"]
fn measure_frames_with_one_five_and_twenty_clients_and_one_who_reads_nothing() {
    for clients in [1, 5, 20] {
        let served = Served::standing();
        let _reads_nothing = served.join();
        let threads = (0..clients).map(|_| {
            let mut client = served.join();
            std::thread::spawn(move || {
                client.frame();
                let rate = client.rate(10.0);
                (rate, client.frame())
            })
        });
        let threads: Vec<_> = threads.collect();
        let told: Vec<_> = threads.into_iter().map(|t| t.join().unwrap()).collect();
        let rates = told.iter().map(|(rate, _)| *rate);
        let (least, sum) = rates.fold((f64::INFINITY, 0.0), |(l, s), r| (l.min(r), s + r));
        let dropped: u64 = told
            .iter()
            .map(|(_, f)| f["dropped"].as_u64().unwrap())
            .sum();
        println!(
            "{clients:2} clients: {:.1} frames a second each, least {least:.1}, {dropped} dropped in all in 10 s, \
             real-time factor {}, {:.0} MB",
            sum / f64::from(clients),
            told[0].1["rtf"],
            memory()
        );
    }
}

#[test]
#[ignore = "prints figures"]
fn measure_memory_of_half_an_hour() {
    let mut session = Session::new(&SceneNames::default()).unwrap();
    let mut view = View::default();
    println!("before: {:.0} MB", memory());
    let begun = Instant::now();
    for second in 1..=1800 {
        if second % 10 == 0 {
            let impulse = if second % 20 == 0 { 60 } else { -60 };
            let push = format!(r#"{{"do":"push","link":"torso","impulse":[{impulse},0]}}"#);
            session
                .ask(&mut view, Request::parse(&push).unwrap())
                .unwrap();
        }
        for _ in 0..60 {
            session.advance(1.0 / 60.0);
        }
        if second % 300 == 0 {
            println!(
                "{second} s: {:.0} MB, {} snapshots, {} events; {:.0} s",
                memory(),
                session.history().snapshots(),
                session.events().len(),
                begun.elapsed().as_secs_f64()
            );
        }
    }
    for step in [1_000, 400_000, 1_234_567, 1_790_001] {
        let begun = Instant::now();
        session.ask(&mut view, Request::Seek { step }).unwrap();
        println!("back to step {step}: {:?}", begun.elapsed());
    }
    assert!(begun.elapsed() < Duration::from_secs(3600));
}

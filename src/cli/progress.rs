//! A progress bar on stderr for long work; silent where stderr is no terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use aplomb::framework::run::Simulation;

/// s simulated between two looks at the clock.
const CHUNK: f64 = 0.1;

/// A bar of `length` pieces of work, with room for a message behind it.
pub(super) fn bar(length: u64, unit: &str) -> ProgressBar {
    let template = format!("{{bar:40}} {{pos}}/{{len}} {unit}, {{eta}} left{{msg}}");
    let style = ProgressStyle::with_template(&template);
    let bar = ProgressBar::new(length);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(Duration::from_millis(250));
    bar
}

/// Runs a simulation for a duration, s, under a bar.
pub(super) fn run(simulation: &mut Simulation, duration: f64) {
    let dt = simulation.world().settings().dt;
    let steps = (duration / dt).round() as u64;
    let chunk = (CHUNK / dt).round().max(1.0) as u64;
    let bar = bar((duration / CHUNK).ceil() as u64, "tenths of a second");
    let mut done = 0;
    while done < steps {
        for _ in 0..chunk.min(steps - done) {
            simulation.step();
        }
        done += chunk.min(steps - done);
        bar.inc(1);
    }
    bar.finish_and_clear();
}

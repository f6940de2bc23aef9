//! The skills of the shipped humanoid, each for what it promises.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

mod bearing;
mod characters;
mod learned;
mod pose;
mod step;

use std::sync::Arc;

use aplomb_controllers::registry;
use aplomb_framework::character::Model;
use aplomb_framework::control::{Controller, ControllerFile};
use aplomb_framework::events::{Event, EventKind, Reason};
use aplomb_framework::input::Source;
use aplomb_framework::run::Simulation;

fn humanoid() -> Arc<Model> {
    Model::load("humanoid").unwrap()
}

/// The text of a shipped file.
fn shipped(name: &str) -> String {
    registry().file(name).unwrap().text
}

/// A controller from the text of its file, or the refusal of it.
fn built(text: &str) -> Result<Box<dyn Controller>, String> {
    let source = Source::new("mine.ron", text);
    let file = ControllerFile::parse(source).map_err(|e| e.to_string())?;
    let built = registry().build(&file, &humanoid());
    built.map_err(|e| e.to_string())
}

/// When which controllers took over, s, and why.
fn switches(run: &Simulation) -> Vec<(f64, &str, &Reason)> {
    let switch = |event| match event {
        &Event {
            time,
            kind: EventKind::Switch {
                ref to, ref reason, ..
            },
            ..
        } => Some((time, to.as_str(), reason)),
        _ => None,
    };
    run.events().iter().filter_map(switch).collect()
}

//! `aplomb` without a subcommand: the story, told, drawn and recorded.

use std::io::Write;
use std::path::Path;

use anyhow::Result;
use aplomb::framework::run::Simulation;

use super::output::{check_picture, check_writable};
use super::{Ending, progress, timeline};

/// Where the story is drawn.
const PICTURE: &str = "out/story.svg";
/// Where it is recorded.
const RECORDING: &str = "out/story.trajectory";

/// Runs the shipped story.
pub(super) fn tell(out: &mut dyn Write) -> Result<Ending> {
    let scenario = aplomb::scenarios::load("story")?;
    let (picture, recording) = (Path::new(PICTURE), Path::new(RECORDING));
    check_picture(picture)?;
    check_writable(recording)?;
    writeln!(
        out,
        "The humanoid stands, is pushed hard from the front, falls on its back, gets up; is pushed from behind, falls on its \
         hands, gets up; pushed lightly, it steps."
    )?;
    out.flush()?;
    let mut simulation = Simulation::new(&scenario, &aplomb::controllers::registry())?;
    simulation.record(&scenario.name, scenario.seed);
    progress::run(&mut simulation, scenario.duration);
    // The files first: a reader of the text who leaves early takes nothing away.
    let mut told = Vec::new();
    timeline::print(&mut told, &simulation, &scenario, false)?;
    let unmet = simulation.unmet(&scenario.expect);
    if let Some(trajectory) = simulation.into_recording() {
        trajectory.write(recording)?;
        aplomb::render::write(&trajectory, picture, true)?;
    }
    out.write_all(&told)?;
    writeln!(out, "\nDrawn in {PICTURE}, recorded in {RECORDING}.")?;
    writeln!(
        out,
        "As an animation: aplomb render {RECORDING} -o story.gif"
    )?;
    writeln!(
        out,
        "To watch it and push it yourself: aplomb view story. Without a browser: aplomb shell, aplomb run --help"
    )?;
    Ok(match unmet {
        None => Ending::Done,
        Some(_) => Ending::Unmet,
    })
}

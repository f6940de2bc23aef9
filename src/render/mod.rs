//! Pictures of recorded runs: film strips, plots over time, animations; and figures of learned
//! pre-conditions ([`comparison`]) and of learned anticipation ([`anticipation`]).
//!
//! [`Trajectory`] → SVG text → PNG, GIF, MP4. All pictures are drawn as SVG; the others are
//! rasterised from it with an embedded font, so that they look the same on every machine.
//!
//! Numbers in a recording that are no numbers are left out of the pictures.

mod animation;
pub mod anticipation;
mod body;
mod camera;
mod captions;
mod change;
mod chart;
mod choose;
pub mod comparison;
mod film;
mod framing;
mod ground;
mod key;
mod legend;
mod marks;
mod palette;
mod plot;
mod raster;
mod scene;
#[cfg(test)]
mod seen;
mod series;
mod style;
mod timeline;
mod video;
mod wardrobe;
mod wishes;

use std::path::Path;

use anyhow::{Context, Result, bail};
use aplomb_framework::input::write_atomically;
use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

pub use animation::{AnimationOptions, gif};
pub use camera::Camera;
pub use film::FilmOptions;
pub use raster::png;
pub use video::mp4;

/// px per SVG unit of PNG files.
const PNG_SCALE: f64 = 2.0;
/// m/s², for weights and capture points; recordings do not say theirs.
const GRAVITY: f64 = 9.81;
/// What [`write`] accepts.
const FORMATS: &str = ".svg, .png, .gif, .mp4";

/// Refuses recordings that cannot be drawn.
fn drawable(trajectory: &Trajectory, character: usize) -> Result<()> {
    if trajectory.is_empty() {
        bail!("the trajectory is empty: no step was recorded");
    }
    let count = trajectory.models.len();
    if character >= count {
        bail!("there is no character {character}; the trajectory has {count}, counted from 0");
    }
    Ok(())
}

/// A film strip as SVG: frames in rows, denser where much happens, each with its time in s and the
/// active controller; a legend below.
///
/// # Errors
/// An empty trajectory or an unknown character.
///
/// ```
/// # use aplomb::framework::prelude::*;
/// # let scenario = Scenario::standing("humanoid", 0.1);
/// # let mut simulation = Simulation::new(&scenario, &aplomb::controllers::registry())?;
/// simulation.record("standing", 0);
/// simulation.run(0.1);
/// let trajectory = simulation.into_recording().expect("it was recorded");
/// let svg = aplomb::render::filmstrip(&trajectory, &Default::default())?;
/// assert!(svg.contains("balance")); // is active
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn filmstrip(trajectory: &Trajectory, options: &FilmOptions) -> Result<String> {
    let (strip, size) = film::strip(trajectory, options)?;
    Ok(style::document(size, strip))
}

/// One character's run over time as SVG: centre of mass, centre of pressure, capture point and
/// base of support in m, height of the centre of mass in m, trunk pitch in rad, the active
/// controller, events. Time in s.
///
/// # Errors
/// An empty trajectory or an unknown character.
///
/// ```
/// # use aplomb::framework::prelude::*;
/// # let scenario = Scenario::standing("humanoid", 0.1);
/// # let mut simulation = Simulation::new(&scenario, &aplomb::controllers::registry())?;
/// simulation.record("standing", 0);
/// simulation.run(0.1);
/// let trajectory = simulation.into_recording().expect("it was recorded");
/// let svg = aplomb::render::plot(&trajectory, 0)?;
/// assert!(svg.contains("balance")); // is active
/// assert!(aplomb::render::plot(&trajectory, 1).is_err()); // there is one character
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plot(trajectory: &Trajectory, character: usize) -> Result<String> {
    let (plot, size) = plot::plot(trajectory, character, film::WIDTH)?;
    Ok(style::document(size, plot))
}

/// One step as SVG, of the camera's size in px.
///
/// # Errors
/// An empty trajectory, or a step that it does not have.
pub fn frame(trajectory: &Trajectory, step: usize, camera: &Camera) -> Result<String> {
    drawable(trajectory, 0)?;
    if step >= trajectory.len() {
        bail!(
            "there is no step {step}; the trajectory has {}, counted from 0",
            trajectory.len()
        );
    }
    let frame = scene::Scene::new(trajectory).moving(step, camera);
    Ok(style::document([camera.width, camera.height], frame))
}

/// The film strip, on request with the first character's plot below it, as SVG.
fn picture(trajectory: &Trajectory, with_plot: bool) -> Result<String> {
    let options = FilmOptions::default();
    let (strip, [width, height]) = film::strip(trajectory, &options)?;
    if !with_plot {
        return Ok(style::document([width, height], strip));
    }
    let (plot, size) = plot::plot(trajectory, options.character, width)?;
    let below = Group::new()
        .set("transform", format!("translate(0 {height})"))
        .add(plot);
    let both = Group::new().add(strip).add(below);
    Ok(style::document([width, height + size[1]], both))
}

/// Draws into a file, whole or not at all: a film strip for `.svg` and `.png`, with `plot` the
/// plot below it; an animation for `.gif` and `.mp4`.
///
/// # Errors
/// Another extension, an empty trajectory, a file that cannot be written; for `.mp4` also a
/// missing `ffmpeg`.
///
/// ```
/// # use aplomb::framework::prelude::*;
/// # let scenario = Scenario::standing("humanoid", 0.1);
/// # let mut simulation = Simulation::new(&scenario, &aplomb::controllers::registry())?;
/// simulation.record("standing", 0);
/// simulation.run(0.1);
/// let trajectory = simulation.into_recording().expect("it was recorded");
/// let folder = tempfile::tempdir()?;
/// aplomb::render::write(&trajectory, &folder.path().join("standing.svg"), true)?;
/// assert!(aplomb::render::write(&trajectory, &folder.path().join("standing.bmp"), true).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(trajectory: &Trajectory, path: &Path, plot: bool) -> Result<()> {
    let extension = path
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    let bytes = match extension.to_ascii_lowercase().as_str() {
        "svg" => picture(trajectory, plot)?.into_bytes(),
        "png" => png(&picture(trajectory, plot)?, PNG_SCALE)?,
        "gif" => {
            let mut bytes = Vec::new();
            gif(trajectory, &mut bytes, &AnimationOptions::default())?;
            bytes
        }
        "mp4" => mp4(trajectory, &AnimationOptions::video())?,
        "" => bail!("{} has no extension; accepted: {FORMATS}", path.display()),
        other => bail!("cannot draw into a .{other} file; accepted: {FORMATS}"),
    };
    write_atomically(path, &bytes).context("the picture was not written")
}

#[cfg(test)]
mod tests;

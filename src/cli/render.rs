//! `aplomb render`: a recorded run as a picture or an animation.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Result, ensure};
use aplomb::framework::run::Trajectory;
use clap::Args;

use super::Ending;
use super::output::check_picture;

/// Draw a recorded run
///
/// Draws a trajectory file: a film strip as .svg or .png, an animation as .gif, or as .mp4 where
/// ffmpeg is installed. The file's name decides.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  aplomb run --push 1:torso:-120 --record fall.trajectory
  aplomb render fall.trajectory -o fall.svg --plot")]
pub(super) struct RenderArgs {
    /// A trajectory file, as written by --record
    trajectory: PathBuf,
    /// The picture: .svg, .png, .gif or .mp4
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Adds centre of mass and pressure, support and the active controller over time (.svg, .png)
    #[arg(long)]
    plot: bool,
}

impl RenderArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        check_picture(&self.output)?;
        let trajectory = Trajectory::read(&self.trajectory)?;
        ensure!(
            !trajectory.is_empty(),
            "{}: the trajectory is empty, no step was recorded",
            self.trajectory.display()
        );
        aplomb::render::write(&trajectory, &self.output, self.plot)?;
        writeln!(out, "drawn into {}", self.output.display())?;
        Ok(Ending::Done)
    }
}

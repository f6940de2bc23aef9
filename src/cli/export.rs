//! `aplomb export`: a recorded run for other programs.
//!
//! trajectory file → rows → CSV, by the extension of the output. Row by row: the table is never in
//! memory as a whole.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use aplomb::framework::input::{Error, stream_atomically};
use aplomb::framework::run::Trajectory;
use aplomb::table::write_csv;
use clap::Args;

use super::Ending;
use super::output::check_writable;
use super::values::number;

/// The formats that are written.
const FORMATS: [&str; 1] = ["csv"];

/// Write a recorded run for other programs
///
/// Writes a trajectory file as CSV: a header line, then a row a step. `time`; for each character
/// NAME.active, NAME.x, .y, .pitch and every NAME.JOINT, the same velocities as NAME.v.…, NAME.com_x,
/// com_y, com_vx, com_vy, grf_x, grf_y (ground reaction force), cop_x, support_rear, support_front,
/// reference_x, and the frame of every link, NAME.LINK.x, .y, .angle; for each prop its frame. SI and
/// radians; what is not there is empty. A second character of a name is NAME_2.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  aplomb run --push 1:torso:-60 --record push.trajectory
  aplomb export push.trajectory -o push.csv --every 10")]
pub(super) struct ExportArgs {
    /// A trajectory file, as written by --record
    trajectory: PathBuf,
    /// The file that is written: .csv
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// A row every MS milliseconds, of the nearest step, instead of a row a step
    #[arg(long, value_name = "MS", value_parser = number(0.001, 1e7, "ms"),
          allow_negative_numbers = true)]
    every: Option<f64>,
}

impl ExportArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        check_format(&self.output)?;
        check_writable(&self.output)?;
        let trajectory = Trajectory::read(&self.trajectory)?;
        let dt = trajectory.header.dt;
        let every = self.every.map_or(dt, |ms| 1e-3 * ms);
        if every < dt * (1.0 - 1e-9) {
            bail!(Error::invalid(
                "--every",
                "MS",
                1e3 * every,
                format!("at least the recording's step, {} ms", 1e3 * dt)
            ));
        }
        let mut rows = 0;
        stream_atomically(&self.output, |file| {
            rows = write_csv(&trajectory, every, file)?;
            Ok(())
        })?;
        writeln!(out, "{rows} rows written to {}", self.output.display())?;
        Ok(Ending::Done)
    }
}

/// Refuses an extension that stands for no format.
fn check_format(path: &Path) -> Result<()> {
    let extension = path.extension().unwrap_or_default();
    let extension = extension.to_string_lossy().to_ascii_lowercase();
    if FORMATS.contains(&extension.as_str()) {
        return Ok(());
    }
    let found = match extension.as_str() {
        "" => "its name has no extension".to_owned(),
        other => format!("it is a .{other} file"),
    };
    bail!(Error::Write {
        path: path.to_owned(),
        reason: format!("{found}; accepted: .{}", FORMATS.join(", .")),
    })
}

//! Recorded runs as tables for other programs.
//!
//! [`Trajectory`] → rows → CSV.

use std::io::Write;

use aplomb_framework::run::{Datum, Export, Trajectory};

/// Bytes between two writes to the file.
const BUFFER: usize = 1 << 16;

/// Writes a recording as CSV, a row every so many s; returns how many rows there are.
///
/// # Errors
/// Those of the file.
///
/// ```
/// use aplomb::framework::{run::Simulation, scenario::Scenario};
///
/// let scenario = Scenario::standing("humanoid", 0.01);
/// let mut simulation = Simulation::new(&scenario, &aplomb::controllers::registry())?;
/// simulation.record("standing", 0);
/// simulation.run(0.01);
/// let recording = simulation.into_recording().expect("it was recorded");
/// let mut table = Vec::new();
/// assert_eq!(aplomb::table::write_csv(&recording, 0.001, &mut table)?, 10);
/// assert!(table.starts_with(b"time,humanoid.active,"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_csv(trajectory: &Trajectory, every: f64, file: impl Write) -> std::io::Result<usize> {
    let mut export = Export::new(trajectory);
    let mut csv = csv::WriterBuilder::new()
        .buffer_capacity(BUFFER)
        .from_writer(file);
    csv.write_record(export.columns())?;
    let (mut row, mut text, mut rows) = (Vec::new(), Vec::new(), 0);
    for step in export.steps(every) {
        export.row(step, &mut row);
        for datum in &row {
            text.clear();
            match datum {
                Datum::Time(s) => write!(text, "{s}")?,
                Datum::Number(x) => write!(text, "{x}")?,
                Datum::Name(name) => text.extend(name.as_bytes()),
                Datum::Nothing => {}
            }
            csv.write_field(&text)?;
        }
        csv.write_record(None::<&[u8]>)?;
        rows += 1;
    }
    csv.flush()?;
    Ok(rows)
}

//! What was done in a live run, as files.
//!
//! [`Session`] → [`Replay`] → scenario text, recording, table.

use aplomb_framework::input::{Error, Result};
use aplomb_framework::run::{Simulation, Trajectory, row_width};
use aplomb_framework::scenario::{Number, Scenario, ScheduledInput};

use crate::live::history::History;
use crate::live::session::Session;
use crate::table;

/// The longest recording in memory, bytes.
const LARGEST_RECORDING: f64 = 1e9;

/// A run that can be done again, apart from the session that it was done in.
#[derive(Debug)]
pub struct Replay {
    beginning: Simulation,
    scenario: Scenario,
    history: History,
    end: u64,
    /// Whether files changed during the run.
    reloaded: bool,
}

impl Session {
    /// What was done so far.
    #[must_use]
    pub fn replay(&self) -> Replay {
        Replay {
            beginning: self.history.beginning().clone(),
            scenario: self.scene.scenario.clone(),
            history: self.history.without_snapshots(),
            end: self.end,
            reloaded: self.history.reloaded(),
        }
    }
}

impl Replay {
    /// s that a stretch of it lasts, with both of its ends in steps.
    pub(super) fn duration(&self, [from, to]: [Option<usize>; 2]) -> f64 {
        let end = |step: Option<usize>| step.map_or(self.end, |s| self.end.min(s as u64));
        let steps = end(to).saturating_sub(end(Some(from.unwrap_or(0))));
        steps as f64 * self.scenario.settings.dt
    }

    /// The files that can be saved without drawing.
    pub const FILES: [&str; 3] = ["session.ron", "session.trajectory", "session.csv"];

    /// What was done, as the bytes of one of [`Self::FILES`].
    ///
    /// # Errors
    /// Another name; as [`Self::scenario`] and [`Self::recording`].
    pub fn file(self, name: &str) -> Result<Vec<u8>> {
        match name {
            "session.ron" => self.scenario().map(String::into_bytes),
            "session.trajectory" => self.recording()?.to_bytes(),
            "session.csv" => {
                let recording = self.recording()?;
                let mut bytes = Vec::new();
                table::write_csv(&recording, recording.header.dt, &mut bytes)
                    .map_err(|e| Error::refused("recording", e, "a table"))?;
                Ok(bytes)
            }
            _ => Err(Error::unknown("file", name, Self::FILES)),
        }
    }

    /// A scenario that does the same. Files that changed during the run are not in it.
    ///
    /// # Errors
    /// What no scenario file can say.
    pub fn scenario(&self) -> Result<String> {
        let mut scenario = self.scenario.clone();
        scenario.duration = (self.end.max(1) as f64) * scenario.settings.dt;
        scenario.expect.clear();
        let dt = scenario.settings.dt;
        let begun = |at: &Number| {
            let at = scenario.number(at).unwrap_or(f64::INFINITY);
            at < self.end as f64 * dt
        };
        let own = scenario.events.iter().filter(|e| begun(e.at()));
        let events = own.chain(self.history.scheduled()).cloned().collect();
        scenario.events = events;
        scenario.validate().map_err(|e| scenario.locate(e))?;
        let mut text = String::from("// What was done in a live view.\n");
        if self.reloaded {
            text.push_str("// Files of its controllers changed during the run; here they are as they are now.\n");
        }
        text.push_str(&scenario.to_text()?);
        text.push('\n');
        Ok(text)
    }

    /// The run, done again and recorded.
    ///
    /// # Errors
    /// A recording that would take more than 1 GB.
    pub fn recording(self) -> Result<Trajectory> {
        let models = self.beginning.world().characters().iter();
        let width = row_width(models.map(|c| c.body.model()), 0);
        if 4.0 * width as f64 * self.end as f64 > LARGEST_RECORDING {
            let problem = format!("{} steps long", self.end);
            return Err(Error::refused("run", problem, "at most 1 GB in memory"));
        }
        let thrown = self.history.scheduled().filter_map(|input| match input {
            ScheduledInput::Throw { at, prop } => {
                let at = self.scenario.number(at).ok()?;
                Some((at, self.scenario.prop(prop).ok()?))
            }
            _ => None,
        });
        let thrown = thrown.collect();
        let mut run = self.beginning;
        run.record_with(&self.scenario.name, self.scenario.seed, thrown);
        for step in 0..self.end {
            self.history.repeat(&mut run, &self.scenario, step);
            run.step();
        }
        let empty = || Error::refused("run", "not recorded", "a run");
        run.into_recording().ok_or_else(empty)
    }
}

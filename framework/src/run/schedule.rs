//! What is still to be done to the characters of a run.
//!
//! scheduled inputs → [`Schedule`] → what is due at a step.

use crate::character::Model;
use crate::control::Supervisor;
use crate::input::{Error, Result};
use crate::scenario::{Number, Scenario, ScheduledInput};

/// What is done to a character.
#[derive(Debug, Clone)]
pub(crate) enum Input {
    /// A push at a link's centre of mass.
    Push {
        /// Place of the link.
        link: usize,
        /// N·s, forward positive.
        impulse: f64,
        /// s over which it is spread.
        over: f64,
    },
    /// A command string.
    Command(String),
}

/// An input at its time.
#[derive(Debug, Clone)]
pub(crate) struct TimedInput {
    /// s
    pub(crate) time: f64,
    /// Place of the character.
    pub(crate) character: usize,
    /// What is done.
    pub(crate) input: Input,
}

impl TimedInput {
    /// What is scheduled by the scenario to a character of this model and supervisor.
    ///
    /// # Errors
    /// An unknown link or parameter, a malformed command or one that the supervisor does not answer
    /// to: by the way from the event.
    pub(crate) fn new(
        event: &ScheduledInput,
        scenario: &Scenario,
        model: &Model,
        supervisor: &Supervisor,
    ) -> Result<Self> {
        let number = |field: &str, n: &Number| scenario.number(n).map_err(|e| e.inside(field));
        match event {
            ScheduledInput::Push {
                at,
                link,
                impulse,
                over,
                character,
            } => Ok(Self {
                time: number("at", at)?,
                character: *character,
                input: Input::Push {
                    link: model.link_index(link).map_err(|e| e.inside("link"))?,
                    impulse: number("impulse", impulse)?,
                    over: *over,
                },
            }),
            ScheduledInput::Command {
                at,
                text,
                character,
            } => {
                // A trial on a clone: commands that nobody answers to are found before the run.
                let of = |e: Error| e.inside("text");
                let text = scenario.filled(text).map_err(of)?;
                supervisor.clone().command(&text).map_err(of)?;
                Ok(Self {
                    time: number("at", at)?,
                    character: *character,
                    input: Input::Command(text),
                })
            }
        }
    }
}

/// Inputs by time, the next last.
#[derive(Debug, Clone, Default)]
pub(crate) struct Schedule(Vec<TimedInput>);

impl Schedule {
    /// Adds an input. It goes before its equals, which are then taken from the end first: first
    /// scheduled, first done.
    pub(crate) fn add(&mut self, timed: TimedInput) {
        let place = self.0.partition_point(|t| t.time > timed.time);
        self.0.insert(place, timed);
    }

    /// Takes out the next input if its time is before `due`.
    pub(crate) fn next_before(&mut self, due: f64) -> Option<TimedInput> {
        self.0.pop_if(|t| t.time < due)
    }
}

//! What is still to be done in a run.
//!
//! scheduled inputs → [`Schedule`] → what is due at a step.

use crate::character::{Model, Point};
use crate::control::Supervisor;
use crate::input::{Error, Result};
use crate::scenario::{Changeable, Number, Scenario, ScheduledInput};
use crate::world::{Prop, Pull};

/// What is done.
#[derive(Debug, Clone)]
pub(crate) enum Input {
    /// A push at a link's centre of mass.
    Push {
        /// Place of the link.
        link: usize,
        /// N·s, forward and up.
        impulse: Point,
        /// s over which it is spread.
        over: f64,
    },
    /// A command string.
    Command(String),
    /// A prop appears.
    Throw(Box<Prop>),
    /// A spring drags.
    Drag(Pull),
    /// It lets go.
    Release,
    /// A setting of the world changes.
    Set(Changeable, f64),
}

/// An input at its time.
#[derive(Debug, Clone)]
pub(crate) struct TimedInput {
    /// s
    pub(crate) time: f64,
    /// Place of the character; the first of what is done to none.
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
        let input = match event {
            ScheduledInput::Push {
                link,
                impulse,
                upward,
                over,
                ..
            } => Input::Push {
                link: model.link_index(link).map_err(|e| e.inside("link"))?,
                impulse: [number("impulse", impulse)?, number("upward", upward)?],
                over: *over,
            },
            ScheduledInput::Command { text, .. } => {
                // A trial on a clone: commands that nobody answers to are found before the run.
                let of = |e: Error| e.inside("text");
                let text = scenario.filled(text).map_err(of)?;
                supervisor.clone().command(&text).map_err(of)?;
                Input::Command(text)
            }
            ScheduledInput::Throw { prop, .. } => {
                let prop = scenario.prop(prop).map_err(|e| e.inside("prop"))?;
                Input::Throw(Box::new(prop))
            }
            ScheduledInput::Drag {
                what, point, to, ..
            } => {
                let dragged = what.resolved(model).map_err(|e| e.inside("what"))?;
                Input::Drag(Pull::new(dragged, *point, *to))
            }
            ScheduledInput::Release { .. } => Input::Release,
            ScheduledInput::Set { setting, value, .. } => {
                Input::Set(*setting, number("value", value)?)
            }
        };
        Ok(Self {
            time: number("at", event.at())?,
            character: event.character(),
            input,
        })
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

    /// The props that are still to appear, in their order, each with its time, s.
    pub(crate) fn props(&self) -> impl Iterator<Item = (f64, &Prop)> {
        self.0.iter().rev().filter_map(|t| match &t.input {
            Input::Throw(prop) => Some((t.time, &**prop)),
            _ => None,
        })
    }
}

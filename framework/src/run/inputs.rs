//! What is done to a run from outside, now: pushes, commands, things thrown and dragged, settings.
//!
//! an input → world, supervisor → events.

use crate::events::{Event, EventKind, Unmet};
use crate::input::{Error, Result};
use crate::run::simulation::Simulation;
use crate::scenario::{Changeable, MOST_ENTRIES, PUSH_DURATION};
use crate::world::{Dragged, Prop, Pull};

impl Simulation {
    /// Pushes a character's link now: horizontal impulse in N·s over 0.1 s.
    ///
    /// # Errors
    /// An unknown link, or an impulse that is not finite.
    pub fn push(&mut self, character: usize, link: &str, impulse: f64) -> Result<()> {
        self.shove(character, link, [impulse, 0.0], PUSH_DURATION)
    }

    /// Pushes a character's link now, in any direction: impulse in N·s, forward and up, spread over
    /// a time, s.
    ///
    /// # Errors
    /// An unknown link; an impulse that is not finite; a time that is not from 0 to 60 s.
    pub fn shove(
        &mut self,
        character: usize,
        link: &str,
        impulse: [f64; 2],
        over: f64,
    ) -> Result<()> {
        let link = self.model(character).link_index(link)?;
        if let Some(bad) = impulse.iter().find(|i| !i.is_finite()) {
            let accepted = "a finite number of N·s";
            return Err(Error::invalid("push", "impulse", bad, accepted));
        }
        if !(0.0..=60.0).contains(&over) {
            return Err(Error::invalid("push", "over", over, "0 to 60 s"));
        }
        self.do_push(character, link, impulse, over);
        Ok(())
    }

    /// Gives a character a command now.
    ///
    /// # Errors
    /// A malformed command, or one that nobody answers to, with the nearest name.
    pub fn command(&mut self, character: usize, text: &str) -> Result<()> {
        let given = self.actors[character].supervisor.command(text);
        given.inspect_err(|e| {
            let kind = EventKind::Command {
                text: text.to_owned(),
                accepted: false,
            };
            self.note(character, kind);
            let kind = EventKind::Refused {
                command: text.to_owned(),
                controller: None,
                unmet: Unmet::plain(e.to_string()),
            };
            self.note(character, kind);
        })
    }

    pub(super) fn do_push(&mut self, character: usize, link: usize, impulse: [f64; 2], over: f64) {
        let name = self.model(character).links[link].name.clone();
        self.world.push(character, link, impulse, over);
        let kind = EventKind::Push {
            link: name,
            impulse,
        };
        self.note(character, kind);
    }

    /// A prop appears, unless there are already as many as there may be.
    pub(super) fn throw(&mut self, prop: &Prop) {
        if self.world.props().count() < MOST_ENTRIES {
            self.world.add_prop(prop);
            let prop = prop.name.clone();
            self.note(0, EventKind::Thrown { prop });
        }
    }

    /// A spring begins to drag, or the one that does moves on. What is not there is not dragged.
    pub(super) fn drag(&mut self, pull: Pull) {
        let (character, body) = match pull.dragged {
            Dragged::Link { character, link } => {
                (character, self.model(character).links[link].name.clone())
            }
            Dragged::Prop(place) => match self.world.props().nth(place) {
                Some(prop) => (0, prop.name.clone()),
                None => return,
            },
        };
        let before = self.world.pull().map(|p| (p.dragged, p.point));
        self.world.set_pull(Some(pull));
        if before != Some((pull.dragged, pull.point)) {
            self.note(character, EventKind::Dragged { body });
        }
    }

    pub(super) fn release(&mut self) {
        if self.world.pull().is_some() {
            self.world.set_pull(None);
            self.note(0, EventKind::Released);
        }
    }

    pub(super) fn change(&mut self, setting: Changeable, value: f64) {
        match setting {
            Changeable::Friction => self.world.set_friction(value),
            Changeable::Gravity => self.world.set_gravity(value),
        }
        let name = setting.name().to_owned();
        self.note(0, EventKind::Set { name, value });
    }

    /// Something happened now.
    fn note(&mut self, character: usize, kind: EventKind) {
        self.events.push(Event {
            time: self.world.time(),
            character,
            kind,
        });
    }
}

//! What a watcher asks for is done between two steps.
//!
//! [`Request`] → input of the run, or what changes about the session.

use aplomb_framework::input::{Error, Result, Source};
use aplomb_framework::scenario::{
    Changeable, DragTarget, MOST_INPUTS, Number, PUSH_DURATION, ScheduledInput,
};

use crate::live::frame::View;
use crate::live::history::Deed;
use crate::live::request::{DragBody, Request, Thrown};
use crate::live::scene::SceneNames;
use crate::live::session::Session;

impl Session {
    /// Does what is asked for. `view` is the watcher's.
    ///
    /// # Errors
    /// What cannot be done, and why; nothing has changed then.
    pub fn ask(&mut self, view: &mut View, request: Request) -> Result<()> {
        match request {
            Request::Play if self.is_over() => {
                let accepted = "an hour at the longest; reset to begin anew";
                return Err(Error::refused("run", "over", accepted));
            }
            Request::Play => self.paused = false,
            Request::Pause => self.paused = true,
            Request::Step { steps } => {
                self.paused = true;
                for _ in 0..steps {
                    self.forward();
                }
            }
            Request::Speed { factor } => self.speed = factor,
            Request::Seek { step } => self.seek(step),
            Request::Branch => self.branch(),
            Request::Push {
                character,
                link,
                impulse: [impulse, upward],
            } => self.act(ScheduledInput::Push {
                at: self.at(),
                link,
                impulse: impulse.into(),
                upward: upward.into(),
                over: PUSH_DURATION,
                character: self.existing(character)?,
            })?,
            Request::Command { character, text } => self.act(ScheduledInput::Command {
                at: self.at(),
                text,
                character: self.existing(character)?,
            })?,
            Request::Drag { body, point, to } => {
                let what = self.target(&body)?;
                let at = self.at();
                self.act(ScheduledInput::Drag {
                    at,
                    what,
                    point,
                    to,
                })?;
            }
            Request::Release => self.act(ScheduledInput::Release { at: self.at() })?,
            Request::Throw(thrown) => self.throw(&thrown)?,
            Request::Set { name, value } => self.set(&name, value)?,
            Request::Reset => self.begin(self.scene.clone())?,
            Request::Load {
                scenario,
                character,
                repertoire,
            } => {
                let names = SceneNames {
                    scenario,
                    character,
                    repertoire,
                };
                names.check_shipped(&self.registry)?;
                self.begin(names.scene(&self.registry)?)?;
            }
            Request::Open { name, text } => {
                self.begin(self.scene.with(&Source::new(name, text), &self.registry)?)?;
            }
            Request::Watch { features } => view.watch(&features, &self.now)?,
            Request::Inspect {
                character,
                controller,
            } => {
                let character = self.existing(character)?;
                let pool = self.now.actors()[character].supervisor.controllers();
                view.inspect = controller
                    .filter(|c| *c < pool.count())
                    .map(|c| (character, c));
            }
        }
        Ok(())
    }

    /// Now, as the time of an input.
    fn at(&self) -> Number {
        (self.step as f64 * self.dt()).into()
    }

    fn existing(&self, character: usize) -> Result<usize> {
        if character < self.now.actors().len() {
            return Ok(character);
        }
        let accepted = format!("below {}", self.now.actors().len());
        Err(Error::refused("character", character, accepted))
    }

    fn act(&mut self, input: ScheduledInput) -> Result<()> {
        if self.history.inputs() >= MOST_INPUTS - self.scene.scenario.events.len() {
            let accepted = "fewer inputs; reset to begin anew";
            return Err(Error::refused("inputs", MOST_INPUTS, accepted));
        }
        if self.is_past() {
            self.branch();
        }
        let deed = Deed::Input(input);
        self.history
            .act(&mut self.now, &self.scene.scenario, self.step, deed)
    }

    fn target(&self, body: &DragBody) -> Result<DragTarget> {
        match (&body.link, &body.prop) {
            (Some(name), None) => Ok(DragTarget::Link {
                name: name.clone(),
                character: self.existing(body.character)?,
            }),
            (None, Some(name)) => {
                let props: Vec<&str> = self.now.world().props().map(|p| p.name.as_str()).collect();
                let place = props.iter().position(|p| p == name);
                let place = place.ok_or_else(|| Error::unknown("prop", name, props))?;
                Ok(DragTarget::Prop(place))
            }
            _ => Err(Error::refused(
                "drag",
                "of nothing or of two",
                "a link or a prop",
            )),
        }
    }

    fn throw(&mut self, thrown: &Thrown) -> Result<()> {
        let kind = thrown.kind();
        let taken: Vec<&str> = self.now.world().props().map(|p| p.name.as_str()).collect();
        let free = |name: &String| !taken.contains(&name.as_str());
        let mut names =
            std::iter::once(kind.to_owned()).chain((2..).map(|n| format!("{kind}_{n}")));
        let name = names.find(free).unwrap_or_default();
        let at = self.at();
        let prop = thrown.prop(name);
        self.act(ScheduledInput::Throw {
            at,
            prop: Box::new(prop),
        })
    }

    /// Friction and gravity change at once; all else, and parameters of the scenario with their
    /// names, is how a run begins.
    fn set(&mut self, name: &str, value: f64) -> Result<()> {
        // The scenario's own bounds, also for what takes effect at once.
        let mut changed = self.scene.clone();
        changed.scenario.set(name, value)?;
        let own = changed.scenario.parameters.contains_key(name);
        let setting = match name {
            "friction" if !own => Changeable::Friction,
            "gravity" if !own => Changeable::Gravity,
            _ => return self.begin(changed),
        };
        self.act(ScheduledInput::Set {
            at: self.at(),
            setting,
            value: value.into(),
        })
    }
}

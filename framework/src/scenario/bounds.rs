//! Every bound that a scenario must keep.
//!
//! [`Scenario`] → nothing, or the first field that is out of bounds.

use crate::character::{Point, Shape};
use crate::input::{Error, FieldPath, Result, check};
use crate::scenario::expectation::Expectation;
use crate::scenario::file::{Scenario, Start};
use crate::scenario::limits::{LONGEST_RUN, MOST_CHARACTERS, MOST_ENTRIES, MOST_INPUTS};
use crate::scenario::number::Adjustable;
use crate::scenario::props::{HingeEntry, PropEntry};
use crate::scenario::scheduled::ScheduledInput;
use crate::world::Settings;

/// The furthest that anything may be from its frame's origin, m.
const FURTHEST: f64 = 1e3;

impl Scenario {
    /// Checks every bound.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the way to the field and what is accepted; see [`Self::locate`].
    pub fn validate(&self) -> Result<()> {
        check::within("duration", self.duration, 1e-3..=LONGEST_RUN)?;
        check_settings(&self.settings).map_err(|e| e.inside("settings"))?;
        let cast = 1..=MOST_CHARACTERS;
        check::count("characters", self.characters.len(), cast, "characters")?;
        for (field, len) in [
            ("props", self.props.len()),
            ("joints", self.joints.len()),
            ("expect", self.expect.len()),
            ("parameters", self.parameters.len()),
        ] {
            check::count(field, len, 0..=MOST_ENTRIES, "entries")?;
        }
        check::count("events", self.events.len(), 0..=MOST_INPUTS, "entries")?;
        for (name, p) in &self.parameters {
            let of = |e: Error| e.inside(FieldPath::entry(name)).inside("parameters");
            check_parameter(p).map_err(of)?;
        }
        for (i, role) in self.characters.iter().enumerate() {
            let start = check_start(&role.start);
            start.map_err(|e| e.inside("start").inside(("characters", i)))?;
        }
        for (i, prop) in self.props.iter().enumerate() {
            let of = |e: Error| e.inside(("props", i));
            self.check_prop(prop).map_err(of)?;
        }
        for (i, hinge) in self.joints.iter().enumerate() {
            let of = |e: Error| e.inside(("joints", i));
            self.check_hinge(hinge).map_err(of)?;
        }
        for (i, event) in self.events.iter().enumerate() {
            let of = |e: Error| e.inside(("events", i));
            self.check_event(event).map_err(of)?;
        }
        for (i, expectation) in self.expect.iter().enumerate() {
            let of = |e: Error| e.inside(("expect", i));
            self.check_expectation(expectation).map_err(of)?;
        }
        Ok(())
    }

    fn check_character(&self, character: usize) -> Result<()> {
        let last = self.characters.len() as f64 - 1.0;
        check::within("character", character as f64, 0.0..=last)
    }

    fn check_prop(&self, entry: &PropEntry) -> Result<()> {
        self.check_number("mass", &entry.mass, 0.0..=1e6)?;
        self.check_number("friction", &entry.friction, 0.0..=10.0)?;
        self.check_number("restitution", &entry.restitution, 0.0..=1.0)?;
        self.check_number("angle", &entry.angle, -10.0..=10.0)?;
        self.check_number("grip", &entry.grip, 0.0..=1e6)?;
        self.check_point("position", &entry.position, FURTHEST)?;
        self.check_point("velocity", &entry.velocity, FURTHEST)?;
        check_shape(entry.shape).map_err(|e| e.inside("shape"))
    }

    fn check_hinge(&self, entry: &HingeEntry) -> Result<()> {
        self.check_point("at", &entry.at, FURTHEST)?;
        if let Some(to_at) = &entry.to_at {
            self.check_point("to_at", to_at, FURTHEST)?;
        }
        if let Some(breaks) = &entry.breaks {
            self.check_number("breaks", breaks, 1e-3..=1e9)?;
        }
        self.hinge(entry).map(drop)
    }

    fn check_event(&self, event: &ScheduledInput) -> Result<()> {
        match event {
            ScheduledInput::Push {
                impulse,
                upward,
                over,
                ..
            } => {
                self.check_number("impulse", impulse, -1e5..=1e5)?;
                self.check_number("upward", upward, -1e5..=1e5)?;
                check::within("over", *over, 1e-4..=60.0)?;
            }
            ScheduledInput::Command { text, .. } => {
                self.filled(text).map_err(|e| e.inside("text"))?;
            }
            ScheduledInput::Throw { prop, .. } => {
                self.check_prop(prop).map_err(|e| e.inside("prop"))?;
            }
            ScheduledInput::Drag { point, to, .. } => {
                check::point(*point, FURTHEST).map_err(|e| e.inside("point"))?;
                check::point(*to, FURTHEST).map_err(|e| e.inside("to"))?;
            }
            ScheduledInput::Release { .. } => {}
            ScheduledInput::Set { setting, value, .. } => {
                self.check_number("value", value, setting.accepted())?;
            }
        }
        self.check_number("at", event.at(), 0.0..=LONGEST_RUN)?;
        self.check_character(event.character())
    }

    fn check_expectation(&self, expectation: &Expectation) -> Result<()> {
        match expectation {
            Expectation::Standing { character } | Expectation::Balanced { character } => {
                self.check_character(*character)
            }
            Expectation::Holds { at, character, .. } => {
                self.check_number("at", at, 0.0..=LONGEST_RUN)?;
                self.check_character(*character)
            }
            Expectation::Reaches {
                before, character, ..
            } => {
                self.check_number("before", before, 0.0..=LONGEST_RUN)?;
                self.check_character(*character)
            }
            Expectation::Prop {
                name, min, max, at, ..
            } => {
                self.prop_index(name).map_err(|e| e.inside("name"))?;
                self.check_number("at", at, 0.0..=LONGEST_RUN)?;
                let any = f64::NEG_INFINITY..=f64::INFINITY;
                self.check_number("min", min, any)?;
                let least = self.number(min)?;
                self.check_number("max", max, least..=f64::INFINITY)
            }
            Expectation::Active {
                before, character, ..
            }
            | Expectation::Posture {
                before, character, ..
            } => {
                check::within("before", *before, 0.0..=LONGEST_RUN)?;
                self.check_character(*character)
            }
        }
    }
}

fn check_settings(s: &Settings) -> Result<()> {
    check::within("dt", s.dt, 1e-5..=0.01)?;
    check::within("gravity", s.gravity, 0.0..=100.0)?;
    check::within("friction", s.friction, 0.0..=10.0)?;
    check::within("contact_frequency", s.contact_frequency, 1.0..=1000.0)?;
    check::within("contact_damping", s.contact_damping, 0.0..=100.0)?;
    check::within("iterations", s.iterations as f64, 1.0..=64.0)?;
    check::within("torque", s.torque, 0.01..=100.0)?;
    check::within("mass", s.mass, 0.01..=100.0)
}

/// A default written alone has no fields: it is itself told.
fn check_parameter(p: &Adjustable) -> Result<()> {
    check::within("min", p.min, -1e6..=p.max.min(1e6))?;
    check::within("max", p.max, p.min..=1e6)?;
    check::within("default", p.value, p.min..=p.max)
}

fn check_start(start: &Start) -> Result<()> {
    check::within("x", start.x, -FURTHEST..=FURTHEST)?;
    check::within("lift", start.lift, 0.0..=100.0)?;
    check::within("pitch", start.pitch, -10.0..=10.0)?;
    for (joint, angle) in &start.angles {
        let of = |e: Error| e.inside(FieldPath::entry(joint)).inside("angles");
        check::within("", *angle, -10.0..=10.0).map_err(of)?;
    }
    Ok(())
}

fn check_shape(shape: Shape) -> Result<()> {
    let point = |field: &str, p: Point| {
        let near = check::point(p, FURTHEST);
        near.map_err(|e| e.inside(field))
    };
    let length = |field, length| check::within(field, length, 1e-3..=100.0);
    shape.check(length, point)
}

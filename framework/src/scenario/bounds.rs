//! Every bound that a scenario must keep.
//!
//! [`Scenario`] → nothing, or the first field that is out of bounds, where it stands.

use crate::character::Point;
use crate::input::{Error, Result, Source};
use crate::scenario::expectation::Expectation;
use crate::scenario::file::{Scenario, ScheduledInput};
use crate::scenario::limits::{LONGEST_RUN, MOST_CHARACTERS, MOST_ENTRIES};
use crate::scenario::number::Number;
use crate::scenario::props::{HingeEntry, PropEntry};

impl Scenario {
    /// Checks every bound.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the field and what is accepted.
    pub fn validate(&self, source: &Source) -> Result<()> {
        let check = |field: &str, value: f64, low: f64, high: f64| {
            if value >= low && value <= high {
                Ok(())
            } else {
                let needle = field.rsplit('.').next().unwrap_or(field);
                let (place, accepted) =
                    (source.place_of(needle, value), format!("{low} to {high}"));
                Err(Error::invalid(place, field, value, accepted))
            }
        };
        check("duration", self.duration, 1e-3, LONGEST_RUN)?;
        let s = &self.settings;
        check("settings.dt", s.dt, 1e-5, 0.01)?;
        check("settings.gravity", s.gravity, 0.0, 100.0)?;
        check("settings.friction", s.friction, 0.0, 10.0)?;
        check(
            "settings.contact_frequency",
            s.contact_frequency,
            1.0,
            1000.0,
        )?;
        check("settings.contact_damping", s.contact_damping, 0.0, 100.0)?;
        check("settings.iterations", s.iterations as f64, 1.0, 64.0)?;
        check("settings.torque", s.torque, 0.01, 100.0)?;
        check("settings.mass", s.mass, 0.01, 100.0)?;
        check(
            "characters",
            self.characters.len() as f64,
            1.0,
            MOST_CHARACTERS as f64,
        )?;
        for (field, len) in [
            ("props", self.props.len()),
            ("joints", self.joints.len()),
            ("events", self.events.len()),
            ("expect", self.expect.len()),
            ("parameters", self.parameters.len()),
        ] {
            check(field, len as f64, 0.0, MOST_ENTRIES as f64)?;
        }
        for (name, p) in &self.parameters {
            let field = format!("parameters.{name}");
            check(&format!("{field}.min"), p.min, -1e6, p.max.min(1e6))?;
            check(&format!("{field}.max"), p.max, p.min, 1e6)?;
            check(&field, p.value, p.min, p.max)?;
        }
        for role in &self.characters {
            let start = &role.start;
            check("start.x", start.x, -1e3, 1e3)?;
            check("start.lift", start.lift, 0.0, 100.0)?;
            check("start.pitch", start.pitch, -10.0, 10.0)?;
            for (joint, angle) in &start.angles {
                check(&format!("angles.{joint}"), *angle, -10.0, 10.0)?;
            }
        }
        let who = |field: &str, character: usize| {
            check(
                &format!("{field}.character"),
                character as f64,
                0.0,
                self.characters.len() as f64 - 1.0,
            )
        };
        // A number within bounds, be it written out or a parameter's.
        let within = |field: &str, number: &Number, low: f64, high: f64| match number {
            Number::Value(value) => check(field, *value, low, high),
            Number::Parameter(name, _) => self
                .number(number)
                .and_then(|value| check(field, value, low, high))
                .map_err(|e| e.placed(&source.place(&format!("{name}\"")))),
        };
        for prop in &self.props {
            self.validate_prop(source, prop, &check, &within)?;
        }
        for (i, joint) in self.joints.iter().enumerate() {
            self.validate_hinge(source, &format!("joints[{i}]"), joint, &within)?;
        }
        for (i, event) in self.events.iter().enumerate() {
            let field = |name: &str| format!("events[{i}].{name}");
            match event {
                ScheduledInput::Push {
                    at,
                    impulse,
                    over,
                    character,
                    ..
                } => {
                    within(&field("at"), at, 0.0, LONGEST_RUN)?;
                    within(&field("impulse"), impulse, -1e5, 1e5)?;
                    check(&field("over"), *over, 1e-4, 60.0)?;
                    who(&format!("events[{i}]"), *character)?;
                }
                ScheduledInput::Command {
                    at,
                    text,
                    character,
                } => {
                    self.filled(text).map_err(|e| e.at(&source.place(text)))?;
                    within(&field("at"), at, 0.0, LONGEST_RUN)?;
                    who(&format!("events[{i}]"), *character)?;
                }
            }
        }
        for (i, expectation) in self.expect.iter().enumerate() {
            let field = format!("expect[{i}]");
            match expectation {
                Expectation::Standing { character } | Expectation::Balanced { character } => {
                    who(&field, *character)?;
                }
                Expectation::Holds { at, character, .. } => {
                    within(&format!("{field}.at"), at, 0.0, LONGEST_RUN)?;
                    who(&field, *character)?;
                }
                Expectation::Reaches {
                    before, character, ..
                } => {
                    within(&format!("{field}.before"), before, 0.0, LONGEST_RUN)?;
                    who(&field, *character)?;
                }
                Expectation::Prop {
                    name, min, max, at, ..
                } => {
                    let named = self.prop_index(name);
                    named.map_err(|e| e.placed(&source.place(&format!("{name}\""))))?;
                    within(&format!("{field}.at"), at, 0.0, LONGEST_RUN)?;
                    within(
                        &format!("{field}.min"),
                        min,
                        f64::NEG_INFINITY,
                        f64::INFINITY,
                    )?;
                    within(
                        &format!("{field}.max"),
                        max,
                        self.number(min)?,
                        f64::INFINITY,
                    )?;
                }
                Expectation::Active {
                    before, character, ..
                }
                | Expectation::Posture {
                    before, character, ..
                } => {
                    check(&format!("{field}.before"), *before, 0.0, LONGEST_RUN)?;
                    who(&field, *character)?;
                }
            }
        }
        Ok(())
    }

    fn validate_prop(
        &self,
        source: &Source,
        entry: &PropEntry,
        check: &impl Fn(&str, f64, f64, f64) -> Result<()>,
        within: &impl Fn(&str, &Number, f64, f64) -> Result<()>,
    ) -> Result<()> {
        within("mass", &entry.mass, 0.0, 1e6)?;
        within("friction", &entry.friction, 0.0, 10.0)?;
        within("restitution", &entry.restitution, 0.0, 1.0)?;
        within("angle", &entry.angle, -10.0, 10.0)?;
        within("grip", &entry.grip, 0.0, 1e6)?;
        let finite = |field: &str, p: Point| {
            let field = format!("props.{}.{field}", entry.name);
            finite(source, &entry.name, field, p)
        };
        for (field, point) in [("position", &entry.position), ("velocity", &entry.velocity)] {
            let of = |e: Error| e.placed(&source.place(&entry.name));
            finite(field, self.point(point).map_err(of)?)?;
        }
        entry.shape.check(
            |f, length| check(f.split('.').next().unwrap_or(f), length, 1e-3, 100.0),
            |f, point| finite(&format!("shape.{f}"), point),
        )
    }

    fn validate_hinge(
        &self,
        source: &Source,
        field: &str,
        entry: &HingeEntry,
        within: &impl Fn(&str, &Number, f64, f64) -> Result<()>,
    ) -> Result<()> {
        let of = |e: Error| e.placed(&source.place(&format!("prop: \"{}\"", entry.prop)));
        for (name, point) in [("at", Some(&entry.at)), ("to_at", entry.to_at.as_ref())] {
            let Some(point) = point else { continue };
            let (field, point) = (format!("{field}.{name}"), self.point(point).map_err(of)?);
            finite(source, &entry.prop, field, point)?;
        }
        if let Some(breaks) = &entry.breaks {
            within(&format!("{field}.breaks"), breaks, 1e-3, 1e9)?;
        }
        self.hinge(entry).map(drop).map_err(of)
    }
}

fn finite(source: &Source, needle: &str, field: String, p: Point) -> Result<()> {
    if p.iter().all(|c| c.is_finite() && c.abs() <= 1e3) {
        return Ok(());
    }
    let (found, accepted) = (
        format!("({}, {})", p[0], p[1]),
        "finite, at most 1000 either way",
    );
    Err(source.invalid(needle, field, found, accepted))
}

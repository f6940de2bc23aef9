//! Every bound that a scenario must keep.
//!
//! [`Scenario`] → nothing, or the first field that is out of bounds, where it stands.

use crate::error::{Error, Result};
use crate::file::Source;
use crate::model::{Point, Shape};
use crate::scenario::{
    Expectation, Happening, LONGEST, MOST_CHARACTERS, MOST_ENTRIES, Number, Scenario,
};
use crate::world::Prop;

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
        check("duration", self.duration, 1e-3, LONGEST)?;
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
            ("events", self.events.len()),
            ("expect", self.expect.len()),
            ("parameters", self.parameters.len()),
        ] {
            check(field, len as f64, 0.0, MOST_ENTRIES as f64)?;
        }
        for (name, value) in &self.parameters {
            check(&format!("parameters.{name}"), *value, -1e6, 1e6)?;
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
        for prop in &self.props {
            validate_prop(source, prop, &check)?;
        }
        let who = |field: &str, character: usize| {
            check(
                &format!("{field}.character"),
                character as f64,
                0.0,
                self.characters.len() as f64 - 1.0,
            )
        };
        let number = |number: &Number| {
            self.number(number).map_err(|e| match number {
                Number::Parameter(name, _) => e.at(&source.place(&format!("{name}\""))),
                Number::Value(_) => e,
            })
        };
        for (i, event) in self.events.iter().enumerate() {
            let field = |name: &str| format!("events[{i}].{name}");
            match event {
                Happening::Push {
                    at,
                    impulse,
                    over,
                    character,
                    ..
                } => {
                    check(&field("at"), number(at)?, 0.0, LONGEST)?;
                    check(&field("impulse"), number(impulse)?, -1e5, 1e5)?;
                    check(&field("over"), *over, 1e-4, 60.0)?;
                    who(&format!("events[{i}]"), *character)?;
                }
                Happening::Command { at, character, .. } => {
                    check(&field("at"), number(at)?, 0.0, LONGEST)?;
                    who(&format!("events[{i}]"), *character)?;
                }
            }
        }
        for (i, expectation) in self.expect.iter().enumerate() {
            let field = format!("expect[{i}]");
            match expectation {
                Expectation::Standing { character } => who(&field, *character)?,
                Expectation::Active {
                    before, character, ..
                }
                | Expectation::Posture {
                    before, character, ..
                } => {
                    check(&format!("{field}.before"), *before, 0.0, LONGEST)?;
                    who(&field, *character)?;
                }
            }
        }
        Ok(())
    }
}

fn validate_prop(
    source: &Source,
    prop: &Prop,
    check: &impl Fn(&str, f64, f64, f64) -> Result<()>,
) -> Result<()> {
    let finite = |field: &str, p: Point| {
        if p.iter().all(|c| c.is_finite() && c.abs() <= 1e3) {
            Ok(())
        } else {
            let field = format!("props.{}.{field}", prop.name);
            Err(source.invalid(
                &prop.name,
                field,
                format!("({}, {})", p[0], p[1]),
                "finite, at most 1000 either way",
            ))
        }
    };
    check("mass", prop.mass, 0.0, 1e6)?;
    check("friction", prop.friction, 0.0, 10.0)?;
    check("restitution", prop.restitution, 0.0, 1.0)?;
    check("angle", prop.angle, -10.0, 10.0)?;
    finite("position", prop.position)?;
    finite("velocity", prop.velocity)?;
    match prop.shape {
        Shape::Capsule { radius, from, to } => {
            check("radius", radius, 1e-3, 100.0)?;
            finite("shape.from", from)?;
            finite("shape.to", to)
        }
        Shape::Box { half, centre } => {
            check("half", half[0], 1e-3, 100.0)?;
            check("half", half[1], 1e-3, 100.0)?;
            finite("shape.centre", centre)
        }
    }
}

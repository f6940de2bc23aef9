//! Props and hinges of a scenario, with the values of their numbers.
//!
//! [`PropEntry`], [`HingeEntry`], parameters → [`Prop`], [`Hinge`].

use crate::character::Point;
use crate::input::{Error, Result};
use crate::math::{hypot, sin_cos};
use crate::scenario::file::Scenario;
use crate::scenario::number::Number;
use crate::scenario::props::{HingeEntry, PropEntry};
use crate::world::{Hinge, Prop};

/// How far apart the two points of a hinge may be at first, m.
const APART: f64 = 0.05;

/// A point of a prop's frame at the beginning, in the world, m.
fn to_world(prop: &Prop, [x, y]: Point) -> Point {
    let (sin, cos) = sin_cos(prop.angle);
    let [px, py] = prop.position;
    [px + cos * x - sin * y, py + sin * x + cos * y]
}

impl Scenario {
    /// A prop with the values of its numbers.
    ///
    /// # Errors
    /// A parameter that the scenario does not declare, by the way from the entry.
    pub fn prop(&self, entry: &PropEntry) -> Result<Prop> {
        let number = |field: &str, n: &Number| self.number(n).map_err(|e| e.inside(field));
        let point = |field: &str, p: &[Number; 2]| self.point(p).map_err(|e| e.inside(field));
        Ok(Prop {
            name: entry.name.clone(),
            shape: entry.shape,
            mass: number("mass", &entry.mass)?,
            position: point("position", &entry.position)?,
            angle: number("angle", &entry.angle)?,
            velocity: point("velocity", &entry.velocity)?,
            friction: number("friction", &entry.friction)?,
            restitution: number("restitution", &entry.restitution)?,
            grip: number("grip", &entry.grip)?,
        })
    }

    /// Place of the one prop with this name.
    ///
    /// # Errors
    /// A name that no prop has, or several.
    pub fn prop_index(&self, name: &str) -> Result<usize> {
        let mut named = (0..self.props.len()).filter(|i| self.props[*i].name == name);
        match (named.next(), named.next()) {
            (Some(place), None) => Ok(place),
            (Some(_), Some(_)) => {
                let problem = format!("'{name}', the name of several");
                Err(Error::refused("", problem, "the name of one prop"))
            }
            (None, _) => {
                let known = self.props.iter().map(|p| p.name.as_str());
                Err(Error::unknown("prop", name, known))
            }
        }
    }

    /// A hinge with the values of its numbers and the places of its props.
    ///
    /// # Errors
    /// Unknown parameters and props; ends that are one prop or both fixed, or that are too far
    /// apart at first: by the way from the entry.
    pub fn hinge(&self, entry: &HingeEntry) -> Result<Hinge> {
        let wrong = |field: &str, problem: String, accepted: String| {
            Err(Error::refused(field, problem, accepted))
        };
        let place = self.prop_index(&entry.prop).map_err(|e| e.inside("prop"))?;
        let prop = self.prop(&self.props[place])?;
        let other = entry.to.as_deref().map(|to| self.prop_index(to));
        let other = other.transpose().map_err(|e| e.inside("to"))?;
        if other == Some(place) {
            return wrong(
                "to",
                format!("'{}' itself", entry.prop),
                "another prop".into(),
            );
        }
        let to = other.map(|o| self.prop(&self.props[o])).transpose()?;
        if prop.mass == 0.0 && to.as_ref().is_none_or(|t| t.mass == 0.0) {
            let accepted = "at least one prop that moves (mass above 0)";
            return wrong("to", "fixed like the prop".into(), accepted.into());
        }
        let at = self.point(&entry.at).map_err(|e| e.inside("at"))?;
        let [x, y] = to_world(&prop, at);
        let to_at = match (&entry.to_at, &to) {
            (Some(given), _) => self.point(given).map_err(|e| e.inside("to_at"))?,
            (None, None) => [x, y],
            (None, Some(to)) => {
                let (sin, cos) = sin_cos(to.angle);
                let [dx, dy] = [x - to.position[0], y - to.position[1]];
                [cos * dx + sin * dy, cos * dy - sin * dx]
            }
        };
        let [there_x, there_y] = to.as_ref().map_or(to_at, |t| to_world(t, to_at));
        let apart = hypot(there_x - x, there_y - y);
        if apart.is_nan() || apart > APART {
            return wrong(
                "to_at",
                format!("({there_x}, {there_y}) in the world"),
                format!("at most {APART} m from 'at', which is ({x}, {y})"),
            );
        }
        let breaks = entry.breaks.as_ref().map(|b| self.number(b));
        let breaks = breaks.transpose().map_err(|e| e.inside("breaks"))?;
        Ok(Hinge {
            prop: place,
            at,
            to: other,
            to_at,
            breaks: breaks.unwrap_or(f64::INFINITY),
        })
    }
}

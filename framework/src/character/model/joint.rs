//! Checks a joint of a character file: its range, its muscles, its servo.
//!
//! entry → [`Joint`].

use crate::character::model::bounds::{MOST, point};
use crate::character::model::definition::Joint;
use crate::character::model::schema::{JointEntry, MuscleEntry};
use crate::character::muscle::{Muscle, Muscles};
use crate::input::{Error, Result, check};

/// The greatest speed of a muscle curve, rad/s.
const FASTEST: f64 = 1e3;

pub(super) fn joint(entry: &JointEntry, names: &[&str]) -> Result<Joint> {
    point("anchor", entry.anchor)?;
    let [low, high] = entry.range;
    let full = std::f64::consts::TAU;
    if !(-full <= low && low < high && high <= full) {
        let problem = format!("({low}, {high})");
        let accepted = "(low, high) with low < high, both within ±2π";
        return Err(Error::refused("range", problem, accepted));
    }
    let muscles = muscles(entry)?;
    check::above("kp", entry.kp, 0.0, MOST)?;
    check::above("kd", entry.kd, 0.0, MOST)?;
    Ok(Joint {
        name: entry.name.clone(),
        parent: names.iter().position(|n| *n == entry.parent).unwrap_or(0),
        anchor: entry.anchor,
        range: entry.range,
        muscles,
        kp: entry.kp,
        kd: entry.kd,
    })
}

fn muscles(entry: &JointEntry) -> Result<Muscles> {
    match (entry.torque, &entry.muscles) {
        (Some(torque), None) => {
            check::above("torque", torque, 0.0, MOST)?;
            Ok(Muscles::even(torque))
        }
        (None, Some(entry)) => {
            let one = |field: &'static str, entry: &MuscleEntry| {
                muscle(entry).map_err(|e| e.inside(field).inside("muscles"))
            };
            Ok(Muscles {
                positive: one("positive", &entry.positive)?,
                negative: one("negative", &entry.negative)?,
            })
        }
        (torque, _) => {
            let problem = if torque.is_some() {
                "given beside muscles"
            } else {
                "missing"
            };
            let accepted = "either torque: N·m, or muscles: (positive: (torque: …, speeds: (…, …)), negative: (…))";
            Err(Error::refused("torque", problem, accepted))
        }
    }
}

fn muscle(entry: &MuscleEntry) -> Result<Muscle> {
    check::above("torque", entry.torque, 0.0, MOST)?;
    if let Some([slow, half]) = entry.speeds {
        check::above(("speeds", 0), slow, 0.0, FASTEST)?;
        check::above(("speeds", 1), half, slow, FASTEST)?;
    }
    Ok(Muscle {
        torque: entry.torque,
        speeds: entry.speeds,
    })
}

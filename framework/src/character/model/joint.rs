//! Checks a joint of a character file: its range, its muscles, its servo.
//!
//! entry → [`Joint`].

use crate::character::model::bounds::{MOST, point};
use crate::character::model::definition::Joint;
use crate::character::model::schema::JointEntry;
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
        (None, Some(muscles)) => {
            for (field, muscle) in [
                ("positive", &muscles.positive),
                ("negative", &muscles.negative),
            ] {
                check_muscle(muscle).map_err(|e| e.inside(field).inside("muscles"))?;
            }
            Ok(*muscles)
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

fn check_muscle(muscle: &Muscle) -> Result<()> {
    check::above("torque", muscle.torque, 0.0, MOST)?;
    if let Some([slow, half]) = muscle.speeds {
        check::above(("speeds", 0), slow, 0.0, FASTEST)?;
        check::above(("speeds", 1), half, slow, FASTEST)?;
    }
    Ok(())
}

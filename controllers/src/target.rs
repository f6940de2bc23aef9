//! Poses as data: joint names to angles. A name may be a limb's stem for both sides: `hip` stands
//! for `hip_r` and `hip_l`.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use aplomb_framework::character::Model;
use aplomb_framework::input::{Error, FieldPath, Result, check};

/// Target angles by joint name or stem, rad.
pub type NamedAngles = BTreeMap<String, f64>;

/// The joints that a name or stem stands for.
///
/// # Errors
/// [`Error::Unknown`] if there is none.
pub fn joints_named(model: &Model, name: &str) -> Result<Vec<usize>> {
    if let Ok(joint) = model.joint_index(name) {
        return Ok(vec![joint]);
    }
    let sides = [format!("{name}_r"), format!("{name}_l")];
    let found: Vec<usize> = sides
        .iter()
        .filter_map(|n| model.joint_index(n).ok())
        .collect();
    if found.is_empty() {
        model.joint_index(name).map(|j| vec![j])
    } else {
        Ok(found)
    }
}

/// The largest angle of a target, rad.
const LARGEST_ANGLE: f64 = 7.0;

/// Writes the named angles over `all`, one a joint; names of single joints win over stems.
///
/// # Errors
/// An unknown joint, or an angle of more than 7 rad either way, by its name.
pub fn overlay(model: &Model, named: &NamedAngles, all: &mut [f64]) -> Result<()> {
    overlay_within(model, named, -LARGEST_ANGLE..=LARGEST_ANGLE, all)
}

/// The same for other values than angles, which are to lie within `accepted`.
///
/// # Errors
/// An unknown joint, or a value that is not accepted, by its name.
pub fn overlay_within(
    model: &Model,
    named: &NamedAngles,
    accepted: RangeInclusive<f64>,
    all: &mut [f64],
) -> Result<()> {
    for single in [false, true] {
        for (name, value) in named {
            let joints = joints_named(model, name);
            let joints = joints.map_err(|e| e.inside(FieldPath::name(name)))?;
            if (joints.len() == 1) != single {
                continue;
            }
            let of = |e: Error| e.inside(FieldPath::entry(name));
            check::within("", *value, accepted.clone()).map_err(of)?;
            for joint in joints {
                all[joint] = *value;
            }
        }
    }
    Ok(())
}

/// Puts the right limbs ahead of the left: of each named stem the right joint's angle becomes greater by half
/// of the value, rad, and the left one's less.
///
/// # Errors
/// A stem that is not two joints', or a value of more than 7 rad either way, by its name.
pub fn set_apart(model: &Model, named: &NamedAngles, all: &mut [f64]) -> Result<()> {
    for (stem, value) in named {
        let of = |e: Error| e.inside(FieldPath::entry(stem));
        check::within("", *value, -LARGEST_ANGLE..=LARGEST_ANGLE).map_err(of)?;
        for (side, sign) in [("r", 0.5), ("l", -0.5)] {
            let joint = model.joint_index(&format!("{stem}_{side}"));
            all[joint.map_err(|e| e.inside(FieldPath::name(stem)))?] += sign * value;
        }
    }
    Ok(())
}

/// The pose with every joint's angle taken from the other side.
#[must_use]
pub fn mirrored(model: &Model, pose: &[f64]) -> Vec<f64> {
    (0..pose.len())
        .map(|j| pose[model.mirrored_joint(j)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stems_stand_for_both_sides_and_single_names_win() {
        let model = Model::load("humanoid").unwrap();
        let named: NamedAngles = [
            ("hip_l".into(), 0.2),
            ("hip".into(), 0.1),
            ("waist".into(), -0.3),
        ]
        .into();
        let mut pose = vec![0.0; 12];
        overlay(&model, &named, &mut pose).unwrap();
        let at = |n| pose[model.joint_index(n).unwrap()];
        assert_eq!(
            (at("hip_r"), at("hip_l"), at("waist"), at("knee_r")),
            (0.1, 0.2, -0.3, 0.0)
        );
        let other = mirrored(&model, &pose);
        assert_eq!(other[model.joint_index("hip_r").unwrap()], 0.2);
    }

    #[test]
    fn unknown_joints_and_wild_angles_are_refused() {
        let model = Model::load("humanoid").unwrap();
        let mut pose = vec![0.0; 12];
        let mut refusal = |name: &str, value| {
            let named = [(name.to_owned(), value)].into();
            overlay(&model, &named, &mut pose).unwrap_err().to_string()
        };
        assert!(
            refusal("hipp", 0.1).contains("did you mean 'hip_"),
            "{}",
            refusal("hipp", 0.1)
        );
        assert!(refusal("hip", f64::NAN).contains("NaN"));
    }
}

//! The numbers of a controller's file as a point, and the file of a point.
//!
//! controller file → dimensions → point of the unit cube → controller file.

use std::fmt::Write;

use aplomb_controllers::target::NamedAngles;
use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, ControllerFile, Spec};
use aplomb_framework::input::{Result, Source, options};
use aplomb_framework::math::log10;
use serde::Serialize;

use crate::exercise::Task;
use crate::search::dimension::Dimension;
use crate::search::tune::layout::folded;

/// A kind of controller whose spec can be optimised.
pub trait Tunable: Spec + Clone + Serialize + Sync {
    /// What is optimised.
    fn dimensions(&self, model: &Model) -> Vec<Dimension>;
    /// The number of a dimension, to be read or set.
    fn slot(&mut self, name: &str) -> &mut f64;
    /// Makes numbers that depend on others fit them.
    fn settle(&mut self) {}
}

/// Feet flat and trunk upright: the ankles and hips share the knees' bend.
pub(super) fn share_bend(pose: &mut NamedAngles) {
    let knee = pose.get("knee").copied().unwrap_or(0.0);
    for joint in ["hip", "ankle"] {
        pose.insert(joint.to_owned(), -0.5 * knee);
    }
}

/// The dimensions about a spec: each reaches at least to the spec's own number.
fn around<T: Tunable>(base: &T, model: &Model) -> Vec<Dimension> {
    let mut spec = base.clone();
    let all = base.dimensions(model).into_iter();
    all.map(|d| {
        let value = *spec.slot(&d.name);
        d.including(value)
    })
    .collect()
}

/// The spec at a point of the unit cube about `base`.
#[must_use]
pub fn at<T: Tunable>(base: &T, model: &Model, point: &[f64]) -> T {
    let mut spec = base.clone();
    for (d, u) in around(base, model).iter().zip(point) {
        // Five digits are more than the search can tell apart, and read well.
        let value = d.value(*u);
        let digits = (4 - log10(value.abs().max(1e-9)).floor() as i32).clamp(0, 9) as usize;
        *spec.slot(&d.name) = format!("{value:.digits$}").parse().unwrap_or(value);
    }
    spec.settle();
    spec
}

/// The point of the unit cube about itself that a spec stands at.
#[must_use]
pub fn point_of<T: Tunable>(spec: &T, model: &Model) -> Vec<f64> {
    let mut spec = spec.clone();
    around(&spec, model)
        .iter()
        .map(|d| d.unit(*spec.slot(&d.name)))
        .collect()
}

/// Reads the spec of a controller file.
///
/// # Errors
/// Bad syntax, or another kind of controller.
pub fn spec_of<T: Spec>(source: &Source) -> Result<(Contract, T)> {
    let file = ControllerFile::parse(source.clone())?;
    let spec = file.parameters()?;
    Ok((file.contract, spec))
}

#[derive(Serialize)]
struct WholeFile<'a, T> {
    kind: &'a str,
    contract: &'a Contract,
    #[serde(skip_serializing_if = "Option::is_none")]
    exercise: Option<&'a Task>,
    spec: &'a T,
}

fn whole<'a, T: Spec + Serialize>(
    contract: &'a Contract,
    exercise: Option<&'a Task>,
    spec: &'a T,
) -> WholeFile<'a, T> {
    WholeFile {
        kind: T::KIND,
        contract,
        exercise,
        spec,
    }
}

/// A controller file in one line.
#[must_use]
pub fn line_of<T: Spec + Serialize>(
    contract: &Contract,
    exercise: Option<&Task>,
    spec: &T,
) -> String {
    let file = whole(contract, exercise, spec);
    options().to_string(&file).unwrap_or_default()
}

/// A controller file in text, with comments before it.
#[must_use]
pub fn text_of<T: Spec + Serialize>(
    contract: &Contract,
    exercise: Option<&Task>,
    spec: &T,
    header: &str,
) -> String {
    let file = whole(contract, exercise, spec);
    let pretty = ron::ser::PrettyConfig::new()
        .struct_names(false)
        .depth_limit(3);
    let body = options()
        .to_string_pretty(&file, pretty)
        .unwrap_or_default();
    let mut text = String::new();
    for line in header.lines() {
        let _ = writeln!(text, "// {line}");
    }
    text + &folded(&body)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::skill::tests::shipped as skill;
    use aplomb_controllers::kinds::balance::BalanceSpec;
    use aplomb_controllers::kinds::fall::FallSpec;

    fn shipped(name: &str) -> Source {
        aplomb_controllers::registry().file(name).unwrap()
    }

    #[test]
    fn a_spec_survives_the_unit_cube_and_its_file() {
        let (contract, spec) = spec_of::<BalanceSpec>(&shipped("skills/balance.ron")).unwrap();
        let model = Model::load("humanoid").unwrap();
        let same = at(&spec, &model, &point_of(&spec, &model));
        let exercise = Task::of(&skill("balance")).unwrap();
        let text = text_of(&contract, Some(&exercise), &same, "Why.\nHow.");
        assert!(text.contains("exercise: Stand("), "{text}");
        assert!(text.starts_with("// Why.\n// How.\n("), "{text}");
        let (again, back) = spec_of::<BalanceSpec>(&Source::new("x", text)).unwrap();
        assert_eq!((again, &back), (contract, &same));
        for (a, b) in point_of(&back, &model).iter().zip(point_of(&spec, &model)) {
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
    }

    #[test]
    fn another_kind_of_controller_is_refused() {
        let refusal = spec_of::<FallSpec>(&shipped("skills/rest.ron")).unwrap_err();
        assert!(
            refusal
                .to_string()
                .contains("rest.ron:3:11: kind is 'rest'"),
            "{refusal}"
        );
    }
}

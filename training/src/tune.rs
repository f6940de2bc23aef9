//! Optimises the numbers of a controller's file.
//!
//! controller file → dimensions → CMA-ES over rollouts → controller file, with seed and cost.

mod pose;
mod step;

use std::fmt::Write;

use aplomb_controllers::balance::BalanceSpec;
use aplomb_controllers::fall::FallSpec;
use aplomb_controllers::stance::StanceSpec;
use aplomb_controllers::target::NamedAngles;
use aplomb_framework::contract::Contract;
use aplomb_framework::file::{Source, options};
use aplomb_framework::model::Model;
use aplomb_framework::registry::ControllerFile;
use aplomb_framework::{Error, Result};
use serde::Serialize;

use crate::cma_es::{Best, Search, minimise};
use crate::dimension::{Dimension, linear, logarithmic};

/// A kind of controller whose spec can be optimised.
pub trait Tunable: Sized + Clone + Serialize + serde::de::DeserializeOwned + Sync {
    /// The `kind` of its files.
    const KIND: &'static str;
    /// What is optimised.
    fn dimensions(&self, model: &Model) -> Vec<Dimension>;
    /// The number of a dimension, to be read or set.
    fn slot(&mut self, name: &str) -> &mut f64;
    /// Makes numbers that depend on others fit them.
    fn settle(&mut self) {}
}

/// Feet flat and trunk upright: the ankles and hips share the knees' bend.
fn share_bend(pose: &mut NamedAngles) {
    let knee = pose.get("knee").copied().unwrap_or(0.0);
    for joint in ["hip", "ankle"] {
        pose.insert(joint.to_owned(), -0.5 * knee);
    }
}

impl Tunable for BalanceSpec {
    const KIND: &'static str = "balance";

    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            logarithmic("kl", 5.0, 400.0),
            logarithmic("dl", 3.0, 80.0),
            logarithmic("kl_height", 10.0, 400.0),
            logarithmic("dh", 0.1, 30.0),
            logarithmic("kt", 2.0, 200.0),
            logarithmic("dt", 1.0, 50.0),
            logarithmic("angular", 0.01, 10.0),
            logarithmic("tracking", 1e-4, 1.0),
            logarithmic("root", 0.03, 30.0),
            logarithmic("tilted", 1e-2, 1e3),
            logarithmic("lifted", 1e-4, 1.0),
            logarithmic("shoulder", 0.03, 10.0),
            logarithmic("elbow", 0.03, 3.0),
            logarithmic("neck", 0.03, 10.0),
            logarithmic("waist", 0.03, 10.0),
            logarithmic("hip", 0.03, 10.0),
            logarithmic("knee", 0.03, 10.0),
            linear("com_ahead", -0.05, 0.03),
            linear("margin", 0.0, 0.02),
            linear("pose.knee", -0.35, 0.0),
            linear("pose.shoulder", -0.2, 0.3),
            linear("pose.elbow", 0.0, 0.6),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let g = &mut self.gains;
        match name {
            "kl" => &mut g.kl,
            "dl" => &mut g.dl,
            "kl_height" => &mut g.kl_height,
            "dh" => &mut g.dh,
            "kt" => &mut g.kt,
            "dt" => &mut g.dt,
            "angular" => &mut g.angular,
            "tracking" => &mut g.tracking,
            "root" => &mut g.root,
            "tilted" => &mut g.tilted,
            "lifted" => &mut g.lifted,
            "margin" => &mut g.margin,
            "com_ahead" => &mut self.com_ahead,
            other => match other.strip_prefix("pose.") {
                Some(joint) => self.pose.entry(joint.to_owned()).or_insert(0.0),
                None => self.joint_weights.entry(other.to_owned()).or_insert(1.0),
            },
        }
    }

    fn settle(&mut self) {
        share_bend(&mut self.pose);
        let g = &mut self.gains;
        g.dl_height = 2.0 * g.kl_height.sqrt();
    }
}

impl Tunable for StanceSpec {
    const KIND: &'static str = "stance";

    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            linear("com_ahead", -0.05, 0.03),
            logarithmic("position_gain", 0.2, 10.0),
            logarithmic("velocity_gain", 0.5, 8.0),
            logarithmic("bend_gain", 0.1, 30.0),
            linear("bend_margin", -0.02, 0.1),
            logarithmic("stiffness", 0.3, 2.5),
            linear("pose.knee", -0.2, 0.0),
            linear("pose.elbow", 0.0, 0.4),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        match name {
            "com_ahead" => &mut self.com_ahead,
            "position_gain" => &mut self.position_gain,
            "velocity_gain" => &mut self.velocity_gain,
            "bend_gain" => &mut self.bend_gain,
            "bend_margin" => &mut self.bend_margin,
            "stiffness" => &mut self.stiffness,
            other => {
                let joint = other.strip_prefix("pose.").unwrap_or(other);
                self.pose.entry(joint.to_owned()).or_insert(0.0)
            }
        }
    }

    fn settle(&mut self) {
        share_bend(&mut self.pose);
    }
}

impl Tunable for FallSpec {
    const KIND: &'static str = "fall";

    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            linear("forward.reach.waist", -0.6, 0.4),
            linear("forward.reach.shoulder", 0.6, 2.2),
            linear("forward.reach.elbow", 0.1, 1.2),
            linear("forward.reach.hip", -0.2, 1.2),
            linear("forward.reach.knee", -1.6, -0.1),
            linear("forward.give.waist", -0.6, 0.4),
            linear("forward.give.shoulder", 0.6, 2.2),
            linear("forward.give.elbow", 0.4, 2.2),
            linear("forward.give.hip", -0.2, 1.2),
            linear("forward.give.knee", -1.6, -0.1),
            logarithmic("forward.reach_stiffness", 0.2, 1.2),
            logarithmic("forward.give_stiffness", 0.1, 1.0),
            logarithmic("forward.ramp", 0.08, 0.5),
            linear("backward.reach.waist", -1.2, 0.0),
            linear("backward.reach.shoulder", -1.0, 0.6),
            linear("backward.reach.elbow", 0.1, 1.5),
            linear("backward.reach.hip", 0.2, 2.0),
            linear("backward.reach.knee", -2.4, -0.3),
            linear("backward.reach.ankle", -0.4, 0.5),
            linear("backward.give.waist", -1.2, 0.0),
            linear("backward.give.shoulder", -1.0, 1.0),
            linear("backward.give.elbow", 0.1, 2.2),
            linear("backward.give.hip", 0.2, 2.0),
            linear("backward.give.knee", -2.4, -0.3),
            logarithmic("backward.reach_stiffness", 0.2, 1.2),
            logarithmic("backward.give_stiffness", 0.1, 1.0),
            logarithmic("backward.ramp", 0.08, 0.6),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let (way, rest) = match name.strip_prefix("forward.") {
            Some(rest) => (&mut self.forward, rest),
            None => (
                &mut self.backward,
                name.strip_prefix("backward.").unwrap_or(name),
            ),
        };
        match rest.split_once('.') {
            Some(("reach", joint)) => way.reach.entry(joint.to_owned()).or_insert(0.0),
            Some((_, joint)) => way.give.entry(joint.to_owned()).or_insert(0.0),
            None => match rest {
                "reach_stiffness" => &mut way.reach_stiffness,
                "give_stiffness" => &mut way.give_stiffness,
                _ => &mut way.ramp,
            },
        }
    }
}

/// The spec at a point of the unit cube.
#[must_use]
pub fn at<T: Tunable>(base: &T, model: &Model, point: &[f64]) -> T {
    let mut spec = base.clone();
    for (d, u) in base.dimensions(model).iter().zip(point) {
        // Five digits are more than the search can tell apart, and read well.
        let value = d.value(*u);
        let digits = (4 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 9) as usize;
        *spec.slot(&d.name) = format!("{value:.digits$}").parse().unwrap_or(value);
    }
    spec.settle();
    spec
}

/// The point of the unit cube that a spec stands at.
#[must_use]
pub fn point_of<T: Tunable>(spec: &T, model: &Model) -> Vec<f64> {
    let mut spec = spec.clone();
    spec.dimensions(model)
        .iter()
        .map(|d| d.unit(*spec.slot(&d.name)))
        .collect()
}

/// Reads the spec of a controller file.
///
/// # Errors
/// Bad syntax, or another kind of controller.
pub fn spec_of<T: Tunable>(source: &Source) -> Result<(Contract, T)> {
    let file: ControllerFile = source.parse()?;
    if file.kind != T::KIND {
        return Err(Error::unknown("kind", &file.kind, [T::KIND]));
    }
    let inner = Source::new(source.origin.clone(), file.spec.get_ron());
    Ok((file.contract, inner.parse()?))
}

#[derive(Serialize)]
struct WholeFile<'a, T> {
    kind: &'a str,
    contract: &'a Contract,
    spec: &'a T,
}

/// A controller file in text.
#[must_use]
pub fn text_of<T: Tunable>(contract: &Contract, spec: &T, header: &str) -> String {
    let file = WholeFile {
        kind: T::KIND,
        contract,
        spec,
    };
    let pretty = ron::ser::PrettyConfig::new().struct_names(false).depth_limit(3);
    let body = options()
        .to_string_pretty(&file, pretty)
        .unwrap_or_default();
    let mut text = String::new();
    for line in header.lines() {
        let _ = writeln!(text, "// {line}");
    }
    text + &body + "\n"
}

/// A repertoire of the shipped `others`, this controller and one that lets go.
#[must_use]
pub fn repertoire_with<T: Tunable>(others: &[&str], contract: &Contract, spec: &T) -> String {
    let files: String = others.iter().map(|o| format!("File(\"{o}\"), ")).collect();
    format!(
        "(name: \"tuned\", fallback: \"rest\", controllers: [{files}Here({}), \
         File(\"skills/rest.ron\")])",
        text_of(contract, spec, "")
    )
}

/// Searches from a file's own numbers for the least `cost` of a repertoire in text. `others` are
/// shipped controllers that come before it in the pool. `watch` sees the evaluations so far, the
/// least cost and the file's text for it, after the first evaluation and then each generation, so
/// that a search that is stopped has lost nothing. Returns the least cost.
///
/// # Errors
/// An invalid file.
pub fn search<T: Tunable>(
    source: &Source,
    others: &[&str],
    cost: impl Fn(&str) -> Result<f64> + Sync,
    search: Search,
    mut watch: impl FnMut(usize, f64, &dyn Fn(&str) -> String),
) -> Result<f64> {
    let (contract, base) = spec_of::<T>(source)?;
    let model = Model::load("humanoid")?;
    let start = point_of(&base, &model);
    // A first run, so that an invalid file is an error and not a cost.
    cost(&repertoire_with(others, &contract, &base))?;
    let cost = |point: &[f64]| {
        let text = repertoire_with(others, &contract, &at(&base, &model, point));
        cost(&text).unwrap_or(f64::INFINITY)
    };
    let best = minimise(&start, search, cost, |evaluations, best: &Best| {
        let text = |header: &str| text_of(&contract, &at(&base, &model, &best.point), header);
        watch(evaluations, best.cost, &text);
    });
    Ok(best.cost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{falling, standing};

    fn shipped(name: &str) -> Source {
        aplomb_controllers::registry().file(name).unwrap()
    }

    #[test]
    fn a_spec_survives_the_unit_cube_and_its_file() {
        let (contract, spec) = spec_of::<BalanceSpec>(&shipped("skills/balance.ron")).unwrap();
        let model = Model::load("humanoid").unwrap();
        let same = at(&spec, &model, &point_of(&spec, &model));
        let text = text_of(&contract, &same, "Why.\nHow.");
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
            refusal.to_string().contains("unknown kind 'rest'"),
            "{refusal}"
        );
    }

    #[test]
    fn light_pushes_are_stood_and_heavy_ones_are_fallen_from() {
        let registry = aplomb_controllers::registry();
        let (contract, spec) = spec_of::<BalanceSpec>(&shipped("skills/balance.ron")).unwrap();
        let text = repertoire_with(&[], &contract, &spec);
        let push = |impulse| standing::Push {
            site: standing::Site::Trunk,
            impulse,
            at: 1.0,
            friction: 1.0,
        };
        assert!(standing::take(&text, &registry, push(15.0)).unwrap().stood);
        assert!(!standing::take(&text, &registry, push(120.0)).unwrap().stood);
        let (contract, spec) = spec_of::<FallSpec>(&shipped("skills/fall.ron")).unwrap();
        let text = repertoire_with(&["skills/balance.ron"], &contract, &spec);
        let landing = falling::land(&text, &registry, push(-120.0)).unwrap();
        assert!(landing.fell && landing.protected, "{landing:?}");
        let alone = "(name: \"x\", fallback: \"rest\", controllers: [File(\"skills/rest.ron\")])";
        let limp = falling::land(alone, &registry, push(-120.0)).unwrap();
        assert!(limp.head_speed > landing.head_speed, "{limp:?} {landing:?}");
    }
}

//! How a controller's rollouts begin, as data: the distribution of starts and disturbances.
//!
//! RON → [`Disturbance`] (validated). One file a controller; those of the humanoid are shipped.

use aplomb_controllers::target::{NamedAngles, joints_named};
use aplomb_framework::character::Model;
use aplomb_framework::control::boundary::MOST_FEATURES;
use aplomb_framework::input::{Error, Result, Source};
use aplomb_framework::sensing::Feature;
use serde::Deserialize;

/// At most this many starts, supervisors or links to draw from.
const MOST: usize = 64;
/// Strongest force, N.
const STRONGEST: f64 = 20_000.0;

/// A pose from which the disturbance begins.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nominal {
    /// Pitch of the root, rad; π/2 lies on its back.
    #[serde(default)]
    pub pitch: f64,
    /// Joint angles by name or stem, rad; the others are 0.
    #[serde(default)]
    pub angles: NamedAngles,
    /// rad; the pitch strays evenly by up to this much.
    #[serde(default)]
    pub tilt: f64,
    /// rad; each joint strays evenly by up to this much, within its range.
    #[serde(default)]
    pub spread: f64,
    /// m; least and greatest gap under the character.
    #[serde(default)]
    pub lift: [f64; 2],
}

/// Who acts while the character is disturbed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum During {
    /// Servos that hold the start's pose, each with an offset of its target angle.
    Servos,
    /// The whole repertoire.
    Repertoire,
}

/// A force on a link's centre of mass.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Force {
    /// Names of links, one of which is drawn.
    pub links: Vec<String>,
    /// N; its magnitude is drawn evenly up to this, its direction evenly from all.
    pub most: f64,
    /// rad; how far the direction may be off the horizontal, either way.
    #[serde(default = "any_direction")]
    pub rise: f64,
    /// s; the time that it acts is drawn evenly from these.
    pub time: [f64; 2],
}

fn any_direction() -> f64 {
    std::f64::consts::FRAC_PI_2
}

/// What must not happen on the way to a success: the largest forces, filtered over 10 ms, N.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unharmed {
    /// On the head.
    pub head: f64,
    /// On trunk and root together.
    pub trunk: f64,
}

/// The distribution of a controller's rollouts.
///
/// ```
/// # use aplomb_framework::{Model, input::Source};
/// # use aplomb_training::situations::disturbance::Disturbance;
/// let text = r#"(features: ["com_offset", "com_velocity_x"], starts: [()], during: [Servos],
///     force: (links: ["torso"], most: 300, time: (0.05, 0.2)), offset: 0.2, pause: (0, 0.3), within: 4)"#;
/// let model = Model::load("humanoid")?;
/// assert_eq!(Disturbance::parse(&Source::new("mine.ron", text), &model)?.features.len(), 2);
/// let wrong = Source::new("mine.ron", text.replace("torso", "torsoe"));
/// assert!(Disturbance::parse(&wrong, &model).unwrap_err().to_string().contains("'torso'"));
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// What is recorded where the controller takes over.
    pub features: Vec<Feature>,
    /// Poses, one of which is drawn.
    pub starts: Vec<Nominal>,
    /// Who acts meanwhile, one of which is drawn.
    pub during: Vec<During>,
    /// The force.
    pub force: Force,
    /// rad; largest offset of a servo's target.
    pub offset: f64,
    /// s; from the end of the force until the controller takes over, drawn evenly from these. Below 0 the force
    /// still acts when it does, as a push does when it is first felt.
    pub pause: [f64; 2],
    /// s within which it has to succeed; its patience may end sooner. A controller without a
    /// post-condition has to stand at the end.
    pub within: f64,
    /// Limits of what may hit head and trunk; none if left out.
    #[serde(default)]
    pub unharmed: Option<Unharmed>,
}

/// The shipped ones: controller and text.
const SHIPPED: &[(&str, &str)] = &[
    ("balance", include_str!("../../disturbances/balance.ron")),
    (
        "protective_step",
        include_str!("../../disturbances/protective_step.ron"),
    ),
    ("fall", include_str!("../../disturbances/fall.ron")),
    ("roll", include_str!("../../disturbances/roll.ron")),
    (
        "rise_supine",
        include_str!("../../disturbances/rise_supine.ron"),
    ),
    (
        "rise_sitting",
        include_str!("../../disturbances/rise_sitting.ron"),
    ),
    (
        "rise_prone",
        include_str!("../../disturbances/rise_prone.ron"),
    ),
    (
        "rise_hands_and_feet",
        include_str!("../../disturbances/rise_hands_and_feet.ron"),
    ),
    (
        "rise_kneeling",
        include_str!("../../disturbances/rise_kneeling.ron"),
    ),
];

/// Whether the character of a shipped controller has a shipped disturbance.
#[must_use]
pub fn is_shipped(controller: &str) -> bool {
    SHIPPED.iter().any(|(name, _)| *name == controller)
}

/// The shipped disturbance of a controller.
///
/// # Errors
/// [`Error::Unknown`] with those that there are.
pub fn shipped(controller: &str) -> Result<Source> {
    let names = || SHIPPED.iter().map(|(name, _)| *name);
    let found = SHIPPED.iter().find(|(name, _)| *name == controller);
    let (name, text) = found.ok_or_else(|| {
        Error::unknown(
            "shipped disturbance for the controller",
            controller,
            names(),
        )
    })?;
    Ok(Source::new(
        format!("built-in disturbances/{name}.ron"),
        *text,
    ))
}

impl Disturbance {
    /// A disturbance in text, checked against the character.
    ///
    /// # Errors
    /// Malformed text; unknown features, joints or links; numbers out of bounds; empty lists.
    pub fn parse(source: &Source, model: &Model) -> Result<Self> {
        let mut d: Self = source.parse()?;
        let bad = |needle: &str, problem: String, accepted: &str| {
            Err(source.invalid(needle, needle, problem, accepted))
        };
        for (field, count, most) in [
            ("features", d.features.len(), MOST_FEATURES),
            ("starts", d.starts.len(), MOST),
            ("during", d.during.len(), MOST),
            ("links", d.force.links.len(), MOST),
        ] {
            if !(1..=most).contains(&count) {
                return bad(field, format!("a list of {count}"), &format!("1 to {most}"));
            }
        }
        for (i, f) in d.features.iter().enumerate() {
            if d.features[..i].contains(f) {
                return bad("features", format!("'{f}' twice"), "each feature once");
            }
        }
        let within = |name: &'static str, value: f64, low: f64, high: f64| {
            if (low..=high).contains(&value) {
                return Ok(());
            }
            let accepted = format!("{low} to {high}");
            Err(source.invalid(name, name, value, accepted))
        };
        let pair = |name: &'static str, [low, high]: [f64; 2], most: f64| {
            within(name, low, 0.0, most).and(within(name, high, low.clamp(0.0, most), most))
        };
        for start in &d.starts {
            within("pitch", start.pitch, -7.0, 7.0)?;
            within("tilt", start.tilt, 0.0, 7.0)?;
            within("spread", start.spread, 0.0, 7.0)?;
            pair("lift", start.lift, 10.0)?;
            for (joint, angle) in &start.angles {
                within("angles", *angle, -7.0, 7.0)?;
                joints_named(model, joint).map_err(|e| e.at(&source.place(joint)))?;
            }
        }
        for link in &d.force.links {
            model
                .link_index(link)
                .map_err(|e| e.at(&source.place(link)))?;
        }
        within("most", d.force.most, 0.0, STRONGEST)?;
        within("rise", d.force.rise, 0.0, any_direction())?;
        pair("time", d.force.time, 10.0)?;
        within("offset", d.offset, 0.0, 7.0)?;
        within("pause", d.pause[0], -10.0, 60.0)?;
        within("pause", d.pause[1], d.pause[0].clamp(-10.0, 60.0), 60.0)?;
        within("within", d.within, 0.1, 60.0)?;
        for feature in &mut d.features {
            let name = feature.to_string();
            feature
                .resolve(model)
                .map_err(|e| e.at(&source.place(&name)))?;
        }
        Ok(d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_ones_fit_the_humanoid() {
        let model = Model::load("humanoid").unwrap();
        for (name, _) in SHIPPED {
            let d = Disturbance::parse(&shipped(name).unwrap(), &model).unwrap();
            assert!(d.within > 0.0 && is_shipped(name));
        }
        let unknown = shipped("blance").unwrap_err().to_string();
        assert!(unknown.contains("'balance'"), "{unknown}");
    }
}

//! How a controller's rollouts begin, as data: the distribution of starts and disturbances.
//!
//! RON → [`Disturbance`] (validated). One file a controller; those of the humanoid are shipped.

use aplomb_controllers::target::{NamedAngles, overlay};
use aplomb_framework::character::Model;
use aplomb_framework::control::boundary::MOST_FEATURES;
use aplomb_framework::input::{self, Error, Result, Source, check};
use aplomb_framework::sensing::Feature;
use include_dir::{Dir, include_dir};
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

/// The shipped ones, each named after its controller.
static SHIPPED: Dir = include_dir!("$CARGO_MANIFEST_DIR/disturbances");

/// Whether the character of a shipped controller has a shipped disturbance.
#[must_use]
pub fn is_shipped(controller: &str) -> bool {
    SHIPPED.contains(format!("{controller}.ron"))
}

/// The shipped disturbance of a controller.
///
/// # Errors
/// [`Error::Unknown`] with those that there are.
pub fn shipped(controller: &str) -> Result<Source> {
    let all = input::shipped(&SHIPPED);
    let found = all.iter().find(|(name, _)| *name == controller);
    let (name, text) = found.ok_or_else(|| {
        let names = all.iter().map(|(name, _)| *name);
        Error::unknown("shipped disturbance for the controller", controller, names)
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
        let mut disturbance: Self = source.parse()?;
        let resolved = disturbance.resolve(model);
        resolved.map_err(|e| source.locate(e))?;
        Ok(disturbance)
    }

    /// Checks every bound and looks up the joints of the features.
    fn resolve(&mut self, model: &Model) -> Result<()> {
        check::count(
            "features",
            self.features.len(),
            1..=MOST_FEATURES,
            "features",
        )?;
        check::count("starts", self.starts.len(), 1..=MOST, "starts")?;
        check::count("during", self.during.len(), 1..=MOST, "supervisors")?;
        for (i, start) in self.starts.iter().enumerate() {
            start.check(model).map_err(|e| e.inside(("starts", i)))?;
        }
        self.force.check(model).map_err(|e| e.inside("force"))?;
        check::within("offset", self.offset, 0.0..=7.0)?;
        let [shortest, longest] = self.pause;
        check::within(("pause", 0), shortest, -10.0..=60.0)?;
        check::within(("pause", 1), longest, shortest..=60.0)?;
        check::within("within", self.within, 0.1..=60.0)?;
        for i in 0..self.features.len() {
            let of = |e: Error| e.inside(("features", i));
            let (before, rest) = self.features.split_at_mut(i);
            if before.contains(&rest[0]) {
                let problem = format!("'{}' a second time", rest[0]);
                return Err(of(Error::refused("", problem, "each feature once")));
            }
            rest[0].resolve(model).map_err(of)?;
        }
        Ok(())
    }
}

impl Nominal {
    fn check(&self, model: &Model) -> Result<()> {
        check::within("pitch", self.pitch, -7.0..=7.0)?;
        check::within("tilt", self.tilt, 0.0..=7.0)?;
        check::within("spread", self.spread, 0.0..=7.0)?;
        ordered("lift", self.lift)?;
        let mut pose = vec![0.0; model.joint_count()];
        overlay(model, &self.angles, &mut pose).map_err(|e| e.inside("angles"))
    }
}

impl Force {
    fn check(&self, model: &Model) -> Result<()> {
        check::count("links", self.links.len(), 1..=MOST, "links")?;
        for (i, link) in self.links.iter().enumerate() {
            let known = model.link_index(link);
            known.map_err(|e| e.inside(("links", i)))?;
        }
        check::within("most", self.most, 0.0..=STRONGEST)?;
        check::within("rise", self.rise, 0.0..=any_direction())?;
        ordered("time", self.time)
    }
}

/// Two numbers in order, from 0 to 10.
fn ordered(field: &str, [low, high]: [f64; 2]) -> Result<()> {
    check::within((field, 0), low, 0.0..=10.0)?;
    check::within((field, 1), high, low..=10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_ones_fit_the_humanoid() {
        let model = Model::load("humanoid").unwrap();
        for (name, _) in input::shipped(&SHIPPED) {
            let d = Disturbance::parse(&shipped(name).unwrap(), &model).unwrap();
            assert!(d.within > 0.0 && is_shipped(name));
        }
        let unknown = shipped("blance").unwrap_err().to_string();
        assert!(unknown.contains("'balance'"), "{unknown}");
    }
}

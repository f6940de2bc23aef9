//! Reads a character file, and checks every bound that a character must keep.
//!
//! RON → `schema`, of which `tree` checks that it is a tree → [`Model`].

use std::path::Path;
use std::sync::Arc;

use include_dir::{Dir, include_dir};

use crate::character::kinematics::Kinematics;
use crate::character::model::bounds::{MOST, point};
use crate::character::model::definition::{Foot, Hand, Link, MOST_LINKS, Model};
use crate::character::model::joint::joint;
use crate::character::model::schema::{CharacterFile, LinkEntry};
use crate::character::model::{digest, tree};
use crate::character::shape::Shape;
use crate::character::state::State;
use crate::input::{Error, Result, Source, check, shipped};

/// One file each.
static CHARACTERS: Dir = include_dir!("$CARGO_MANIFEST_DIR/characters");

/// The stiffest flesh, N/m.
const STIFFEST: f64 = 1e5;

impl Model {
    /// The built-in characters: name and text, by name.
    #[must_use]
    pub fn built_in() -> Vec<(&'static str, &'static str)> {
        shipped(&CHARACTERS)
    }

    /// A built-in character by name, or a character file by path.
    ///
    /// # Errors
    /// an unreadable or invalid file, with the place of what is refused.
    ///
    /// ```
    /// # use aplomb_framework::character::Model;
    /// let humanoid = Model::load("humanoid")?;
    /// assert_eq!(humanoid.dof(), 15);
    /// assert!((humanoid.total_mass() - 80.0).abs() < 1e-9);
    /// # Ok::<(), aplomb_framework::Error>(())
    /// ```
    pub fn load(name_or_path: &str) -> Result<Arc<Self>> {
        let built_in = Self::built_in();
        let source = match built_in.iter().find(|(n, _)| *n == name_or_path) {
            Some((name, text)) => Source::new(format!("built-in {name}"), *text),
            None => match Source::read(Path::new(name_or_path)) {
                Err(Error::Read { reason, .. }) if !Path::new(name_or_path).exists() => {
                    let known = built_in.iter().map(|(n, _)| *n);
                    return Err(Error::Read {
                        path: name_or_path.into(),
                        reason: format!(
                            "{reason}; characters known by name: {}",
                            known.collect::<Vec<_>>().join(", ")
                        ),
                    });
                }
                other => other?,
            },
        };
        Self::parse(&source).map(Arc::new)
    }

    /// Reads a character from text.
    ///
    /// # Errors
    /// [`Error::Syntax`] or [`Error::Invalid`] with the line, the field and what is accepted.
    pub fn parse(source: &Source) -> Result<Self> {
        read(source)
    }

    /// Fills in what depends on the rest.
    fn complete(mut self) -> Self {
        self.digest = digest::digest(&self);
        self.total_mass = self.links.iter().map(|l| l.mass).sum();
        let model = &mut self;
        let mut kinematics = Kinematics::new(model);
        let state = State {
            q: vec![0.0; model.dof()],
            qdot: vec![0.0; model.dof()],
        };
        kinematics.update(model, &state);
        let lowest = model
            .feet
            .iter()
            .flat_map(|f| [(f.link, f.heel), (f.link, f.toe)])
            .map(|(link, p)| kinematics.point(link, p)[1])
            .fold(f64::INFINITY, f64::min);
        model.standing_height = -lowest;
        let com = kinematics.com;
        model.standing_com = [com[0], com[1] - lowest];
        self
    }
}

/// Parses and validates a character.
fn read(source: &Source) -> Result<Model> {
    let file: CharacterFile = source.parse()?;
    model(file, &source.text).map_err(|e| source.locate(e))
}

fn model(file: CharacterFile, text: &str) -> Result<Model> {
    tree::name(&file.name).map_err(|e| e.inside("name"))?;
    check::count("links", file.links.len(), 1..=MOST_LINKS, "links")?;
    tree::check(&file.links)?;
    let names: Vec<&str> = file.links.iter().map(|l| l.name.as_str()).collect();
    let find = |field: &str, name: &str| {
        let place = names.iter().position(|n| *n == name);
        place.ok_or_else(|| Error::unknown("link", name, names.iter().copied()).inside(field))
    };
    let trunk = find("trunk", &file.trunk)?;
    let head = find("head", &file.head)?;
    if file.feet.is_empty() {
        let accepted = "at least one (link: …, heel: (x, y), toe: (x, y))";
        return Err(Error::refused("feet", "missing", accepted));
    }
    let mut feet = Vec::with_capacity(file.feet.len());
    for (i, f) in file.feet.iter().enumerate() {
        let of = |e: Error| e.inside(("feet", i));
        let link = find("link", &f.link).map_err(of)?;
        point("heel", f.heel).map_err(of)?;
        point("toe", f.toe).map_err(of)?;
        let ahead = f.toe[0] - f.heel[0];
        if ahead < 1e-3 {
            let accepted = "a toe at least 1 mm ahead of the heel";
            let problem = format!("{ahead} m ahead of the heel");
            return Err(of(Error::refused("toe", problem, accepted)));
        }
        feet.push(Foot {
            link,
            heel: f.heel,
            toe: f.toe,
        });
    }
    let mut hands = Vec::with_capacity(file.hands.len());
    for (i, h) in file.hands.iter().enumerate() {
        let of = |e: Error| e.inside(("hands", i));
        point("tip", h.tip).map_err(of)?;
        hands.push(Hand {
            link: find("link", &h.link).map_err(of)?,
            tip: h.tip,
        });
    }
    let mut links = Vec::with_capacity(file.links.len());
    for (i, entry) in file.links.iter().enumerate() {
        links.push(link(entry, &names).map_err(|e| e.inside(("links", i)))?);
    }
    if let Some(flesh) = &file.flesh {
        let of = |e: Error| e.inside("flesh");
        check::within("stiffness", flesh.stiffness, 0.0..=STIFFEST).map_err(of)?;
        check::within("gives", flesh.gives, 0.01..=1.0).map_err(of)?;
    }
    let model = Model {
        name: file.name,
        links,
        feet,
        hands,
        trunk,
        head,
        flesh: file.flesh,
        source: text.to_owned(),
        digest: 0,
        total_mass: 0.0,
        standing_height: 0.0,
        standing_com: [0.0; 2],
    };
    Ok(model.complete())
}

fn link(entry: &LinkEntry, names: &[&str]) -> Result<Link> {
    check::above("mass", entry.mass, 0.0, MOST)?;
    check::above("inertia", entry.inertia, 0.0, MOST)?;
    point("com", entry.com)?;
    shape(entry.shape).map_err(|e| e.inside("shape"))?;
    let joint = entry.joint.as_ref().map(|j| joint(j, names)).transpose();
    Ok(Link {
        name: entry.name.clone(),
        joint: joint.map_err(|e| e.inside("joint"))?,
        mass: entry.mass,
        com: entry.com,
        inertia: entry.inertia,
        shape: entry.shape,
    })
}

fn shape(shape: Shape) -> Result<()> {
    let length = |field, length| check::above(field, length, 0.0, MOST);
    shape.check(length, |field, p| point(field, p))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HUMANOID: &str = include_str!("../../../characters/humanoid.ron");

    fn refusal(text: &str) -> String {
        read(&Source::new("test.ron", text))
            .unwrap_err()
            .to_string()
    }

    fn changed(from: &str, to: &str) -> String {
        assert!(HUMANOID.contains(from), "{from}");
        refusal(&HUMANOID.replacen(from, to, 1))
    }

    #[test]
    fn the_humanoid_is_read_with_its_numbers() {
        let m = read(&Source::new("humanoid", HUMANOID)).unwrap();
        assert_eq!((m.links.len(), m.dof(), m.feet.len()), (13, 15, 2));
        assert!((m.total_mass() - 80.0).abs() < 1e-9);
        assert!((m.standing_height() - 0.917_146_456_370_34).abs() < 1e-12);
    }

    #[test]
    fn infinities_and_not_a_number_are_refused_with_field_and_line() {
        let text = changed("mass: 8.936", "mass: NaN");
        assert!(
            text.starts_with("test.ron:") && text.contains("links[0].mass is NaN"),
            "{text}"
        );
        assert!(
            changed("inertia: 0.4535531586997044", "inertia: inf")
                .contains("links[1].inertia is inf")
        );
        assert!(changed("mass: 8.936", "mass: -1.0").contains("above 0"));
    }

    #[test]
    fn broken_trees_are_refused() {
        let cycle = changed(
            "name: \"waist\", parent: \"pelvis\"",
            "name: \"waist\", parent: \"head\"",
        );
        assert!(cycle.contains("a cycle (torso → head → torso)"), "{cycle}");
        let orphan = changed(
            "name: \"neck\", parent: \"torso\"",
            "name: \"neck\", parent: \"torsso\"",
        );
        assert!(
            orphan.contains("'torsso'") && orphan.contains("did you mean 'torso'"),
            "{orphan}"
        );
        assert!(changed("name: \"neck\"", "name: \"waist\"").contains("a second time"));
    }

    #[test]
    fn missing_feet_and_unordered_limits_are_refused() {
        let start = HUMANOID.find("    feet: [").unwrap();
        let end = start + HUMANOID[start..].find("    ],").unwrap() + 7;
        let text = refusal(&format!("{}{}", &HUMANOID[..start], &HUMANOID[end..]));
        assert!(text.contains("feet is missing"), "{text}");
        let text = changed(
            "range: (-1.0471975511965976, 1.0471975511965976)",
            "range: (1.0, -1.0)",
        );
        assert!(text.contains(".joint.range is (1, -1)"), "{text}");
    }

    #[test]
    fn muscles_and_flesh_are_checked() {
        let neck = "muscles: (positive: (torque: 63.0, speeds: (2.0, 5.0)), negative: (torque: 35.0, speeds: (2.0, 5.0))),";
        let beside = changed(neck, &format!("torque: 250.0, {neck}"));
        assert!(
            beside.contains("joint.torque is given beside muscles"),
            "{beside}"
        );
        let missing = changed(neck, "");
        assert!(
            missing.contains("joint.torque is missing; accepted: either"),
            "{missing}"
        );
        for (from, to, told) in [
            (
                "speeds: (1.578, 3.19)",
                "speeds: (3.2, 3.19)",
                "joint.muscles.positive.speeds[1] is 3.19; accepted: above 3.2",
            ),
            (
                "torque: 350.0",
                "torque: -350.0",
                "joint.muscles.positive.torque is -350",
            ),
            (
                "gives: 0.03",
                "gives: 0",
                "flesh.gives is 0; accepted: 0.01 to 1",
            ),
        ] {
            let refused = changed(from, to);
            assert!(refused.contains(told), "{refused}");
        }
    }

    #[test]
    fn unknown_fields_say_where_they_stand() {
        let text = changed("trunk:", "trnk:");
        assert!(text.starts_with("test.ron:13:"), "{text}");
    }
}

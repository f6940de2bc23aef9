//! The schema of a character file, and every bound that a character must keep.
//!
//! RON → entries, of which `model_tree` checks that they form a tree → [`Model`].

use serde::Deserialize;

use crate::error::{Error, Result};
use crate::file::Source;
use crate::model::{Foot, Hand, Joint, Link, MOST_LINKS, Model, Point, Shape};
use crate::model_tree;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CharacterFile {
    name: String,
    trunk: String,
    head: String,
    #[serde(default)]
    hands: Vec<HandEntry>,
    #[serde(default)]
    feet: Vec<FootEntry>,
    links: Vec<LinkEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FootEntry {
    link: String,
    heel: Point,
    toe: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HandEntry {
    link: String,
    tip: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkEntry {
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) joint: Option<JointEntry>,
    mass: f64,
    com: Point,
    inertia: f64,
    shape: Shape,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointEntry {
    pub(crate) name: String,
    pub(crate) parent: String,
    anchor: Point,
    range: [f64; 2],
    torque: f64,
    kp: f64,
    kd: f64,
}

const POSITIVE: &str = "a finite number above 0 and at most 1e6";
const LENGTH: &str = "finite, at most 100 m either way";

/// Parses and validates a character.
pub(crate) fn read(source: &Source) -> Result<Model> {
    let file: CharacterFile = source.parse()?;
    name(source, "name", &file.name)?;
    let count = file.links.len();
    if count == 0 || count > MOST_LINKS {
        return Err(source.invalid(
            "links",
            "links",
            format!("a list of {count}"),
            format!("1 to {MOST_LINKS} links"),
        ));
    }
    model_tree::check(source, &file.links)?;
    let names: Vec<&str> = file.links.iter().map(|l| l.name.as_str()).collect();
    let find = |field: &str, name: &str| {
        names.iter().position(|n| *n == name).ok_or_else(|| {
            let place = source.place(field);
            Error::unknown("link", name, names.iter().copied()).at(&format!("{place}: {field}"))
        })
    };
    let trunk = find("trunk", &file.trunk)?;
    let head = find("head", &file.head)?;
    if file.feet.is_empty() {
        return Err(source.invalid(
            "feet",
            "feet",
            "missing",
            "at least one (link: …, heel: (x, y), toe: (x, y))",
        ));
    }
    let mut feet = Vec::with_capacity(file.feet.len());
    for (i, f) in file.feet.iter().enumerate() {
        point(source, &format!("feet[{i}].heel"), &f.link, f.heel)?;
        point(source, &format!("feet[{i}].toe"), &f.link, f.toe)?;
        if f.toe[0] - f.heel[0] < 1e-3 {
            return Err(source.invalid(
                "feet",
                format!("feet[{i}].toe"),
                format!("{} m ahead of the heel", f.toe[0] - f.heel[0]),
                "a toe at least 1 mm ahead of the heel",
            ));
        }
        feet.push(Foot {
            link: find("feet", &f.link)?,
            heel: f.heel,
            toe: f.toe,
        });
    }
    let mut hands = Vec::with_capacity(file.hands.len());
    for (i, h) in file.hands.iter().enumerate() {
        point(source, &format!("hands[{i}].tip"), &h.link, h.tip)?;
        hands.push(Hand {
            link: find("hands", &h.link)?,
            tip: h.tip,
        });
    }
    let mut links = Vec::with_capacity(count);
    for entry in &file.links {
        links.push(link(source, entry, &names)?);
    }
    Ok(Model::assemble(
        source.text.clone(),
        file.name,
        links,
        feet,
        hands,
        trunk,
        head,
    ))
}

fn link(source: &Source, entry: &LinkEntry, names: &[&str]) -> Result<Link> {
    let who = entry.name.as_str();
    let field = |f: &str| format!("{who}.{f}");
    positive(source, &field("mass"), who, entry.mass)?;
    positive(source, &field("inertia"), who, entry.inertia)?;
    point(source, &field("com"), who, entry.com)?;
    match entry.shape {
        Shape::Capsule { radius, from, to } => {
            positive(source, &field("shape.radius"), who, radius)?;
            point(source, &field("shape.from"), who, from)?;
            point(source, &field("shape.to"), who, to)?;
        }
        Shape::Box { half, centre } => {
            positive(source, &field("shape.half.0"), who, half[0])?;
            positive(source, &field("shape.half.1"), who, half[1])?;
            point(source, &field("shape.centre"), who, centre)?;
        }
    }
    let joint = entry
        .joint
        .as_ref()
        .map(|j| joint(source, j, names))
        .transpose()?;
    Ok(Link {
        name: entry.name.clone(),
        joint,
        mass: entry.mass,
        com: entry.com,
        inertia: entry.inertia,
        shape: entry.shape,
    })
}

fn joint(source: &Source, entry: &JointEntry, names: &[&str]) -> Result<Joint> {
    let who = entry.name.as_str();
    let field = |f: &str| format!("{who}.{f}");
    point(source, &field("anchor"), who, entry.anchor)?;
    let [low, high] = entry.range;
    let full = std::f64::consts::TAU;
    if !(low.is_finite()
        && high.is_finite()
        && low < high
        && low.abs() <= full
        && high.abs() <= full)
    {
        return Err(source.invalid(
            &quoted(who),
            field("range"),
            format!("({low}, {high})"),
            "(low, high) with low < high, both within ±2π",
        ));
    }
    positive(source, &field("torque"), who, entry.torque)?;
    positive(source, &field("kp"), who, entry.kp)?;
    positive(source, &field("kd"), who, entry.kd)?;
    Ok(Joint {
        name: entry.name.clone(),
        parent: names.iter().position(|n| *n == entry.parent).unwrap_or(0),
        anchor: entry.anchor,
        range: entry.range,
        torque: entry.torque,
        kp: entry.kp,
        kd: entry.kd,
    })
}

pub(crate) fn quoted(name: &str) -> String {
    format!("\"{name}\"")
}

fn positive(source: &Source, field: &str, who: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 && value <= 1e6 {
        Ok(())
    } else {
        Err(source.invalid(&quoted(who), field, value, POSITIVE))
    }
}

fn point(source: &Source, field: &str, who: &str, p: Point) -> Result<()> {
    if p.iter().all(|c| c.is_finite() && c.abs() <= 100.0) {
        Ok(())
    } else {
        Err(source.invalid(&quoted(who), field, format!("({}, {})", p[0], p[1]), LENGTH))
    }
}

pub(crate) fn name(source: &Source, field: &str, name: &str) -> Result<()> {
    let fine = !name.is_empty()
        && name.len() <= 64
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if fine {
        Ok(())
    } else {
        Err(source.invalid(
            &quoted(name),
            field,
            format!("'{}'", crate::error::shortened(name)),
            "1 to 64 letters, digits, '_' or '-'",
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HUMANOID: &str = include_str!("../characters/humanoid.ron");

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
            text.starts_with("test.ron:") && text.contains("pelvis.mass is NaN"),
            "{text}"
        );
        assert!(
            changed("inertia: 0.4535531586997044", "inertia: inf").contains("torso.inertia is inf")
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
        assert!(text.contains("neck.range is (1, -1)"), "{text}");
    }

    #[test]
    fn unknown_fields_say_where_they_stand() {
        let text = changed("trunk:", "trnk:");
        assert!(text.starts_with("test.ron:8:"), "{text}");
    }
}

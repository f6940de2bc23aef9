#![allow(clippy::disallowed_methods, reason = "tests may differ in a last bit")]

use std::sync::Arc;

use aplomb_framework::character::{Kinematics, State};
use aplomb_framework::input::Source;

use super::curve::{area, inside};
use super::*;

const CHARACTERS: [&str; 3] = ["humanoid", "sumo", "lion"];

/// The humanoid with other names.
fn renamed(names: &[(&str, &str)]) -> Arc<Model> {
    let source = Model::load("humanoid").unwrap().source.clone();
    let text = names
        .iter()
        .fold(source, |t, (from, to)| t.replace(from, to));
    Arc::new(Model::parse(&Source::new("renamed", &text)).unwrap())
}

#[test]
fn outlines_are_closed_polygons_of_finite_corners() {
    for name in CHARACTERS {
        for part in figure(&Model::load(name).unwrap()) {
            let about = format!("{name}, link {}, {:?}", part.link, part.tone);
            assert!(part.outline.len() >= 8, "{about}");
            assert!(area(&part.outline) > 1e-5, "{about}");
            assert_ne!(part.outline.first(), part.outline.last(), "{about}");
            let points = part.outline.iter().chain(part.lines.iter().flatten());
            assert!(points.flatten().all(|x| x.is_finite()), "{about}");
            assert!(part.lines.iter().all(|l| l.len() > 1), "{about}");
        }
    }
}

#[test]
fn every_link_has_a_part_and_far_sides_are_behind() {
    for name in CHARACTERS {
        let model = Model::load(name).unwrap();
        let parts = figure(&model);
        for (i, link) in model.links.iter().enumerate() {
            let own: Vec<_> = parts.iter().filter(|p| p.link == i).collect();
            assert!(!own.is_empty(), "{name}: {}", link.name);
            let far = link.name.ends_with("_l");
            assert!(own.iter().all(|p| p.far == far), "{name}: {}", link.name);
        }
        let first_near = parts.iter().position(|p| !p.far).unwrap();
        assert!(parts[first_near..].iter().all(|p| !p.far), "{name}");
        assert!(parts.is_sorted_by_key(|p| p.layer), "{name}");
    }
}

/// The drawn body reaches as far as the physical one, give or take clothes, hair and ears.
#[test]
fn parts_stay_near_the_physical_shapes() {
    for name in CHARACTERS {
        let model = Model::load(name).unwrap();
        let allowed = if name == "lion" { 0.11 } else { 0.06 };
        for part in figure(&model) {
            let link = &model.links[part.link];
            for p in &part.outline {
                let (near, radius) = link.shape.nearest(*p);
                let beyond = (p[0] - near[0]).hypot(p[1] - near[1]) - radius;
                // Clothes and flesh reach to the joints at most.
                let to_joint = model.links.iter().filter_map(|l| l.joint.as_ref());
                let children = to_joint.filter(|j| j.parent == part.link).map(|j| j.anchor);
                let joint = children
                    .chain([[0.0; 2]])
                    .map(|c| (p[0] - c[0]).hypot(p[1] - c[1]) - radius)
                    .fold(f64::INFINITY, f64::min);
                let beyond = beyond.min(joint);
                assert!(beyond < allowed, "{name}: {} by {beyond}", link.name);
            }
        }
    }
}

#[test]
fn soles_lie_on_the_physical_soles() {
    for name in CHARACTERS {
        let model = Model::load(name).unwrap();
        let parts = figure(&model);
        for foot in &model.feet {
            let outlines = parts.iter().filter(|p| p.link == foot.link);
            let corners: Vec<Point> = outlines.flat_map(|p| p.outline.clone()).collect();
            let low = corners.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
            assert!((low - foot.heel[1]).abs() < 0.002, "{name}: {low}");
            // It is flat for most of the foot's length.
            let flat = corners.iter().filter(|p| p[1] < low + 0.002).map(|p| p[0]);
            let (rear, front) = flat.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
            let length = foot.toe[0] - foot.heel[0];
            assert!(front - rear > 0.8 * length, "{name}: {rear} to {front}");
        }
    }
}

/// Around every joint a disc is covered by the link and its parent at all angles.
#[test]
fn neighbours_overlap_at_joints_through_their_range() {
    let unknown = renamed(&[("_arm_", "_limb_")]);
    let shipped = CHARACTERS.map(|name| Model::load(name).unwrap());
    for model in shipped.into_iter().chain([unknown]) {
        let parts = figure(&model);
        let mut kinematics = Kinematics::new(&model);
        for (i, link) in model.links.iter().enumerate() {
            let Some(joint) = &link.joint else { continue };
            let least = 0.55 * link.shape.nearest([0.0; 2]).1;
            for step in 0..=8 {
                let angle =
                    joint.range[0] + f64::from(step) / 8.0 * (joint.range[1] - joint.range[0]);
                let mut state = State::standing(&model);
                state.q[i + 2] = angle;
                kinematics.update(&model, &state);
                let centre = kinematics.links[i].origin;
                for k in 0..12 {
                    let around = f64::from(k) / 12.0 * std::f64::consts::TAU;
                    let p = [
                        centre[0] + least * around.cos(),
                        centre[1] + least * around.sin(),
                    ];
                    let covered = parts
                        .iter()
                        .filter(|part| [i, joint.parent].contains(&part.link))
                        .any(|part| {
                            let world: Vec<Point> = part
                                .outline
                                .iter()
                                .map(|c| kinematics.point(part.link, *c))
                                .collect();
                            inside(&world, p)
                        });
                    assert!(covered, "{}: {} at {angle}", model.name, joint.name);
                }
            }
        }
    }
}

#[test]
fn unknown_links_are_drawn_as_what_touches_the_world() {
    let model = renamed(&[("upper_arm", "wing"), ("\"head\"", "\"bulb\"")]);
    let parts = figure(&model);
    let tone = |name: &str| {
        let link = model.link_index(name).unwrap();
        let part = parts.iter().rev().find(|p| p.link == link).unwrap();
        (part.tone, part.far)
    };
    assert_eq!(tone("wing_l"), (Tone::Shirt, true));
    assert_eq!(tone("bulb"), (Tone::Skin, false));
    assert_eq!(tone("thigh_r"), (Tone::Trousers, false));
}

#[test]
fn what_is_worn_is_what_the_character_wears() {
    let tones = |name: &str| {
        let parts = figure(&Model::load(name).unwrap());
        let tones: std::collections::BTreeSet<Tone> = parts.iter().map(|p| p.tone).collect();
        tones.into_iter().collect::<Vec<_>>()
    };
    use Tone::{Belt, Fur, Hair, Mane, Shirt, Shoe, Skin, Trousers};
    assert_eq!(tones("humanoid"), [Skin, Hair, Shirt, Trousers, Shoe]);
    assert_eq!(tones("sumo"), [Skin, Hair, Belt]);
    assert_eq!(tones("lion"), [Hair, Fur, Mane]);
}

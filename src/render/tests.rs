use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::events::{Event, EventKind};
use aplomb_framework::run::{Cast, Header, push_character};
use aplomb_framework::sensing::Sensors;
use aplomb_framework::world::Prop;

use super::seen::{Seen, Sight, assert_seen};
use super::style::GROUND;
use super::wardrobe::colour;
use super::*;
use crate::figure::{FigurePart, figure};

/// A standing character that is pushed at 0.5 s, falls at 1 s and lies.
pub(super) fn recording(steps: usize, spoil: impl FnMut(usize, &mut Vec<f32>)) -> Trajectory {
    staged(steps, vec![], spoil)
}

/// The same with props, whose x, y and angle the last function adds to each row.
pub(super) fn staged(
    steps: usize,
    props: Vec<Prop>,
    mut spoil: impl FnMut(usize, &mut Vec<f32>),
) -> Trajectory {
    let model = Model::load("humanoid").unwrap();
    let cast = Cast {
        model: model.source.clone(),
        controllers: vec!["balance".into(), "<fall> & \"rest\"\u{1}".into()],
    };
    let header = Header {
        scenario: "a & b <c>".into(),
        seed: 3,
        dt: 1e-3,
        cast: vec![cast],
        props,
    };
    let mut t = Trajectory::new(header, vec![Arc::clone(&model)]);
    let mut now = Sensors::new(&model, 9.81);
    for i in 0..steps {
        let time = i as f64 * 1e-3;
        let fallen = (2.0 * (time - 1.0)).clamp(0.0, 1.0);
        now.state.q[1] = 0.9 - 0.7 * fallen;
        now.state.q[2] = 1.5 * fallen;
        now.com = [-0.5 * fallen, 1.0 - 0.8 * fallen];
        now.cop = Some(0.05);
        now.base_of_support = Some([-0.06, 0.19]);
        now.ground_reaction_force = [10.0, 785.0];
        let mut row = Vec::new();
        push_character(&mut row, &now, Some(0.0), usize::from(time > 1.0));
        spoil(i, &mut row);
        t.push_row(&row);
    }
    let events = [
        (
            0.5,
            EventKind::Push {
                link: "torso".into(),
                impulse: [-60.0, 0.0],
            },
        ),
        (
            0.8,
            EventKind::Push {
                link: "no such link".into(),
                impulse: [f64::NAN, 0.0],
            },
        ),
        (1.1, EventKind::Fell),
        (9e9, EventKind::Stood),
    ];
    t.events.extend(events.map(|(time, kind)| Event {
        time,
        character: 0,
        kind,
    }));
    t
}

/// What every picture of such a recording shows, whatever its numbers are.
fn all_pictures(t: &Trajectory) {
    // The key names what is there.
    let stands = t.moment(0, 0).cop.is_some_and(f32::is_finite);
    let mut signs = vec!["right limbs", "left limbs"];
    if stands {
        signs.extend(["centre of pressure", "base of support"]);
    }
    if t.len() > 600 {
        signs.push("push");
    }
    let mut sights = vec![Sight::Text("seed 3", 1), Sight::Text("0.00 s", 1)];
    sights.extend(signs.into_iter().map(|name| Sight::Text(name, 1)));
    sights.push(Sight::Curve(GROUND, 4, 100.0));
    assert_seen(&filmstrip(t, &FilmOptions::default()).unwrap(), &sights);
    let axes = [
        "position x (m)",
        "height (m)",
        "trunk pitch (rad)",
        "time (s)",
    ];
    let mut axes = axes.map(|name| Sight::Text(name, 1)).to_vec();
    axes.push(Sight::Text("centre of mass", 2));
    assert_seen(&plot(t, 0).unwrap(), &axes);
    sights.extend(axes);
    assert_seen(&picture(t, true).unwrap(), &sights);
    let camera = Camera::following(t, 0, 0, [480.0, 300.0]).unwrap();
    let clock = format!("{:.2} s", (t.len() - 1) as f64 * t.header.dt);
    let sights = [Sight::Text(&clock, 1), Sight::Curve(GROUND, 4, 480.0)];
    assert_seen(&frame(t, t.len() - 1, &camera).unwrap(), &sights);
}

#[test]
fn pictures_show_what_they_are_for_whatever_the_names_are() {
    all_pictures(&recording(3000, |_, _| {}));
}

/// How many outlines of one frame have the colour of the humanoid's parts of each tone and side,
/// and how many such parts there are on the links whose names are kept.
fn drawn(t: &Trajectory, kept: impl Fn(&str) -> bool) -> [Vec<usize>; 2] {
    let model = &t.models[0];
    let camera = Camera::following(t, 0, 0, [480.0, 300.0]).unwrap();
    let seen = Seen::of(&frame(t, 0, &camera).unwrap());
    let parts = figure(model);
    let mut kinds: Vec<_> = parts.iter().map(|p| (p.tone, p.far)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let of = |part: &FigurePart| kept(&model.links[part.link].name);
    let count = |kind| {
        parts
            .iter()
            .filter(|p| (p.tone, p.far) == kind && of(p))
            .count()
    };
    let there = kinds
        .iter()
        .map(|(tone, far)| seen.coloured(&colour(0, *tone, *far)).len());
    [there.collect(), kinds.iter().map(|k| count(*k)).collect()]
}

#[test]
fn every_part_of_every_limb_is_drawn_in_its_colour() {
    let model = Model::load("humanoid").unwrap();
    let [there, all] = drawn(&recording(1, |_, _| {}), |_| true);
    assert_eq!(there, all);
    assert!(all.len() >= 8, "near and far have colours of their own");
    // Without a right elbow's angle the right forearm is missing.
    let elbow = 3 + model.joint_index("elbow_r").unwrap();
    let without = recording(1, |_, row| row[elbow] = f32::NAN);
    let [there, rest] = drawn(&without, |link| link != "forearm_r");
    assert_eq!(there, rest);
    assert_ne!(rest, all);
    let lost = recording(1, |_, row| row[1] = f32::NAN);
    let [there, none] = drawn(&lost, |_| false);
    assert_eq!(there, none);
}

#[test]
fn labels_neither_overlap_nor_leave_the_picture() {
    let t = recording(3000, |_, _| {});
    let camera = Camera::following(&t, 0, 0, [480.0, 300.0]).unwrap();
    let pictures = [
        filmstrip(&t, &FilmOptions::default()),
        plot(&t, 0),
        picture(&t, true),
        frame(&t, 1200, &camera),
    ];
    for svg in pictures {
        let crowded = Seen::of(&svg.unwrap()).crowded();
        assert!(crowded.is_empty(), "{}", crowded.join("\n"));
    }
    // Words on top of each other, and words outside, are found.
    let words = |x: f64, words: &str| style::text([x, 20.0], 12.0, "#000000", "start", words);
    let spoilt = Group::new()
        .add(words(10.0, "one"))
        .add(words(14.0, "two"))
        .add(words(90.0, "outside"));
    let crowded = Seen::of(&style::document([100.0, 40.0], spoilt)).crowded();
    assert_eq!(crowded.len(), 2, "{crowded:?}");
}

/// Tags in a film strip and the band of a plot have the colour and the time of who is active.
#[test]
fn active_controllers_are_seen_for_as_long_as_they_are_active() {
    let mut t = recording(3000, |_, _| {});
    // Its colour is that of nothing else.
    t.header.cast[0].controllers[1] = "fall".into();
    let colours = style::controller_colours(&t.header.cast[0].controllers);
    let options = FilmOptions {
        frames: Some(8),
        ..FilmOptions::default()
    };
    let shots = choose::shots(&t, 8);
    let before = shots.iter().filter(|s| s.step <= 1000).count();
    let after = shots.len() - before;
    assert!(before > 0 && after > 0);
    let tags = [
        Sight::Text("balance", before),
        Sight::Shapes(colours[0], before),
        Sight::Shapes(colours[1], after),
    ];
    assert_seen(&filmstrip(&t, &options).unwrap(), &tags);
    let band = [
        Sight::Text("push 60 N·s", 1),
        Sight::Text("fell", 1),
        Sight::Shapes(colours[0], 1),
        Sight::Shapes(colours[1], 1),
        Sight::Curve(style::COM, 100, 800.0),
        Sight::Curve(style::FORCE, 100, 800.0),
        Sight::Curve(style::CAPTURE, 100, 800.0),
    ];
    let seen = assert_seen(&plot(&t, 0).unwrap(), &band);
    assert!(
        seen.labels.iter().all(|l| l.text != "stood"),
        "it is after the end"
    );
    let width = |colour| seen.coloured(colour)[0].extent.width();
    let share = width(colours[0]) / (width(colours[0]) + width(colours[1]));
    assert!((share - 1.001 / 3.0).abs() < 1e-3, "{share}");
}

/// Pixels of the second of two frames that are not as in the first.
fn changed(t: &Trajectory, steps: [usize; 2]) -> usize {
    let camera = Camera::following(t, 0, 0, [480.0, 300.0]).unwrap();
    let drawn = |step| raster::pixels(&frame(t, step, &camera).unwrap(), 1.0).unwrap();
    let [first, second] = steps.map(drawn);
    let pairs = first.pixels().iter().zip(second.pixels());
    pairs.filter(|(a, b)| a != b).count()
}

/// While it stands, the clock alone changes; when it falls, the body does.
#[test]
fn frames_differ_by_what_moves() {
    let t = recording(1500, |_, _| {});
    assert_eq!(changed(&t, [100, 100]), 0);
    let (clock, fall) = (changed(&t, [100, 300]), changed(&t, [1000, 1300]));
    assert!((1..300).contains(&clock), "{clock}");
    assert!(fall > 3000, "{fall}");
}

#[test]
fn recordings_of_a_single_step_are_drawn() {
    let t = recording(1, |_, _| {});
    all_pictures(&t);
    gif(&t, Vec::new(), &AnimationOptions::default()).unwrap();
}

#[test]
fn what_is_no_number_is_left_out() {
    all_pictures(&recording(1200, |_, row| row.fill(f32::NAN)));
    all_pictures(&recording(1200, |i, row| {
        if i > 600 {
            row.fill(f32::INFINITY);
        }
    }));
    all_pictures(&recording(1200, |i, row| {
        row[i % 30] = f32::NAN;
    }));
}

#[test]
fn a_character_far_away_is_drawn() {
    let far = |_: usize, row: &mut Vec<f32>| {
        row[0] = 1e6;
        row[30] = 1e6;
    };
    all_pictures(&recording(300, far));
    all_pictures(&recording(300, |i, row| {
        row[0] = 1e30 * i as f32;
        row[30] = 1e30 * i as f32;
    }));
}

#[test]
fn an_empty_recording_is_an_error() {
    let t = recording(0, |_, _| {});
    let error = filmstrip(&t, &FilmOptions::default())
        .unwrap_err()
        .to_string();
    assert!(error.contains("no step was recorded"), "{error}");
    assert!(plot(&t, 0).is_err());
    assert!(gif(&t, Vec::new(), &AnimationOptions::default()).is_err());
    assert!(plot(&recording(10, |_, _| {}), 1).is_err());
}

#[test]
fn other_extensions_are_refused_with_the_accepted_ones() {
    let t = recording(10, |_, _| {});
    let folder = tempfile::tempdir().unwrap();
    for name in ["x.bmp", "x"] {
        let path = folder.path().join(name);
        let error = write(&t, &path, true).unwrap_err().to_string();
        assert!(error.contains(".svg, .png, .gif, .mp4"), "{error}");
        assert!(!path.exists());
    }
    let path = folder.path().join("x.PNG");
    write(&t, &path, true).unwrap();
    assert!(std::fs::read(&path).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_gif_plays_in_real_time() {
    let t = recording(2001, |_, _| {});
    let mut bytes = Vec::new();
    gif(
        &t,
        &mut bytes,
        &AnimationOptions {
            fps: 30.0,
            ..AnimationOptions::default()
        },
    )
    .unwrap();
    let mut decoder = gif::DecodeOptions::new()
        .read_info(bytes.as_slice())
        .unwrap();
    let (mut changed, mut time) = (Vec::new(), 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let same = |index: &&u8| Some(**index) != frame.transparent;
        changed.push(frame.buffer.iter().filter(same).count());
        time += u32::from(frame.delay);
    }
    assert_eq!((changed.len(), time), (61, 200 + 100));
    // The first is whole; from 1 s to 1.5 s, frames 30 to 45, it falls.
    assert_eq!(changed[0], 640 * 400);
    let fall = changed[32..44].iter().min().unwrap();
    let rest = changed[2..12].iter().chain(&changed[50..]).max().unwrap();
    assert!(fall > rest, "{changed:?}");
}

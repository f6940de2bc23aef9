use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::events::{Event, EventKind};
use aplomb_framework::run::{Cast, Header, push_character};
use aplomb_framework::sensing::Sensors;

use super::body::SKINS;
use super::seen::{Seen, Sight, assert_seen};
use super::style::GROUND;
use super::*;

/// A standing character that is pushed at 0.5 s, falls at 1 s and lies.
pub(super) fn recording(steps: usize, mut spoil: impl FnMut(usize, &mut Vec<f32>)) -> Trajectory {
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
        props: vec![],
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
    let signs = [
        "right limbs",
        "centre of pressure",
        "base of support",
        "push",
    ];
    let mut sights = vec![Sight::Text("seed 3", 1), Sight::Text("0.00 s", 1)];
    sights.extend(signs.map(|name| Sight::Text(name, 1)));
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

/// The outlines of one frame that are drawn in each shade of the first skin: right, middle, left.
fn limbs(t: &Trajectory) -> [usize; 3] {
    let camera = Camera::following(t, 0, 0, [480.0, 300.0]).unwrap();
    let seen = Seen::of(&frame(t, 0, &camera).unwrap());
    let skin = SKINS[0];
    [skin.near, skin.middle, skin.far].map(|shade| seen.coloured(shade).len())
}

/// A link is one outline, with a bridge to its joint and, within a limb, one from there to its parent.
#[test]
fn every_limb_is_drawn() {
    let model = Model::load("humanoid").unwrap();
    let side = |link: usize| {
        model.links[link]
            .name
            .rsplit_once('_')
            .map(|(_, side)| side)
    };
    let outlines = |wanted: Option<&str>| -> usize {
        let links = (0..model.links.len()).filter(|l| side(*l) == wanted);
        let bridges = |link: &usize| match &model.links[*link].joint {
            Some(joint) => 1 + usize::from(side(joint.parent) == wanted),
            None => 0,
        };
        links.map(|l| 1 + bridges(&l)).sum()
    };
    // The middle has nose and face as well.
    let all = [outlines(Some("r")), outlines(None) + 2, outlines(Some("l"))];
    assert_eq!(limbs(&recording(1, |_, _| {})), all);
    // Without a right elbow's angle the forearm and both of its bridges are missing.
    let elbow = 3 + model.joint_index("elbow_r").unwrap();
    let without = limbs(&recording(1, |_, row| row[elbow] = f32::NAN));
    assert!(without[0] < all[0], "{without:?} of {all:?}");
    assert_eq!(without[1..], all[1..]);
    let lost = limbs(&recording(1, |_, row| row[1] = f32::NAN));
    assert_eq!(lost, [0; 3]);
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
    let before = choose::shots(&t, 8)
        .iter()
        .filter(|s| s.step <= 1000)
        .count();
    assert!((1..8).contains(&before));
    let tags = [
        Sight::Text("balance", before),
        Sight::Shapes(colours[0], before),
        Sight::Shapes(colours[1], 8 - before),
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
fn frames_are_chosen_at_the_ends_at_events_and_where_much_moves() {
    let t = recording(6000, |_, _| {});
    let shots = choose::shots(&t, 12);
    assert_eq!(shots.len(), 12);
    assert_eq!((shots[0].step, shots[11].step), (0, 5999));
    assert!(shots.iter().any(|s| s.step == 550), "during the push");
    assert!(shots.iter().any(|s| s.step == 1100), "the fall");
    let falling = shots
        .iter()
        .filter(|s| (1000..1500).contains(&s.step))
        .count();
    assert!(
        falling >= 5,
        "{falling} of 12 show the half second of the fall"
    );
    let events: Vec<usize> = shots.iter().flat_map(|s| s.events.clone()).collect();
    assert_eq!(
        events,
        [0, 1, 2],
        "each event on one frame, unless it is after the end"
    );
    assert_eq!(choose::shots(&t, 1).len(), 1);
    assert_eq!(choose::shots(&recording(3, |_, _| {}), 12).len(), 3);
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
    assert_eq!(changed[0], 480 * 300);
    let fall = changed[32..44].iter().min().unwrap();
    let rest = changed[2..12].iter().chain(&changed[50..]).max().unwrap();
    assert!(fall > rest, "{changed:?}");
}

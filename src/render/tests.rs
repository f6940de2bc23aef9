use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::events::{Event, EventKind};
use aplomb_framework::run::{Cast, Header, push_character};
use aplomb_framework::sensing::Sensors;

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

fn parses(svg: &str) {
    let size = raster::pixels(svg, 0.5).unwrap();
    assert!(size.width() > 1 && size.height() > 1);
    assert!(
        !svg.contains("NaN") && !svg.contains("inf"),
        "numbers that are none"
    );
}

fn all_pictures(t: &Trajectory) {
    parses(&filmstrip(t, &FilmOptions::default()).unwrap());
    parses(&plot(t, 0).unwrap());
    parses(&picture(t, true).unwrap());
    let camera = Camera::following(t, 0, 0, [480.0, 300.0]).unwrap();
    parses(&frame(t, t.len() - 1, &camera).unwrap());
}

#[test]
fn pictures_are_valid_svg_whatever_the_names_are() {
    all_pictures(&recording(3000, |_, _| {}));
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
    let t = recording(1001, |_, _| {});
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
    let (mut frames, mut time) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        frames += 1;
        time += u32::from(frame.delay);
    }
    assert_eq!((frames, time), (31, 100 + 100));
}

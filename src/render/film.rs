//! A film strip: chosen frames in rows at one scale, and a legend.

use anyhow::Result;
use aplomb_framework::events::EventKind;
use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

use super::body::SKINS;
use super::choose::{Shot, shots, suitable};
use super::marks::{WEIGHT_ARROW, com_sign, cop_sign, support_sign};
use super::scene::{Scene, window};
use super::style::{
    FAINT_INK, FORCE, FRAME, INK, PUSH, arrow, line, px, rectangle, shortened, text, text_width,
};
use super::timeline::event_colour;
use super::track::{Room, Track};
use super::{GRAVITY, drawable};

/// Width of a strip, SVG units.
pub(super) const WIDTH: f64 = 1080.0;
/// About the strip.
const MARGIN: f64 = 14.0;
/// Between panels.
const GAP: f64 = 7.0;
/// Of the line with time and controller over each panel, and of each further controller.
const HEAD: [f64; 2] = [23.0, 17.5];
/// Rows when the number of frames is not given.
const MOST_ROWS: usize = 4;

/// What a film strip shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FilmOptions {
    /// Number of frames; none leaves it to how much happens.
    pub frames: Option<usize>,
    /// Frames a row; none leaves it to the room that a frame takes.
    pub columns: Option<usize>,
    /// The character that is followed.
    pub character: usize,
}

/// The strip and its size.
pub(super) fn strip(trajectory: &Trajectory, options: &FilmOptions) -> Result<(Group, [f64; 2])> {
    drawable(trajectory, options.character)?;
    let track = Track::new(trajectory, options.character);
    let every = (trajectory.len() / 500).max(1);
    let steps: Vec<usize> = (0..trajectory.len()).step_by(every).collect();
    let room = Room::of(trajectory, options.character, &track, &steps);
    let fitting = if room.half > 1.5 { 4 } else { 6 };
    let columns = options.columns.unwrap_or(fitting).clamp(1, 24);
    let count = options.frames.unwrap_or_else(|| {
        let rows = suitable(trajectory).div_ceil(columns).clamp(1, MOST_ROWS);
        rows * columns
    });
    let shots = shots(trajectory, count.max(1));
    let columns = columns.min(shots.len().max(1));

    let across = |n: usize| (WIDTH - 2.0 * MARGIN - GAP * (n - 1) as f64) / n as f64;
    let width = across(columns).min(across(4));
    let height = (width / (2.0 * room.half) * room.top / 0.88).clamp(60.0, 420.0);
    let scene = Scene::new(trajectory);
    let head = head(trajectory);
    let top = 40.0;
    let mut group = Group::new().add(title(trajectory));
    for (i, shot) in shots.iter().enumerate() {
        let x = MARGIN + (i % columns) as f64 * (width + GAP);
        let y = top + (i / columns) as f64 * (height + head + GAP);
        let camera = room.camera(track.at(shot.step), [width, height]);
        let panel = panel(&scene, trajectory, shot, &camera);
        group = group.add(panel.set("transform", format!("translate({} {})", px(x), px(y))));
    }
    let rows = shots.len().div_ceil(columns);
    let below = top + rows as f64 * (height + head + GAP) + 10.0;
    let weight = trajectory.models[options.character].total_mass() * GRAVITY;
    let scale = room.camera(0.0, [width, height]).scale;
    group = group.add(legend(below, weight, scale));
    Ok((group, [WIDTH, below + 26.0]))
}

/// Height of what stands over each panel, px.
fn head(trajectory: &Trajectory) -> f64 {
    HEAD[0] + HEAD[1] * (trajectory.models.len() - 1) as f64
}

/// What the recording is.
fn title(trajectory: &Trajectory) -> Group {
    let header = &trajectory.header;
    let name = shortened(&header.scenario, 14.0, 0.6 * WIDTH);
    let about = format!("{:.2} s, seed {}", trajectory.duration(), header.seed);
    let after = MARGIN + 1.08 * text_width(&name, 14.0) + 10.0;
    Group::new()
        .add(text([MARGIN, 26.0], 14.0, INK, "start", &name).set("font-weight", "bold"))
        .add(text([after, 26.0], 11.0, FAINT_INK, "start", &about))
}

/// One frame with its time, its controllers and what happens in it.
fn panel(scene: &Scene<'_>, trajectory: &Trajectory, shot: &Shot, camera: &super::Camera) -> Group {
    let time = shot.step as f64 * trajectory.header.dt;
    let mut pushes = Vec::new();
    let mut lines = Vec::new();
    for &event in &shot.events {
        match &trajectory.events[event].kind {
            EventKind::Push { .. } => pushes.push((event, 1.0)),
            other => lines.extend(other.label().map(|label| (label, event_colour(other)))),
        }
    }
    let size = [camera.width, camera.height];
    let head = head(trajectory);
    let clock = format!("{time:.2} s");
    let free = camera.width - text_width(&clock, 11.5) - 16.0;
    let mut group = Group::new()
        .add(text([1.0, 15.5], 11.5, INK, "start", &clock).set("font-weight", "bold"))
        .add(window(
            [0.0, head],
            size,
            scene.still(shot.step, camera, &pushes),
        ))
        .add(scene.tags(shot.step, [camera.width, 3.5], 10.0, free));
    for (i, (caption, colour)) in lines.iter().take(3).enumerate() {
        let caption = shortened(caption, 10.0, camera.width - 12.0);
        let at = [6.0, head + 14.0 + 12.5 * i as f64];
        group = group.add(text(at, 10.0, colour, "start", &caption).set("font-weight", "bold"));
    }
    let frame = rectangle([0.0, head], size, "none");
    group.add(frame.set("stroke", FRAME).set("stroke-width", 1))
}

/// What the marks mean; `weight` in N, `scale` in px per m.
fn legend(y: f64, weight: f64, scale: f64) -> Group {
    let mut group = Group::new();
    let mut x = MARGIN + 6.0;
    let mut entry = |sign: Group, width: f64, label: &str| {
        let sign = sign.set("transform", format!("translate({} {})", px(x), px(y)));
        let label_at = [x + width + 6.0, y + 3.6];
        let label_width = text_width(label, 10.5);
        x = label_at[0] + label_width + 20.0;
        Group::new()
            .add(sign)
            .add(text(label_at, 10.5, INK, "start", label))
    };
    let skin = SKINS[0];
    let limb = |at: f64, colour: &str| {
        Group::new()
            .add(line([at, 0.0], [at + 9.0, 0.0], INK, 9.5).set("stroke-linecap", "round"))
            .add(line([at, 0.0], [at + 9.0, 0.0], colour, 7.5).set("stroke-linecap", "round"))
    };
    let arrow_length = (WEIGHT_ARROW * scale).clamp(10.0, 60.0);
    group = group.add(entry(limb(0.0, skin.near), 14.0, "right limbs"));
    group = group.add(entry(limb(0.0, skin.far), 14.0, "left limbs"));
    group = group.add(entry(
        Group::new().add(com_sign([3.0, 0.0], 4.5)),
        8.0,
        "centre of mass",
    ));
    group = group.add(entry(
        Group::new().add(cop_sign([3.0, -4.0], 5.0)),
        7.0,
        "centre of pressure",
    ));
    group = group.add(entry(
        Group::new().add(support_sign([0.0, -2.0], [22.0, -2.0], 5.0)),
        22.0,
        "base of support",
    ));
    let force = arrow([0.0, 0.0], [arrow_length, 0.0], FORCE, 2.6);
    group = group.add(entry(
        force,
        arrow_length,
        &format!("ground reaction force (this long: {weight:.0} N, body weight)"),
    ));
    group.add(entry(
        arrow([0.0, 0.0], [22.0, 0.0], PUSH, 3.4),
        22.0,
        "push",
    ))
}

//! A film strip: chosen frames in rows at one scale, and a legend.

use anyhow::Result;
use aplomb_framework::events::EventKind;
use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

use super::camera::Camera;
use super::captions::{captions, event_colour, title_line};
use super::choose::{Shot, shots, suitable};
use super::drawable;
use super::framing::Framing;
use super::key::key;
use super::scene::{PUSH_TIME, Scene, window};
use super::style::{FRAME, INK, px, rectangle, text, text_width};

/// Width of a strip, SVG units.
pub(super) const WIDTH: f64 = 1080.0;
/// About the strip.
const MARGIN: f64 = 14.0;
/// Between panels.
const GAP: f64 = 7.0;
/// Of the line with time and controller over each panel, and of each further controller, px.
const HEAD: [f64; 2] = [23.0, 17.5];
/// Size of a caption, px, and how many a panel has at most.
const CAPTION: f64 = 10.0;
const LINES: usize = 3;
/// Room for a push's label above the heads, px.
const ABOVE: f64 = 6.0;
/// Rows when the number of frames is not given.
const MOST_ROWS: usize = 5;

/// What a film strip shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FilmOptions {
    /// Number of frames at most, as none looks like the one before; none leaves it to how much happens.
    pub frames: Option<usize>,
    /// Frames a row; none leaves it to the room that a frame takes.
    pub columns: Option<usize>,
    /// The character that is followed.
    pub character: usize,
}

/// The strip and its size.
pub(super) fn strip(trajectory: &Trajectory, options: &FilmOptions) -> Result<(Group, [f64; 2])> {
    drawable(trajectory, options.character)?;
    let framing = Framing::of(trajectory, options.character);
    let fitting = match framing.half {
        half if half > 1.9 => 4,
        half if half > 1.45 => 5,
        _ => 6,
    };
    let columns = options.columns.unwrap_or(fitting).clamp(1, 24);
    let count = options.frames.unwrap_or_else(|| {
        let rows = suitable(trajectory).div_ceil(columns).clamp(1, MOST_ROWS);
        rows * columns
    });
    let shots = shots(trajectory, count.max(1));
    let columns = columns.min(shots.len().max(1));

    let across = |n: usize| (WIDTH - 2.0 * MARGIN - GAP * (n - 1) as f64) / n as f64;
    let width = across(columns).min(across(4));
    let height = (width / (2.0 * framing.half) * framing.top / 0.88).clamp(60.0, 420.0);
    let scene = Scene::new(trajectory);
    let title = title_line(trajectory, [MARGIN, 26.0], 14.0, WIDTH - 2.0 * MARGIN);
    let mut group = Group::new().add(scene.definitions()).add(title);
    let mut top = 40.0;
    for row in shots.chunks(columns) {
        let head = head(trajectory, row);
        for (i, shot) in row.iter().enumerate() {
            let at = [MARGIN + i as f64 * (width + GAP), top];
            let camera = framing.camera(shot.step, [width, height], ABOVE);
            let panel = panel(&scene, trajectory, shot, head, &camera);
            let moved = format!("translate({} {})", px(at[0]), px(at[1]));
            group = group.add(panel.set("transform", moved));
        }
        top += height + head + GAP;
    }
    let below = top + 10.0;
    let scale = framing.camera(0, [width, height], ABOVE).scale;
    let (key, high) = key(&scene, trajectory, &shots, options.character, scale);
    let key = key.set("transform", format!("translate({} {below})", MARGIN + 6.0));
    Ok((group.add(key), [WIDTH, below + high]))
}

/// Height of what stands over each panel of a row, px.
fn head(trajectory: &Trajectory, row: &[Shot]) -> f64 {
    let lines = row.iter().map(|shot| lines(trajectory, shot).len()).max();
    let captions = 1.25 * CAPTION * lines.unwrap_or(0) as f64;
    HEAD[0] + HEAD[1] * (trajectory.models.len() - 1) as f64 + captions
}

/// What stands under a frame's time: what happens in it, but for pushes, which are drawn.
fn lines(trajectory: &Trajectory, shot: &Shot) -> Vec<(String, &'static str)> {
    let mut lines = Vec::new();
    for &event in &shot.events {
        let kind = &trajectory.events[event].kind;
        if !matches!(kind, EventKind::Push { .. })
            && let Some(label) = kind.label()
        {
            match lines.last_mut() {
                // Both hands may take the same.
                Some((last, _)) if *last == label => {}
                _ => lines.push((label, event_colour(kind))),
            }
        }
    }
    lines.truncate(LINES);
    lines
}

/// The pushes that a frame shows: those that it lies in, and those since the frame before.
fn pushes(trajectory: &Trajectory, shot: &Shot) -> Vec<(usize, f64)> {
    let time = shot.step as f64 * trajectory.header.dt;
    let events = trajectory.events.iter().enumerate();
    events
        .filter(|(i, e)| {
            let during = (0.0..=PUSH_TIME).contains(&(time - e.time));
            matches!(e.kind, EventKind::Push { .. }) && (during || shot.events.contains(i))
        })
        .map(|(i, _)| (i, 1.0))
        .collect()
}

/// One frame with its time, its controllers and what happens in it.
fn panel(
    scene: &Scene<'_>,
    trajectory: &Trajectory,
    shot: &Shot,
    head: f64,
    camera: &Camera,
) -> Group {
    let time = shot.step as f64 * trajectory.header.dt;
    let size = [camera.width, camera.height];
    let lines = lines(trajectory, shot);
    let clock = format!("{time:.2} s");
    let free = camera.width - text_width(&clock, 11.5) - 16.0;
    let first = HEAD[0] + HEAD[1] * (trajectory.models.len() - 1) as f64;
    let still = scene.still(shot.step, camera, &pushes(trajectory, shot));
    let frame = rectangle([0.0, head], size, "none");
    Group::new()
        .add(text([1.0, 15.5], 11.5, INK, "start", &clock).set("font-weight", "bold"))
        .add(window([0.0, head], size, still))
        .add(scene.tags(shot.step, [camera.width, 3.5], 10.0, free))
        .add(captions(
            &lines,
            [1.0, first + 0.7 * CAPTION],
            CAPTION,
            camera.width - 4.0,
        ))
        .add(frame.set("stroke", FRAME).set("stroke-width", 1))
}

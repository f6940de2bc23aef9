//! Animations in real time: the frames of a recording at a steady rate, and GIF files of them.

use std::io::Write;

use anyhow::{Context, Result, bail};
use aplomb_framework::run::Trajectory;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;
use resvg::tiny_skia::Pixmap;

use super::drawable;
use super::framing::Framing;
use super::palette::{Palette, UNCHANGED};
use super::raster::pixels;
use super::scene::{Scene, head};
use super::style::document;

/// Frames that are drawn at a time.
const BATCH: usize = 32;
/// Frames at equal distances, and as many at events, whose colours make the palette.
const SAMPLES: usize = 12;
/// For how long the last frame stays before the animation begins anew, hundredths of a s.
const HOLD: u16 = 100;

/// Size and rate of an animation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnimationOptions {
    /// Frames per second of recorded time, 1 to 60 (GIF: to 50); playback is in real time.
    pub fps: f64,
    /// px, even
    pub width: u32,
    /// px, even
    pub height: u32,
    /// The character that is followed.
    pub character: usize,
}

impl Default for AnimationOptions {
    /// For GIF.
    fn default() -> Self {
        Self {
            fps: 20.0,
            width: 640,
            height: 400,
            character: 0,
        }
    }
}

impl AnimationOptions {
    /// For video.
    #[must_use]
    pub fn video() -> Self {
        Self {
            fps: 50.0,
            width: 960,
            height: 600,
            character: 0,
        }
    }
}

/// The frames of an animation, drawn when asked for.
pub(super) struct Film<'a> {
    trajectory: &'a Trajectory,
    scene: Scene<'a>,
    framing: Framing,
    size: [f64; 2],
    fps: f64,
}

impl<'a> Film<'a> {
    pub(super) fn new(trajectory: &'a Trajectory, options: &AnimationOptions) -> Result<Self> {
        drawable(trajectory, options.character)?;
        let AnimationOptions {
            fps, width, height, ..
        } = *options;
        if !(1.0..=60.0).contains(&fps) {
            bail!("{fps} frames per second cannot be drawn; accepted: 1 to 60");
        }
        let even = |n: u32| (64..=4096).contains(&n) && n.is_multiple_of(2);
        if !even(width) || !even(height) {
            bail!(
                "an animation of {width} × {height} px cannot be drawn; accepted: even numbers from 64 to 4096"
            );
        }
        Ok(Self {
            framing: Framing::of(trajectory, options.character),
            scene: Scene::new(trajectory),
            size: [width, height].map(f64::from),
            trajectory,
            fps,
        })
    }

    /// Number of frames, the last step's included.
    pub(super) fn len(&self) -> usize {
        (self.trajectory.duration() * self.fps).ceil() as usize + 1
    }

    pub(super) fn frame(&self, number: usize) -> Result<Pixmap> {
        let step = self.trajectory.step_at(number as f64 / self.fps);
        let camera = self.framing.camera(step, self.size, head(self.size));
        pixels(&document(self.size, self.scene.moving(step, &camera)), 1.0)
    }

    /// Frames that together have all colours: some at equal distances, some at events.
    fn samples(&self) -> Vec<usize> {
        let every = self.len().div_ceil(SAMPLES).max(1);
        let events = &self.trajectory.events;
        let some = events.iter().step_by(events.len().div_ceil(SAMPLES).max(1));
        let at = |time: f64| ((time * self.fps).clamp(0.0, 1e12) as usize + 2).min(self.len() - 1);
        let mut samples: Vec<usize> = (0..self.len()).step_by(every).collect();
        samples.extend(some.map(|e| at(e.time)));
        samples.sort_unstable();
        samples.dedup();
        samples
    }

    /// Draws several at a time and hands them on in order.
    pub(super) fn each<T: Send>(
        &self,
        convert: impl Fn(Pixmap) -> T + Sync,
        mut take: impl FnMut(usize, T) -> Result<()>,
    ) -> Result<()> {
        for start in (0..self.len()).step_by(BATCH) {
            let numbers = start..(start + BATCH).min(self.len());
            let drawn: Vec<Result<T>> = numbers
                .clone()
                .into_par_iter()
                .map(|n| self.frame(n).map(&convert))
                .collect();
            for (number, frame) in numbers.zip(drawn) {
                take(number, frame?)?;
            }
        }
        Ok(())
    }
}

/// Plays the recording in real time, as an endlessly repeated GIF. Only what changes from frame to
/// frame is stored.
///
/// # Errors
/// An empty trajectory, options outside what they accept, a failing writer.
pub fn gif(trajectory: &Trajectory, writer: impl Write, options: &AnimationOptions) -> Result<()> {
    if options.fps > 50.0 {
        bail!(
            "a GIF cannot show {} frames per second; accepted: 1 to 50",
            options.fps
        );
    }
    let film = Film::new(trajectory, options)?;
    let samples = film.samples().into_par_iter().map(|n| film.frame(n));
    let palette = Palette::of(&samples.collect::<Result<Vec<_>>>()?);

    let (width, height) = (options.width as u16, options.height as u16);
    let mut encoder = Encoder::new(writer, width, height, &palette.table())?;
    encoder.set_repeat(Repeat::Infinite)?;
    let last = film.len() - 1;
    let mut before: Option<Vec<u8>> = None;
    film.each(
        |picture| palette.indices(&picture),
        |number, now| {
            let mut frame = changed(before.as_deref(), &now, usize::from(width));
            // Delays are whole hundredths of a second: rounded so that they do not drift.
            let end = |n: usize| (n as f64 * 100.0 / options.fps).round() as u64;
            frame.delay = if number == last {
                HOLD
            } else {
                (end(number + 1) - end(number)) as u16
            };
            before = Some(now);
            encoder
                .write_frame(&frame)
                .context("the animation could not be written")
        },
    )
}

/// The rectangle in which a frame differs from the one before, with the colour "as before" where
/// it does not.
fn changed(before: Option<&[u8]>, now: &[u8], width: usize) -> Frame<'static> {
    let height = now.len() / width;
    let Some(before) = before else {
        return Frame::from_indexed_pixels(width as u16, height as u16, now.to_vec(), None);
    };
    let differs = |x: usize, y: usize| before[y * width + x] != now[y * width + x];
    let rows = |y: &usize| before[y * width..(y + 1) * width] != now[y * width..(y + 1) * width];
    let top = (0..height).find(rows).unwrap_or(0);
    let bottom = (0..height).rfind(rows).unwrap_or(0);
    let columns = |x: &usize| (top..=bottom).any(|y| differs(*x, y));
    let left = (0..width).find(columns).unwrap_or(0);
    let right = (0..width).rfind(columns).unwrap_or(0);
    let mut pixels = Vec::with_capacity((right - left + 1) * (bottom - top + 1));
    for y in top..=bottom {
        pixels.extend((left..=right).map(|x| {
            if differs(x, y) {
                now[y * width + x]
            } else {
                UNCHANGED
            }
        }));
    }
    let (wide, high) = ((right - left + 1) as u16, (bottom - top + 1) as u16);
    Frame {
        left: left as u16,
        top: top as u16,
        dispose: DisposalMethod::Keep,
        ..Frame::from_indexed_pixels(wide, high, pixels, Some(UNCHANGED))
    }
}

//! MP4 files, encoded by the `ffmpeg` executable.

use std::io::{ErrorKind, Read, Write};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use aplomb_framework::run::Trajectory;

use super::animation::{AnimationOptions, Film};

/// Plays the recording in real time, as the bytes of an MP4 file (H.264).
///
/// # Errors
/// An empty trajectory, options outside what they accept, `ffmpeg` missing or failing.
pub fn mp4(trajectory: &Trajectory, options: &AnimationOptions) -> Result<Vec<u8>> {
    encode("ffmpeg", trajectory, options)
}

fn encode(program: &str, trajectory: &Trajectory, options: &AnimationOptions) -> Result<Vec<u8>> {
    let film = Film::new(trajectory, options)?;
    let folder = tempfile::tempdir().context("no temporary folder for the video")?;
    let path = folder.path().join("video.mp4");
    let mut child = Command::new(program)
        .args(["-nostdin", "-loglevel", "error", "-y"])
        .args(["-f", "rawvideo", "-pix_fmt", "rgba"])
        .args(["-s", &format!("{}x{}", options.width, options.height)])
        .args(["-r", &options.fps.to_string(), "-i", "-"])
        .args(["-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p"])
        .args(["-movflags", "+faststart"])
        .arg(&path)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| match e.kind() {
            ErrorKind::NotFound => anyhow::anyhow!(
                "MP4 files are encoded by the program ffmpeg, which is not installed; without it, draw a .gif"
            ),
            _ => anyhow::Error::from(e).context("ffmpeg could not be started"),
        })?;
    // Read on the side: a full pipe of messages would stop the encoder.
    let messages = child.stderr.take().map(|mut pipe| {
        std::thread::spawn(move || {
            let mut text = String::new();
            // What it said is only for the error; unreadable messages are none.
            let _ = pipe.read_to_string(&mut text);
            text
        })
    });
    let drawn = match child.stdin.take() {
        Some(mut pipe) => film.each(
            |picture| picture.take(),
            |_, bytes| pipe.write_all(&bytes).context("ffmpeg stopped early"),
        ),
        None => Ok(()),
    };
    let status = child.wait().context("ffmpeg could not be waited for")?;
    let said = messages.and_then(|m| m.join().ok()).unwrap_or_default();
    if !status.success() {
        bail!("ffmpeg failed ({status}): {}", said.trim());
    }
    drawn?;
    std::fs::read(&path).context("ffmpeg left no video")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tests::recording;

    #[test]
    fn a_missing_or_failing_encoder_is_named() {
        let t = recording(100, |_, _| {});
        let fails = |program| {
            let error = encode(program, &t, &AnimationOptions::video()).unwrap_err();
            error.to_string()
        };
        let missing = fails("no-such-program-as-ffmpeg");
        assert!(
            missing.contains("ffmpeg, which is not installed"),
            "{missing}"
        );
        #[cfg(unix)]
        assert!(fails("false").contains("ffmpeg failed"));
    }
}

//! Where results and messages go: stdout that may be closed, stderr that may be closed, and files
//! that are checked before a long run.

use std::fmt;
use std::io::{self, BufWriter, StdoutLock, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Result, bail, ensure};
use aplomb::framework::input::Error;
use aplomb::framework::run::Trajectory;
use serde::Serialize;

/// What [`aplomb::render::write`] draws into.
const PICTURES: [&str; 4] = ["svg", "png", "gif", "mp4"];

/// Stdout, buffered. That its reader has left is told apart from every other failure.
pub(super) struct Output(BufWriter<StdoutLock<'static>>);

/// The reader of stdout has left.
#[derive(Debug)]
struct ReaderLeft;

impl fmt::Display for ReaderLeft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("nobody reads the output")
    }
}

impl std::error::Error for ReaderLeft {}

impl Output {
    pub(super) fn stdout() -> Self {
        Self(BufWriter::new(io::stdout().lock()))
    }
}

fn told_apart(error: io::Error) -> io::Error {
    match error.kind() {
        io::ErrorKind::BrokenPipe => io::Error::other(ReaderLeft),
        kind => io::Error::new(kind, format!("cannot write the results: {error}")),
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(told_apart)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(told_apart)
    }
}

/// Prints one JSON value in a line.
pub(super) fn write_json(out: &mut dyn Write, value: &impl Serialize) -> Result<()> {
    serde_json::to_writer(&mut *out, value)?;
    writeln!(out)?;
    Ok(())
}

/// Whether a subcommand ended because nobody reads its output.
pub(super) fn reader_left(error: &anyhow::Error) -> bool {
    let io = error.chain().filter_map(|e| e.downcast_ref::<io::Error>());
    let mut inner = io.filter_map(io::Error::get_ref);
    inner.any(|e| e.is::<ReaderLeft>())
}

/// A line on stderr. A closed stderr is no reason to stop.
pub(super) fn message(text: fmt::Arguments<'_>) {
    drop(writeln!(io::stderr(), "{text}"));
}

/// Refuses a file that could not be written after the run, before it. Leaves nothing behind.
pub(super) fn check_writable(path: &Path) -> Result<()> {
    let fail = |reason: String| Error::Write {
        path: path.to_owned(),
        reason,
    };
    ensure!(!path.is_dir(), fail("it is a folder".to_owned()));
    ensure!(
        path.file_name().is_some(),
        fail("it names no file".to_owned())
    );
    // The nearest folder that exists; those below it will be made.
    let here = Path::new(".");
    let mut folders = path.ancestors().skip(1);
    let folder = folders.find(|f| f.exists()).unwrap_or(here);
    let folder = if folder.as_os_str().is_empty() {
        here
    } else {
        folder
    };
    if !folder.is_dir() {
        bail!(fail(format!("{} is no folder", folder.display())));
    }
    tempfile::tempfile_in(folder).map_err(|e| fail(e.to_string()))?;
    Ok(())
}

/// As [`check_writable`], for a picture: also refuses a format that cannot be drawn.
pub(super) fn check_picture(path: &Path) -> Result<()> {
    let extension = path.extension().unwrap_or_default();
    let extension = extension.to_string_lossy().to_ascii_lowercase();
    if !PICTURES.contains(&extension.as_str()) {
        let found = match extension.as_str() {
            "" => "its name has no extension".to_owned(),
            other => format!("it is a .{other} file"),
        };
        let reason = format!("{found}; accepted: .{}", PICTURES.join(", ."));
        let path = path.to_owned();
        bail!(Error::Write { path, reason });
    }
    if extension == "mp4" {
        let mut ffmpeg = Command::new("ffmpeg");
        let ffmpeg = ffmpeg.arg("-version").stdin(Stdio::null());
        let ran = ffmpeg.stdout(Stdio::null()).stderr(Stdio::null()).status();
        ensure!(
            ran.is_ok_and(|status| status.success()),
            "{} would be encoded by the program ffmpeg, which is not installed or does not run; without it, draw a .gif",
            path.display()
        );
    }
    check_writable(path)
}

/// Writes the recording and the picture that were asked for.
pub(super) fn write_recording(
    recording: &Trajectory,
    record: Option<&Path>,
    picture: Option<&Path>,
) -> Result<()> {
    if let Some(path) = record {
        recording.write(path)?;
        message(format_args!("recorded in {}", path.display()));
    }
    if let Some(path) = picture {
        aplomb::render::write(recording, path, false)?;
        message(format_args!("drawn into {}", path.display()));
    }
    Ok(())
}

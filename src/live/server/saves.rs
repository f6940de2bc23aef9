//! Files of what was done, for the page to save.
//!
//! name, steps → session's [`Replay`] → scenario, recording, table, picture.

use std::net::TcpStream;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::Duration;

use aplomb_framework::run::Trajectory;

use crate::live::save::Replay;
use crate::live::server::{Said, http};
use crate::{render, table};

/// At most so many at a time: each runs the whole session again.
const MOST: usize = 2;
/// How long the session may take to hand over what was done.
const PATIENCE: Duration = Duration::from_secs(10);

/// The longest animation, s: one takes longer to draw than it lasts, and others wait for their turn.
const LONGEST_FILM: f64 = 60.0;

/// Which steps, as the query says: `from=10&to=500`.
fn stretch(query: &str) -> [Option<usize>; 2] {
    ["from=", "to="].map(|key| {
        let mut pairs = query.split('&');
        pairs.find_map(|pair| pair.strip_prefix(key)?.parse().ok())
    })
}

/// The kind of a file by its extension.
fn kind(extension: &str) -> Option<&'static str> {
    Some(match extension {
        "ron" => "text/plain; charset=utf-8",
        "trajectory" => "application/octet-stream",
        "csv" => "text/csv",
        "gif" => "image/gif",
        "mp4" => "video/mp4",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        _ => return None,
    })
}

/// Answers with a file of what was done.
pub(super) fn save(
    stream: &mut TcpStream,
    name: &str,
    query: &str,
    say: &SyncSender<Said>,
    saves: &AtomicUsize,
) {
    let extension = name.strip_prefix("session.").unwrap_or_default();
    let Some(kind) = kind(extension) else {
        let accepted = "accepted: session.ron, .trajectory, .csv, .gif, .mp4, .svg, .png";
        return http::refuse(stream, "404 Not Found", accepted);
    };
    if saves.fetch_add(1, Ordering::Relaxed) >= MOST {
        saves.fetch_sub(1, Ordering::Relaxed);
        return http::refuse(
            stream,
            "503 Service Unavailable",
            "two saves are under way: try again",
        );
    }
    let (answer, answered) = sync_channel(1);
    let replay = say.try_send(Said::Save(answer)).ok();
    let replay = replay.and_then(|()| answered.recv_timeout(PATIENCE).ok());
    let bytes = match replay {
        Some(replay) => file(replay, extension, stretch(query)),
        None => Err("the session is busy: try again".to_owned()),
    };
    saves.fetch_sub(1, Ordering::Relaxed);
    match bytes {
        Ok(bytes) => http::respond(stream, "200 OK", kind, &bytes),
        Err(why) => http::refuse(stream, "500 Internal Server Error", &why),
    }
}

fn file(replay: Replay, extension: &str, steps: [Option<usize>; 2]) -> Result<Vec<u8>, String> {
    if extension == "ron" {
        return replay
            .scenario()
            .map(String::into_bytes)
            .map_err(|e| e.to_string());
    }
    let seconds = replay.duration(steps);
    if matches!(extension, "gif" | "mp4") && seconds > LONGEST_FILM {
        return Err(format!(
            "session.{extension} would last {seconds:.1} s; accepted: at most {LONGEST_FILM} s: \
             zoom the timeline to choose them"
        ));
    }
    let whole = replay.recording().map_err(|e| e.to_string())?;
    let [from, to] = steps;
    let recording = whole.stretch(from.unwrap_or(0)..to.unwrap_or(usize::MAX));
    if recording.is_empty() {
        return Err("there is nothing in these steps".to_owned());
    }
    encoded(&recording, extension).map_err(|e| e.to_string())
}

/// Pictures by way of a file, as the other subcommands write them.
fn encoded(recording: &Trajectory, extension: &str) -> anyhow::Result<Vec<u8>> {
    match extension {
        "trajectory" => Ok(recording.to_bytes()?),
        "csv" => {
            let mut bytes = Vec::new();
            table::write_csv(recording, recording.header.dt, &mut bytes)?;
            Ok(bytes)
        }
        _ => {
            let folder = tempfile::tempdir()?;
            let path = folder.path().join("session").with_extension(extension);
            render::write(recording, &path, false)?;
            Ok(std::fs::read(path)?)
        }
    }
}

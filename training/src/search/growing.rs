//! Text files that grow by whole lines, so that work that was ended in any way can go on.
//!
//! first lines → file; file → its whole lines → file to append to.
//!
//! A last line without an end is of something that was not finished.

use std::fs::{File, OpenOptions};
use std::path::Path;

use aplomb_framework::input::{Error, Result, read_bounded, write_atomically};

/// Begins a file with some lines in the place of any that is there.
///
/// # Errors
/// [`Error::Write`].
pub(crate) fn begin(path: &Path, lines: &str) -> Result<File> {
    write_atomically(path, lines.as_bytes())?;
    go_on(path, lines.len())
}

/// The whole lines of a file of at most `limit` bytes, and where they end.
///
/// # Errors
/// [`Error::Read`].
pub(crate) fn whole_lines(path: &Path, limit: u64) -> Result<(String, usize)> {
    let bytes = read_bounded(path, limit)?;
    let end = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    Ok((String::from_utf8_lossy(&bytes[..end]).into_owned(), end))
}

/// Cuts a file where its whole lines end, to append to them.
///
/// # Errors
/// [`Error::Write`].
pub(crate) fn go_on(path: &Path, end: usize) -> Result<File> {
    let file = OpenOptions::new().append(true).open(path);
    let cut = file.and_then(|file| file.set_len(end as u64).map(|()| file));
    cut.map_err(|e| failed(path, &e))
}

/// A file that could not be written.
pub(crate) fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::Write {
        path: path.to_owned(),
        reason: error.to_string(),
    }
}

//! Bounded reading of untrusted text, and writing that never leaves half a file.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use ron::value::RawValue;
use serde::de::DeserializeOwned;

use crate::input::error::{Error, Result};
use crate::input::locate;
use crate::input::path::FieldPath;
use crate::input::syntax;

/// The largest text file (character, repertoire, scenario, controller) that is read: 1 MiB.
pub const LARGEST_TEXT: u64 = 1 << 20;

/// Text of a data file together with the name that error messages give it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Source {
    /// File name as the user gave it, or `built-in NAME`.
    pub origin: String,
    /// The text.
    pub text: String,
    /// The value in the text that is spoken of.
    inside: FieldPath,
}

impl Source {
    /// Text that is not from a file, under the name that messages give it.
    #[must_use]
    pub fn new(origin: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            origin: origin.into(),
            text: text.into(),
            inside: FieldPath::default(),
        }
    }

    /// The same text, of which only the value at `path` is spoken of: where [`Self::locate`] begins.
    #[must_use]
    pub fn part(&self, path: impl Into<FieldPath>) -> Self {
        let mut part = self.clone();
        part.inside = part.inside.then(path);
        part
    }

    /// Reads a regular UTF-8 text file of at most [`LARGEST_TEXT`] bytes.
    ///
    /// # Errors
    /// [`Error::Read`] for anything else: missing, a directory or device, too large, not UTF-8.
    pub fn read(path: &Path) -> Result<Self> {
        Self::read_up_to(path, LARGEST_TEXT)
    }

    /// Reads a regular UTF-8 text file of at most `limit` bytes.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_up_to(path: &Path, limit: u64) -> Result<Self> {
        let bytes = read_bounded(path, limit)?;
        let text = String::from_utf8(bytes).map_err(|_| Error::Read {
            path: path.to_owned(),
            reason: "it is no UTF-8 text".to_owned(),
        })?;
        Ok(Self::new(path.display().to_string(), text))
    }

    /// Parses the text as RON of the type's schema.
    ///
    /// # Errors
    /// [`Error::Syntax`] with line and column.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T> {
        options()
            .from_str(&self.text)
            .map_err(|e| self.spanned(&e, (0, 0)))
    }

    /// Parses the value at `path`, which the parser of the text has left as it stands.
    ///
    /// # Errors
    /// [`Error::Syntax`] with line and column in the whole text.
    pub fn parse_part<T: DeserializeOwned>(
        &self,
        path: impl Into<FieldPath>,
        raw: &RawValue,
    ) -> Result<T> {
        options().from_str(raw.get_ron()).map_err(|e| {
            let start = locate::start(&self.text, &self.inside.clone().then(path));
            let (line, column) = locate::line_and_column(&self.text, start);
            self.spanned(&e, (line - 1, column - 1))
        })
    }

    /// `offset` is the (line, column) at which the parsed part begins in the whole text, from 0.
    fn spanned(&self, error: &ron::error::SpannedError, offset: (usize, usize)) -> Error {
        let start = error.span.start;
        let line = start.line + offset.0;
        let text = self
            .text
            .lines()
            .nth(line.saturating_sub(1))
            .unwrap_or_default();
        Error::Syntax {
            origin: self.origin.clone(),
            line,
            column: if start.line <= 1 {
                start.col + offset.1
            } else {
                start.col
            },
            message: syntax::message(&error.code, text),
        }
    }

    /// The same refusal with the place of the value that was refused: line and column of the value
    /// itself, or of what it is missing in. What has its place already stays. Of a source without
    /// text the place is its origin.
    ///
    /// ```
    /// # use aplomb_framework::input::{Source, check};
    /// let source = Source::new("x.ron", "(props: [(mass: 1), (mass: -2)])");
    /// let error = check::within("mass", -2.0, 0.0..=9.0).unwrap_err().inside(("props", 1));
    /// assert_eq!(
    ///     source.locate(error).to_string(),
    ///     "x.ron:1:28: props[1].mass is -2; accepted: 0 to 9",
    /// );
    /// ```
    #[must_use]
    pub fn locate(&self, error: Error) -> Error {
        let error = error.inside(self.inside.clone());
        match &error {
            Error::Invalid { place, field, .. } if place.is_empty() => {
                let place = self.place(field);
                error.at(&place)
            }
            _ => error,
        }
    }

    /// `file:line:column` of a value.
    fn place(&self, path: &FieldPath) -> String {
        if self.text.is_empty() {
            return self.origin.clone();
        }
        let offset = locate::locate(&self.text, path);
        let (line, column) = locate::line_and_column(&self.text, offset);
        format!("{}:{line}:{column}", self.origin)
    }
}

/// How every RON file of the project is read: `Some(…)` may be left out.
#[must_use]
pub fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// Reads at most `limit` bytes of a regular file.
///
/// # Errors
/// [`Error::Read`] if it is missing, no regular file, or larger.
pub fn read_bounded(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let fail = |reason: String| Error::Read {
        path: path.to_owned(),
        reason,
    };
    let meta = std::fs::metadata(path).map_err(|e| fail(e.to_string()))?;
    if !meta.is_file() {
        return Err(fail("it is no regular file".to_owned()));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|f| f.take(limit + 1).read_to_end(&mut bytes))
        .map_err(|e| fail(e.to_string()))?;
    if bytes.len() as u64 > limit {
        return Err(fail(format!("it is larger than {limit} bytes")));
    }
    Ok(bytes)
}

/// Writes a file whole or not at all: to a temporary name beside it, then renamed into place.
/// Missing parent folders are made.
///
/// # Errors
/// [`Error::Write`]; an existing file is then as it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    stream_atomically(path, |file| file.write_all(bytes))
}

/// As [`write_atomically`], for what is too long to be held in memory: `write` gets the temporary
/// file, unbuffered.
///
/// # Errors
/// [`Error::Write`], also with what `write` fails with; an existing file is then as it was.
pub fn stream_atomically(
    path: &Path,
    write: impl FnOnce(&mut File) -> std::io::Result<()>,
) -> Result<()> {
    let fail = |e: std::io::Error| Error::Write {
        path: path.to_owned(),
        reason: e.to_string(),
    };
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(fail)?;
    let mut temporary = tempfile::Builder::new()
        .prefix(".aplomb-")
        .suffix(".partial")
        .tempfile_in(folder)
        .map_err(fail)?;
    write(temporary.as_file_mut()).map_err(fail)?;
    readable_by_all(temporary.as_file()).map_err(fail)?;
    temporary.persist(path).map_err(|e| fail(e.error))?;
    Ok(())
}

/// Temporary files are private to their owner; the files we leave are ordinary ones.
#[cfg(unix)]
fn readable_by_all(file: &File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable_by_all(_: &File) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_replaces_whole_files_and_leaves_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/er/x.txt");
        write_atomically(&path, b"one").unwrap();
        write_atomically(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(
            std::fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1
        );
    }

    #[test]
    fn a_stream_that_fails_leaves_the_old_file_and_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.txt");
        write_atomically(&path, b"one").unwrap();
        let failed = stream_atomically(&path, |file| {
            file.write_all(b"half")?;
            Err(std::io::Error::other("no more room"))
        });
        assert!(failed.unwrap_err().to_string().contains("no more room"));
        assert_eq!(std::fs::read(&path).unwrap(), b"one");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn folders_devices_and_oversized_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(read_bounded(folder.path(), 10).is_err());
        let path = folder.path().join("big");
        std::fs::write(&path, [0_u8; 11]).unwrap();
        let text = read_bounded(&path, 10).unwrap_err().to_string();
        assert!(text.contains("larger than 10 bytes"), "{text}");
    }
}

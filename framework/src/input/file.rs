//! Bounded reading of untrusted text, and writing that never leaves half a file.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use serde::de::DeserializeOwned;

use crate::input::error::{Error, Result};

/// The largest text file (character, repertoire, scenario, controller) that is read: 1 MiB.
pub const LARGEST_TEXT: u64 = 1 << 20;

/// Text of a data file together with the name that error messages give it.
#[derive(Debug, Clone)]
pub struct Source {
    /// File name as the user gave it, or `built-in NAME`.
    pub origin: String,
    /// The text.
    pub text: String,
}

impl Source {
    /// Text that is not from a file, under the name that messages give it.
    #[must_use]
    pub fn new(origin: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            origin: origin.into(),
            text: text.into(),
        }
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
            .map_err(|e| self.syntax(&e, (0, 0)))
    }

    /// A parser's complaint as an [`Error::Syntax`]; `offset` is the (line, column) at which the
    /// parsed part begins in the whole text, both from 0.
    #[must_use]
    pub fn syntax(&self, error: &ron::error::SpannedError, offset: (usize, usize)) -> Error {
        let start = error.span.start;
        Error::Syntax {
            origin: self.origin.clone(),
            line: start.line + offset.0,
            column: if start.line <= 1 {
                start.col + offset.1
            } else {
                start.col
            },
            message: error.code.to_string(),
        }
    }

    /// `file:line` of the first occurrence of `needle`, as a whole word if there is one; or the file
    /// alone.
    #[must_use]
    pub fn place(&self, needle: &str) -> String {
        let found = self.words(needle).next();
        self.line_at(found.or_else(|| self.text.find(needle)))
    }

    /// `file:line` of the field of this name that has this value, or of the first of this name.
    #[must_use]
    pub fn place_of(&self, field: &str, value: f64) -> String {
        let has_value = |at: &usize| {
            let after = self.text[at + field.len()..].trim_start_matches([' ', '"', ':']);
            let end = after.find([',', ')', '}', '\n']).unwrap_or(after.len());
            let number = after[..end].trim().parse::<f64>();
            number.is_ok_and(|n| n == value || (n.is_nan() && value.is_nan()))
        };
        match self.words(field).find(has_value) {
            Some(at) => self.line_at(Some(at)),
            None => self.place(field),
        }
    }

    /// Where `needle` stands as a whole word.
    fn words<'a>(&'a self, needle: &'a str) -> impl Iterator<Item = usize> + 'a {
        let part_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        self.text
            .match_indices(needle)
            .map(|(at, _)| at)
            .filter(move |at| {
                !self.text[..*at].ends_with(part_of_name)
                    && !self.text[at + needle.len()..].starts_with(part_of_name)
            })
    }

    fn line_at(&self, at: Option<usize>) -> String {
        match at {
            Some(at) => format!(
                "{}:{}",
                self.origin,
                1 + self.text[..at].matches('\n').count()
            ),
            None => self.origin.clone(),
        }
    }

    /// An [`Error::Invalid`] at the first occurrence of `needle`.
    pub fn invalid(
        &self,
        needle: &str,
        field: impl Into<String>,
        problem: impl ToString,
        accepted: impl Into<String>,
    ) -> Error {
        Error::invalid(self.place(needle), field, problem, accepted)
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

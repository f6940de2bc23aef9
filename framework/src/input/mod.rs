//! Untrusted text: bounded reading, parsing, and messages that name file, line, column, field and
//! what is accepted. Nothing above this folder needs to know how a file is written.
//!
//! path → [`Source`] → a schema's values, or an [`Error`].

mod error;
mod file;
mod shipped;

pub use error::{Error, Result, nearest, shortened};
pub use file::{LARGEST_TEXT, Source, options, read_bounded, write_atomically};
pub use shipped::shipped;

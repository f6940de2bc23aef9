//! Untrusted text: bounded reading, parsing, bounds, and messages that name file, line, column, field
//! and what is accepted. Nothing above this folder needs to know how a file is written.
//!
//! path → [`Source`] → a schema's values → [`check`] → nothing, or an [`Error`] with the
//! [`FieldPath`] of what is refused → [`Source::locate`] → the same with its line and column.

pub mod check;
mod error;
mod file;
mod locate;
mod path;
mod shipped;
mod syntax;

pub use error::{Error, Result, nearest, shortened};
pub use file::{LARGEST_TEXT, Source, options, read_bounded, stream_atomically, write_atomically};
pub use path::FieldPath;
pub use shipped::shipped;

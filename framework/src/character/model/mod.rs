//! The character itself: what its file says, checked, and what follows from it.
//!
//! RON → `schema` → `tree`, `file` (bounds) → [`Model`], with its `digest`.

mod bounds;
mod definition;
mod digest;
mod file;
mod joint;
mod schema;
mod tree;

pub use definition::{Flesh, Foot, Hand, Joint, Link, MOST_LINKS, Model};

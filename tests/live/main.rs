//! The live session, its server and its page.

#![allow(clippy::unwrap_used)]

mod session;

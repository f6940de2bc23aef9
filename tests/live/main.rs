//! The live session, its server and its page.

#![allow(clippy::unwrap_used)]

#[cfg(unix)]
mod browser;
#[cfg(unix)]
mod program;
#[cfg(unix)]
mod server;
mod session;

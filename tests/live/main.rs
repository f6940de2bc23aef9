//! The live session, its server and its page.

#![allow(clippy::unwrap_used)]

#[cfg(unix)]
mod browser;
#[cfg(unix)]
#[path = "../common/chromium.rs"]
mod chromium;
#[cfg(unix)]
mod program;
#[cfg(unix)]
mod server;
mod session;

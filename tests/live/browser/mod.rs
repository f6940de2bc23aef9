//! The page in a real browser: what somebody sees, clicks, draws and types.
//!
//! Each test starts the program and a Chromium of its own. See [`driver`] for what it needs.

mod driver;
mod files;
mod look;
mod mind;
mod page;
mod saves;
mod time;
mod touch;

use crate::program::Program;
use page::Page;

/// The humanoid standing, in the program and in a browser; none where there is no browser.
fn standing() -> Option<(Program, Page)> {
    let program = Program::start(&[]);
    let page = Page::open(&program)?;
    Some((program, page))
}

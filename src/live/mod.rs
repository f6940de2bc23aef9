//! A run that somebody watches and touches: commands in, frames out, back in time and on from there.
//!
//! [`Request`]s, seconds that have passed → [`Session`] → frames, events and answers as JSON, one
//! [`View`] a watcher. Nothing in it reads files or clocks: the server, the page's WebAssembly and
//! tests drive the same session.

pub mod answer;
mod ask;
mod clauses;
mod frame;
mod hello;
mod history;
mod opened;
mod request;
mod save;
mod scene;
#[cfg(feature = "program")]
pub mod server;
mod session;
mod watcher;

pub use frame::View;
pub use history::History;
pub use opened::Opened;
pub use request::{DragBody, LARGEST_MESSAGE, LARGEST_OPENED, Request, Thrown};
pub use save::Replay;
pub use scene::{LiveScene, SceneNames};
pub use session::Session;
pub use watcher::Watcher;

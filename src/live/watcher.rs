//! One who watches a session: what it has been told already.
//!
//! [`Session`] → messages that are news to this watcher, and frames.

use crate::live::answer::told;
use crate::live::frame::View;
use crate::live::request::Request;
use crate::live::session::Session;

/// A watcher of a session.
#[derive(Debug, Default)]
pub struct Watcher {
    /// What it wants to see.
    pub view: View,
    /// The scene that it knows; none yet.
    scene: Option<u64>,
    cuts: u64,
    events: usize,
    props: usize,
}

impl Watcher {
    /// What has changed since the last call, as messages. `native` is whether the session runs
    /// outside of the watcher's page.
    pub fn news(&mut self, session: &Session, native: bool) -> Vec<String> {
        let mut news = Vec::new();
        let props = session.simulation().world().props().count();
        if self.scene != Some(session.generation) {
            // What somebody asked for before the first hello is about this scene.
            if self.scene.replace(session.generation).is_some() {
                self.view.forget();
            }
            (self.cuts, self.events, self.props) = (session.cuts, 0, props);
            news.push(session.hello(native));
            news.push(self.happened(session));
        }
        if self.cuts != session.cuts {
            self.cuts = session.cuts;
            self.events = self.events.min(session.events().len());
            self.props = 0;
            news.push(self.happened(session));
        }
        while self.events < session.events().len() {
            news.push(self.happened(session));
        }
        if self.props != props {
            // Fewer after a step back in time: all are told again.
            let from = if self.props < props { self.props } else { 0 };
            news.push(session.props(from));
            self.props = props;
        }
        news
    }

    fn happened(&mut self, session: &Session) -> String {
        let (text, told) = session.events_from(self.events);
        self.events = told;
        text
    }

    /// Hands on a request; what cannot be done is the answer.
    pub fn ask(&mut self, session: &mut Session, text: &str) -> Option<String> {
        let request = Request::parse(text);
        let asked = request.and_then(|request| session.ask(&mut self.view, request));
        asked.err().map(|e| told(false, &e.to_string()))
    }
}

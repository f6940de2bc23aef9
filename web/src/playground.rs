//! A session with its only watcher.
//!
//! requests as text, seconds → [`Playground`] → messages as text, files as bytes.

use std::collections::VecDeque;

use aplomb::framework::input::Result;
use aplomb::live::{SceneNames, Session, Watcher};

/// A session in the page of the one who watches it.
#[derive(Debug)]
pub(crate) struct Playground {
    session: Session,
    watcher: Watcher,
    /// Messages that the page has not taken yet.
    waiting: VecDeque<String>,
}

impl Playground {
    /// Begins with the scene that the program begins with.
    pub(crate) fn new() -> Result<Self> {
        Ok(Self {
            session: Session::new(&SceneNames::default())?,
            watcher: Watcher::default(),
            waiting: VecDeque::new(),
        })
    }

    /// Does what the page asks for; a refusal becomes a message.
    pub(crate) fn ask(&mut self, text: &str) {
        // Before a request that changes the scene: what has happened in the old one.
        self.listen();
        let refusal = self.watcher.ask(&mut self.session, text);
        self.waiting.extend(refusal);
    }

    /// Lets time pass, s; returns how many steps were done.
    pub(crate) fn advance(&mut self, seconds: f64) -> u64 {
        self.session.advance(seconds)
    }

    fn listen(&mut self) {
        // The session runs inside of its watcher's page.
        let native = false;
        self.waiting
            .extend(self.watcher.news(&self.session, native));
    }

    /// The next message, if there is one.
    pub(crate) fn next_message(&mut self) -> Option<String> {
        if self.waiting.is_empty() {
            self.listen();
        }
        self.waiting.pop_front()
    }

    /// What is to be drawn now. `dropped` frames were left out because the page was busy.
    pub(crate) fn frame(&mut self, dropped: u32) -> String {
        self.watcher.view.dropped = dropped.into();
        self.session.frame(&self.watcher.view)
    }

    /// What was done so far, as one of [`aplomb::live::Replay::FILES`].
    pub(crate) fn save(&self, name: &str) -> Result<Vec<u8>> {
        self.session.replay().file(name)
    }

    /// The digest of the run up to now.
    pub(crate) fn digest(&self) -> String {
        self.session.simulation().digest()
    }
}

#[cfg(test)]
mod tests {
    use aplomb::framework::run::Simulation;
    use aplomb::framework::scenario::Scenario;

    use super::*;

    fn all(playground: &mut Playground) -> Vec<serde_json::Value> {
        std::iter::from_fn(|| playground.next_message())
            .map(|text| serde_json::from_str(&text).unwrap())
            .collect()
    }

    #[test]
    fn a_page_is_told_the_scene_then_what_happens_then_what_is_refused() {
        let mut playground = Playground::new().unwrap();
        let told = all(&mut playground);
        assert_eq!(told[0]["is"], "hello");
        assert_eq!(told[0]["native"], false);
        assert_eq!(told[1]["is"], "events");
        playground.ask(r#"{"do":"push","link":"torso","impulse":[60,0]}"#);
        playground.ask(r#"{"do":"dance"}"#);
        assert_eq!(playground.advance(0.05), 50);
        let told = all(&mut playground);
        let kinds: Vec<_> = told.iter().map(|m| m["is"].as_str().unwrap()).collect();
        assert_eq!(kinds, ["told", "events"], "{told:?}");
        assert!(playground.frame(3).contains(r#""n":50,"#));
        assert!(all(&mut playground).is_empty());
    }

    #[test]
    fn what_is_saved_has_the_runs_digest() {
        let mut playground = Playground::new().unwrap();
        playground.ask(r#"{"do":"push","link":"torso","impulse":[60,0]}"#);
        playground.ask(r#"{"do":"step","steps":500}"#);
        let text = String::from_utf8(playground.save("session.ron").unwrap()).unwrap();
        let source = aplomb::framework::input::Source::new("saved", text.as_str());
        let scenario = Scenario::parse(&source).unwrap();
        let registry = aplomb::controllers::registry();
        let mut again = Simulation::new(&scenario, &registry).unwrap();
        again.run(scenario.duration);
        assert_eq!(again.digest(), playground.digest());
        let recording = playground.save("session.trajectory").unwrap();
        assert!(recording.starts_with(b"APLOMB-T"));
        let table = playground.save("session.csv").unwrap();
        assert_eq!(table.iter().filter(|b| **b == b'\n').count(), 501);
        let refused = playground.save("session.gif").unwrap_err().to_string();
        assert!(refused.contains("session.csv"), "{refused}");
    }
}

//! What watchers are told of events and of what went wrong.
//!
//! [`Session`], errors → JSON.

use aplomb_framework::events::{Bid, Event, EventKind};
use serde::Serialize;
use serde_json::{Value, json};

use crate::live::session::Session;

/// At most this many events in one message.
const AT_ONCE: usize = 200;

#[derive(Serialize)]
struct EventAnswer<'a> {
    n: u64,
    t: f64,
    character: usize,
    kind: &'a str,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    role: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bids: Vec<(&'a str, f64, Option<String>)>,
}

/// An event's line without its name and the column that it stands in.
fn text(kind: &EventKind) -> String {
    let line = kind.to_string();
    let rest = line.strip_prefix(kind.name()).unwrap_or(&line);
    rest.trim_start().to_owned()
}

fn answer(event: &Event, dt: f64) -> EventAnswer<'_> {
    let mut answer = EventAnswer {
        n: (event.time / dt).round() as u64,
        t: (event.time * 1e3).round() / 1e3,
        character: event.character,
        kind: event.kind.name(),
        text: text(&event.kind),
        from: None,
        to: None,
        role: None,
        reason: None,
        bids: Vec::new(),
    };
    if let EventKind::Switch {
        from,
        to,
        role,
        reason,
        bids,
    } = &event.kind
    {
        let refusal = |b: &Bid| b.refusal.as_ref().map(ToString::to_string);
        answer.from = from.as_deref();
        answer.to = Some(to);
        answer.role = serde_json::to_value(role).ok();
        answer.reason = Some(reason.name());
        answer.bids = bids
            .iter()
            .map(|b| (b.controller.as_str(), b.suitability, refusal(b)))
            .collect();
    }
    answer
}

impl Session {
    /// Events from a place on, and the place after the last of them.
    #[must_use]
    pub fn events_from(&self, from: usize) -> (String, usize) {
        #[derive(Serialize)]
        struct Events<'a> {
            is: &'a str,
            from: usize,
            list: Vec<EventAnswer<'a>>,
        }
        let dt = self.now.world().settings().dt;
        let from = from.min(self.events.len());
        let until = self.events.len().min(from + AT_ONCE);
        let list = self.events[from..until]
            .iter()
            .map(|e| answer(e, dt))
            .collect();
        let is = "events";
        let text = serde_json::to_string(&Events { is, from, list });
        (text.unwrap_or_default(), until)
    }
}

/// What a watcher is told of a request.
#[must_use]
pub fn told(ok: bool, text: &str) -> String {
    json!({"is": "told", "ok": ok, "text": text}).to_string()
}

/// What watchers are told of files that have changed.
#[must_use]
pub fn files(ok: bool, text: &str) -> String {
    json!({"is": "files", "ok": ok, "text": text}).to_string()
}

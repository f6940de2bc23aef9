//! What is still to be sent to one watcher.
//!
//! messages, frames → [`Outbox`] → the watcher's connection, in order; of frames only the newest.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What one watcher may have said that is still to be heard, so that others are heard too.
const MOST_UNHEARD: usize = 128;
/// At most so many bytes wait; who lets more pile up is let go.
const LARGEST: usize = 8 << 20;

#[derive(Debug, Default)]
struct Waiting {
    messages: VecDeque<String>,
    bytes: usize,
    frame: Option<String>,
    dropped: u64,
    closed: bool,
}

/// A bounded box.
#[derive(Debug, Default)]
pub(super) struct Outbox {
    waiting: Mutex<Waiting>,
    changed: Condvar,
    /// How much the watcher has said that the session has not heard yet.
    unheard: AtomicUsize,
}

/// What is to be sent.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Letter {
    /// It is sent for sure.
    Message(String),
    /// The newest.
    Frame(String),
}

/// Room for one thing that a watcher says, until it was heard.
#[derive(Debug)]
pub(super) struct Slot(Arc<Outbox>);

impl Drop for Slot {
    fn drop(&mut self) {
        self.0.unheard.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Outbox {
    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        // Nobody panics while it is held, and nothing in it could be half done.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Room for something that the watcher says; none while too much of it is unheard.
    pub(super) fn slot(self: &Arc<Self>) -> Option<Slot> {
        let before = self.unheard.fetch_add(1, Ordering::Relaxed);
        let slot = Slot(Arc::clone(self));
        (before < MOST_UNHEARD).then_some(slot)
    }

    /// Puts a message in; closes the box if too much is in it.
    pub(super) fn put(&self, message: String) {
        let mut waiting = self.waiting();
        waiting.bytes += message.len();
        waiting.messages.push_back(message);
        if waiting.bytes > LARGEST {
            waiting.closed = true;
            waiting.messages.clear();
        }
        self.changed.notify_one();
    }

    /// Puts a frame in, in the place of one that is still there.
    pub(super) fn put_frame(&self, frame: String) {
        let mut waiting = self.waiting();
        if waiting.frame.replace(frame).is_some() {
            waiting.dropped += 1;
        }
        self.changed.notify_one();
    }

    /// Frames that were replaced before they were sent.
    pub(super) fn dropped(&self) -> u64 {
        self.waiting().dropped
    }

    /// Nothing more will come.
    pub(super) fn close(&self) {
        self.waiting().closed = true;
        self.changed.notify_one();
    }

    /// Whether nothing more will come.
    pub(super) fn is_closed(&self) -> bool {
        self.waiting().closed
    }

    /// Takes out what is next, a frame only if wanted, waiting for it up to `time`.
    pub(super) fn take(&self, time: Duration, frames: bool) -> Option<Letter> {
        let mut waiting = self.waiting();
        let until = Instant::now() + time;
        loop {
            if let Some(message) = waiting.messages.pop_front() {
                waiting.bytes -= message.len();
                return Some(Letter::Message(message));
            }
            if frames && let Some(frame) = waiting.frame.take() {
                return Some(Letter::Frame(frame));
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() || waiting.closed {
                return None;
            }
            let woken = self.changed.wait_timeout(waiting, left);
            waiting = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_keep_their_order_and_only_the_newest_frame_is_kept() {
        let outbox = Outbox::default();
        outbox.put_frame("frame 1".into());
        outbox.put("a".into());
        outbox.put_frame("frame 2".into());
        outbox.put("b".into());
        let take = |frames| outbox.take(Duration::ZERO, frames);
        let message = |text: &str| Some(Letter::Message(text.to_owned()));
        assert_eq!(take(true), message("a"));
        assert_eq!(take(false), message("b"));
        assert_eq!(take(false), None);
        assert_eq!(take(true), Some(Letter::Frame("frame 2".to_owned())));
        assert_eq!(outbox.dropped(), 1);
    }

    #[test]
    fn who_lets_too_much_pile_up_is_let_go() {
        let outbox = Outbox::default();
        for _ in 0..9 {
            outbox.put("x".repeat(1 << 20));
        }
        assert!(outbox.is_closed());
        assert_eq!(outbox.take(Duration::ZERO, true), None);
    }
}

//! What is still to be sent to one watcher.
//!
//! messages, frames → [`Outbox`] → the watcher's connection, in order; of frames only the newest.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

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
}

impl Outbox {
    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        // Nobody panics while it is held, and nothing in it could be half done.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
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

    /// Takes out what is next, waiting for it up to `time`.
    pub(super) fn take(&self, time: Duration) -> Option<String> {
        let mut waiting = self.waiting();
        let empty = |w: &Waiting| w.messages.is_empty() && w.frame.is_none();
        if empty(&waiting) && !waiting.closed && !time.is_zero() {
            let woken = self.changed.wait_timeout(waiting, time);
            waiting = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
        if let Some(message) = waiting.messages.pop_front() {
            waiting.bytes -= message.len();
            return Some(message);
        }
        waiting.frame.take()
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
        let taken: Vec<_> = std::iter::from_fn(|| outbox.take(Duration::ZERO)).collect();
        assert_eq!(taken, ["a", "b", "frame 2"]);
        assert_eq!(outbox.dropped(), 1);
    }

    #[test]
    fn who_lets_too_much_pile_up_is_let_go() {
        let outbox = Outbox::default();
        for _ in 0..9 {
            outbox.put("x".repeat(1 << 20));
        }
        assert!(outbox.is_closed());
        assert_eq!(outbox.take(Duration::ZERO), None);
    }
}

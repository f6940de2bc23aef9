//! What connections have said and the session has not heard yet.
//!
//! [`Said`] in its order → [`Said`], of seeks that follow one another only the last: somebody who
//! drags along the timeline wants to see where the pointer is now.

use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Instant;

use super::Said;

/// What is still to be heard.
pub(super) struct Unheard {
    said: Receiver<Said>,
    /// The next one, taken out to be looked at.
    next: Option<Said>,
}

impl Unheard {
    pub(super) fn new(said: Receiver<Said>) -> Self {
        Self { said, next: None }
    }

    /// The next one that is there.
    pub(super) fn next(&mut self) -> Option<Said> {
        let mut first = self.next.take().or_else(|| self.said.try_recv().ok())?;
        loop {
            self.next = self.said.try_recv().ok();
            match &self.next {
                Some(second) if is_outdated(&first, second) => first = self.next.take()?,
                _ => return Some(first),
            }
        }
    }

    /// The next one, if it comes before a time; none at that time.
    pub(super) fn before(&mut self, end: Instant) -> Option<Said> {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return None;
        }
        if self.next.is_none() {
            match self.said.recv_timeout(left) {
                Ok(said) => self.next = Some(said),
                Err(RecvTimeoutError::Timeout) => return None,
                // Nobody can say anything any more.
                Err(RecvTimeoutError::Disconnected) => std::thread::sleep(left),
            }
        }
        self.next()
    }
}

/// Whether the second makes the first one needless.
fn is_outdated(first: &Said, second: &Said) -> bool {
    let seeks = |text: &str| text.contains("\"do\":\"seek\"");
    match (first, second) {
        (Said::Text(one, a, _), Said::Text(other, b, _)) => one == other && seeks(a) && seeks(b),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::mpsc::sync_channel;
    use std::time::Duration;

    use super::*;
    use crate::live::server::outbox::Outbox;

    #[test]
    fn of_seeks_that_follow_one_another_the_last_is_heard() {
        let (say, said) = sync_channel(16);
        let outbox = Arc::new(Outbox::default());
        let mut unheard = Unheard::new(said);
        for (id, text) in [
            (1, r#"{"do":"seek","step":1}"#),
            (1, r#"{"do":"seek","step":2}"#),
            (1, r#"{"do":"seek","step":3}"#),
            (2, r#"{"do":"seek","step":4}"#),
            (2, r#"{"do":"branch"}"#),
            (2, r#"{"do":"seek","step":5}"#),
        ] {
            let slot = outbox.slot().unwrap();
            say.send(Said::Text(id, text.to_owned(), slot)).unwrap();
        }
        let heard = std::iter::from_fn(|| unheard.next()).map(|said| match said {
            Said::Text(_, text, _) => text,
            _ => String::new(),
        });
        let heard: Vec<String> = heard.collect();
        assert_eq!(heard.len(), 4, "{heard:?}");
        assert!(heard[0].contains("3") && heard[2].contains("branch"));
        let soon = Instant::now() + Duration::from_millis(2);
        assert!(unheard.before(soon).is_none());
        say.send(Said::Left(1)).unwrap();
        assert!(
            unheard
                .before(Instant::now() + Duration::from_secs(5))
                .is_some()
        );
    }
}

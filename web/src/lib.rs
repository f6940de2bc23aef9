//! A live session as WebAssembly: what `aplomb view` serves, inside of the page.
//!
//! The worker's calls → a session and its watcher → messages, frames and files. The module imports
//! nothing: no clock, no random numbers, no files. The worker (`web/worker.js`) brings the time.
//!
//! Texts and bytes cross the border in two buffers. Inward: the worker asks for [`room`], writes
//! there, and tells the length. Outward: a call returns a length, and the bytes stand at [`out`]
//! until the next call.
//!
//! A panic stops a module for good; [`last_words`] then says why.
#![cfg_attr(
    target_arch = "wasm32",
    allow(
        unsafe_code,
        reason = "the names of exports; no pointer is followed here"
    )
)]

mod playground;

use std::cell::{Cell, RefCell};

use playground::Playground;

thread_local! {
    static PLAYGROUND: RefCell<Option<Playground>> = const { RefCell::new(None) };
    static INWARD: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTWARD: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static LAST_WORDS: Cell<String> = const { Cell::new(String::new()) };
}

/// Does something with the playground; nothing before [`begin`].
fn with<T: Default>(act: impl FnOnce(&mut Playground) -> T) -> T {
    PLAYGROUND.with_borrow_mut(|playground| playground.as_mut().map(act).unwrap_or_default())
}

/// Lays bytes out for the worker; returns how many.
fn put(bytes: impl Into<Vec<u8>>) -> usize {
    OUTWARD.with_borrow_mut(|outward| {
        *outward = bytes.into();
        outward.len()
    })
}

/// The text that the worker has written.
fn written(length: usize) -> String {
    INWARD.with_borrow(|inward| {
        let bytes = inward.get(..length).unwrap_or_default();
        String::from_utf8_lossy(bytes).into_owned()
    })
}

/// Begins a session; returns the length of a message that says why not, or 0.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn begin() -> usize {
    std::panic::set_hook(Box::new(|panic| LAST_WORDS.set(panic.to_string())));
    match Playground::new() {
        Ok(playground) => {
            PLAYGROUND.set(Some(playground));
            0
        }
        Err(e) => put(e.to_string()),
    }
}

/// Where the worker may write so many bytes, until the next call.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn room(length: usize) -> *mut u8 {
    INWARD.with_borrow_mut(|inward| {
        inward.clear();
        inward.resize(length, 0);
        inward.as_mut_ptr()
    })
}

/// Where the bytes stand whose length the last call returned.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn out() -> *const u8 {
    OUTWARD.with_borrow(|outward| outward.as_ptr())
}

/// Does what the text in the room asks for, a request of the live protocol.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn ask(length: usize) {
    let text = written(length);
    with(|playground| playground.ask(&text));
}

/// Lets time pass, s; returns how many steps were done.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn advance(seconds: f64) -> u32 {
    with(|playground| playground.advance(seconds) as u32)
}

/// The length of the next message, or 0.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn next_message() -> usize {
    put(with(Playground::next_message).unwrap_or_default())
}

/// The length of the frame of this moment. `dropped` were left out because the page was busy.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn frame(dropped: u32) -> usize {
    put(with(|playground| playground.frame(dropped)))
}

/// Saves what was done, as the file whose name is in the room: the length of its bytes, or minus
/// that of a message that says why not.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn save(length: usize) -> isize {
    let name = written(length);
    match with(|playground| Some(playground.save(&name))) {
        Some(Ok(bytes)) => put(bytes) as isize,
        Some(Err(e)) => -(put(e.to_string()) as isize),
        None => -(put("there is no session") as isize),
    }
}

/// The length of the digest of the run so far.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn digest() -> usize {
    put(with(|playground| playground.digest()))
}

/// The length of what a panic said, or 0.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn last_words() -> usize {
    put(LAST_WORDS.take())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the worker would: there `room` and `out` stand for it.
    fn write(text: &str) -> usize {
        room(text.len());
        INWARD.with_borrow_mut(|inward| inward.copy_from_slice(text.as_bytes()));
        text.len()
    }

    fn read(length: usize) -> String {
        OUTWARD.with_borrow(|outward| {
            assert_eq!(outward.len(), length);
            String::from_utf8(outward.clone()).unwrap()
        })
    }

    #[test]
    fn what_is_called_before_the_beginning_does_nothing() {
        ask(write(r#"{"do":"play"}"#));
        assert_eq!((advance(1.0), next_message(), frame(0)), (0, 0, 0));
        assert!(save(write("session.ron")) < 0);
    }

    #[test]
    fn texts_cross_the_border_in_both_directions() {
        assert_eq!(begin(), 0);
        assert!(read(next_message()).starts_with(r#"{"is":"hello","#));
        ask(write(r#"{"do":"step","steps":7}"#));
        assert!(read(frame(2)).contains(r#""n":7,"#));
        assert_eq!(read(digest()).len(), 32);
        let length = save(write("session.ron"));
        assert!(read(length as usize).contains("characters"));
        // Longer than what was written: as if nothing was.
        ask(1 << 20);
        while next_message() > 0 {}
    }
}

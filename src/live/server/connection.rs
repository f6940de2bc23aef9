//! One connection: a file of the page, a save, or a WebSocket.
//!
//! socket → request → answer; for a WebSocket: messages → session, [`Outbox`] → messages.

use std::io::{ErrorKind, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use tungstenite::handshake::derive_accept_key;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Error, Message, WebSocket};

use crate::live::answer::told;
use crate::live::request::LARGEST_OPENED;
use crate::live::server::outbox::{Letter, Outbox};
use crate::live::server::{Said, http, page, saves};

/// How long a connection waits for something to send before it listens again.
const LISTENING: Duration = Duration::from_millis(8);
/// Messages that are read before anything else is sent.
const AT_ONCE: usize = 16;
/// Frames that may be on their way. Each is followed by a ping: what nobody has answered waits in
/// boxes on the way, where only old frames would pile up.
const MOST_UNDER_WAY: u64 = 16;
/// How long somebody may be silent, or take nothing.
const SILENCE: Duration = Duration::from_secs(45);
/// What may wait in the socket's own box, bytes.
const LARGEST_UNSENT: usize = 16 << 20;

/// Somebody who has knocked.
pub(super) struct Visitor {
    pub(super) id: u64,
    /// Where the server listens.
    pub(super) address: SocketAddr,
    pub(super) say: SyncSender<Said>,
    /// How many saves are being made.
    pub(super) saves: Arc<AtomicUsize>,
    pub(super) stop: Arc<AtomicBool>,
}

impl Visitor {
    /// Serves them until they or the server are done.
    pub(super) fn visit(&self, mut stream: TcpStream) {
        // Accepted sockets are like their listener on some systems.
        if stream.set_nonblocking(false).is_err() || stream.set_nodelay(true).is_err() {
            return;
        }
        let Some(asked) = http::read(&mut stream) else {
            return http::refuse(&mut stream, "400 Bad Request", "this is no request");
        };
        if !asked.is_at_home(self.address) {
            let why = "only the page itself may ask: open it at the address that was printed";
            return http::refuse(&mut stream, "403 Forbidden", why);
        }
        if asked.method != "GET" {
            return http::refuse(&mut stream, "405 Method Not Allowed", "accepted: GET");
        }
        let path = asked.path.split(['?', '#']).next().unwrap_or_default();
        if path == "/live" {
            let Some(key) = &asked.key else {
                return http::refuse(&mut stream, "426 Upgrade Required", "accepted: a WebSocket");
            };
            return self.shake_hands(stream, key);
        }
        if let Some(name) = path.strip_prefix("/save/") {
            let query = asked.path.split_once('?').map_or("", |(_, query)| query);
            return saves::save(&mut stream, name, query, &self.say, &self.saves);
        }
        match page::file(path) {
            Some((kind, body)) => http::respond(&mut stream, "200 OK", kind, body),
            None => http::refuse(&mut stream, "404 Not Found", "there is nothing here"),
        }
    }

    fn shake_hands(&self, mut stream: TcpStream, key: &str) {
        let accept = derive_accept_key(key.as_bytes());
        let head = format!(
            "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
             Sec-WebSocket-Accept: {accept}\r\n\r\n"
        );
        if stream.write_all(head.as_bytes()).is_err() || stream.set_nonblocking(true).is_err() {
            return;
        }
        let config = WebSocketConfig::default()
            .write_buffer_size(0)
            .max_write_buffer_size(LARGEST_UNSENT)
            .max_message_size(Some(LARGEST_OPENED))
            .max_frame_size(Some(LARGEST_OPENED));
        let socket = WebSocket::from_raw_socket(stream, Role::Server, Some(config));
        let outbox = Arc::new(Outbox::default());
        if self
            .say
            .send(Said::Joined(self.id, Arc::clone(&outbox)))
            .is_err()
        {
            return;
        }
        let mut talk = Talk {
            visitor: self,
            socket,
            outbox,
            unsent: false,
            heard: Instant::now(),
            taken: Instant::now(),
            frames: 0,
            answered: 0,
        };
        while !self.stop.load(Ordering::Relaxed) && talk.go_on() {}
        talk.outbox.close();
        // A last word, if they listen.
        drop(talk.socket.close(None));
        drop(talk.socket.flush());
        drop(self.say.send(Said::Left(self.id)));
    }
}

/// A WebSocket that is open.
struct Talk<'a> {
    visitor: &'a Visitor,
    socket: WebSocket<TcpStream>,
    outbox: Arc<Outbox>,
    /// Whether something that was written has not left yet.
    unsent: bool,
    /// When they were last heard and took something.
    heard: Instant,
    taken: Instant,
    /// Frames that were sent, and that have been read for sure.
    frames: u64,
    answered: u64,
}

impl Talk<'_> {
    /// Sends what is there, listens; whether the talk goes on.
    fn go_on(&mut self) -> bool {
        if self.outbox.is_closed() {
            return false;
        }
        let now = Instant::now();
        if now - self.heard > SILENCE || (self.unsent && now - self.taken > SILENCE) {
            return false;
        }
        self.send() && self.listen()
    }

    fn send(&mut self) -> bool {
        if self.unsent {
            std::thread::sleep(LISTENING);
            let flushed = self.socket.flush();
            if !self.left(flushed) {
                return false;
            }
        }
        // Who is slow gets no frame before the last has left: only the newest is kept for them.
        let mut time = LISTENING;
        while !self.unsent {
            let frames = self.frames - self.answered < MOST_UNDER_WAY;
            let went = match self.outbox.take(time, frames) {
                None => return true,
                Some(Letter::Message(text)) => self.went(Message::text(text)),
                Some(Letter::Frame(text)) => {
                    self.frames += 1;
                    let count = self.frames.to_le_bytes().to_vec();
                    self.went(Message::text(text)) && self.went(Message::Ping(count.into()))
                }
            };
            if !went {
                return false;
            }
            time = Duration::ZERO;
        }
        true
    }

    /// Writes a message; whether the talk goes on.
    fn went(&mut self, message: Message) -> bool {
        let written = self
            .socket
            .write(message)
            .and_then(|()| self.socket.flush());
        self.left(written)
    }

    /// Whether all has left, or can still leave.
    fn left(&mut self, result: Result<(), Error>) -> bool {
        match result {
            Ok(()) => {
                (self.unsent, self.taken) = (false, Instant::now());
                true
            }
            Err(e) if would_block(&e) => {
                self.unsent = true;
                true
            }
            Err(_) => false,
        }
    }

    /// Hands on what they say; whether there was room for it.
    fn said(&self, text: &str) -> bool {
        let (visitor, slot) = (self.visitor, self.outbox.slot());
        let said = slot.map(|slot| Said::Text(visitor.id, text.to_owned(), slot));
        said.is_some_and(|said| visitor.say.try_send(said).is_ok())
    }

    fn listen(&mut self) -> bool {
        for _ in 0..AT_ONCE {
            match self.socket.read() {
                Ok(Message::Text(text)) => {
                    self.heard = Instant::now();
                    if !self.said(text.as_str()) {
                        let busy = "too much is asked at once: this was not heard";
                        self.outbox.put(told(false, busy));
                    }
                }
                Ok(Message::Close(_)) => return false,
                Ok(Message::Pong(count)) => {
                    self.heard = Instant::now();
                    let count = count.as_ref().try_into().map_or(0, u64::from_le_bytes);
                    self.answered = self.answered.max(count.min(self.frames));
                }
                Ok(_) => self.heard = Instant::now(),
                Err(e) if would_block(&e) => return true,
                Err(_) => return false,
            }
        }
        true
    }
}

fn would_block(error: &Error) -> bool {
    matches!(error, Error::Io(e) if e.kind() == ErrorKind::WouldBlock)
}

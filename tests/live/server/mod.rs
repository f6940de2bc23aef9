//! The server without a browser: strangers, crowds, noise, and how it ends.

mod crowd;
mod ends;
mod measure;
mod noise;
mod strangers;

use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use aplomb::live::server::Server;
use aplomb::live::{SceneNames, Session};
use serde_json::Value;
use tungstenite::{Message, WebSocket};

use crate::program::PATIENCE;

/// A server in a thread of this process.
pub(crate) struct Served {
    pub(crate) address: SocketAddr,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Served {
    /// Somebody standing.
    pub(crate) fn standing() -> Self {
        let server = Server::bind(IpAddr::V4(Ipv4Addr::LOCALHOST), 0).unwrap();
        let (address, stop) = (server.address(), Arc::new(AtomicBool::new(false)));
        let raised = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let session = Session::new(&SceneNames::default()).unwrap();
            server.serve(session, None, &raised);
        });
        Self {
            address,
            stop,
            thread: Some(thread),
        }
    }

    /// A WebSocket to it.
    pub(crate) fn join(&self) -> Client {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_nodelay(true).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_millis(500)))
            .unwrap();
        let url = format!("ws://{}/live", self.address);
        let (socket, _) = tungstenite::client(url, stream).unwrap();
        Client { socket }
    }

    /// The whole answer to a text that is sent as it is.
    fn raw(&self, text: &str) -> String {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        // It may close before it has read all.
        drop(stream.write_all(text.as_bytes()));
        let mut answer = Vec::new();
        drop(stream.read_to_end(&mut answer));
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// The answer to a request for a path.
    fn get(&self, path: &str) -> String {
        let host = self.address;
        self.raw(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n"))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let ended = self.thread.take().unwrap().join();
        assert!(
            ended.is_ok() || std::thread::panicking(),
            "the server panicked"
        );
    }
}

/// A client that is no browser.
pub(crate) struct Client {
    socket: WebSocket<TcpStream>,
}

impl Client {
    pub(crate) fn say(&mut self, text: &str) {
        self.socket.send(Message::text(text)).unwrap();
    }

    /// The next message; none if the server is silent for a while or has closed.
    pub(crate) fn hear(&mut self) -> Option<Value> {
        loop {
            match self.socket.read().ok()? {
                Message::Text(text) => return Some(serde_json::from_str(&text).unwrap()),
                Message::Close(_) => return None,
                _ => (),
            }
        }
    }

    /// The next message that is wanted.
    pub(crate) fn until(&mut self, what: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end {
            if let Some(message) = self.hear().filter(&wanted) {
                return message;
            }
        }
        panic!("waited in vain: {what}");
    }

    pub(crate) fn frame(&mut self) -> Value {
        self.until("a frame", |m| m["is"] == "frame")
    }

    /// Frames a second, measured for some seconds.
    pub(crate) fn rate(&mut self, seconds: f64) -> f64 {
        let (begun, mut frames) = (Instant::now(), 0);
        while begun.elapsed().as_secs_f64() < seconds {
            frames += usize::from(self.hear().is_some_and(|m| m["is"] == "frame"));
        }
        frames as f64 / begun.elapsed().as_secs_f64()
    }
}

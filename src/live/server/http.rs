//! The little of HTTP that a page and its WebSocket need. Everything that is read is bounded, in
//! bytes and in time.
//!
//! socket → [`HttpRequest`] → response.

use std::io::{Read, Write};
use std::net::{IpAddr, SocketAddr, TcpStream};
use std::time::{Duration, Instant};

/// The longest head of a request, bytes.
const LONGEST_HEAD: usize = 8 << 10;
/// How long somebody may take for it.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long somebody may take to read an answer.
pub(super) const READING: Duration = Duration::from_secs(20);

/// What somebody asked for.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct HttpRequest {
    pub(super) method: String,
    /// With what stands behind a `?`.
    pub(super) path: String,
    pub(super) host: Option<String>,
    pub(super) origin: Option<String>,
    /// The key of a WebSocket's handshake, if it is one.
    pub(super) key: Option<String>,
}

/// Reads a request's head; none for what is none, too long or too slow.
pub(super) fn read(stream: &mut TcpStream) -> Option<HttpRequest> {
    let until = Instant::now() + PATIENCE;
    let mut head = Vec::new();
    let mut piece = [0; 1024];
    loop {
        let left = until.checked_duration_since(Instant::now())?;
        stream
            .set_read_timeout(Some(left.max(Duration::from_millis(1))))
            .ok()?;
        let read = stream.read(&mut piece).ok().filter(|n| *n > 0)?;
        head.extend_from_slice(&piece[..read]);
        if head.len() > LONGEST_HEAD {
            return None;
        }
        if let Some(asked) = parse(&head)? {
            return Some(asked);
        }
    }
}

/// A head that is complete; some nothing while it is not; none if it never will be.
fn parse(head: &[u8]) -> Option<Option<HttpRequest>> {
    let mut headers = [httparse::EMPTY_HEADER; 64];
    let mut request = httparse::Request::new(&mut headers);
    if request.parse(head).ok()?.is_partial() {
        return Some(None);
    }
    let value = |name: &str| {
        let header = request
            .headers
            .iter()
            .find(|h| h.name.eq_ignore_ascii_case(name));
        header
            .and_then(|h| std::str::from_utf8(h.value).ok())
            .map(str::to_owned)
    };
    let upgrades = value("upgrade").is_some_and(|u| u.eq_ignore_ascii_case("websocket"));
    let asked = HttpRequest {
        method: request.method?.to_owned(),
        path: request.path?.to_owned(),
        host: value("host"),
        origin: value("origin"),
        key: value("sec-websocket-key").filter(|_| upgrades),
    };
    Some(Some(asked))
}

impl HttpRequest {
    /// Whether it comes from the page itself. A page from elsewhere has another `Origin`; a name
    /// that was made to point to this computer has another `Host`. Programs send no `Origin`.
    pub(super) fn is_at_home(&self, address: SocketAddr) -> bool {
        let Some(host) = &self.host else {
            return false;
        };
        let own_origin = |o: &String| o.eq_ignore_ascii_case(&format!("http://{host}"));
        is_own(host, address) && self.origin.as_ref().is_none_or(own_origin)
    }
}

/// Whether a `Host` is this server: `localhost` or an address, never another name.
fn is_own(host: &str, address: SocketAddr) -> bool {
    let (name, port) = match host.rsplit_once(':') {
        Some((name, port)) if !port.ends_with(']') => (name, port.parse().unwrap_or(0)),
        _ => (host, 80),
    };
    let name = name.trim_matches(['[', ']']);
    let here = name.eq_ignore_ascii_case("localhost") || name.parse::<IpAddr>().is_ok();
    here && port == address.port()
}

/// Answers with a body.
pub(super) fn respond(stream: &mut TcpStream, status: &str, kind: &str, body: &[u8]) {
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: close\r\n\
         Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\n\
         Content-Security-Policy: default-src 'self'; img-src 'self' data: blob:; media-src blob:; \
         style-src 'self' 'unsafe-inline'; frame-ancestors 'none'\r\n\r\n",
        body.len()
    );
    // Who is gone needs no answer.
    drop(stream.set_write_timeout(Some(READING)));
    drop(
        stream
            .write_all(head.as_bytes())
            .and_then(|()| stream.write_all(body)),
    );
    drop(stream.flush());
}

/// Answers with a line of text.
pub(super) fn refuse(stream: &mut TcpStream, status: &str, why: &str) {
    respond(
        stream,
        status,
        "text/plain; charset=utf-8",
        format!("{why}\n").as_bytes(),
    );
}

/// Says that there are too many, without waiting for anything.
pub(super) fn turn_away(mut stream: TcpStream) {
    drop(stream.set_nonblocking(true));
    let head = "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
    drop(stream.write_all(head.as_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(text: &str) -> Option<Option<HttpRequest>> {
        parse(text.as_bytes())
    }

    #[test]
    fn heads_are_read_when_they_are_whole() {
        let head = "GET /live HTTP/1.1\r\nHost: localhost:7227\r\nUpgrade: WebSocket\r\n\
                    Sec-WebSocket-Key: abc\r\nOrigin: http://localhost:7227\r\n\r\n";
        let whole = asked(head).flatten().unwrap();
        assert_eq!(whole.key.as_deref(), Some("abc"));
        assert_eq!(asked(&head[..40]), Some(None));
        assert_eq!(asked("\u{1}\u{2}"), None);
    }

    #[test]
    fn pages_from_elsewhere_and_foreign_names_are_strangers() {
        let address = "127.0.0.1:7227".parse().unwrap();
        let at_home = |host: &str, origin: Option<&str>| {
            let asked = HttpRequest {
                host: Some(host.to_owned()),
                origin: origin.map(str::to_owned),
                ..HttpRequest::default()
            };
            asked.is_at_home(address)
        };
        assert!(at_home("127.0.0.1:7227", Some("http://127.0.0.1:7227")));
        assert!(at_home("localhost:7227", None));
        assert!(at_home("[::1]:7227", Some("http://[::1]:7227")));
        for (host, origin) in [
            ("127.0.0.1:7227", Some("http://evil.example")),
            ("127.0.0.1:7227", Some("null")),
            ("127.0.0.1:7227", Some("http://localhost:7227")),
            ("evil.example:7227", Some("http://evil.example:7227")),
            ("127.0.0.1:80", None),
            ("localhost", None),
            ("", None),
        ] {
            assert!(!at_home(host, origin), "{host} {origin:?}");
        }
        assert!(!HttpRequest::default().is_at_home(address));
    }
}

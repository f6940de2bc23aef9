//! A web server of static files, as any host of the playground is.

use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};

/// Below this path the worker is another: its session panics in each round.
pub(crate) const BROKEN: &str = "broken/";
/// Below this path the WebAssembly is missing.
pub(crate) const BARE: &str = "bare/";

/// Serves a folder until the test ends; gives its address.
pub(crate) fn serve(folder: PathBuf) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}/", listener.local_addr().unwrap());
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let folder = folder.clone();
            std::thread::spawn(move || answer(&stream, &folder));
        }
    });
    address
}

fn answer(mut stream: &TcpStream, folder: &Path) -> Option<()> {
    let mut lines = BufReader::new(stream).lines();
    let asked = lines.next()?.ok()?;
    lines.map_while(Result::ok).find(String::is_empty);
    let path = asked.split(' ').nth(1)?.strip_prefix('/')?;
    let (broken, bare) = (path.strip_prefix(BROKEN), path.strip_prefix(BARE));
    let name = match broken.or(bare).unwrap_or(path) {
        "" => "index.html",
        name => name,
    };
    let mut bytes = std::fs::read(folder.join(name)).ok();
    if broken.is_some() && name == "worker.js" {
        let text = String::from_utf8(bytes?).ok()?;
        let (sound, panics) = ("session.advance(", "session.room(-1); (");
        assert!(text.contains(sound));
        bytes = Some(text.replace(sound, panics).into_bytes());
    }
    if bare.is_some() && name.ends_with(".wasm") {
        bytes = None;
    }
    let kind = match name.rsplit_once('.')?.1 {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript",
        "css" => "text/css",
        "svg" => "image/svg+xml",
        "wasm" => "application/wasm",
        _ => "application/octet-stream",
    };
    let status = match bytes {
        Some(_) => "200 OK",
        None => "404 Not Found",
    };
    let bytes = bytes.unwrap_or_default();
    let length = bytes.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes()).ok()?;
    stream.write_all(&bytes).ok()
}

//! Who may ask, for what, and how much at once.

use std::io::{ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tungstenite::{Error, Message};

use super::Served;
use crate::program::{PATIENCE, until};

const KEY: &str = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\
                   Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";

#[test]
fn pages_from_elsewhere_and_foreign_names_are_refused() {
    let served = Served::standing();
    let (host, port) = (served.address, served.address.port());
    let asked = |path: &str, host: &str, origin: &str| {
        let text =
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\n{KEY}\r\n\r\n");
        served.raw(&text)
    };
    for path in ["/", "/live", "/save/session.ron", "/main.js"] {
        for (host, origin) in [
            (host.to_string(), "http://evil.example"),
            (host.to_string(), "null"),
            (format!("evil.example:{port}"), "http://evil.example"),
            (format!("localhost:{}", port ^ 1), "http://localhost"),
        ] {
            let answer = asked(path, &host, origin);
            assert!(
                answer.starts_with("HTTP/1.1 403 "),
                "{path} {host} {origin}: {answer}"
            );
        }
    }
    assert!(
        served
            .raw("GET / HTTP/1.1\r\n\r\n")
            .starts_with("HTTP/1.1 403 "),
        "no host"
    );
}

#[test]
fn only_files_of_the_page_and_saves_are_served() {
    let served = Served::standing();
    let page = served.get("/");
    assert!(page.starts_with("HTTP/1.1 200 OK") && page.contains("<!doctype html>"));
    assert!(page.contains("Content-Security-Policy: default-src 'self'"));
    assert!(
        served
            .get("/uplot/uPlot.min.css")
            .starts_with("HTTP/1.1 200 OK")
    );
    for path in [
        "/../Cargo.toml",
        "/../../../Cargo.toml",
        "/%2e%2e/%2e%2e/Cargo.toml",
        "/uplot/../../session.rs",
        "//etc/passwd",
        "/etc/passwd",
        "/uplot",
        "/uplot/",
        "/./index.html/..",
        "/index.html\\..\\x.js",
        "/live/../main.rs",
        "/save/../../etc/passwd",
        "/save/session.exe",
        "/save/session.",
        "/save/",
        "/\u{7f}",
    ] {
        let answer = served.get(path);
        let status = answer.split(' ').nth(1).unwrap_or_default().to_owned();
        assert!(
            ["404", "400"].contains(&status.as_str()),
            "{path}: {answer}"
        );
        assert!(
            !answer.contains("[package]") && !answer.contains("root:"),
            "{path}"
        );
    }
    let host = served.address;
    let post = served.raw(&format!("POST / HTTP/1.1\r\nHost: {host}\r\n\r\n"));
    assert!(post.starts_with("HTTP/1.1 405 "), "{post}");
    let plain = served.get("/live");
    assert!(plain.starts_with("HTTP/1.1 426 "), "{plain}");
}

#[test]
fn what_is_too_large_ends_its_connection_alone() {
    let served = Served::standing();
    let mut other = served.join();
    other.frame();
    let head = format!(
        "GET / HTTP/1.1\r\nHost: {}\r\nX: {}",
        served.address,
        "x".repeat(1 << 20)
    );
    let answer = served.raw(&head);
    assert!(
        answer.is_empty() || answer.starts_with("HTTP/1.1 400 "),
        "{answer}"
    );

    // What a command may not be is told; what no message may be ends the talk.
    let mut client = served.join();
    client.say(&format!(
        r#"{{"do":"command","text":"{}"}}"#,
        "x".repeat(100_000)
    ));
    let told = client.until("a refusal", |m| m["is"] == "told");
    assert!(
        told["text"].as_str().unwrap().contains("at most 4 kB"),
        "{told}"
    );
    // It may be closed while it is still being sent.
    drop(client.socket.send(Message::text("x".repeat(4 << 20))));
    until("the end of the talk", || match client.socket.read() {
        Err(Error::Io(e)) if e.kind() == ErrorKind::WouldBlock => None,
        Err(_) => Some(()),
        Ok(_) => None,
    });
    other.frame();
    served.join().frame();
}

#[test]
fn binary_messages_change_nothing() {
    let served = Served::standing();
    let mut client = served.join();
    for _ in 0..200 {
        let play = br#"{"do":"pause"}"#.as_slice();
        client.socket.send(Message::binary(play)).unwrap();
        client
            .socket
            .send(Message::Ping(vec![1, 2, 3].into()))
            .unwrap();
    }
    client.say(r#"{"do":"command","text":"who is there"}"#);
    client.until("an answer", |m| m["is"] == "told");
    assert_eq!(client.frame()["paused"], false);
}

#[test]
fn requests_that_are_none_are_survived() {
    let served = Served::standing();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let good = format!(
        "GET /live HTTP/1.1\r\nHost: {}\r\n{KEY}\r\n\r\n\u{81}\u{85}",
        served.address
    );
    for _ in 0..300 {
        let mut bytes = good.clone().into_bytes();
        for _ in 0..random.gen_range(1..20) {
            let place = random.gen_range(0..bytes.len());
            match random.gen_range(0..3) {
                0 => bytes[place] = random.r#gen(),
                1 => bytes.truncate(place.max(1)),
                _ => bytes.extend_from_within(place..),
            }
            bytes.truncate(20_000);
        }
        let mut stream = TcpStream::connect(served.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        drop(stream.write_all(&bytes));
        drop(stream.shutdown(Shutdown::Write));
        let mut answer = [0; 1000];
        drop(stream.read(&mut answer));
    }
    served.join().frame();
}

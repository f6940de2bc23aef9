//! Many at once, some of them silent, slow or rude: nobody disturbs the others.

use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::Served;
use crate::program::until;

/// Frames a second that a client surely gets on a busy computer; 60 on one that is not.
const ENOUGH: f64 = 30.0;

#[test]
fn two_hundred_who_say_nothing_leave_the_others_their_frames() {
    let served = Served::standing();
    let mut client = served.join();
    client.frame();
    let silent: Vec<TcpStream> = (0..200)
        .map_while(|_| TcpStream::connect(served.address).ok())
        .collect();
    assert_eq!(silent.len(), 200);
    let rate = client.rate(1.0);
    assert!(rate > ENOUGH, "{rate} frames a second");
    drop(silent);
    // There is room again.
    until("room", || {
        let page = served.get("/");
        page.starts_with("HTTP/1.1 200 OK").then_some(())
    });
}

#[test]
fn who_reads_nothing_loses_frames_and_the_others_none() {
    let served = Served::standing();
    let mut slow = served.join();
    let mut client = served.join();
    client.frame();
    let mut least = f64::INFINITY;
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(3) {
        least = least.min(client.rate(0.5));
    }
    assert!(least > ENOUGH, "{least} frames a second");
    let now = client.frame();
    // What waited for it is little; then it is told what it has missed.
    let first = slow.until("frames", |m| m["is"] == "frame");
    let late = slow.until("a frame of now", |m| m["n"].as_u64() >= now["n"].as_u64());
    assert!(first["n"].as_u64() < now["n"].as_u64());
    let dropped = late["dropped"].as_u64().unwrap();
    assert!(dropped > 60, "{dropped} dropped");
    let own = client.frame()["dropped"].as_u64().unwrap();
    assert!(own < dropped / 2, "{own} of {dropped}");
}

#[test]
fn each_client_is_told_what_it_watches() {
    let served = Served::standing();
    let (mut one, mut other) = (served.join(), served.join());
    one.say(r#"{"do":"watch","features":["com_height"]}"#);
    other.say(r#"{"do":"watch","features":["angle.knee_r","com_height","com_speed"]}"#);
    other.say(r#"{"do":"inspect","controller":1}"#);
    let watched = |m: &Value, n: usize| m["watch"].as_array().is_some_and(|w| w.len() == n);
    let frame = one.until("its feature", |m| watched(m, 1));
    assert!(frame["inspect"].is_null() && frame["watch"][0].as_f64().unwrap() > 0.9);
    let frame = other.until("its features", |m| watched(m, 3) && !m["inspect"].is_null());
    assert_eq!(frame["inspect"]["controller"], 1);
}

#[test]
fn more_than_can_be_heard_is_told_and_the_others_get_their_frames() {
    let served = Served::standing();
    let mut client = served.join();
    client.frame();
    // Each of these takes a while.
    let mut rude = served.join();
    for _ in 0..2000 {
        rude.say(r#"{"do":"step","steps":1000}"#);
    }
    let (begun, mut longest, mut last) = (Instant::now(), Duration::ZERO, Instant::now());
    while begun.elapsed() < Duration::from_secs(2) {
        if client.hear().is_some_and(|m| m["is"] == "frame") {
            longest = longest.max(last.elapsed());
            last = Instant::now();
        }
    }
    longest = longest.max(last.elapsed());
    assert!(
        longest < Duration::from_secs(2),
        "{longest:?} without a frame"
    );
    rude.until("that it is too much", |m| {
        m["text"].as_str().is_some_and(|t| t.contains("too much"))
    });
    // What it still wants is forgotten when it goes.
    drop(rude);
    client.say(r#"{"do":"play"}"#);
    client.until("an answer", |m| m["paused"] == false);
}

#[test]
fn a_pause_by_one_is_seen_by_twenty() {
    let served = Served::standing();
    let mut clients: Vec<_> = (0..20).map(|_| served.join()).collect();
    clients[7].say(&json!({"do": "pause"}).to_string());
    let steps = clients.iter_mut().map(|c| {
        let frame = c.until("a pause", |m| m["paused"] == true);
        frame["n"].as_u64().unwrap()
    });
    let steps: Vec<u64> = steps.collect();
    assert!(steps.iter().all(|n| *n == steps[0]), "{steps:?}");
}

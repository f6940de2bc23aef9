//! Thousands of messages, random and mutated: the run goes on and the server answers.
//!
//! `LIVE_MESSAGES=100000` sends more.

use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tungstenite::Message;

use super::{Client, Served};

const MESSAGES: usize = 20_000;
/// Messages between two that are answered for sure, so that all are heard.
const BETWEEN: usize = 100;

/// Messages to be mutated; the last ones are seldom, for they take long.
const SEEDS: [&str; 20] = [
    r#"{"do":"play"}"#,
    r#"{"do":"pause"}"#,
    r#"{"do":"step","steps":3}"#,
    r#"{"do":"speed","factor":1.0}"#,
    r#"{"do":"push","character":0,"link":"torso","impulse":[40,-12.5]}"#,
    r#"{"do":"drag","character":0,"link":"torso","point":[0,0.2],"to":[1.2,1.5]}"#,
    r#"{"do":"drag","prop":"ball","point":[0,0.2],"to":[-1.2,1.5]}"#,
    r#"{"do":"release"}"#,
    r#"{"do":"throw","shape":"ball","mass":5,"size":0.12,"position":[2,1],"velocity":[-4,1]}"#,
    r#"{"do":"throw","shape":"crate","mass":50,"size":0.2,"position":[-2,3],"velocity":[0,0]}"#,
    r#"{"do":"command","character":0,"text":"bow depth=0.5"}"#,
    r#"{"do":"command","text":"rise_supine"}"#,
    r#"{"do":"set","name":"friction","value":0.6}"#,
    r#"{"do":"set","name":"gravity","value":12}"#,
    r#"{"do":"seek","step":12}"#,
    r#"{"do":"branch"}"#,
    r#"{"do":"watch","features":["angle.knee_r","com_height"]}"#,
    r#"{"do":"inspect","character":0,"controller":3}"#,
    r#"{"do":"open","name":"mine.ron","text":"(name: \"x\", fallback: \"rest\", controllers: [File(\"skills/rest.ron\")])"}"#,
    r#"{"do":"load","scenario":"clips/catch","character":"humanoid","repertoire":null}"#,
];
const SELDOM: usize = 2;

/// What a number, a word or a piece of a message is replaced by.
const ODD: [&str; 24] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e999",
    "1e-320",
    "-0.0",
    "18446744073709551616",
    "0.1e1",
    "NaN",
    "null",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[[[[[[[[[",
    "\\u0000",
    "\u{1F938}",
    "\"prop\":\"ball\",",
    "\"do\":\"reset\",",
    "torso",
    "../../x",
    "\u{FFFD}",
    "999999999",
];

fn message(random: &mut ChaCha8Rng) -> String {
    let seed = if random.gen_bool(0.01) {
        random.gen_range(SEEDS.len() - SELDOM..SEEDS.len())
    } else {
        random.gen_range(0..SEEDS.len() - SELDOM)
    };
    let mut text: Vec<char> = SEEDS[seed].chars().collect();
    if random.gen_bool(0.02) {
        let length = random.gen_range(0..300);
        return (0..length).map(|_| random.r#gen::<char>()).collect();
    }
    for _ in 0..random.gen_range(0..4) {
        if text.is_empty() {
            break;
        }
        let from = random.gen_range(0..text.len());
        let to = (from + random.gen_range(0..12)).min(text.len());
        let odd = ODD.choose(random).unwrap();
        match random.gen_range(0..6) {
            0 => text[from] = random.r#gen(),
            1 => drop(text.drain(from..to)),
            2 => drop(text.splice(from..from, odd.chars())),
            3 => {
                let piece: Vec<char> = text[from..to].to_vec();
                drop(text.splice(from..from, piece));
            }
            4 => text.truncate(from),
            _ => {
                // A whole number.
                let digit = |c: &char| c.is_ascii_digit();
                let Some(from) = text.iter().position(digit) else {
                    continue;
                };
                let length = text[from..].iter().take_while(|c| digit(c)).count();
                drop(text.splice(from..from + length, odd.chars()));
            }
        }
    }
    text.into_iter().collect()
}

/// Says something that is surely answered, and waits for the answer.
fn agree(client: &mut Client, number: usize) {
    let name = format!("marker{number}");
    client.say(&format!(r#"{{"do":"set","name":"{name}","value":1}}"#));
    client.until("the marker", |m| {
        m["is"] == "told" && m["text"].as_str().is_some_and(|t| t.contains(&name))
    });
}

#[test]
fn noise_ends_nothing() {
    let messages = std::env::var("LIVE_MESSAGES").ok();
    let messages = messages.map_or(MESSAGES, |n| n.parse().unwrap());
    let served = Served::standing();
    let mut client = served.join();
    let mut random = ChaCha8Rng::seed_from_u64(20_000);
    for k in 0..messages {
        let text = message(&mut random);
        let message = if random.gen_bool(0.02) {
            Message::binary(text.into_bytes())
        } else {
            Message::text(text)
        };
        client.socket.send(message).unwrap();
        if k % BETWEEN == BETWEEN - 1 {
            agree(&mut client, k);
        }
    }
    client.say(r#"{"do":"load","scenario":null,"character":null,"repertoire":null}"#);
    client.say(r#"{"do":"speed","factor":1}"#);
    client.say(r#"{"do":"play"}"#);
    client.until("a new beginning", |m| m["is"] == "hello");
    let frame = client.until("time that goes on", |m| m["n"].as_u64() > Some(300));
    assert_eq!(frame["c"][0]["posture"], "standing");
    let high = frame["c"][0]["com"][1].as_f64().unwrap();
    assert!((0.9..1.1).contains(&high), "{high}");
}

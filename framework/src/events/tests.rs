use proptest::prelude::*;

use super::*;

/// One event of each kind, and a switch for each reason, with a text, a number and a found thing in
/// every place that takes one.
fn every(text: &str, number: f64, found: Found) -> Vec<EventKind> {
    let text = || text.to_owned();
    let unmet = Unmet {
        clause: text(),
        found,
    };
    let bid = |refusal| Bid {
        controller: text(),
        suitability: number,
        refusal,
    };
    let refusals = [
        Refusal::OnCommandOnly,
        Refusal::Recovering,
        Refusal::Precondition(unmet.clone()),
        Refusal::Declines,
    ];
    let bids = || {
        refusals
            .clone()
            .map(Some)
            .into_iter()
            .chain([None])
            .map(bid)
    };
    let (link, prop, from) = (text(), text(), Some(text()));
    let mut kinds = vec![
        EventKind::Push {
            link: text(),
            impulse: [number, -number],
        },
        EventKind::Command {
            text: text(),
            accepted: number > 0.0,
        },
        EventKind::Refused {
            command: text(),
            controller: from.clone(),
            unmet: unmet.clone(),
        },
        EventKind::Grasped {
            link: link.clone(),
            prop: prop.clone(),
        },
        EventKind::Slipped { link, prop },
        EventKind::Broke { prop: text(), from },
        EventKind::Fell,
        EventKind::Stood,
        EventKind::Thrown { prop: text() },
        EventKind::Dragged { body: text() },
        EventKind::Released,
        EventKind::Set {
            name: text(),
            value: number,
        },
    ];
    let reasons = [
        Reason::Start,
        Reason::Succeeded,
        Reason::Failed(unmet),
        Reason::Command,
    ];
    kinds.extend(reasons.map(|reason| EventKind::Switch {
        from: (number < 0.0).then(text),
        to: text(),
        role: Role::Rise,
        reason,
        bids: bids().collect(),
    }));
    kinds
}

/// Place of a kind in a list of all kinds. One that is added does not compile before it stands here.
fn place(kind: &EventKind) -> usize {
    match kind {
        EventKind::Push { .. } => 0,
        EventKind::Command { .. } => 1,
        EventKind::Refused { .. } => 2,
        EventKind::Grasped { .. } => 3,
        EventKind::Slipped { .. } => 4,
        EventKind::Broke { .. } => 5,
        EventKind::Fell => 6,
        EventKind::Stood => 7,
        EventKind::Switch { .. } => 12,
        EventKind::Thrown { .. } => 8,
        EventKind::Dragged { .. } => 9,
        EventKind::Released => 10,
        EventKind::Set { .. } => 11,
    }
}

fn found(number: f64) -> impl Strategy<Value = Found> {
    prop_oneof![
        Just(Found::Nothing),
        Just(Found::Value(number)),
        any::<String>().prop_map(Found::State),
        any::<String>().prop_map(Found::Absent),
    ]
}

/// Any number, what is none among them, and something found.
fn any_found() -> impl Strategy<Value = (f64, Found)> {
    let special = prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0]);
    prop_oneof![prop::num::f64::ANY, special].prop_flat_map(|n| (Just(n), found(n)))
}

/// A number that a few decimals say exactly, and something found.
fn short_found() -> impl Strategy<Value = (f64, Found)> {
    any::<i32>().prop_flat_map(|n| {
        let number = f64::from(n) / 64.0;
        (Just(number), found(number))
    })
}

#[test]
fn every_kind_is_tried() {
    let kinds = every("x", 1.0, Found::Nothing);
    let mut places: Vec<usize> = kinds.iter().map(place).collect();
    places.dedup();
    assert_eq!(places, (0..13).collect::<Vec<_>>());
    let mut names: Vec<&str> = kinds.iter().map(EventKind::name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 13, "no two kinds have one name: {names:?}");
}

proptest! {
    /// Bit by bit: what is no number comes back as the same.
    #[test]
    fn recorded_events_are_read_back(text: String, (number, found) in any_found(), time: f64) {
        for kind in every(&text, number, found) {
            let event = Event { time, character: 3, kind };
            let bytes = postcard::to_stdvec(&event).unwrap();
            let read: Event = postcard::from_bytes(&bytes).unwrap();
            prop_assert_eq!(place(&read.kind), place(&event.kind));
            prop_assert_eq!(read.kind.to_string(), event.kind.to_string());
            prop_assert_eq!(postcard::to_stdvec(&read).unwrap(), bytes.clone());
            // Of an event that is cut short nothing is read.
            prop_assert!(postcard::from_bytes::<Event>(&bytes[..bytes.len() - 1]).is_err());
        }
    }

    #[test]
    fn events_in_json_are_read_back(text: String, (number, found) in short_found()) {
        for kind in every(&text, number, found) {
            let event = Event { time: number, character: 3, kind };
            let json = serde_json::to_string(&event).unwrap();
            prop_assert_eq!(serde_json::from_str::<Event>(&json).unwrap(), event);
        }
    }

    /// Whatever the numbers and the texts are.
    #[test]
    fn events_are_words(text: String, (number, found) in any_found()) {
        for kind in every(&text, number, found) {
            let line = kind.to_string();
            prop_assert!(line.starts_with(kind.name()), "{}", line);
            if let Some(label) = kind.label() {
                prop_assert!(!label.trim().is_empty());
                prop_assert!(!label.contains("NaN") || text.contains("NaN"), "{}", label);
            }
        }
    }
}

//! The session alone: time, inputs, replays, what a watcher is told.

use aplomb::framework::input::{Result, Source};
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::Scenario;
use aplomb::live::{Request, SceneNames, Session, View};
use serde_json::Value;

fn session(scenario: Option<&str>) -> Session {
    let scenario = scenario.map(str::to_owned);
    let names = SceneNames {
        scenario,
        ..SceneNames::default()
    };
    Session::new(&names).unwrap()
}

fn ask(session: &mut Session, text: &str) -> Result<()> {
    session.ask(&mut View::default(), Request::parse(text)?)
}

/// Lets seconds pass in frames of a 60th.
fn pass(session: &mut Session, seconds: f64) {
    for _ in 0..(seconds * 60.0).round() as usize {
        session.advance(1.0 / 60.0);
    }
}

fn frame(session: &Session) -> Value {
    serde_json::from_str(&session.frame(&View::default())).unwrap()
}

/// Twenty inputs in six seconds, of every kind.
fn busy() -> Session {
    let mut session = session(None);
    for (until, text) in [
        (0.5, r#"{"do":"push","link":"torso","impulse":[30,0]}"#),
        (1.5, r#"{"do":"push","link":"torso","impulse":[-60,10]}"#),
        (
            2.5,
            r#"{"do":"throw","shape":"ball","mass":3,"size":0.1,"position":[3,1],"velocity":[-5,2]}"#,
        ),
        (3.0, r#"{"do":"set","name":"friction","value":0.7}"#),
        (
            3.2,
            r#"{"do":"drag","link":"torso","point":[0,0.2],"to":[0.4,1.9]}"#,
        ),
        (
            3.6,
            r#"{"do":"drag","link":"torso","point":[0,0.2],"to":[0.7,2.4]}"#,
        ),
        (4.1, r#"{"do":"release"}"#),
        (
            4.3,
            r#"{"do":"throw","shape":"crate","mass":10,"size":0.15,"position":[0.5,3],"velocity":[0,0]}"#,
        ),
        (
            5.0,
            r#"{"do":"drag","prop":"ball","point":[0,0],"to":[0,2]}"#,
        ),
        (5.5, r#"{"do":"release"}"#),
        (5.6, r#"{"do":"set","name":"gravity","value":7}"#),
        (5.8, r#"{"do":"command","text":"bow"}"#),
    ] {
        let time = session.simulation().time();
        pass(&mut session, until - time);
        ask(&mut session, text).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    pass(&mut session, 1.0);
    session
}

#[test]
fn what_was_done_is_saved_and_has_the_same_digest() {
    let session = busy();
    let digest = session.simulation().digest();
    let recording = session.replay().recording().unwrap();
    assert_eq!(recording.digest(), digest, "as a recording");
    assert_eq!(recording.len() as u64, session.step());
    assert_eq!(recording.events, session.events());
    let text = session.replay().scenario().unwrap();
    let scenario = Scenario::parse(&Source::new("saved", text.as_str())).unwrap();
    let mut again = Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap();
    again.run(scenario.duration);
    assert_eq!(again.digest(), digest, "as a scenario: {text}");
}

#[test]
fn a_minute_with_twenty_inputs_is_done_again_alike_twice() {
    let mut session = session(None);
    for i in 0..20 {
        let text = match i % 5 {
            0 => format!(
                r#"{{"do":"push","link":"torso","impulse":[{},0]}}"#,
                40 + i * 3
            ),
            1 => format!(
                r#"{{"do":"push","link":"pelvis","impulse":[-{},5]}}"#,
                60 + i * 5
            ),
            2 => r#"{"do":"drag","link":"forearm_r","point":[0,-0.2],"to":[1,1.8]}"#.to_owned(),
            3 => r#"{"do":"release"}"#.to_owned(),
            _ => format!(
                r#"{{"do":"throw","shape":"crate","mass":{i},"size":0.1,"position":[2,2],"velocity":[-4,1]}}"#
            ),
        };
        ask(&mut session, &text).unwrap();
        pass(&mut session, 3.0);
    }
    assert_eq!(session.step(), 60_000);
    let digest = session.simulation().digest();
    for _ in 0..2 {
        assert_eq!(session.replay().recording().unwrap().digest(), digest);
    }
}

#[test]
fn every_step_can_be_gone_back_to_and_time_goes_on_from_there_alike() {
    let mut session = busy();
    let (end, digest) = (session.step(), session.simulation().digest());
    let events = session.events().len();
    for step in [0, 1, 499, 3210, 250, end - 1, 5777] {
        ask(&mut session, &format!(r#"{{"do":"seek","step":{step}}}"#)).unwrap();
        assert_eq!((session.step(), session.is_past()), (step, true));
        assert_eq!(frame(&session)["n"], step);
    }
    ask(&mut session, r#"{"do":"play"}"#).unwrap();
    while session.step() < end {
        session.advance((end - session.step()).min(50) as f64 * 1e-3 + 1e-9);
    }
    assert_eq!(session.simulation().digest(), digest, "replayed");
    assert_eq!(session.events().len(), events, "nothing is told twice");
}

#[test]
fn who_starts_here_forgets_what_came_later() {
    let mut session = busy();
    ask(&mut session, r#"{"do":"seek","step":2000}"#).unwrap();
    ask(&mut session, r#"{"do":"branch"}"#).unwrap();
    assert!(!session.is_past());
    assert!(session.events().iter().all(|e| e.time < 2.0 + 1e-9));
    ask(&mut session, r#"{"do":"play"}"#).unwrap();
    pass(&mut session, 1.0);
    ask(&mut session, r#"{"do":"seek","step":1000}"#).unwrap();
    // A push in the past starts there, too.
    ask(
        &mut session,
        r#"{"do":"push","link":"torso","impulse":[60,0]}"#,
    )
    .unwrap();
    assert!(!session.is_past());
    ask(&mut session, r#"{"do":"play"}"#).unwrap();
    pass(&mut session, 2.0);
    let recording = session.replay().recording().unwrap();
    assert_eq!(recording.digest(), session.simulation().digest());
}

#[test]
fn steps_speed_and_pause_are_obeyed() {
    let mut session = session(None);
    ask(&mut session, r#"{"do":"speed","factor":0.5}"#).unwrap();
    pass(&mut session, 1.0);
    assert_eq!(session.step(), 500);
    ask(&mut session, r#"{"do":"pause"}"#).unwrap();
    pass(&mut session, 1.0);
    assert_eq!(session.step(), 500);
    ask(&mut session, r#"{"do":"step","steps":7}"#).unwrap();
    assert_eq!(session.step(), 507);
    ask(&mut session, r#"{"do":"reset"}"#).unwrap();
    assert_eq!((session.step(), session.is_paused()), (0, true));
}

#[test]
fn frames_are_small_and_tell_the_state() {
    let mut session = session(None);
    let mut longest = 0;
    for i in 0..600 {
        if i == 60 {
            ask(
                &mut session,
                r#"{"do":"push","link":"torso","impulse":[-150,0]}"#,
            )
            .unwrap();
        }
        session.advance(1.0 / 60.0);
        longest = longest.max(session.frame(&View::default()).len());
    }
    assert!(longest <= 2048, "{longest} bytes");
    let frame = frame(&session);
    let character = &frame["c"][0];
    assert_eq!(character["posture"], "standing");
    assert_eq!(character["l"].as_array().unwrap().len(), 3 * 13);
    let pool = session.simulation().actors()[0].supervisor.controllers();
    assert_eq!(character["bids"].as_array().unwrap().len(), pool.count());
    assert!(!character["touch"].as_array().unwrap().is_empty());
}

#[test]
fn clauses_of_a_contract_are_told_to_who_inspects_it() {
    let session = &mut session(None);
    let mut view = View::default();
    let hello: Value = serde_json::from_str(&session.hello(true)).unwrap();
    let pool = hello["characters"][0]["controllers"].as_array().unwrap();
    let fall = pool.iter().position(|c| c["name"] == "fall").unwrap();
    let inspect = format!(r#"{{"do":"inspect","controller":{fall}}}"#);
    session
        .ask(&mut view, Request::parse(&inspect).unwrap())
        .unwrap();
    let watch = r#"{"do":"watch","features":["com_height","angle.knee_r"]}"#;
    session
        .ask(&mut view, Request::parse(watch).unwrap())
        .unwrap();
    let frame: Value = serde_json::from_str(&session.frame(&view)).unwrap();
    assert_eq!(frame["inspect"]["pre"][0][0], 0, "it refuses");
    assert!(frame["watch"][0].as_f64().unwrap() > 0.9);
    let bid = &frame["c"][0]["bids"][fall];
    assert_eq!(bid[0], 0.0);
    assert!(bid[1].as_i64().unwrap() >= 0, "{bid}");
}

#[test]
fn what_cannot_be_done_is_refused_and_changes_nothing() {
    let mut session = session(None);
    pass(&mut session, 0.1);
    for (text, why) in [
        (r#"{"do":"push","link":"tosro","impulse":[1,0]}"#, "torso"),
        (
            r#"{"do":"push","character":3,"link":"torso","impulse":[1,0]}"#,
            "character is 3",
        ),
        (
            r#"{"do":"drag","prop":"box","point":[0,0],"to":[0,0]}"#,
            "box",
        ),
        (
            r#"{"do":"drag","point":[0,0],"to":[0,0]}"#,
            "a link or a prop",
        ),
        (r#"{"do":"command","text":"dance"}"#, "dance"),
        (r#"{"do":"set","name":"colour","value":1}"#, "colour"),
        (
            r#"{"do":"set","name":"gravity","value":1000}"#,
            "gravity is 1000",
        ),
        (
            r#"{"do":"load","scenario":"/etc/passwd"}"#,
            "unknown scenario",
        ),
        (
            r#"{"do":"load","character":"/etc/passwd"}"#,
            "'/etc/passwd'",
        ),
        (r#"{"do":"watch","features":["x"]}"#, "'x'"),
        (
            r#"{"do":"open","name":"x.ron","text":"(name: \"x\", duration: 1, characters: [(character: \"/etc/passwd\")])"}"#,
            "x.ron:1:",
        ),
        (
            r#"{"do":"open","name":"x.ron","text":"(name: 3)"}"#,
            "another file",
        ),
    ] {
        let told = ask(&mut session, text).unwrap_err().to_string();
        assert!(told.contains(why), "{text}: {told}");
    }
    assert_eq!((session.step(), session.history().inputs()), (100, 0));
}

#[test]
fn scenes_and_files_are_opened() {
    let mut session = session(None);
    ask(&mut session, r#"{"do":"load","scenario":"clips/catch"}"#).unwrap();
    let hello: Value = serde_json::from_str(&session.hello(true)).unwrap();
    assert_eq!(hello["props"][0]["name"], "ball");
    ask(&mut session, r#"{"do":"set","name":"mass","value":9}"#).unwrap();
    assert_eq!(session.step(), 0, "it begins anew");
    let nod = include_str!("../../examples/mine/nod.ron");
    let open = serde_json::json!({"do": "open", "name": "nod.ron", "text": nod});
    ask(&mut session, &open.to_string()).unwrap();
    ask(&mut session, r#"{"do":"command","text":"nod"}"#).unwrap();
    ask(&mut session, r#"{"do":"load"}"#).unwrap();
    let lion = include_str!("../../framework/characters/lion.ron");
    let open = serde_json::json!({"do": "open", "name": "lion.ron", "text": lion});
    ask(&mut session, &open.to_string()).unwrap();
    let hello: Value = serde_json::from_str(&session.hello(true)).unwrap();
    assert_eq!(hello["characters"][0]["name"], "lion");
}

#[test]
fn a_long_run_keeps_little() {
    let mut session = session(None);
    for i in 0..90 {
        if i % 9 == 0 {
            ask(
                &mut session,
                r#"{"do":"push","link":"torso","impulse":[-60,0]}"#,
            )
            .unwrap();
        }
        pass(&mut session, 1.0);
    }
    assert!(
        session.history().snapshots() <= 250,
        "{}",
        session.history().snapshots()
    );
    ask(&mut session, r#"{"do":"seek","step":7123}"#).unwrap();
    assert_eq!(session.step(), 7123);
}

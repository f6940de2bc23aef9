//! The playground in Chromium: the folder that web/build.sh made, whose name is in `PLAYGROUND`.
//!
//! `tests/playground.sh` builds it and runs these tests, which are left out otherwise.
#![allow(clippy::unwrap_used)]

mod browser;
#[path = "../common/chromium.rs"]
mod chromium;
mod site;

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use browser::Browser;
use site::{BARE, BROKEN, serve};

/// What a playground must be able to do: twice real time.
const LEAST_STEPS_A_SECOND: f64 = 2000.0;

/// The folder, relative to that of the package.
fn dist() -> PathBuf {
    let folder =
        std::env::var_os("PLAYGROUND").expect("PLAYGROUND names a folder: see tests/playground.sh");
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

fn page(below: &str) -> Browser {
    Browser::open(&(serve(dist()) + below))
}

/// A worker of the test's own beside the page's: `say` to it, `digest` and `save` answer.
const WORKER: &str = r#"
    const worker = new Worker("worker.js", {type: "module"});
    const answers = [];
    const say = (message) => worker.postMessage(JSON.stringify(message));
    const answer = (is) => new Promise((heard) => answers.push({is, heard}));
    const refused = [];
    worker.onmessage = ({data}) => {
        worker.postMessage(null);
        const message = typeof data === "string" ? JSON.parse(data) : data;
        if (message.is === "told") refused.push(message.text);
        const place = answers.findIndex((one) => one.is === message.is);
        if (place >= 0) answers.splice(place, 1)[0].heard(message);
    };
    const digest = async () => { say({do: "digest"}); return (await answer("digest")).text; };
    const save = async (name) => { say({do: "save", name}); return await answer("saved"); };
    const steps = (many) => {
        for (; many > 0; many -= 1000) say({do: "step", steps: Math.min(many, 1000)});
    };
    const text = (saved) => saved.error ?? new TextDecoder().decode(saved.bytes);
    say({do: "pause"});
    say({do: "reset"});
"#;

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn the_page_lives_and_a_push_makes_the_character_step() {
    let page = page("");
    page.until("window.aplomb?.frame?.n > 200");
    assert_eq!(page.run("return aplomb.hello.native"), false);
    let before = page.run("return aplomb.frame.c[0].l");
    page.run(
        "const strength = document.getElementById('strength'); strength.value = 65;
         strength.dispatchEvent(new Event('input'));
         document.querySelector('[data-tool=push]').click();
         document.getElementById('push-right').click();",
    );
    page.until("aplomb.events.some((one) => one.kind === 'push')");
    page.until("aplomb.events.some((one) => one.kind === 'switch' && one.role === 'step')");
    page.until("aplomb.events.some((one) => one.kind === 'switch' && one.role === 'balance' && one.n > 500)");
    let after = page.run("return aplomb.frame.c[0].l");
    // (x, y, angle) of the pelvis: it has gone on by a step.
    let moved = after[0].as_f64().unwrap() - before[0].as_f64().unwrap();
    assert!(moved > 0.1, "moved by {moved} m");
    page.until("aplomb.frame.c[0].standing");
    for (name, begins) in [
        ("session.ron", "// What was done"),
        ("session.csv", "time,"),
        ("session.trajectory", "APLOMB-T"),
    ] {
        let saved = page.run(&format!(
            "return new Promise((good) => {{
                 aplomb.state.on('saved', (saved) => saved.name === '{name}' && good(saved.error ?? new TextDecoder('latin1').decode(saved.bytes.slice(0, 40))));
                 aplomb.state.send({{do: 'save', name: '{name}'}});
             }})"
        ));
        assert!(
            saved.as_str().unwrap().starts_with(begins),
            "{name}: {saved}"
        );
    }
    assert_eq!(page.console(), [""; 0]);
}

/// Does something in a session of its own and gives what it came to: its digest, its scenario, its film.
fn done(what: &str) -> Value {
    page("").run(&format!(
        r#"{WORKER}
        {what}
        return (async () => ({{
            digest: await digest(), scenario: text(await save("session.ron")),
            gif: text(await save("session.gif")), refused,
        }}))();"#
    ))
}

/// What the program says of a scenario that a session saved.
fn native(scenario: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("session.ron");
    std::fs::write(&file, scenario).unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_aplomb"))
        .arg("run")
        .arg(&file)
        .arg("--json")
        .output()
        .unwrap();
    serde_json::from_slice(&run.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&run.stderr)))
}

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn what_was_done_has_the_same_digest_as_in_the_program() {
    let done = done(
        r#"steps(500);
        say({do: "push", link: "torso", impulse: [60, 0]});
        steps(1200);
        say({do: "throw", shape: "ball", mass: 3, size: 0.1, position: [3, 1], velocity: [-5, 2]});
        steps(600);
        say({do: "set", name: "friction", value: 0.7});
        say({do: "drag", link: "torso", point: [0, 0.2], to: [0.4, 1.9]});
        steps(400);
        say({do: "release"});
        steps(700);
        say({do: "push", link: "torso", impulse: [-150, 10]});
        steps(6000);
        say({do: "command", text: "bow"});
        steps(2600);"#,
    );
    let text = |name: &str| done[name].as_str().unwrap();
    assert!(text("gif").contains("session.csv"), "{}", text("gif"));
    println!(
        "{} after 12,000 steps; refused: {}",
        text("digest"),
        done["refused"]
    );
    assert_eq!(
        done["digest"],
        native(text("scenario"))["digest"],
        "{}",
        text("scenario")
    );
}

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn a_minute_with_twenty_inputs_has_the_same_digest_as_in_the_program() {
    let done = done(
        r#"for (let i = 0; i < 20; i++) {
            say([
                {do: "push", link: "torso", impulse: [40 + i * 3, 0]},
                {do: "push", link: "pelvis", impulse: [-60 - i * 5, 5]},
                {do: "drag", link: "forearm_r", point: [0, -0.2], to: [1, 1.8]},
                {do: "release"},
                {do: "throw", shape: "crate", mass: i, size: 0.1, position: [2, 2], velocity: [-4, 1]},
            ][i % 5]);
            steps(3000);
        }"#,
    );
    assert_eq!(done["refused"], serde_json::json!([]));
    let scenario = done["scenario"].as_str().unwrap();
    let native = native(scenario);
    println!("{} after a minute", done["digest"]);
    assert_eq!(native["duration"], 60.0);
    assert_eq!(done["digest"], native["digest"], "{scenario}");
}

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn it_is_fast_enough() {
    let page = page("");
    let took = page.run(&format!(
        r#"{WORKER}
        // The page's own session would take half of the computer.
        aplomb.state.send({{do: "pause"}});
        steps(1000);
        return (async () => {{
            await digest();
            const begun = performance.now();
            steps(10000);
            await digest();
            return performance.now() - begun;
        }})();"#
    ));
    let pace = 1e4 / (took.as_f64().unwrap() / 1e3);
    println!("{pace:.0} steps a second in the browser");
    assert!(pace >= LEAST_STEPS_A_SECOND);
}

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn a_panic_is_told() {
    let page = page(BROKEN);
    page.until("document.getElementById('told').textContent.includes('capacity overflow')");
    page.until("document.getElementById('told').textContent.includes('Load the page again')");
}

#[test]
#[ignore = "tests/playground.sh builds what it needs"]
fn a_missing_file_is_told() {
    let page = page(BARE);
    page.until(
        "document.getElementById('told').textContent.includes('aplomb.wasm: the server says 404')",
    );
}

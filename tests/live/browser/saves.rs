//! What is taken away: the scenario of what was done, its recording, a picture of a stretch.

use aplomb::framework::run::Trajectory;
use serde_json::Value;

use super::standing;
use crate::program::{aplomb, until};

#[test]
fn what_was_done_is_saved_and_runs_again_alike() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.key('\u{E012}'); // left arrow
    page.until("a push", "aplomb.events.some(one => one.kind === 'push')");
    let pushed = page.number("aplomb.frame.n");
    page.until("some time", &format!("aplomb.frame.n > {pushed} + 600"));
    page.click("#play");
    page.until("a pause", "aplomb.frame.paused");
    page.click("#tab-save");
    page.click("#save-scenario");
    let folder = page.driver.downloads();
    let scenario = until("session.ron", || {
        Some(folder.join("session.ron")).filter(|p| p.is_file())
    });
    page.click("#save-recording");
    let recording = until("session.trajectory", || {
        Some(folder.join("session.trajectory")).filter(|p| p.is_file())
    });
    let steps = page.number("aplomb.frame.end");
    let recording = Trajectory::read(&recording).unwrap();
    assert_eq!(recording.len() as f64, steps);
    let output = aplomb()
        .args(["run", "--json"])
        .arg(&scenario)
        .output()
        .unwrap();
    let again: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(again["digest"], recording.digest());
}

#[test]
fn a_stretch_is_served_as_an_animation_and_a_link_opens_the_same() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until("some time", "aplomb.frame.n > 400");
    let head = page.driver.wait(|c| {
        c.execute_async(
            "const done = arguments[0]; \
             fetch('save/session.gif?from=100&to=300').then(async answer => { \
               const bytes = new Uint8Array(await answer.arrayBuffer()); \
               done([answer.status, answer.headers.get('content-type'), String.fromCharCode(...bytes.slice(0, 6)), bytes.length]); \
             }, error => done(String(error)))",
            Vec::new(),
        )
    });
    let head = head.unwrap();
    assert_eq!(
        (&head[0], &head[1], &head[2]),
        (&200.into(), &"image/gif".into(), &"GIF89a".into())
    );
    assert!(head[3].as_u64().unwrap() > 2000, "{head}");
    page.click("#play");
    page.until("a pause", "aplomb.frame.paused");
    let end = page.number("aplomb.frame.end");
    page.click("#tab-save");
    page.click("#save-link");
    let link = page.until("a link", "document.getElementById('link-text').value.includes('#s=') && document.getElementById('link-text').value");
    page.click("#reset");
    page.until("the beginning", "aplomb.frame.end < 400");
    page.driver.wait(|c| c.goto("about:blank")).unwrap();
    page.go(link.as_str().unwrap());
    page.until(
        "the link's scenario",
        &format!("Math.abs(aplomb.hello.scenario.duration - {end} * 0.001) < 1e-6"),
    );
}

#[test]
fn a_long_stretch_is_refused_as_an_animation_and_told_before() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("#tab-save");
    page.until(
        "the bound",
        "document.getElementById('save-stretch').textContent.includes('at most 60 s')",
    );
    let steps = "for (let k = 0; k < 62; k++) aplomb.state.send({do: 'step', steps: 1000})";
    page.get(&format!("(() => {{ {steps} }})()"));
    page.until("a minute", "aplomb.frame.end > 61000");
    page.until(
        "that it is too long",
        "document.getElementById('save-stretch').dataset.long === 'true'",
    );
    page.click("#save-gif");
    page.until(
        "the refusal",
        "/session.gif would last 6.* s; accepted: at most 60 s/.test(document.getElementById('told').textContent)",
    );
    page.until(
        "no note of work",
        "!document.querySelector('.told[data-stays=work]')",
    );
}

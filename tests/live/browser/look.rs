//! What is seen: the page itself, light and dark, small and large, in one browser and in two.

use super::driver::Screen;
use super::page::Page;
use super::standing;
use crate::program::{Program, until};

#[test]
fn the_page_loads_without_a_complaint_and_shows_who_is_there() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until("half a second", "aplomb.frame.n >= 500");
    page.until(
        "words",
        "document.getElementById('time').value !== '0.000 s'",
    );
    assert!(page.text("#scene-name").contains("humanoid"));
    assert!(page.text("#now").contains("balance · standing"));
    assert_eq!(page.text("#banner"), "");
    for tab in ["why", "plots", "scene", "save", "mind"] {
        page.click(&format!("#tab-{tab}"));
        page.until(
            "its panel",
            &format!("!document.getElementById('panel-{tab}').hidden"),
        );
    }
    assert_eq!(page.console(), Vec::<String>::new());
}

#[test]
fn a_key_pushes_and_the_character_moves() {
    let Some((_program, page)) = standing() else {
        return;
    };
    let before = page.number("aplomb.frame.c[0].com[0]");
    page.key('\u{E014}'); // right arrow
    page.until("a push", "aplomb.events.some(one => one.kind === 'push')");
    let moved = format!("aplomb.frame.c[0].com[0] > {before} + 0.03");
    page.until("another pose", &moved);
}

#[test]
fn what_is_dark_is_dark_and_the_button_turns_it() {
    let Some((_program, page)) = standing() else {
        return;
    };
    let brightness = "(getComputedStyle(document.body).backgroundColor.match(/\\d+/g) ?? []) \
                      .slice(0, 3).reduce((sum, v) => sum + Number(v), 0)";
    let sky = "(() => { const c = document.getElementById('stage'); \
               const [r, g, b] = c.getContext('2d').getImageData(5, 5, 1, 1).data; return r + g + b; })()";
    page.prefer("light");
    page.until("a light page", &format!("{brightness} > 500"));
    page.until("a light stage", &format!("{sky} > 400"));
    page.prefer("dark");
    page.until("a dark page", &format!("{brightness} < 200"));
    page.until("a dark stage", &format!("{sky} < 300"));
    page.click("#theme");
    page.until("light again", &format!("{brightness} > 500"));
}

#[test]
fn a_phone_shows_everything_without_scrolling_sideways() {
    let program = Program::start(&["story"]);
    let Some(page) = Page::open_on(Screen::Phone, &program) else {
        return;
    };
    assert_eq!(page.number("innerWidth"), 390.0);
    for tab in ["mind", "why", "plots", "scene", "save"] {
        page.until("the tab", &format!("document.getElementById('tab-{tab}')"));
        if page.get(&format!("document.getElementById('panel-{tab}').hidden")) == true {
            page.click(&format!("#tab-{tab}"));
        }
        let wide = page.number("document.documentElement.scrollWidth");
        assert!(wide <= 390.0, "{tab}: {wide} px");
        // Only the strip of commands scrolls by itself.
        let outside = page.get(
            "[...document.querySelectorAll('button, input, select')].filter(one => { \
               const box = one.getBoundingClientRect(); \
               return box.width > 1 && !one.closest('.strip') && (box.right > 390.5 || box.left < -0.5); \
             }).map(one => one.id || one.textContent)",
        );
        assert_eq!(outside.as_array().unwrap().len(), 0, "{tab}: {outside}");
    }
    page.click("[data-tool=push]");
    page.until("options", "!document.getElementById('tool-options').hidden");
    let right =
        page.number("document.getElementById('tool-options').getBoundingClientRect().right");
    assert!(right <= 390.0, "{right}");
}

#[test]
fn two_browsers_see_the_same_session() {
    let Some((program, one)) = standing() else {
        return;
    };
    let Some(other) = Page::open(&program) else {
        return;
    };
    one.key('\u{E014}');
    other.until(
        "the other's push",
        "aplomb.events.some(one => one.kind === 'push')",
    );
    other.click("#play");
    one.until("the other's pause", "aplomb.frame.paused");
    let step = one.number("aplomb.frame.n");
    other.until("the same step", &format!("aplomb.frame.n === {step}"));
    assert_eq!(one.get("aplomb.frame.c"), other.get("aplomb.frame.c"));
}

#[test]
fn the_page_finds_the_program_again_when_it_was_started_anew() {
    let Some((mut program, page)) = standing() else {
        return;
    };
    page.until("some time", "aplomb.frame.n > 300");
    program.kill();
    page.until("the banner", "!document.getElementById('banner').hidden");
    let port = program.port();
    let _again = Program::start_at(port, &["clips/catch"]);
    page.until("no banner", "document.getElementById('banner').hidden");
    page.until(
        "the new scene",
        "aplomb.hello.scenario.name === 'clips/catch' && aplomb.frame.n > 0",
    );
    let catch = until("its name", || {
        Some(page.text("#scene-name")).filter(|t| t.contains("catch"))
    });
    assert!(catch.contains("humanoid"));
}

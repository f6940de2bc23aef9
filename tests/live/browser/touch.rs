//! The pointer on the stage: pushes drawn as arrows, drags with a spring, things that are thrown.

use super::page::Page;
use super::standing;
use crate::program::{Program, scenario};

#[test]
fn a_push_drawn_as_an_arrow_makes_it_step() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("[data-tool=push]");
    assert_eq!(
        page.get("document.querySelector('[data-tool=push]').ariaPressed"),
        "true"
    );
    let [x, y] = page.link("head");
    page.press(page.at(x, y));
    page.pull(page.at(x - 0.4, y));
    page.let_go();
    page.until(
        "the push",
        "aplomb.events.some(one => one.kind === 'push' && /^head -[345]\\d/.test(one.text))",
    );
    page.until(
        "a step",
        "aplomb.events.some(one => one.kind === 'switch' && one.to === 'protective_step')",
    );
}

#[test]
fn a_drag_lifts_the_torso_and_lets_go() {
    let Some((_program, page)) = standing() else {
        return;
    };
    let high = page.number("aplomb.frame.c[0].com[1]");
    let [x, y] = page.link("torso");
    page.press(page.at(x, y));
    page.until("a spring", "aplomb.frame.drag !== null");
    page.pull(page.at(x, y + 0.5));
    page.until(
        "a lift by a force",
        &format!(
            "aplomb.frame.c[0].com[1] > {high} + 0.1 && Math.hypot(...aplomb.frame.drag.force) > 50"
        ),
    );
    page.let_go();
    page.until("nothing that pulls", "aplomb.frame.drag === null");
}

#[test]
fn a_drag_may_begin_while_time_stands_still() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("#play");
    page.until("a pause", "aplomb.frame.paused");
    let [x, y] = page.link("head");
    let before = page.number("aplomb.frame.n");
    page.press(page.at(x, y));
    page.pull(page.at(x + 0.4, y + 0.1));
    page.until("a spring", "aplomb.frame.drag?.to[0] > 0.2");
    assert_eq!(page.number("aplomb.frame.n"), before);
    page.key(' ');
    page.until(
        "a pull",
        "!aplomb.frame.paused && aplomb.frame.drag.force[0] > 20",
    );
    page.let_go();
    page.until("nothing that pulls", "aplomb.frame.drag === null");
}

#[test]
fn a_ball_that_is_thrown_hits_and_a_crate_can_be_dragged() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("[data-tool=crate]");
    page.press(page.at(-0.9, 0.5));
    page.let_go();
    page.until(
        "a crate at rest",
        "aplomb.frame.p.length === 3 && aplomb.frame.p[1] < 0.25",
    );
    page.click("[data-tool=ball]");
    page.press(page.at(1.1, 1.2));
    page.pull(page.at(0.4, 1.3));
    page.let_go();
    page.until(
        "a ball",
        "aplomb.frame.p.length === 6 && aplomb.hello && aplomb.state.props.length === 2",
    );
    page.click("[data-tool=drag]");
    // Not in its middle: all of a crate can be held.
    let [x, y] = [0, 1].map(|k| page.number(&format!("aplomb.frame.p[{k}]")));
    page.press(page.at(x - 0.1, y + 0.1));
    page.pull(page.at(x - 0.2, y + 0.6));
    page.until("a crate in the air", "aplomb.frame.p[1] > 0.35");
    page.let_go();
    assert_eq!(page.console(), Vec::<String>::new());
}

#[test]
fn of_two_characters_the_touched_one_is_chosen_and_pushed() {
    let program = Program::start(&[&scenario("two.ron")]);
    let Some(page) = Page::open(&program) else {
        return;
    };
    page.until(
        "both",
        "aplomb.frame.c.length === 2 && aplomb.frame.n > 1500",
    );
    let [x, y] = [0, 1].map(|k| page.number(&format!("aplomb.frame.c[1].com[{k}]")));
    page.click("[data-tool=push]");
    page.press(page.at(x, y + 0.2));
    page.pull(page.at(x + 0.3, y + 0.2));
    page.let_go();
    page.until(
        "the other's push",
        "aplomb.events.some(one => one.kind === 'push' && one.character === 1 && one.n > 1500)",
    );
    let chosen = "document.querySelector('#now [data-chosen=true]')?.dataset.character";
    page.until("the other is chosen", &format!("{chosen} === '1'"));
    page.click("#now [data-character='0']");
    page.until("the first is chosen", &format!("{chosen} === '0'"));
}

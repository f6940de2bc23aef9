//! Time: pause, steps, back and on from there; and what is commanded.

use super::standing;

#[test]
fn time_stands_goes_by_steps_and_back_and_on_from_there() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until("some time", "aplomb.frame.n > 500");
    page.click("#play");
    page.until(
        "a pause",
        "aplomb.frame.paused && document.getElementById('play').dataset.paused === 'true'",
    );
    let end = page.number("aplomb.frame.n");
    page.click("#step");
    page.until("one step", &format!("aplomb.frame.n === {end} + 1"));
    page.click("#back");
    page.until(
        "one step back",
        &format!("aplomb.frame.n === {end} && aplomb.frame.past"),
    );
    let x = page.number("aplomb.timelineX(200)");
    let y = page.number(
        "(box => box.top + box.height / 2)(document.getElementById('timeline').getBoundingClientRect())",
    );
    page.press([x, y]);
    page.let_go();
    page.until(
        "the past",
        "aplomb.frame.past && Math.abs(aplomb.frame.n - 200) < 40",
    );
    page.until(
        "words",
        "document.getElementById('step-number').value.includes(' of ')",
    );
    page.click("#start-here");
    page.until("no future", "!aplomb.frame.past && aplomb.frame.end < 240");
    page.click("#play");
    page.until("time that goes on", "aplomb.frame.n > 300");
    page.click("#reset");
    page.until("the beginning", "aplomb.frame.n < 300");
}

#[test]
fn a_command_is_typed_and_obeyed() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.type_in("#command", "bow depth=0.5");
    page.until(
        "the command",
        "aplomb.events.some(one => one.kind === 'command' && one.text.includes('bow depth=0.5'))",
    );
    page.until(
        "the bow",
        "aplomb.events.some(one => one.kind === 'switch' && one.to === 'bow')",
    );
    page.until(
        "its name",
        "document.getElementById('now').textContent.startsWith('bow')",
    );
}

#[test]
fn a_refused_command_tells_its_clause_and_the_value() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.type_in("#command", "stand_up");
    page.until(
        "the refusal",
        "aplomb.events.some(one => one.kind === 'refused')",
    );
    page.until(
        "clause and value",
        "/stand_up.*com_height ≤ 0.95 \\(is \\d/.test(document.getElementById('told').textContent)",
    );
    let field = "document.getElementById('command').value";
    page.until("what is to be mended", &format!("{field} === 'stand_up'"));
    page.type_in("#command", "bwo");
    page.until(
        "the nearest name before the others",
        "/'bwo' \\(did you mean 'bow'\\?\\); accepted/.test(document.getElementById('told').textContent)",
    );
    page.type_in("#command", "dance");
    page.until(
        "what is accepted",
        "/dance.*bow/s.test(document.getElementById('told').textContent)",
    );
}

#[test]
fn seconds_go_by_and_the_timeline_follows_or_shows_all() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("#play");
    page.until("a pause", "aplomb.frame.paused");
    let begun = page.number("aplomb.frame.n");
    page.click("#on-second");
    page.until("a second on", &format!("aplomb.frame.n === {begun} + 1000"));
    page.key('<');
    page.until("a second back", &format!("aplomb.frame.n === {begun}"));
    let shown = "!document.getElementById('timeline-now').hidden";
    assert_eq!(page.get(shown), false);
    page.get(
        "document.getElementById('timeline').dispatchEvent(new WheelEvent('wheel', \
         {deltaY: -2000, clientX: aplomb.timelineX(0), cancelable: true}))",
    );
    page.until("a way back", shown);
    page.click("#timeline-now");
    page.click("#play");
    let edge = "document.getElementById('timeline').getBoundingClientRect().right";
    page.until(
        "the newest step in sight",
        &format!("aplomb.frame.n > {begun} + 2500 && aplomb.timelineX(aplomb.frame.end) < {edge}"),
    );
    page.click("#timeline-whole");
    page.until("the whole run", &format!("!({shown})"));
}

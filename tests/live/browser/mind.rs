//! What goes on in it: bids, clauses of contracts, why it switched.

use super::standing;

#[test]
fn clauses_of_a_contract_are_green_or_red() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until(
        "a row that bids",
        "document.querySelector('[data-controller=stance]').dataset.state === 'bids'",
    );
    assert_eq!(
        page.get("document.querySelector('[data-controller=balance]').dataset.state"),
        "active"
    );
    page.click("#mind [data-controller=rise_supine]");
    page.until(
        "a clause that does not hold and one that does",
        "document.querySelector('#contract [data-part=pre][data-holds=false]') && \
         document.querySelector('#contract [data-part=pre][data-holds=true]')",
    );
    let colour = |holds: bool| {
        page.get(&format!(
            "getComputedStyle(document.querySelector('#contract [data-part=pre][data-holds={holds}] .sign')).color"
        ))
    };
    assert_ne!(colour(true), colour(false));
    let refusal = page.text("#mind [data-controller=rise_supine] .why");
    assert!(refusal.contains("supine"), "{refusal}");
}

#[test]
fn it_explains_the_last_switch() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until("some time", "aplomb.frame.n > 100");
    page.type_in("#command", "bow");
    page.until(
        "the bow",
        "aplomb.events.some(one => one.kind === 'switch' && one.to === 'bow')",
    );
    page.click("#explain");
    page.until(
        "a pause at the switch",
        "aplomb.frame.paused && aplomb.frame.past",
    );
    page.until(
        "its title",
        "document.getElementById('why-title').textContent === 'balance → bow'",
    );
    let bids = page.number("document.querySelectorAll('#why-list [data-name]').length");
    assert!(bids >= 5.0, "{bids}");
    let refusals = page.text("#why-list [data-state=refuses]");
    assert!(refusals.contains("is "), "a value: {refusals}");
    page.click("#why-before");
    page.until(
        "the one before",
        "document.getElementById('why-title').textContent === '→ balance'",
    );
}

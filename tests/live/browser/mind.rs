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
fn every_contract_of_the_pool_opens_without_a_complaint() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.until(
        "the rows",
        "document.querySelector('#mind [data-controller]')",
    );
    let names = page.get("aplomb.hello.characters[0].controllers.map(one => one.name)");
    let names = names.as_array().unwrap();
    assert!(names.len() > 15, "{names:?}");
    for (place, name) in names.iter().enumerate() {
        let name = name.as_str().unwrap();
        let row = format!("document.querySelector('#mind [data-controller={name}]')");
        page.get(&format!("{row}.click()"));
        page.until(
            name,
            &format!("aplomb.frame.inspect?.controller === {place}"),
        );
        // Every sign is filled in, the last sentence too.
        let signs = "[...document.querySelectorAll('#contract .sign')]";
        page.until(
            name,
            &format!("{signs}.every(one => one.textContent !== '·')"),
        );
        let patience =
            "document.querySelector('#contract > .sentence:last-of-type')?.textContent ?? ''";
        page.until(name, &format!("!/ s$/.test({patience})"));
        if name == "rise_kneeling" {
            let clause = page.text("#contract [data-part=pre][data-holds=false]");
            assert_eq!(clause, "✗posture is kneelingis standing");
        }
    }
    let row = "document.querySelector('#mind [data-controller=balance]')";
    page.get(&format!("{row}.click()"));
    assert_eq!(page.console(), Vec::<String>::new());
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

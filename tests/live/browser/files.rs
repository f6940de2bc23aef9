//! Files that are edited while it runs, and scenes that are chosen.

use std::path::Path;

use super::page::Page;
use super::standing;
use crate::program::Program;

#[test]
fn a_file_that_is_edited_takes_effect_and_a_mistake_is_told_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let mine = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/mine");
    for name in ["mine.ron", "nod.ron"] {
        std::fs::copy(mine.join(name), folder.path().join(name)).unwrap();
    }
    let [repertoire, nod] = ["mine.ron", "nod.ron"].map(|name| folder.path().join(name));
    let program = Program::start(&["--repertoire", repertoire.to_str().unwrap()]);
    let Some(page) = Page::open(&program) else {
        return;
    };
    let text = std::fs::read_to_string(&nod).unwrap();
    assert_eq!(patience(&page), 5.0);
    let begun = page.until("some time", "aplomb.frame.n > 200 && aplomb.frame.n");

    std::fs::write(&nod, text.replace("patience: 5.0", "patience: 4.0")).unwrap();
    page.until("the new patience", "aplomb.hello.characters[0].controllers.some(one => one.name === 'nod' && one.patience === 4)");
    page.until(
        "that it is told",
        "document.getElementById('told').textContent.includes('nod.ron')",
    );
    page.until("the same run", &format!("aplomb.frame.n > {begun}"));

    std::fs::write(&nod, text.replace("weight: 0,", "weight: heavy,")).unwrap();
    let told = page.until(
        "the mistake",
        "!document.getElementById('files').hidden && document.getElementById('files').textContent",
    );
    let told = told.as_str().unwrap();
    assert!(told.contains("nod.ron:7:16"), "{told}");
    assert_eq!(patience(&page), 4.0, "the old one stays in use");
    let now = page.number("aplomb.frame.n");
    page.until("time that goes on", &format!("aplomb.frame.n > {now}"));

    std::fs::write(&nod, text.replace("patience: 5.0", "patience: 3.0")).unwrap();
    page.until("no mistake", "document.getElementById('files').hidden");
    page.until("the mended file", "aplomb.hello.characters[0].controllers.some(one => one.name === 'nod' && one.patience === 3)");
    page.type_in("#command", "nod");
    page.until(
        "a nod",
        "aplomb.events.some(one => one.kind === 'switch' && one.to === 'nod')",
    );
}

fn patience(page: &Page) -> f64 {
    page.number("aplomb.hello.characters[0].controllers.find(one => one.name === 'nod').patience")
}

#[test]
fn a_shipped_scenario_is_loaded_and_its_parameters_are_set() {
    let Some((_program, page)) = standing() else {
        return;
    };
    page.click("#tab-scene");
    page.choose("#scenario", "clips/push");
    page.click("#load");
    page.until(
        "the scene",
        "aplomb.hello.scenario.name === 'clips/push' && aplomb.frame?.p.length === 12",
    );
    page.until(
        "its name",
        "document.getElementById('scene-name').textContent.includes('clips/push')",
    );
    page.until(
        "a slider",
        "document.querySelector('[data-parameter=mass] input')",
    );
    page.get(
        "(input => { input.value = '60'; input.dispatchEvent(new Event('input')); input.dispatchEvent(new Event('change')); })\
         (document.querySelector('[data-parameter=mass] input'))",
    );
    page.until(
        "the new mass",
        "aplomb.hello.scenario.parameters.find(one => one.name === 'mass').value === 60",
    );
    page.choose("#scenario", "");
    page.choose("#character", "lion");
    page.click("#load");
    page.until(
        "the lion",
        "aplomb.hello.characters[0].name === 'lion' && aplomb.frame?.n > 0",
    );
    assert_eq!(page.console(), Vec::<String>::new());
}

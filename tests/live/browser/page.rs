//! The page in a browser, as somebody uses it: clicks, keys, the pointer on the stage, what is read.

use std::time::{Duration, Instant};

use fantoccini::Locator;
use fantoccini::actions::{InputSource, MouseActions, PointerAction};
use fantoccini::key::Key;
use serde_json::{Value, json};

use super::driver::{Driver, Screen};
use crate::program::{PATIENCE, Program};

pub(super) struct Page {
    pub(super) driver: Driver,
}

impl Page {
    /// Opens the program's page on a laptop and waits for its first frames; none without a browser.
    pub(super) fn open(program: &Program) -> Option<Self> {
        Self::open_on(Screen::Laptop, program)
    }

    pub(super) fn open_on(screen: Screen, program: &Program) -> Option<Self> {
        let driver = Driver::start(screen)?;
        let page = Self { driver };
        page.go(&program.url);
        Some(page)
    }

    /// Goes to an address, and waits for frames.
    pub(super) fn go(&self, url: &str) {
        self.driver.wait(|c| c.goto(url)).unwrap();
        self.until("frames", "window.aplomb?.frame?.n >= 0");
    }

    /// The value of an expression in the page.
    pub(super) fn get(&self, expression: &str) -> Value {
        let script = format!("return ({expression});");
        let value = self.driver.wait(|c| c.execute(&script, Vec::new()));
        value.unwrap_or_else(|e| panic!("{expression}: {e}"))
    }

    pub(super) fn number(&self, expression: &str) -> f64 {
        let value = self.get(expression);
        value
            .as_f64()
            .unwrap_or_else(|| panic!("{expression} is {value}"))
    }

    pub(super) fn text(&self, css: &str) -> String {
        let text = self.get(&format!(
            "document.querySelector({css:?})?.textContent ?? ''"
        ));
        text.as_str().unwrap().to_owned()
    }

    /// Waits until an expression holds; its value.
    pub(super) fn until(&self, what: &str, expression: &str) -> Value {
        let end = Instant::now() + PATIENCE;
        let script = format!("try {{ return ({expression}) }} catch {{ return null }}");
        loop {
            let value = self
                .driver
                .wait(|c| c.execute(&script, Vec::new()))
                .unwrap();
            if value.as_bool().unwrap_or(!value.is_null()) {
                return value;
            }
            if Instant::now() > end {
                let told = self.text("#told");
                panic!(
                    "waited in vain: {what} ({expression} is {value}); told: {told}; console: {:?}",
                    self.console()
                );
            }
            std::thread::sleep(Duration::from_millis(25));
        }
    }

    /// Clicks in the middle of an element.
    pub(super) fn click(&self, css: &str) {
        let clicked = self.driver.wait(|c| async move {
            let element = c.find(Locator::Css(css)).await?;
            element.click().await
        });
        clicked.unwrap_or_else(|e| panic!("{css}: {e}"));
    }

    /// Types into a field, and confirms it.
    pub(super) fn type_in(&self, css: &str, text: &str) {
        let typed = format!("{text}{}", char::from(Key::Enter));
        let done = self.driver.wait(|c| async move {
            let element = c.find(Locator::Css(css)).await?;
            element.send_keys(&typed).await
        });
        done.unwrap_or_else(|e| panic!("{css}: {e}"));
    }

    /// Presses a key that the page listens to.
    pub(super) fn key(&self, key: char) {
        let body = Locator::Css("body");
        let done = self
            .driver
            .wait(|c| async move { c.find(body).await?.send_keys(&key.to_string()).await });
        done.unwrap();
    }

    /// Chooses in a list.
    pub(super) fn choose(&self, css: &str, value: &str) {
        let done = self.driver.wait(|c| async move {
            let list = c.find(Locator::Css(css)).await?;
            list.select_by_value(value).await
        });
        done.unwrap_or_else(|e| panic!("{css}={value}: {e}"));
    }

    /// Client pixels of a point of the world.
    pub(super) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let point = self.get(&format!("aplomb.toScreen({x}, {y})"));
        [0, 1].map(|k| point[k].as_f64().unwrap())
    }

    /// Where the middle of a link of the first character is, world, m.
    pub(super) fn link(&self, name: &str) -> [f64; 2] {
        let script = format!(
            "(() => {{ const {{links}} = aplomb.hello.characters[0]; \
             const k = links.findIndex(one => one.name === {name:?}); \
             const [x, y, a] = aplomb.frame.c[0].l.slice(3 * k, 3 * k + 3); \
             const [u, v] = links[k].com; \
             return [x + Math.cos(a) * u - Math.sin(a) * v, y + Math.sin(a) * u + Math.cos(a) * v]; }})()"
        );
        let place = self.get(&script);
        [0, 1].map(|k| place[k].as_f64().unwrap())
    }

    fn pointer(&self, actions: Vec<PointerAction>) {
        let mouse = MouseActions::new("mouse".to_owned());
        let mouse = actions.into_iter().fold(mouse, InputSource::then);
        self.driver.wait(|c| c.perform_actions(mouse)).unwrap();
    }

    /// Puts the pointer down at a place of the window.
    pub(super) fn press(&self, [x, y]: [f64; 2]) {
        self.pointer(vec![to(x, y, 0), PointerAction::Down { button: 0 }]);
    }

    /// Moves it, in some steps.
    pub(super) fn pull(&self, [x, y]: [f64; 2]) {
        self.pointer(vec![to(x, y, 120)]);
    }

    pub(super) fn let_go(&self) {
        self.pointer(vec![PointerAction::Up { button: 0 }]);
    }

    /// What was said in the console since the last call, errors and warnings.
    pub(super) fn console(&self) -> Vec<String> {
        let log = self.driver.own("se/log", &json!({"type": "browser"}));
        let entries = log.as_array().unwrap().iter();
        entries
            .filter(|e| e["level"] == "SEVERE" || e["level"] == "WARNING")
            .map(|e| e["message"].as_str().unwrap().to_owned())
            .collect()
    }

    /// Whether the browser prefers dark pages.
    pub(super) fn prefer(&self, scheme: &str) {
        let feature = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        let call = json!({"cmd": "Emulation.setEmulatedMedia", "params": {"features": feature}});
        self.driver.own("goog/cdp/execute", &call);
    }
}

fn to(x: f64, y: f64, milliseconds: u64) -> PointerAction {
    PointerAction::MoveTo {
        duration: Some(Duration::from_millis(milliseconds)),
        x: x.round(),
        y: y.round(),
    }
}

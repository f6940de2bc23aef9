//! A Chromium of its own for a test: WebDriver's few calls over plain HTTP.
//!
//! Debian's packages `chromium` and `chromium-driver`.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::chromium::FLAGS;

/// The size of the window, px.
const WINDOW: &str = "--window-size=1440,900";
/// How long something may take to become true.
const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Browser {
    chromedriver: Child,
    port: u16,
    session: String,
    _profile: TempDir,
}

impl Browser {
    /// Starts one that shows a page.
    pub(crate) fn open(address: &str) -> Self {
        let mut chromedriver = Command::new("chromedriver")
            .args(["--port=0", "--log-level=SEVERE"])
            .stdout(Stdio::piped())
            .spawn()
            .expect("chromedriver: Debian's package chromium-driver has it");
        let mut lines = BufReader::new(chromedriver.stdout.take().unwrap()).lines();
        let port = lines.by_ref().map_while(Result::ok).find_map(|line| {
            let port = line.rsplit_once("on port ")?.1;
            // It first says that it was told 0.
            port.trim_end_matches('.').parse().ok().filter(|p| *p != 0)
        });
        // It may go on writing.
        std::thread::spawn(move || lines.for_each(drop));
        let profile = tempfile::tempdir().unwrap();
        let mut browser = Self {
            chromedriver,
            port: port.expect("chromedriver says its port"),
            session: String::new(),
            _profile: profile,
        };
        let mut flags: Vec<String> = FLAGS.map(str::to_owned).to_vec();
        flags.push(WINDOW.to_owned());
        let folder = browser._profile.path().display();
        flags.push(format!("--user-data-dir={folder}"));
        let wanted = json!({
            "goog:chromeOptions": {"args": flags},
            "goog:loggingPrefs": {"browser": "ALL"},
        });
        let body = json!({"capabilities": {"alwaysMatch": wanted}});
        let begun = browser.http("POST", "/session", &body);
        browser.session = begun["sessionId"].as_str().unwrap().to_owned();
        browser.call("timeouts", &json!({"script": 300_000}));
        browser.call("url", &json!({"url": address}));
        browser
    }

    fn http(&self, method: &str, path: &str, body: &Value) -> Value {
        let answer = self.send(method, path, body);
        let answer = answer.unwrap_or_else(|e| panic!("{method} {path}: {e}"));
        let mut answer: Value = serde_json::from_slice(&answer).unwrap();
        let value = answer["value"].take();
        assert!(value["error"].is_null(), "{method} {path}: {value}");
        value
    }

    /// The body of the answer. Chromedriver leaves the connection open, whatever it is asked.
    fn send(&self, method: &str, path: &str, body: &Value) -> std::io::Result<Vec<u8>> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port))?;
        let body = body.to_string();
        write!(
            stream,
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\n\r\n{body}",
            self.port,
            body.len()
        )?;
        let mut answer = BufReader::new(stream);
        let mut length = 0;
        loop {
            let mut line = String::new();
            answer.read_line(&mut line)?;
            match line.trim_end().split_once(':') {
                Some((name, value)) if name.eq_ignore_ascii_case("content-length") => {
                    length = value.trim().parse().unwrap_or(0);
                }
                None if line.trim_end().is_empty() => break,
                _ => {}
            }
        }
        let mut body = vec![0; length];
        answer.read_exact(&mut body)?;
        Ok(body)
    }

    fn call(&self, path: &str, body: &Value) -> Value {
        self.http("POST", &format!("/session/{}/{path}", self.session), body)
    }

    /// Runs a script and gives what it returns, or what its promise becomes.
    pub(crate) fn run(&self, script: &str) -> Value {
        self.call("execute/sync", &json!({"script": script, "args": []}))
    }

    /// Waits until an expression is neither false nor nothing; gives its value.
    pub(crate) fn until(&self, expression: &str) -> Value {
        let begun = Instant::now();
        loop {
            let value = self.run(&format!("return {expression}"));
            if !matches!(value, Value::Null | Value::Bool(false)) {
                return value;
            }
            let told = || self.run("return document.getElementById('told')?.textContent");
            assert!(
                begun.elapsed() < PATIENCE,
                "never: {expression}; told: {}; console: {:?}",
                told(),
                self.console()
            );
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Errors of the page and of its workers since the last call.
    pub(crate) fn console(&self) -> Vec<String> {
        let lines = self.call("se/log", &json!({"type": "browser"}));
        let lines = lines.as_array().unwrap().iter();
        let errors = lines.filter(|line| line["level"] == "SEVERE");
        errors.map(|line| line["message"].to_string()).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let path = format!("/session/{}", self.session);
        drop(self.send("DELETE", &path, &json!({})));
        drop(self.chromedriver.kill());
        drop(self.chromedriver.wait());
    }
}

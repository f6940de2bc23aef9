//! A Chromium of its own for a test, driven through chromedriver.
//!
//! Debian's packages `chromium` and `chromium-driver`. Where they are missing the tests are left out,
//! unless `CI` is set. Calls wait for their answer, so that tests read from top to bottom and
//! everything is closed when one fails.

use std::future::Future;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Once;
use std::time::Duration;

use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tempfile::TempDir;
use tokio::runtime::Runtime;

use crate::chromium::FLAGS;
use crate::program::PATIENCE;

/// Beside those that every test needs.
const MORE_FLAGS: [&str; 3] = [
    "--disable-extensions",
    // It ends when chromedriver does.
    "--remote-debugging-pipe",
    "--force-color-profile=srgb",
];

/// The screen that a browser pretends to have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Screen {
    Laptop,
    /// Upright, with touch.
    Phone,
}

pub(super) struct Driver {
    runtime: Runtime,
    client: Option<Client>,
    session: String,
    chromedriver: Child,
    port: u16,
    folder: TempDir,
}

/// The programs, or none; says so once.
fn programs() -> Option<[PathBuf; 2]> {
    static SAID: Once = Once::new();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let find = |name: &str| {
        let places = std::env::split_paths(&path).map(|folder| folder.join(name));
        places.into_iter().find(|place| place.is_file())
    };
    let found = (find("chromium"), find("chromedriver"));
    if let (Some(chromium), Some(chromedriver)) = found {
        return Some([chromium, chromedriver]);
    }
    let why = "chromium and chromedriver are not installed";
    assert!(std::env::var_os("CI").is_none(), "{why}");
    SAID.call_once(|| {
        // Past the tests' capture of what is printed.
        drop(writeln!(
            std::io::stderr(),
            "{why}: tests in the browser are left out"
        ));
    });
    None
}

impl Driver {
    /// Starts a browser; none where there is none.
    pub(super) fn start(screen: Screen) -> Option<Self> {
        let [chromium, chromedriver] = programs()?;
        let folder = tempfile::tempdir().unwrap();
        let mut child = Command::new(chromedriver)
            .args(["--port=0", "--log-level=SEVERE"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .process_group(0)
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let port = lines.by_ref().map_while(Result::ok).find_map(|line| {
            let port = line.rsplit_once("successfully on port ")?.1;
            port.trim_end_matches('.').parse().ok()
        });
        // It may go on writing.
        std::thread::spawn(move || lines.for_each(drop));
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .unwrap();
        let mut driver = Self {
            runtime,
            client: None,
            session: String::new(),
            chromedriver: child,
            port: port.expect("chromedriver says its port"),
            folder,
        };
        driver.connect(&chromium, screen);
        Some(driver)
    }

    fn connect(&mut self, chromium: &Path, screen: Screen) {
        let profile = self.folder.path().join("profile");
        let mut flags: Vec<String> = FLAGS.map(str::to_owned).to_vec();
        flags.extend(MORE_FLAGS.map(str::to_owned));
        flags.push(format!("--user-data-dir={}", profile.display()));
        flags.push("--window-size=1200,760".to_owned());
        let mut options = json!({
            "binary": chromium,
            "args": flags,
            "prefs": {"download.default_directory": self.downloads()},
        });
        if screen == Screen::Phone {
            let metrics = json!({"width": 390, "height": 844, "pixelRatio": 2, "touch": true});
            options["mobileEmulation"] = json!({"deviceMetrics": metrics});
        }
        let capabilities = json!({
            "goog:chromeOptions": options,
            "goog:loggingPrefs": {"browser": "ALL"},
        });
        let mut builder = ClientBuilder::new(HttpConnector::new());
        builder.capabilities(capabilities.as_object().unwrap().clone());
        let address = format!("http://127.0.0.1:{}", self.port);
        let client = self
            .runtime
            .block_on(builder.connect(&address))
            .unwrap_or_else(|e| panic!("no browser: {e}"));
        let session = self.runtime.block_on(client.session_id()).unwrap();
        (self.client, self.session) = (Some(client), session.unwrap());
    }

    /// Waits for an answer of the browser.
    pub(super) fn wait<'a, F: Future>(&'a self, ask: impl FnOnce(&'a Client) -> F) -> F::Output {
        let client = self.client.as_ref().unwrap();
        let call = ask(client);
        self.runtime.block_on(call)
    }

    /// Where downloads go.
    pub(super) fn downloads(&self) -> PathBuf {
        self.folder.path().join("downloads")
    }

    /// One of chromedriver's own calls, which WebDriver knows nothing of.
    pub(super) fn own(&self, path: &str, body: &Value) -> Value {
        let (session, body) = (&self.session, body.to_string());
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        write!(
            stream,
            "POST /session/{session}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}",
            self.port,
            body.len()
        )
        .unwrap();
        let mut answer = BufReader::new(stream);
        let (mut length, mut line) = (0, String::new());
        while answer.read_line(&mut line).unwrap() > 2 {
            let lower = line.to_ascii_lowercase();
            if let Some(found) = lower.strip_prefix("content-length:") {
                length = found.trim().parse().unwrap();
            }
            line.clear();
        }
        let mut body = vec![0; length];
        answer.read_exact(&mut body).unwrap();
        let mut answer: Value = serde_json::from_slice(&body).unwrap();
        answer["value"].take()
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        if let Some(client) = self.client.take() {
            let close =
                async { tokio::time::timeout(Duration::from_secs(5), client.close()).await };
            drop(self.runtime.block_on(close));
        }
        // Chromium too, should it still be there.
        let group = format!("-{}", self.chromedriver.id());
        drop(Command::new("kill").args(["-KILL", "--", &group]).status());
        drop(self.chromedriver.wait());
    }
}

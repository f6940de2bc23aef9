//! The program itself, as somebody starts it: `aplomb view`.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

/// How long anything may take on a busy computer.
pub(crate) const PATIENCE: Duration = Duration::from_secs(40);

/// `aplomb view` that runs; killed at the end of a test, also of one that fails.
pub(crate) struct Program {
    pub(crate) child: Child,
    /// The page's address, with a slash at its end.
    pub(crate) url: String,
    /// So that the program can go on writing.
    _stdout: BufReader<ChildStdout>,
}

impl Program {
    /// Starts it with more arguments, on a free port.
    pub(crate) fn start(arguments: &[&str]) -> Self {
        Self::start_at(0, arguments)
    }

    /// Starts it on a port.
    pub(crate) fn start_at(port: u16, arguments: &[&str]) -> Self {
        let mut child = view(port, arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        stdout.read_line(&mut line).unwrap();
        let url = line.trim().to_owned();
        assert!(url.starts_with("http://127.0.0.1:"), "{line:?}");
        Self {
            child,
            url,
            _stdout: stdout,
        }
    }

    /// `127.0.0.1:PORT`.
    pub(crate) fn address(&self) -> &str {
        self.url.trim_start_matches("http://").trim_end_matches('/')
    }

    pub(crate) fn port(&self) -> u16 {
        self.address().rsplit_once(':').unwrap().1.parse().unwrap()
    }

    /// Ends it at once, as a crash would.
    pub(crate) fn kill(&mut self) {
        // It may have ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.kill();
    }
}

/// The command, not yet started.
pub(crate) fn view(port: u16, arguments: &[&str]) -> Command {
    let mut command = aplomb();
    let port = port.to_string();
    command
        .args(["view", "--no-open", "--port", &port])
        .args(arguments);
    command
}

pub(crate) fn aplomb() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_aplomb"));
    command.env("COLUMNS", "100").env("NO_COLOR", "1");
    command
}

/// A file of the tests' own scenarios.
pub(crate) fn scenario(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenarios");
    folder.join(name).to_str().unwrap().to_owned()
}

/// Asks again and again until there is an answer.
pub(crate) fn until<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let end = Instant::now() + PATIENCE;
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(Instant::now() < end, "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(15));
    }
}

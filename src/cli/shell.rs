//! `aplomb shell`: commands from a person or a script, one a line.
//!
//! lines of stdin → supervisor, pushes, time → events on stdout.

use std::io::{self, BufRead, IsTerminal, Read, Write};

use anyhow::{Result, anyhow, bail, ensure};
use aplomb::framework::input::shortened;
use aplomb::framework::run::Simulation;
use aplomb::framework::scenario::LONGEST_RUN;
use clap::Args;

use super::arguments::Record;
use super::controllers::usage;
use super::output::{check_writable, message};
use super::scene::{SceneArgs, record};
use super::values::{impulse, number};
use super::{Ending, progress, timeline};

/// The longest line, bytes.
const LONGEST_LINE: u64 = 4096;

const HELP: &str = "\
wait S             lets S seconds pass; nothing moves otherwise
push LINK IMPULSE  pushes a link over the next 0.1 s, N·s, + forward: push torso -40
COMMAND            any command of a controller, taken up when time passes next
explain            what every controller would bid now, and why not
state              posture, centre of mass and the active controller
help               this list
quit               ends; so does the end of the input
# …                a comment";

/// Give commands line by line
///
/// Reads commands from a person or, through stdin, from a script. Time passes only in `wait`; what
/// happens meanwhile is printed with its time in s. A bad line is reported on stderr and left out.
/// A person's session ends with exit code 0, and a script's with 2 if it had a bad line.
#[derive(Debug, Args)]
#[command(after_help = "\
Lines: push LINK IMPULSE (N·s), wait S (s), explain, state, help, quit, or a command such as balance.

Example: printf 'wait 1\\npush torso -120\\nwait 3\\nstate\\n' | aplomb shell")]
pub(super) struct ShellArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    record: Record,
}

impl ShellArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let registry = aplomb::controllers::registry();
        let mut scenario = self.scene.load(LONGEST_RUN, &registry)?;
        scenario.duration = LONGEST_RUN;
        self.record.file.as_deref().map_or(Ok(()), check_writable)?;
        let mut simulation = Simulation::new(&scenario, &registry)?;
        if self.record.file.is_some() {
            record(&mut simulation, &scenario)?;
        }
        let stdin = io::stdin();
        let person = stdin.is_terminal();
        let told = 0;
        let mut shell = Shell { simulation, told };
        let bad = shell.converse(&mut stdin.lock(), out, person)?;
        if let (Some(path), Some(recording)) = (self.record.file, shell.simulation.into_recording())
        {
            recording.write(&path)?;
            message(format_args!("recorded in {}", path.display()));
        }
        Ok(if bad > 0 && !person {
            Ending::BadLines
        } else {
            Ending::Done
        })
    }
}

/// A session.
struct Shell {
    simulation: Simulation,
    /// Number of events that were printed.
    told: usize,
}

impl Shell {
    /// Reads to the end or to `quit`. Returns the number of bad lines.
    fn converse(
        &mut self,
        input: &mut dyn BufRead,
        out: &mut dyn Write,
        person: bool,
    ) -> Result<usize> {
        let (mut bad, mut count) = (0, 0_usize);
        if person {
            writeln!(out, "{HELP}")?;
        }
        loop {
            if person {
                write!(out, "{:.3} s> ", self.simulation.time())?;
            }
            out.flush()?;
            let Some(line) = next_line(input)? else {
                if person {
                    writeln!(out)?;
                }
                return Ok(bad);
            };
            count += 1;
            match self.obey(line.trim(), out) {
                Ok(true) => {}
                Ok(false) => return Ok(bad),
                // Stdout is at fault, not the line.
                Err(error) if error.is::<io::Error>() => return Err(error),
                Err(error) => {
                    bad += 1;
                    message(format_args!("error: line {count}: {error:#}"));
                }
            }
        }
    }

    /// Does what a line says. Returns false for `quit`.
    fn obey(&mut self, line: &str, out: &mut dyn Write) -> Result<bool> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [] => {}
            [first, ..] if first.starts_with('#') => {}
            ["quit"] => return Ok(false),
            ["help"] => self.help(out)?,
            ["state"] => writeln!(out, "{}", self.state())?,
            ["explain"] => self.explain(out)?,
            ["wait", seconds] => self.wait(seconds, out)?,
            ["push", link, strength] => {
                let strength = impulse(strength).map_err(|e| anyhow!(e))?;
                self.simulation.push(0, link, strength)?;
                self.tell(out)?;
            }
            ["wait", ..] => bail!("accepted: wait S, for example wait 2"),
            ["push", ..] => bail!("accepted: push LINK IMPULSE, for example push torso -40"),
            [word @ ("quit" | "help" | "state" | "explain"), ..] => {
                bail!("'{word}' stands alone")
            }
            _ => {
                let given = self.simulation.command(0, line);
                if given.is_err() {
                    // The error says it; the events need not.
                    self.told = self.simulation.events().len();
                }
                given?;
            }
        }
        Ok(true)
    }

    fn help(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{HELP}\n\nCommands:")?;
        for controller in self.simulation.actors()[0].supervisor.controllers() {
            for answer in &controller.contract().commands {
                writeln!(out, "  {}", usage(answer))?;
            }
        }
        Ok(())
    }

    fn state(&self) -> String {
        let now = self.simulation.sensors(0);
        let support = match now.base_of_support {
            Some([rear, front]) => format!("feet from {rear:.3} to {front:.3} m"),
            None => "feet in the air".to_owned(),
        };
        format!("{}; {support}", timeline::end(&self.simulation, 0))
    }

    fn explain(&self, out: &mut dyn Write) -> io::Result<()> {
        let supervisor = &self.simulation.actors()[0].supervisor;
        let active = supervisor.active().unwrap_or("nothing yet");
        writeln!(out, "{:9.3} s  active: {active}", self.simulation.time())?;
        let bids = supervisor.bids(self.simulation.sensors(0));
        timeline::print_bids(out, &bids, "             ")
    }

    fn wait(&mut self, seconds: &str, out: &mut dyn Write) -> Result<()> {
        let left = LONGEST_RUN - self.simulation.time();
        let seconds = number(0.0, LONGEST_RUN, "s")(seconds)
            .map_err(|e| anyhow!("wait '{}'; {e}", shortened(seconds)))?;
        ensure!(
            seconds <= left,
            "a session lasts at most {LONGEST_RUN} s, of which {left:.3} s are left"
        );
        progress::run(&mut self.simulation, seconds);
        self.tell(out)
    }

    /// Prints what has happened since it was last asked.
    fn tell(&mut self, out: &mut dyn Write) -> Result<()> {
        let detail = timeline::Detail {
            explain: false,
            several: self.simulation.actors().len() > 1,
        };
        let events = self.simulation.events();
        for event in &events[self.told..] {
            timeline::print_event(out, event, detail)?;
        }
        self.told = events.len();
        Ok(())
    }
}

/// The next line without its end; none at the end of the input. What is no UTF-8 is replaced, and
/// refused as an unknown command.
fn next_line(input: &mut dyn BufRead) -> Result<Option<String>> {
    let mut bytes = Vec::new();
    let read = input.take(LONGEST_LINE + 1).read_until(b'\n', &mut bytes);
    let count = read.map_err(|e| anyhow!("cannot read the input: {e}"))?;
    ensure!(
        count as u64 <= LONGEST_LINE,
        "a line of the input is longer than {LONGEST_LINE} bytes"
    );
    Ok((count > 0).then(|| String::from_utf8_lossy(&bytes).into_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb::framework::scenario::Scenario;

    fn shell() -> Shell {
        let scenario = Scenario::standing("humanoid", 1.0);
        let registry = aplomb::controllers::registry();
        let simulation = Simulation::new(&scenario, &registry).unwrap();
        Shell {
            simulation,
            told: 0,
        }
    }

    #[test]
    fn time_passes_only_in_wait() {
        let (mut shell, mut out) = (shell(), Vec::new());
        let script = b"# a script\npush torso 5\nexplain\nwait 0.1\nstate\nquit\nnonsense\n";
        let bad = shell.converse(&mut &script[..], &mut out, false).unwrap();
        assert_eq!(bad, 0);
        assert!((shell.simulation.time() - 0.1).abs() < 1e-9);
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains("push     torso +5 N·s"), "{text}");
    }

    #[test]
    fn bad_lines_are_counted_and_left_out() {
        let mut shell = shell();
        let script = b"blance\npush tail 3\npush torso inf\nwait 1e9\nwait\nquit now\n\xff\n";
        let bad = shell.converse(&mut &script[..], &mut Vec::new(), false);
        assert_eq!(bad.unwrap(), 7);
        assert_eq!(shell.simulation.time(), 0.0);
    }

    #[test]
    fn an_endless_line_is_refused() {
        let line = vec![b'x'; 10_000];
        let answer = shell().converse(&mut &line[..], &mut Vec::new(), false);
        assert!(answer.unwrap_err().to_string().contains("longer than"));
    }
}

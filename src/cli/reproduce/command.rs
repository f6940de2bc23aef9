//! A command of the program as a value: what `--json` would print, without another process.
//!
//! command line → parsed as the program parses its own → report → JSON value.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, bail, ensure};
use clap::Parser;
use serde_json::{Value, to_value};

use crate::cli::train::TrainCommand;
use crate::cli::{Action, Cli};

/// What a command, such as `aplomb trials --count 10`, prints with `--json`. It runs in the threads of
/// the caller, whatever its `--jobs` says. If it is stopped the value is not complete.
///
/// # Errors
/// A command that cannot be parsed, has nothing to measure or fails; none is begun once it is stopped.
pub(super) fn value(command: &str, stop: &AtomicBool) -> Result<Value> {
    ensure!(!stop.load(Ordering::Relaxed), "stopped");
    let cli = Cli::try_parse_from(command.split_whitespace())?;
    Ok(match cli.command {
        Some(Action::Run(args)) => to_value(args.measure()?)?,
        Some(Action::Trials(args)) => to_value(args.measure(stop)?)?,
        Some(Action::Robustness(args)) => to_value(args.measure(stop)?)?,
        Some(Action::Clips(args)) => to_value(args.measure()?)?,
        Some(Action::Train(TrainCommand::Preconditions(args))) => to_value(args.measure(stop)?)?,
        Some(Action::Train(TrainCommand::Cmrt(args))) => to_value(args.measure(stop)?)?,
        Some(Action::Train(TrainCommand::Basis(args))) => to_value(args.measure(stop)?)?,
        _ => bail!("{command}: there is nothing to measure"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_has_the_value_that_it_prints() {
        let never = AtomicBool::new(false);
        let run = value("aplomb run --duration 0.1 --seed 3", &never).unwrap();
        assert_eq!(
            (&run["seed"], &run["end"]["active"]),
            (&3.into(), &"balance".into())
        );
        for bad in ["aplomb run --duration x", "aplomb controllers"] {
            assert!(value(bad, &never).is_err(), "{bad}");
        }
    }
}

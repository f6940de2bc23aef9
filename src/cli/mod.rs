//! The subcommands: one file each, and this table of them.
//!
//! arguments → subcommand → results on stdout, progress and messages on stderr, exit code.

mod arguments;
mod clips;
mod compare;
mod controllers;
mod export;
mod json;
mod output;
mod progress;
mod render;
mod reproduce;
mod robustness;
mod run;
mod scene;
mod shell;
mod statistics;
mod story;
mod timeline;
mod train;
mod trials;
mod values;
mod view;
mod work;

use std::io::Write;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

use output::{Output, message};

/// Composable controllers for physically simulated planar characters.
///
/// Without a subcommand it tells a story: the humanoid stands, is pushed hard from the front, falls
/// and gets up; the same from behind; and, pushed lightly, steps. The timeline is printed; out/story.svg and
/// out/story.trajectory are written.
#[derive(Debug, Parser)]
#[command(name = "aplomb", version, after_help = UNITS)]
struct Cli {
    #[command(subcommand)]
    command: Option<Action>,
}

/// Said once for all subcommands.
const UNITS: &str = "\
Units are SI and radians: m, kg, s, N·s, rad. x points forward, y up; a positive impulse pushes \
forward. Results go to stdout, progress and messages to stderr.
Exit codes: 0 done; 1 an expectation of the run was not met; 2 bad usage or bad input.

Example: aplomb run --push 1:torso:-40 --explain";

#[derive(Debug, Subcommand)]
enum Action {
    View(view::ViewArgs),
    Run(run::RunArgs),
    Trials(trials::TrialsArgs),
    Shell(shell::ShellArgs),
    Controllers(controllers::ControllersArgs),
    Clips(clips::ClipsArgs),
    #[command(subcommand)]
    Train(train::TrainCommand),
    Compare(compare::CompareArgs),
    Robustness(robustness::RobustnessArgs),
    Render(render::RenderArgs),
    Export(export::ExportArgs),
    Reproduce(reproduce::ReproduceArgs),
}

/// What a finished subcommand tells the shell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    /// Done: 0.
    Done,
    /// An expectation of the run was not met: 1.
    Unmet,
    /// Some lines of a script were bad: 2.
    BadLines,
}

impl Cli {
    fn run(self, out: &mut dyn Write) -> Result<Ending> {
        match self.command {
            None => story::tell(out),
            Some(Action::View(args)) => args.run(out),
            Some(Action::Run(args)) => args.run(out),
            Some(Action::Trials(args)) => args.run(out),
            Some(Action::Shell(args)) => args.run(out),
            Some(Action::Controllers(args)) => args.run(out),
            Some(Action::Clips(args)) => args.run(out),
            Some(Action::Train(command)) => command.run(out),
            Some(Action::Compare(args)) => args.run(out),
            Some(Action::Robustness(args)) => args.run(out),
            Some(Action::Render(args)) => args.run(out),
            Some(Action::Export(args)) => args.run(out),
            Some(Action::Reproduce(args)) => args.run(out),
        }
    }
}

/// The whole program.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    let mut out = Output::stdout();
    let result = cli.run(&mut out);
    let result = result.and_then(|verdict| {
        out.flush()?;
        Ok(verdict)
    });
    match result {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Unmet) => ExitCode::from(1),
        Ok(Ending::BadLines) => ExitCode::from(2),
        // Nobody reads on (`| head`): no fault of the run.
        Err(error) if output::reader_left(&error) => ExitCode::SUCCESS,
        Err(error) => {
            message(format_args!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_table_of_subcommands_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_help_of_run_names_every_shipped_scenario() {
        let mut cli = Cli::command();
        let help = cli.find_subcommand_mut("run").unwrap().render_long_help();
        for (name, _) in aplomb::scenarios::shipped() {
            let name = name.split('/').next().unwrap_or(name);
            assert!(help.to_string().contains(name), "{name}");
        }
    }
}

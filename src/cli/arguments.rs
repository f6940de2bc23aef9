//! The options that several subcommands share, one declaration each.

use std::path::PathBuf;

use clap::Args;

use super::values::{Setting, whole};

/// `--json`.
#[derive(Debug, Args)]
pub(super) struct Json {
    /// Prints one JSON value instead of text
    #[arg(id = "json", long = "json")]
    pub(super) wanted: bool,
}

/// `--seed`.
#[derive(Debug, Args)]
pub(super) struct Seed {
    /// Fixes everything random
    #[arg(id = "seed", long = "seed", value_name = "N", default_value = "0",
          value_parser = whole(0, u64::MAX), allow_negative_numbers = true)]
    pub(super) value: u64,
}

/// `--resume`.
#[derive(Debug, Args)]
pub(super) struct Resume {
    /// Goes on with the search whose journal is beside the output
    #[arg(id = "resume", long = "resume")]
    pub(super) wanted: bool,
}

/// `--record`.
#[derive(Debug, Args)]
pub(super) struct Record {
    /// Records every step into a trajectory file
    #[arg(id = "record", long = "record", value_name = "FILE")]
    pub(super) file: Option<PathBuf>,
}

/// `--set` of clips.
#[derive(Debug, Args)]
pub(super) struct ClipSettings {
    /// Sets a parameter of the clip; repeatable
    #[arg(long, value_name = "KEY=VALUE", allow_hyphen_values = true)]
    pub(super) set: Vec<Setting>,
}

//! Long work in parallel: the threads that do it, and Ctrl-C that ends it.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use clap::Args;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::values::whole;

/// How many threads work.
#[derive(Debug, Args)]
pub(super) struct Jobs {
    /// Number of threads; changes no result [default: one a core]
    #[arg(long, value_name = "N", value_parser = whole(1, 256), allow_negative_numbers = true)]
    jobs: Option<u64>,
}

impl Jobs {
    /// So many threads, or one a core.
    pub(super) fn threads(&self) -> Result<ThreadPool> {
        let threads = ThreadPoolBuilder::new().num_threads(self.jobs.map_or(0, |j| j as usize));
        threads.build().context("cannot start the threads")
    }
}

/// Whether the work goes on: until the flag is raised.
pub(super) fn going_on(stop: &AtomicBool) -> ControlFlow<()> {
    if stop.load(Ordering::Relaxed) {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// A flag that the first Ctrl-C raises; the second ends the program at once.
pub(super) fn stop_on_interrupt() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })
    .context("cannot watch for Ctrl-C")?;
    Ok(stop)
}

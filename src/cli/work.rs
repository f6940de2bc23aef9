//! Long work in parallel: the threads that do it, and Ctrl-C that ends it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// So many threads, or one a core.
pub(super) fn threads(jobs: Option<u64>) -> Result<ThreadPool> {
    let threads = ThreadPoolBuilder::new().num_threads(jobs.map_or(0, |j| j as usize));
    threads.build().context("cannot start the threads")
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

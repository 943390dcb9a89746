//! Protection against work in a forked process.

use crate::error::bail;
use pyo3::PyResult;
use std::process;
use std::sync::OnceLock;

/// The process that has started the threads of the solvers.
static HOME: OnceLock<u32> = OnceLock::new();

/// Refuses work in a process that was forked from one that has worked: it has none of the threads, and would wait for them forever.
pub fn check_not_forked() -> PyResult<()> {
    let here = process::id();
    if *HOME.get_or_init(|| here) == here {
        return Ok(());
    }
    bail(
        "this process was forked from one that has solved already, and it has none of its threads: start workers by spawn or \
         forkserver, as with multiprocessing.get_context(\"spawn\")",
    )
}

//! The process that the threads of the solvers live in.

use crate::refusal::refuse;
use pyo3::PyResult;
use std::process;
use std::sync::OnceLock;

/// The process that made the threads.
static HOME: OnceLock<u32> = OnceLock::new();

/// Refuses work in a process that was forked from one that has worked: it has none of the threads, and would wait for them for ever.
pub fn check() -> PyResult<()> {
    let here = process::id();
    if *HOME.get_or_init(|| here) == here {
        return Ok(());
    }
    refuse(
        "this process was forked from one that has solved already and has none of its threads: start workers by spawn or forkserver, as \
         with multiprocessing.get_context(\"spawn\")",
    )
}

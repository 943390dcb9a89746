//! Peak memory of a run.

/// Runs `run`, and says how much memory was resident at its peak, in MiB, where the system tells: the high-water mark of the
/// whole process (`VmHWM`), set back to what is resident at the start. What the allocator keeps of earlier runs counts.
#[cfg(target_os = "linux")]
pub fn peak_of<T>(run: impl FnOnce() -> T) -> (T, Option<f64>) {
    use procfs::process::{ClearRefs, Process};
    let process = Process::myself().and_then(|process| process.clear_refs(ClearRefs::PeakRSS).map(|()| process));
    let value = run();
    let kib = process.and_then(|process| process.status()).ok().and_then(|status| status.vmhwm);
    (value, kib.map(|kib| kib as f64 / 1024.0))
}

/// Runs `run`; this system does not tell how much memory that took.
#[cfg(not(target_os = "linux"))]
pub fn peak_of<T>(run: impl FnOnce() -> T) -> (T, Option<f64>) {
    (run(), None)
}

//! The memory that is free.

use crate::sentence::{Sentence, sentence};

#[cfg(all(target_os = "linux", feature = "figures"))]
mod group;

/// Bytes of free memory, if the system reports it: those of the machine, or fewer where a container has a limit.
pub fn available_bytes() -> Option<f64> {
    #[cfg(all(target_os = "linux", feature = "figures"))]
    {
        use procfs::{Current, Meminfo};
        let of_machine = Meminfo::current().ok().and_then(|memory| memory.mem_available).map(|bytes| bytes as f64);
        of_machine.into_iter().chain(group::bytes_left()).reduce(f64::min)
    }
    #[cfg(not(all(target_os = "linux", feature = "figures")))]
    None
}

/// Memory that is not granted.
pub(crate) struct MissingMemory {
    /// Bytes that are free, if the system reports them and they are too few.
    pub free: Option<f64>,
}

/// Refuses work that needs more bytes than are free, or than the system allows.
pub(crate) fn check_bytes(needed: f64) -> Result<(), MissingMemory> {
    if let Some(free) = available_bytes().filter(|free| needed > *free) {
        return Err(MissingMemory { free: Some(free) });
    }
    let mut reserved = Vec::<u8>::new();
    let granted = reserved.try_reserve_exact(needed as usize);
    std::hint::black_box(reserved);
    granted.map_err(|_| MissingMemory { free: None })
}

/// How much memory is free, after the words on how much is needed.
pub(crate) fn free_in_words(free: Option<f64>) -> Sentence {
    match free.map(crate::quantity::bytes_in_words) {
        Some(free) => sentence!("and {free} are free", free),
        None => "more than the system allows".into(),
    }
}

/// Refuses work that needs more bytes than are free, or than the system allows.
///
/// # Errors
/// How many are needed and free, such as "1.1 TB, and 21 GB are free".
pub fn check_room(needed: f64) -> Result<(), String> {
    check_bytes(needed)
        .map_err(|missing| format!("{}, {}", crate::quantity::bytes_in_words(needed), free_in_words(missing.free)))
}

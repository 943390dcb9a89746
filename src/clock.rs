//! The clock of solves: that of the system or, in a browser, one that the page hands in.
//!
//! A WebAssembly module has no clock of its own. Without `set_clock` all durations in a browser are 0.

#[cfg(not(target_arch = "wasm32"))]
pub use std::time::Instant;

#[cfg(target_arch = "wasm32")]
pub use handed_in::{Instant, set_clock};

#[cfg(target_arch = "wasm32")]
mod handed_in {
    use std::sync::OnceLock;
    use std::time::Duration;

    static NOW: OnceLock<fn() -> f64> = OnceLock::new();

    /// Takes the clock: a function that returns milliseconds from any beginning on. A second clock is ignored.
    pub fn set_clock(now: fn() -> f64) {
        NOW.set(now).ok();
    }

    /// A moment, as [`std::time::Instant`].
    #[derive(Debug, Clone, Copy)]
    pub struct Instant {
        milliseconds: f64,
    }

    impl Instant {
        /// This moment.
        pub fn now() -> Self {
            Self { milliseconds: NOW.get().map_or(0.0, |now| now()) }
        }

        /// The time since this moment.
        pub fn elapsed(&self) -> Duration {
            Duration::from_secs_f64((Self::now().milliseconds - self.milliseconds).max(0.0) / 1e3)
        }
    }
}

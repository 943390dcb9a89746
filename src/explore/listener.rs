//! Who hears of a session while it solves.

use super::report::Report;

/// Functions that a session calls while it solves, where nothing else can run at the same time: in a browser, a module has one
/// thread.
#[derive(Clone, Copy)]
pub struct Listener {
    /// Gets every new report.
    pub report: fn(&Report),
    /// Says whether the solve goes on.
    pub goes_on: fn() -> bool,
}

//! A progress bar over the points of a sweep, for people at a terminal.

use asperity::study::Row;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// Shows which share of the nodes is solved and the time left, on standard error, if that is a terminal.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar over so many nodes under loads, titled `title`.
    pub fn new(title: &str, nodes: u64) -> Self {
        let bar = if std::io::stderr().is_terminal() { ProgressBar::new(nodes) } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{prefix} [{wide_bar}] {percent} %, {msg} ({eta} left)") {
            bar.set_style(style);
        }
        bar.set_prefix(title.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// Goes on by a solved point.
    pub fn add(&self, row: &Row) {
        let hurst = row.hurst.map_or(String::new(), |hurst| format!(", H = {hurst}"));
        self.0.set_message(format!("{}{hurst}, p* = {:.2e}", row.name, row.reduced_pressure));
        self.0.inc((row.ny * row.nx) as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

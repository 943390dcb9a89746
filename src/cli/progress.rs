//! A progress bar for people at a terminal.

use asperity::contact::{Observer, Step};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::time::Duration;

/// Places on the bar from the first certificate to the tolerance.
const LENGTH: u64 = 1000;

/// Shows the certificate on its way to the tolerance, on standard error, if that is a terminal.
pub struct Progress {
    bar: ProgressBar,
    tolerance: f64,
    first: Option<f64>,
}

impl Progress {
    /// A bar that is full at `tolerance`.
    pub fn new(tolerance: f64, title: &str) -> Self {
        let bar = if std::io::stderr().is_terminal() { ProgressBar::new(LENGTH) } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{prefix} [{wide_bar}] {msg} ({elapsed})") {
            bar.set_style(style);
        }
        bar.set_prefix(title.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, tolerance, first: None }
    }
}

impl Observer for Progress {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        if let Some(eta) = step.certificate().filter(|_| !self.bar.is_hidden()) {
            let first = *self.first.get_or_insert(eta);
            let share = (first / eta).ln() / (first / self.tolerance).ln();
            self.bar.set_position((share.clamp(0.0, 1.0) * LENGTH as f64) as u64);
            self.bar.set_message(format!("step {}, certificate {eta:.1e}", step.index()));
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

//! A progress bar on a terminal.

use super::command_style::is_quiet;
use super::interrupt::Interruption;
use asperity::contact::{Failure, Observer, Phase, Problem, Solver, Step, Stop, Wish};
use asperity::job::{Pass, Watcher};
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Places on the bar from the first certificate to the tolerance.
const BAR_PLACES: u64 = 1000;

/// Shows grid level and certificate, and the progress towards the tolerance, on standard error, if that is a terminal.
/// It uses only those values of a step that cost nothing.
pub(crate) struct Progress {
    bar: ProgressBar,
    tolerance: f64,
    /// Levels above the finest one.
    coarse: usize,
    level: Option<LevelProgress>,
}

/// The certificates of a level.
struct LevelProgress {
    number: usize,
    first: f64,
    last: f64,
    trend: Trend,
}

/// A bar with a title, for experiments that watch their runs.
pub(crate) fn bar(title: &str) -> Box<dyn Observer> {
    Box::new(Progress::new(title))
}

/// A bar for each solve of a job. Ctrl-C ends a run with several states after the last state that is solved.
#[derive(Default)]
pub(crate) struct Bars {
    interrupted: Option<Arc<AtomicBool>>,
}

impl Watcher for Bars {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        let title = match pass {
            Pass::Grid(run) | Pass::Solve(run, _) => run.label().to_owned(),
            Pass::Reference(run) => format!("{}, first pass", run.label()),
            Pass::Stick(_) => "stick zone".into(),
            Pass::State(run, _, number) => match run.setup.loads.len() {
                0 => format!("state {}", number + 1),
                loads => format!("load {} of {loads}", number + 1),
            },
        };
        let interruption = self.interrupted.clone().filter(|_| matches!(pass, Pass::State(..))).map(Interruption);
        Box::new((interruption, Progress::new(&title)))
    }

    fn ended(&self) -> Option<Arc<AtomicBool>> {
        self.interrupted.clone()
    }
}

impl Bars {
    /// Bars of a run that Ctrl-C ends.
    pub(crate) fn until(interrupted: Arc<AtomicBool>) -> Self {
        Self { interrupted: Some(interrupted) }
    }
}

/// A bar without a length on standard error, if that is a terminal and the program is not quiet.
pub(crate) fn blank(template: &str) -> ProgressBar {
    let is_shown = std::io::stderr().is_terminal() && !is_quiet();
    let bar = if is_shown { ProgressBar::no_length() } else { ProgressBar::hidden() };
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

impl Progress {
    /// A bar that is full at the tolerance of the run.
    pub(crate) fn new(title: &str) -> Self {
        let bar = blank("{prefix} [{wide_bar}] {msg} ({elapsed})");
        bar.set_length(BAR_PLACES);
        bar.set_prefix(title.to_owned());
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        Self { bar, tolerance: f64::NAN, coarse: 0, level: None }
    }

    fn show(&mut self, step: usize, phase: Phase, certificate: Option<f64>, seconds: f64) {
        self.coarse = self.coarse.max(phase.level);
        self.level.take_if(|level| level.number != phase.level);
        if let Some(eta) = certificate {
            let fresh = LevelProgress { number: phase.level, first: eta, last: eta, trend: Trend::default() };
            let level = self.level.get_or_insert(fresh);
            level.last = eta;
            level.trend.add(seconds, eta.ln());
        }
        self.bar.set_position(self.level.as_ref().map_or(0, |level| level.place(self.tolerance)));
        self.bar.set_message(self.message(step, phase, seconds));
    }

    fn message(&self, step: usize, phase: Phase, seconds: f64) -> String {
        let on_level =
            if self.coarse > 0 { format!("level {} of {}, ", phase.level, self.coarse) } else { String::new() };
        let Some(level) = &self.level else { return format!("{on_level}step {step}") };
        let end = level.trend.meets(self.tolerance.ln()).filter(|&end| phase.level == 0 && end > seconds);
        let left = end.and_then(|end| Duration::try_from_secs_f64(end - seconds).ok());
        let left = left.map_or_else(String::new, |left| format!(", about {} left", HumanDuration(left)));
        format!("{on_level}step {step}, certificate {:.1e}{left}", level.last)
    }
}

impl LevelProgress {
    /// How far along the bar the certificate is.
    fn place(&self, tolerance: f64) -> u64 {
        let share = (self.first / self.last).ln() / (self.first / tolerance).ln();
        (share.clamp(0.0, 1.0) * BAR_PLACES as f64) as u64
    }
}

impl Observer for Progress {
    fn begin(&mut self, _: &dyn Solver, _: &Problem, stop: &Stop) -> Result<(), Failure> {
        self.tolerance = stop.tolerance();
        Ok(())
    }

    fn step(&mut self, step: &Step<'_>) -> Wish {
        if !self.bar.is_hidden() {
            self.show(
                step.index(),
                step.phase(),
                step.certificate().map(|it| it.eta),
                self.bar.elapsed().as_secs_f64(),
            );
        }
        Ok(ControlFlow::Continue(()))
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A straight line through values over time, of which the latest third counts most: sums of weight, time, value and
/// their products.
#[derive(Default)]
struct Trend {
    count: u32,
    sums: [f64; 6],
}

impl Trend {
    /// The fewest values to go by.
    const FEWEST_VALUES: u32 = 4;
    /// The least share of the variance that a line must explain (`r^2`).
    const LEAST_R_SQUARED: f64 = 0.5;

    fn add(&mut self, t: f64, y: f64) {
        if y.is_finite() {
            self.count += 1;
            let keep = (1.0 - 1.0 / f64::from(self.count)).powi(3);
            let new = [1.0, t, y, t * t, t * y, y * y];
            self.sums.iter_mut().zip(new).for_each(|(sum, new)| *sum = keep * *sum + new);
        }
    }

    /// When the line falls to `target`, if it falls and the values follow it.
    fn meets(&self, target: f64) -> Option<f64> {
        let [weight, t, y, tt, ty, yy] = self.sums;
        let [mean_t, mean_y] = [t / weight, y / weight];
        let [tt, ty, yy] =
            [tt / weight - mean_t * mean_t, ty / weight - mean_t * mean_y, yy / weight - mean_y * mean_y];
        let is_trend = self.count >= Self::FEWEST_VALUES && ty < 0.0 && ty * ty > Self::LEAST_R_SQUARED * tt * yy;
        is_trend.then(|| mean_t + (target - mean_y) * tt / ty)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trend(values: impl IntoIterator<Item = (f64, f64)>) -> Trend {
        let mut trend = Trend::default();
        values.into_iter().for_each(|(t, y)| trend.add(t, y));
        trend
    }

    #[test]
    fn a_steady_fall_predicts_its_end() {
        let fall = |n: usize| trend((0..n).map(|i| (10.0 + i as f64, -0.5 * i as f64)));
        assert!((fall(20).meets(-20.0).unwrap() - 50.0).abs() < 1e-9);
        assert!(fall(4).meets(-20.0).is_some() && fall(3).meets(-20.0).is_none() && fall(0).meets(-20.0).is_none());
    }

    #[test]
    fn the_latest_rate_counts_and_noise_hardly() {
        let noise = |i: usize| if i.is_multiple_of(2) { 0.5 } else { -0.5 };
        let slower = |i: usize| if i < 100 { -0.2 * i as f64 } else { -20.0 - 0.05 * (i - 100) as f64 };
        let end = trend((0..1000).map(|i| (i as f64, slower(i) + noise(i)))).meets(-75.0).unwrap();
        assert!((end - 1200.0).abs() < 60.0, "{end}");
    }

    #[test]
    fn without_a_trend_there_is_no_end() {
        assert!(trend((0..50).map(|i| (f64::from(i), 0.1 * f64::from(i)))).meets(-1.0).is_none());
        assert!(trend((0..50).map(|i| (f64::from(i), f64::from(i * 7 % 5)))).meets(-9.0).is_none());
        assert!(trend((0..50).map(|i| (f64::from(i), -3.0))).meets(-9.0).is_none());
    }

    #[test]
    fn the_bar_names_level_certificate_and_time_left() {
        let mut progress = Progress::new("it");
        progress.tolerance = 1e-8;
        let mut message = |step, level, inner, certificate, seconds| {
            progress.show(step, Phase { level, outer: 0, inner }, certificate, seconds);
            progress.message(step, Phase { level, outer: 0, inner }, seconds)
        };
        assert_eq!(message(0, 2, 0, Some(0.5), 0.0), "level 2 of 2, step 0, certificate 5.0e-1");
        assert_eq!(message(1, 0, 1, None, 1.0), "level 0 of 2, step 1");
        for step in 2..6 {
            message(step, 0, 0, Some(10f64.powi(2 - step as i32)), step as f64);
        }
        let expected = "level 0 of 2, step 6, certificate 1.0e-3, about 4 seconds left";
        assert_eq!(message(6, 0, 3, None, 6.0), expected);
        assert_eq!(message(7, 0, 4, None, 11.0), "level 0 of 2, step 7, certificate 1.0e-3");
    }
}

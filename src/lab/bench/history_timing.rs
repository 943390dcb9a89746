//! Times and errors of this code and of another one, in the same histories.

use super::history_contest::HistoryContest;
use super::peer::Python;
use crate::contact::Stop;
use crate::error::HistoryError;
use crate::lab::table::{median, or_dash};
use crate::surface::Field;
use serde::Serialize;
use std::fmt;
use std::num::NonZeroUsize;
use std::time::Instant;

/// The names of the columns in which a [`HistoryTiming`] displays.
pub const HISTORY_HEAD: &str = "\
case                        points steps code                       seconds    error    ratio";

/// One history by one code. It displays as a row, and serialises with all digits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HistoryTiming {
    case: String,
    points: usize,
    steps: usize,
    code: String,
    /// The version of the code, if it runs.
    version: Option<String>,
    /// Of this code the median over the repeats; the other one runs once.
    seconds: Option<f64>,
    /// The root mean square of the difference from the traction of the reference at the end, over that of the traction. The reference is this
    /// code in many more steps in time, or to a smaller tolerance.
    error: Option<f64>,
    /// Its seconds over those of this code.
    ratio: Option<f64>,
    /// Why the code did not solve it.
    skipped: Option<String>,
}

impl HistoryTiming {
    /// Solves a history by this code and by another one, each on as many threads as the pool has. Each row is given to `show` when it is known.
    ///
    /// # Errors
    /// A step that is not solved.
    pub fn all(
        contest: &HistoryContest,
        stop: &Stop,
        repeats: NonZeroUsize,
        python: &Python,
        mut show: impl FnMut(Self),
    ) -> Result<(), HistoryError> {
        let reference = contest.reference(stop)?;
        let row = |code: &str, version: Option<String>, solved: Result<(f64, f64), String>, ours: Option<f64>| {
            let (solved, skipped) = solved.map_or_else(|why| (None, Some(why)), |solved| (Some(solved), None));
            let seconds = solved.map(|(seconds, _)| seconds);
            Self {
                case: contest.name().into(),
                points: contest.surface().grid().shape()[0],
                steps: contest.steps(),
                code: code.into(),
                version,
                seconds,
                error: solved.map(|(_, error)| error),
                ratio: seconds.zip(ours).map(|(seconds, ours)| seconds / ours),
                skipped,
            }
        };
        let mut ours = Vec::new();
        let mut traction = reference.clone();
        for _ in 0..repeats.get() {
            let clock = Instant::now();
            traction = contest.traction(stop)?;
            ours.push(clock.elapsed().as_secs_f64());
        }
        ours.sort_by(f64::total_cmp);
        let seconds = median(&ours);
        let version = Some(env!("CARGO_PKG_VERSION").to_owned());
        show(row("asperity", version, Ok((seconds, distance(&traction, &reference))), Some(seconds)));
        let (peer, task) = (contest.peer(), contest.task(stop.tolerance()));
        let mut version = None;
        let solved = peer.run(python, contest.surface(), task, rayon::current_num_threads()).map(|found| {
            version = Some(found.version);
            let traction = Field::from_shape_vec(reference.raw_dim(), found.pressure);
            (found.seconds, traction.map_or(f64::NAN, |traction| distance(&traction, &reference)))
        });
        show(row(peer.into(), version, solved, Some(seconds)));
        Ok(())
    }
}

/// The root mean square of the difference of two fields over that of the second one.
fn distance(field: &Field, other: &Field) -> f64 {
    let square = |field: &Field| field.iter().map(|value| value * value).sum::<f64>();
    (square(&(field - other)) / square(other)).sqrt()
}

impl fmt::Display for HistoryTiming {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let code = format!("{} {}", self.code, self.version.as_deref().unwrap_or_default());
        let points = format!("{0}x{0}", self.points);
        write!(f, "{:<22} {points:>11} {:>5} {code:<24}", self.case, self.steps)?;
        if let Some(reason) = &self.skipped {
            return write!(f, " skipped: {reason}");
        }
        let [seconds, ratio] = [self.seconds, self.ratio].map(|value| or_dash(value, |value| format!("{value:.3}")));
        write!(f, " {seconds:>9} {:>8} {ratio:>8}", or_dash(self.error, |error| format!("{error:.1e}")))
    }
}

//! Times and errors of this code and of another one, on surfaces that creep.

use super::peer::{Peer, Python};
use crate::Grid;
use crate::contact::{ContactModulus, Load, Multilevel, Problem, Stop};
use crate::elastic::{Prony, PronyTerm};
use crate::error::{CreepError, SetupError};
use crate::history::{Creep, CreepPath, CreepState, CreepSteps};
use crate::lab::table::{median, or_dash};
use crate::surface::{Field, Spectrum, Surface};
use serde::Serialize;
use serde_json::json;
use std::fmt;
use std::num::NonZeroUsize;
use std::time::Instant;

/// The names of the columns in which a [`CreepTiming`] displays.
pub const CREEP_HEAD: &str = "\
case                        points steps code                       seconds    error    ratio";

/// The contact modulus after all relaxation. Tamaas 2.9.0 agrees with other solutions only where the relaxed shear modulus is 1.
const RELAXED: f64 = 2.0;
/// The share of the modulus that relaxes, the time of that, and the time for which the load is held.
const ELEMENT: PronyTerm = PronyTerm { ratio: 0.9, time: 1.0 };
const DURATION: f64 = 5.0;
/// Steps in time, and how many times as many the reference has.
const STEPS: usize = 20;
const FINER: usize = 16;
/// Points along each side of the surface, and of a smaller one.
const SIDES: [usize; 2] = [256, 128];

/// A rough surface under a held load on a solid that creeps.
pub struct HeldCreep {
    name: String,
    problem: Problem,
    prony: Prony,
    load: Load,
}

/// One history by one code. It displays as a row, and serialises with all digits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CreepTiming {
    case: String,
    points: usize,
    steps: usize,
    code: String,
    /// The version of the code, if it runs.
    version: Option<String>,
    /// Of this code the median over the repeats; the other one runs once.
    seconds: Option<f64>,
    /// The root mean square of the difference from the pressure of this code in many more steps, at the end, over that of the pressure.
    time_error: Option<f64>,
    /// Its seconds over those of this code.
    ratio: Option<f64>,
    /// Why the code did not solve it.
    skipped: Option<String>,
}

impl HeldCreep {
    /// The contests, or smaller ones of their kind, with a rough surface of a seed.
    ///
    /// # Errors
    /// A contact that cannot be posed.
    pub fn all(is_quick: bool, seed: u64) -> Result<Vec<Self>, SetupError> {
        let side = SIDES[usize::from(is_quick)];
        let spectrum =
            Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 4.0 / side as f64, rms_gradient: 1e-3 };
        let surface = Surface::rough(Grid::surface([side; 2], [1.0; 2])?, &spectrum, seed)?;
        let prony = Prony::from_relaxation(&[ELEMENT])?;
        let contest = |pressure: f64| {
            let load = Load::ReducedPressure(pressure);
            let at_once = ContactModulus(RELAXED / (1.0 - ELEMENT.ratio));
            let problem = Problem::new(surface.clone(), at_once, load)?;
            Ok(Self { name: format!("creep H 0.8 p* {pressure}"), problem, prony: prony.clone(), load })
        };
        [2e-3, 2e-2].into_iter().map(contest).collect()
    }

    /// Name in tables.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The pressure at the end of some steps.
    fn pressure(&self, steps: usize, stop: &Stop) -> Result<Field, CreepError> {
        let (creep, path) =
            (Creep::new(self.problem.clone(), self.prony.clone()), CreepPath::held(self.load, DURATION)?);
        let mut last: Option<CreepState> = None;
        for state in CreepSteps::fixed(creep, path, steps, &Multilevel, *stop)? {
            last = Some(state?);
        }
        Ok(last.expect("there is a state for each step").contact.pressure)
    }
}

impl CreepTiming {
    /// Solves a history by this code and by Tamaas, each on as many threads as the pool has. Each row is given to `show` when it is known.
    ///
    /// # Errors
    /// A step that is not solved.
    pub fn all(
        contest: &HeldCreep,
        stop: &Stop,
        repeats: NonZeroUsize,
        python: &Python,
        mut show: impl FnMut(Self),
    ) -> Result<(), CreepError> {
        let surface = contest.problem.surface();
        let reference = contest.pressure(FINER * STEPS, stop)?;
        let row = |code: &str, version: Option<String>, solved: Result<(f64, f64), String>, ours: Option<f64>| {
            let (solved, skipped) = solved.map_or_else(|why| (None, Some(why)), |solved| (Some(solved), None));
            let seconds = solved.map(|(seconds, _)| seconds);
            Self {
                case: contest.name.clone(),
                points: surface.grid().shape()[0],
                steps: STEPS,
                code: code.into(),
                version,
                seconds,
                time_error: solved.map(|(_, error)| error),
                ratio: seconds.zip(ours).map(|(seconds, ours)| seconds / ours),
                skipped,
            }
        };
        let mut ours = Vec::new();
        let mut pressure = reference.clone();
        for _ in 0..repeats.get() {
            let clock = Instant::now();
            pressure = contest.pressure(STEPS, stop)?;
            ours.push(clock.elapsed().as_secs_f64());
        }
        ours.sort_by(f64::total_cmp);
        let seconds = median(&ours);
        let version = Some(env!("CARGO_PKG_VERSION").to_owned());
        show(row("asperity", version, Ok((seconds, distance(&pressure, &reference))), Some(seconds)));
        let task = json!({
            "pressure": contest.problem.expected_mean_pressure(),
            "tolerance": stop.tolerance(),
            "relaxed": RELAXED,
            "element": RELAXED * ELEMENT.ratio / (1.0 - ELEMENT.ratio),
            "time": ELEMENT.time,
            "duration": DURATION,
            "steps": STEPS,
        });
        let mut version = None;
        let solved = Peer::Tamaas.run(python, surface, task, rayon::current_num_threads()).map(|found| {
            version = Some(found.version);
            let pressure = Field::from_shape_vec(reference.raw_dim(), found.pressure);
            (found.seconds, pressure.map_or(f64::NAN, |pressure| distance(&pressure, &reference)))
        });
        show(row(Peer::Tamaas.into(), version, solved, Some(seconds)));
        Ok(())
    }
}

/// The root mean square of the difference of two fields over that of the second one.
fn distance(field: &Field, other: &Field) -> f64 {
    let square = |field: &Field| field.iter().map(|value| value * value).sum::<f64>();
    (square(&(field - other)) / square(other)).sqrt()
}

impl fmt::Display for CreepTiming {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let code = format!("{} {}", self.code, self.version.as_deref().unwrap_or_default());
        let points = format!("{0}x{0}", self.points);
        write!(f, "{:<22} {points:>11} {:>5} {code:<24}", self.case, self.steps)?;
        if let Some(reason) = &self.skipped {
            return write!(f, " skipped: {reason}");
        }
        let [seconds, ratio] = [self.seconds, self.ratio].map(|value| or_dash(value, |value| format!("{value:.3}")));
        write!(f, " {seconds:>9} {:>8} {ratio:>8}", or_dash(self.time_error, |error| format!("{error:.1e}")))
    }
}

//! Histories that several codes go through: what happens to a rough surface, step by step.

use super::peer::Peer;
use crate::Grid;
use crate::adhesion::{AdhesiveMethod, AdhesiveProblem, Attraction, AttractionForm};
use crate::contact::{ContactModulus, FieldKind, Load, Multilevel, Problem, State, Stop};
use crate::elastic::{Prony, PronyTerm};
use crate::error::{HistoryError, SetupError};
use crate::history::{AdhesiveProcess, CreepProcess, PathPoint, Process, SlipHistory, SlipPace, SlipProcess};
use crate::surface::{Field, Roughness, Spectrum, Surface};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Points along each side of the surface, and of a smaller one.
const SIDES: [usize; 2] = [256, 128];
/// The root-mean-square gradient of a surface.
const SLOPE: f64 = 1e-3;

/// The contact modulus after all relaxation. Tamaas 2.9.0 agrees with other solutions only where the relaxed shear modulus is 1.
const RELAXED: f64 = 2.0;
/// The share of the modulus that relaxes, the time of that, and the time for which the load is held.
const ELEMENT: PronyTerm = PronyTerm { ratio: 0.9, time: 1.0 };
const DURATION: f64 = 5.0;
/// Steps in time, and how many times as many the reference has.
const STEPS: usize = 20;
const FINER: usize = 16;

/// Mean gaps over the root-mean-square height, down and up again.
const GAPS: [f64; 11] = [3.0, 2.6, 2.2, 1.8, 1.4, 1.0, 1.4, 1.8, 2.2, 2.6, 3.0];
/// The range of the attraction over the root-mean-square height, and its process zone in spacings.
const RANGE: f64 = 0.3;
const ZONE: f64 = 4.0;

/// Coefficient of friction and Poisson's ratio of the solid on a rigid surface.
const FRICTION: f64 = 0.3;
const POISSON: f64 = 0.3;
/// Mean pressures over `g E*`, and pulls over the limit of friction of the first of them.
const PRESSES: [f64; 4] = [0.02, 0.02, 0.03, 0.03];
const PULLS: [f64; 4] = [0.0, 0.5, 0.75, 0.2];

/// The tolerance of the reference where it has the same steps.
const TIGHT: f64 = 1e-11;

/// A rough surface with its history.
pub struct HistoryContest {
    name: String,
    problem: Problem,
    kind: Kind,
}

/// What happens to a surface.
enum Kind {
    /// A held load, on a solid that creeps.
    Creep(Load, Prony),
    /// Mean gaps down and up, with an attraction.
    Adhesion(Vec<f64>, Attraction),
    /// Mean pressures, and pulls along `x`, with friction.
    Slip(Vec<[f64; 2]>),
}

impl HistoryContest {
    /// The contests, or smaller ones of their kind, with a rough surface of a seed.
    ///
    /// # Errors
    /// A contact that cannot be posed.
    pub fn all(is_quick: bool, seed: u64) -> Result<Vec<Self>, SetupError> {
        let side = SIDES[usize::from(is_quick)];
        let grid = Grid::surface([side; 2], [1.0; 2])?;
        let rough = |grid: Grid, spacings: f64| {
            let short_cutoff = spacings / side as f64;
            let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff, rms_gradient: SLOPE };
            Surface::rough(grid, &spectrum, seed)
        };
        let fine = rough(grid, 4.0)?;
        Ok(vec![
            Self::creep(fine.clone(), 2e-3)?,
            Self::creep(fine, 2e-2)?,
            Self::adhesion(rough(grid, 16.0)?)?,
            Self::slip(rough(grid.with_periodic([false; 2]), 4.0)?)?,
        ])
    }

    fn creep(surface: Surface, pressure: f64) -> Result<Self, SetupError> {
        let load = Load::ReducedPressure(pressure);
        let problem = Problem::new(surface, ContactModulus(RELAXED / (1.0 - ELEMENT.ratio)), load)?;
        let kind = Kind::Creep(load, Prony::from_relaxation(&[ELEMENT])?);
        Ok(Self { name: format!("creep p* {pressure}"), problem, kind })
    }

    fn adhesion(surface: Surface) -> Result<Self, SetupError> {
        let height = Roughness::new(&surface).rms_height;
        let (range, spacing) = (RANGE * height, surface.grid().spacing()[1]);
        let work = range * range / (PI * ZONE * spacing);
        let attraction = Attraction::new(AttractionForm::Exponential, work, range)?;
        let gaps = GAPS.map(|gap| gap * height).to_vec();
        // the load is that of the path; nothing may touch at its first mean gap
        let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(attraction.strength()))?;
        Ok(Self { name: "adhesion".into(), problem, kind: Kind::Adhesion(gaps, attraction) })
    }

    fn slip(surface: Surface) -> Result<Self, SetupError> {
        let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(PRESSES[0]))?;
        let unit = problem.rms_gradient();
        let limit = FRICTION * PRESSES[0] * unit;
        let path = PRESSES.into_iter().zip(PULLS).map(|(press, pull)| [press * unit, pull * limit]).collect();
        Ok(Self { name: "slip, free".into(), problem, kind: Kind::Slip(path) })
    }

    /// Name in tables.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The surface.
    pub(super) fn surface(&self) -> &Surface {
        self.problem.surface()
    }

    /// The steps.
    pub(super) fn steps(&self) -> usize {
        match &self.kind {
            Kind::Creep(..) => STEPS,
            Kind::Adhesion(gaps, _) => gaps.len(),
            Kind::Slip(path) => path.len(),
        }
    }

    /// The other code that goes through the history.
    pub(super) fn peer(&self) -> Peer {
        match self.kind {
            Kind::Creep(..) => Peer::Tamaas,
            Kind::Adhesion(..) => Peer::Adhesion,
            Kind::Slip(_) => Peer::Aspher,
        }
    }

    /// The history in the words of the script that runs other codes.
    pub(super) fn task(&self, tolerance: f64) -> Value {
        match &self.kind {
            Kind::Creep(..) => json!({
                "kind": "creep",
                "tolerance": tolerance,
                "pressure": self.problem.expected_mean_pressure(),
                "relaxed": RELAXED,
                "element": RELAXED * ELEMENT.ratio / (1.0 - ELEMENT.ratio),
                "time": ELEMENT.time,
                "duration": DURATION,
                "steps": STEPS,
            }),
            Kind::Adhesion(gaps, attraction) => json!({
                "kind": "adhesion",
                "tolerance": tolerance,
                "work": attraction.work(),
                "reach": attraction.range(),
                "gaps": gaps,
            }),
            Kind::Slip(path) => json!({
                "kind": "slip",
                "tolerance": tolerance,
                "friction": FRICTION,
                "poisson": POISSON,
                "path": path,
            }),
        }
    }

    /// The traction at the end of the history: the normal one, less the attraction; of a contact that slips that along `x`.
    ///
    /// # Errors
    /// A step that is not solved.
    pub(super) fn traction(&self, stop: &Stop) -> Result<Field, HistoryError> {
        self.at_end(STEPS, stop)
    }

    /// A better solution of [`HistoryContest::traction`]: in more steps in time, otherwise to a smaller tolerance.
    ///
    /// # Errors
    /// A step that is not solved.
    pub(super) fn reference(&self, stop: &Stop) -> Result<Field, HistoryError> {
        match self.kind {
            Kind::Creep(..) => self.at_end(FINER * STEPS, stop),
            _ => self.at_end(STEPS, &stop.at(TIGHT)),
        }
    }

    /// The traction at the end, in some steps in time.
    fn at_end(&self, steps: usize, stop: &Stop) -> Result<Field, HistoryError> {
        let problem = self.problem.clone();
        match &self.kind {
            Kind::Creep(load, prony) => {
                let path = [0.0, DURATION].map(|time| PathPoint { time: Some(time), ..PathPoint::under(*load) });
                let history = (problem, prony.clone());
                let mut process = CreepProcess::new(history, &path, (Some(steps), 0.0), (&Multilevel, *stop))?;
                Ok(last(&mut process)?.contact.pressure)
            }
            Kind::Adhesion(gaps, attraction) => {
                let path = gaps.iter().map(|&gap| PathPoint::under(Load::MeanGap(gap))).collect();
                let sticky = AdhesiveProblem::new(problem, attraction.clone())?;
                let state = last(&mut AdhesiveProcess::new(sticky, path, 1, AdhesiveMethod::Fast, *stop))?;
                let attraction = state.field(FieldKind::Attraction);
                Ok(attraction
                    .map_or_else(|| state.contact.pressure.clone(), |attraction| &state.contact.pressure - attraction))
            }
            Kind::Slip(path) => {
                let ratio = POISSON / (1.0 - POISSON);
                let history = SlipHistory::sheared(problem, FRICTION, ratio, &Multilevel, *stop)?;
                let point = |&[press, pull]: &[f64; 2]| PathPoint {
                    tangential: Some(pull),
                    ..PathPoint::under(Load::MeanPressure(press))
                };
                let state = last(&mut SlipProcess::new(history, path.iter().map(point).collect(), SlipPace::Count(1)))?;
                Ok(state
                    .field(FieldKind::Traction)
                    .cloned()
                    .unwrap_or_else(|| Field::zeros(state.contact.pressure.raw_dim())))
            }
        }
    }
}

/// The state at the end of a history.
fn last(process: &mut dyn Process) -> Result<State, HistoryError> {
    let mut last = Err(HistoryError::Pathless);
    while let Some(state) = process.next(&mut ()) {
        let mut state = state?;
        state.contact = state.contact.converged()?;
        last = Ok(state);
    }
    last
}

//! A viscoelastic solid in time.

use crate::contact::{Feels, Problem, Quantity, State};
use crate::elastic::Prony;
use crate::error::SetupError;
use crate::history::CreepProcess;
use crate::setup::cost::bytes;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::key::{Dimension, FlagValue, Key, key};
use crate::setup::{Setup, Solid};
use crate::warning::Warning;
use std::sync::Arc;

/// The estimated relative error in time, if none is given.
const TIME_TOLERANCE: f64 = 1e-2;

/// Steps between two points of a path in time that are expected where the error in time chooses them.
const EXPECTED_STEPS: usize = 32;

/// Fields that creep takes besides its solves, lines and surfaces, and for each term of the Prony series: the history is followed in doubled steps as well,
/// with a memory for each term. Measured as the peak of resident memory.
const FIELDS: [f64; 2] = [17.0, 16.0];
const TERM_FIELDS: f64 = 10.3;

/// Errors in time of the pressure of states with less than this part of the largest mean pressure are not compared with the tolerance, and those of the
/// gap are divided by at least this part of the rms height.
const SMALL: f64 = 1e-2;

#[rustfmt::skip]
const KEYS: &[Key] = &[
    key("viscoelastic.creep", "creep", FlagValue::List, Dimension::Time, "F,TAU[,...]", "Creep of a viscoelastic solid: pairs of a ratio and a retardation time; the modulus is the one at once after loading; needs --path-time, --path or --speed").named("retardation time"),
    key("viscoelastic.relaxation", "relaxation", FlagValue::List, Dimension::Time, "G,TAU[,...]", "Relaxation of a viscoelastic solid, instead of --creep: pairs of a share of the modulus and a relaxation time").named("relaxation time"),
];

/// A viscoelastic solid in time, under loads that change along a path.
pub(crate) const CREEP: Drive = Drive {
    name: "creep",
    keys: KEYS,
    given: Ingredient { path: "viscoelastic", name: "creep", is_given: |it| it.viscoelastic.is_some() },
    takes: &["path", "law.hardness", "solver.method"],
    needs: &["path.time"],
    states: |it| it.states_of_path(EXPECTED_STEPS),
    check: |_, _| Ok(()),
    bytes: |it, grid| {
        let terms = it.memory()?.len() as f64;
        Ok(bytes(grid, FIELDS[usize::from(!grid.is_line())] + TERM_FIELDS * terms))
    },
    transforms: |_, _| Ok(Drive::TRANSFORMS_OF_WARM_STATE),
    make: |it, problem| Ok(Box::new(it.creep(problem)?)),
    doubts: |it, states| it.warnings_of_creep().into_iter().chain(warning_of_time_errors(it, states)).collect(),
    totals: |_| Vec::new(),
    needs_pressure: false,
    is_list: false,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: Some(Quantity::Time),
    is_logarithmic: false,
    charts: [
        StateChart::against(Quantity::Time, Quantity::RelativeArea),
        StateChart::against(Quantity::Time, Quantity::MeanGap),
    ],
    columns: &[
        Quantity::Time,
        Quantity::MeanPressure,
        Quantity::RelativeArea,
        Quantity::KappaR,
        Quantity::MeanGap,
        Quantity::EffectivePressure,
        Quantity::Dissipated,
        Quantity::DissipatedTimeError,
        Quantity::TimeError,
        Quantity::Certificate,
    ],
    caption: &[Quantity::Time],
    has_claims: false,
    feels: Feels::MEMORY,
};

impl Setup {
    /// Whether the solid creeps under a contact that does not slide.
    pub(in crate::setup) fn creeps(&self) -> bool {
        self.viscoelastic.is_some() && self.sliding.is_none()
    }

    /// The Prony series of the solid; without terms for one that does not creep.
    pub(in crate::setup) fn prony(&self) -> Result<Prony, SetupError> {
        Ok(self.viscoelastic.as_ref().map(crate::setup::Viscoelastic::prony).transpose()?.unwrap_or_default())
    }

    /// The terms of a solid that creeps, a ratio and a time each.
    pub(crate) fn memory(&self) -> Result<Vec<(f64, f64)>, SetupError> {
        Ok(self.prony()?.terms().iter().map(|term| (term.ratio, term.time)).collect())
    }

    /// The tolerance of relative errors in time.
    pub fn time_tolerance(&self) -> f64 {
        self.path.as_ref().and_then(|path| path.time_tolerance).unwrap_or(TIME_TOLERANCE)
    }

    /// What makes the history of a problem on a solid that creeps along the path of this setup.
    ///
    /// # Errors
    /// The errors of [`Viscoelastic::prony`](crate::setup::Viscoelastic::prony) and of [`CreepProcess::new`].
    pub fn creep(&self, problem: Problem) -> Result<CreepProcess<'_>, SetupError> {
        let steps = self.path.as_ref().and_then(|path| path.steps);
        let (points, solver) = (self.path_points(), self.solver.solver());
        let steps = (steps, self.time_tolerance());
        Ok(CreepProcess::new((problem, self.prony()?), &points, steps, (solver, self.stop))?)
    }

    /// Warnings about a solid that creeps: a path that begins late, and a creep that two bodies share.
    pub fn warnings_of_creep(&self) -> Vec<Warning> {
        if self.viscoelastic.is_none() {
            return Vec::new();
        }
        let times = self.path.as_ref().map_or(&[][..], |path| &path.time);
        let late = times.first().filter(|first| times.len() > 1 && **first > 0.0).map(|first| {
            Warning::new(
                format!("The path begins at the time {first:?}, so its first load acts from the time 0 on"),
                "Begin the path at the time 0 with the load that acts there",
            )
            .with_remedy("path.time", None)
        });
        let shared = self.solid.as_ref().and_then(Solid::compliance_shares).map(|[first, second]| {
            Warning::new(
                "Two bodies and one creep are given, so both bodies creep alike",
                format!(
                    "If only one body creeps, multiply the ratios of its creep by its share of the compliance: {first:.3} for the first \
                     body, {second:.3} for the second"
                ),
            )
        });
        late.into_iter().chain(shared).collect()
    }
}

/// The warning that errors in time are above the tolerance: those of all quantities that it limits.
fn warning_of_time_errors(setup: &Setup, states: &[Arc<State>]) -> Option<Warning> {
    let (tolerance, count) = (setup.time_tolerance(), states.len());
    let mut above = Vec::new();
    for (name, errors) in [
        ("contact pressure", pressure_time_errors(states)),
        ("mean gap", gap_time_errors(states)),
        ("lost energy", loss_time_errors(states)),
    ] {
        let missed = errors.iter().filter(|error| **error > tolerance).count();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        if missed > 0 {
            above.push(format!("of the {name} in {missed} of {count} states (largest {largest:.1e})"));
        }
    }
    (!above.is_empty()).then(|| {
        Warning::new(
            format!("The estimated error in time is above the tolerance of {tolerance:e}: {}", above.join(", ")),
            "Read the stated errors in time, or use a smaller tolerance of the error in time",
        )
        .with_remedy("path.time-tolerance", None)
    })
}

/// The relative errors in time of the contact pressure, of states whose mean pressure is not small.
fn pressure_time_errors(states: &[Arc<State>]) -> Vec<f64> {
    let largest = states.iter().map(|it| it.contact.mean_pressure()).fold(0.0, f64::max);
    let pressed = states.iter().filter(|it| it.contact.mean_pressure() >= SMALL * largest);
    pressed.filter_map(|it| it.get(Quantity::TimeError)).collect()
}

/// The errors in time of the mean gap over that, or over a small part of the rms height.
fn gap_time_errors(states: &[Arc<State>]) -> Vec<f64> {
    let size = |it: &State| it.contact.mean_gap().max(SMALL * it.contact.problem.rms_height());
    let relative = |it: &Arc<State>| Some(it.get(Quantity::MeanGapTimeError)? / size(it));
    states.iter().filter_map(relative).collect()
}

/// The errors in time of the lost energy over that at the next point of the path: on the way there it may be as small as one likes.
fn loss_time_errors(states: &[Arc<State>]) -> Vec<f64> {
    let (mut errors, mut at_point) = (Vec::new(), None);
    for state in states.iter().rev() {
        let (Some(error), Some(lost)) = (state.get(Quantity::DissipatedTimeError), state.get(Quantity::Dissipated))
        else {
            continue;
        };
        if state.point.is_some() || at_point.is_none() {
            at_point = Some(lost);
        }
        if let Some(size) = at_point.filter(|size| *size > 0.0) {
            errors.push(error / size);
        }
    }
    errors
}

//! The load at which a contact seals.

use super::{FlowAxis, Percolation};
use crate::contact::{Contact, Load, Observables, Observer, Problem, Solver, Stop};
use crate::error::SealError;
use crate::surface::Field;
use serde::Serialize;

/// The reduced pressure from which on a contact is looked for that seals, about that of random roughness.
const START: f64 = 0.2;
/// Factor between two loads as long as one of both sides is not known.
const FACTOR: f64 = 1.5;
/// The lowest and the highest reduced pressure.
const ENDS: [f64; 2] = [1e-6, 1e6];
/// The highest mean pressure over the hardness, if there is one: then all but a thousandth of the nodes touch.
const BELOW_HARDNESS: f64 = 0.999;
/// The smallest relative width: solvers tell loads apart that are farther from each other.
const SMALLEST_WIDTH: f64 = 1e-9;

/// The load at which the open area stops to connect two sides of the cell, between a load at which it does and one at which it does not.
///
/// Contacts grow with the load: what touches under a load also touches under a higher one. So the open area
/// percolates below one load and not above it, and this load is found by bisection. Each contact is solved from the one before.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
/// use asperity::flow::{FlowAxis, PercolationLoad};
/// use asperity::{Grid, Problem, Surface, surface::Spectrum};
/// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.06, rms_gradient: 1e-2 };
/// let surface = Surface::rough(Grid::surface([64, 64], [1.0, 1.0])?, &spectrum, 1)?;
/// let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
/// let found = PercolationLoad::new(&problem, &Multilevel, &Stop::default(), FlowAxis::X, 0.01, |_| ())?;
/// assert!(found.open.reduced_pressure < found.sealed.reduced_pressure && found.width() < 0.01);
/// assert!(found.sealed.relative_area > 0.2 && found.sealed.relative_area < 0.6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PercolationLoad {
    /// The axis between whose sides fluid would flow.
    pub axis: FlowAxis,
    /// The contact under the highest load at which the open area was seen to percolate.
    pub open: PercolationState,
    /// The contact under the lowest load at which it was seen not to.
    pub sealed: PercolationState,
    /// The number of contacts that were solved.
    pub solves: usize,
}

/// A contact beside the load at which it seals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PercolationState {
    /// The reduced pressure `p*`.
    pub reduced_pressure: f64,
    /// The mean pressure.
    pub mean_pressure: f64,
    /// The mean gap.
    pub mean_gap: f64,
    /// The relative area, with edges interpolated between the nodes.
    pub relative_area: f64,
    /// The share of nodes in contact. These decide whether the open area percolates.
    pub relative_area_counted: f64,
    /// The share of nodes in contact, corrected for the length of the edges.
    pub relative_area_corrected: f64,
}

impl PercolationLoad {
    /// Finds the load at which the surface of a problem seals along an axis, to a relative width; the load of the problem is not used.
    /// `watch` makes the observer of each solve, by its number from 0 on.
    ///
    /// # Errors
    /// [`SealError::Width`] for a width below 1e-9 or from 1 on, [`SealError::Line`] for a line, which one node in contact seals,
    /// [`SealError::Always`] and [`SealError::Never`] for a surface that seals under no load, or under all; and the errors of the solver, also
    /// for contacts that do not converge.
    pub fn new<O: Observer>(
        problem: &Problem,
        solver: &dyn Solver,
        stop: &Stop,
        axis: FlowAxis,
        width: f64,
        watch: impl FnMut(usize) -> O,
    ) -> Result<Self, SealError> {
        if !(SMALLEST_WIDTH..1.0).contains(&width) {
            return Err(SealError::Width { value: width });
        }
        if problem.surface().grid().is_line() {
            return Err(SealError::Line);
        }
        let mut search = LoadSearch { problem, solver, stop, axis, watch, start: None, solves: 0 };
        let [mut open, mut sealed] = search.bracket()?;
        while sealed.reduced_pressure - open.reduced_pressure > width * sealed.reduced_pressure {
            let (state, is_open) = search.solve(0.5 * (open.reduced_pressure + sealed.reduced_pressure))?;
            *(if is_open { &mut open } else { &mut sealed }) = state;
        }
        Ok(Self { axis, open, sealed, solves: search.solves })
    }

    /// The distance of both loads, relative to the upper one.
    pub fn width(&self) -> f64 {
        1.0 - self.open.reduced_pressure / self.sealed.reduced_pressure
    }
}

/// A search that goes on from contact to contact.
struct LoadSearch<'a, W> {
    problem: &'a Problem,
    solver: &'a dyn Solver,
    stop: &'a Stop,
    axis: FlowAxis,
    watch: W,
    /// The pressure of the last contact.
    start: Option<Field>,
    solves: usize,
}

impl<O: Observer, W: FnMut(usize) -> O> LoadSearch<'_, W> {
    /// The contact under a load, and whether the open area percolates.
    fn solve(&mut self, reduced_pressure: f64) -> Result<(PercolationState, bool), SealError> {
        let problem = self.problem.clone().with_load(Load::ReducedPressure(reduced_pressure))?;
        let mut observer = (self.watch)(self.solves);
        let contact = self.solver.solve_from(self.start.as_ref(), &problem, self.stop, &mut observer)?.converged()?;
        self.solves += 1;
        let is_open = Percolation::from_contact(&contact).open_percolates(self.axis);
        let state = PercolationState::new(&contact, reduced_pressure);
        self.start = Some(contact.pressure);
        Ok((state, is_open))
    }

    /// A load at which the open area percolates, and one at which it does not.
    fn bracket(&mut self) -> Result<[PercolationState; 2], SealError> {
        let [lowest, highest] = self.ends();
        let (mut last, is_open) = self.solve(START.min(highest))?;
        loop {
            let next = if is_open { last.reduced_pressure * FACTOR } else { last.reduced_pressure / FACTOR };
            let next = next.clamp(lowest, highest);
            if next == last.reduced_pressure {
                return Err(self.failure(is_open, last));
            }
            let (state, is_next_open) = self.solve(next)?;
            match (is_open, is_next_open) {
                (true, false) => return Ok([last, state]),
                (false, true) => return Ok([state, last]),
                _ => last = state,
            }
        }
    }

    /// The lowest and the highest reduced pressure.
    fn ends(&self) -> [f64; 2] {
        let unit = self.problem.rms_gradient() * self.problem.contact_modulus();
        let hardness = self.problem.law().hardness().unwrap_or(f64::INFINITY);
        let highest = ENDS[1].min(BELOW_HARDNESS * hardness / unit);
        [ENDS[0].min(highest / ENDS[1]), highest]
    }

    fn failure(&self, is_open: bool, last: PercolationState) -> SealError {
        let (axis, reduced_pressure) = (self.axis.name(), last.reduced_pressure);
        if is_open { SealError::Never { axis, reduced_pressure } } else { SealError::Always { axis, reduced_pressure } }
    }
}

impl PercolationState {
    fn new(contact: &Contact, reduced_pressure: f64) -> Self {
        let it = Observables::new(contact);
        Self {
            reduced_pressure,
            mean_pressure: it.mean_pressure,
            mean_gap: it.mean_gap,
            relative_area: it.relative_area,
            relative_area_counted: it.relative_area_counted,
            relative_area_corrected: it.relative_area_corrected,
        }
    }
}

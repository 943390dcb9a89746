//! Loads one after the other on one surface.

use super::flattened::Flattened;
use super::process::{PathPoint, Process};
use super::sliding::Sliding;
use crate::contact::{Contact, Load, Observer, Problem, Solver, State, Stop};
use crate::error::HistoryError;
use crate::surface::Field;

/// The process of a list of loads: each contact is solved from the pressure under the load before.
///
/// With a hardness, plastic deformation remains: a load that is not higher than an earlier one is solved on the surface after the highest load, see
/// [`Contact::unloaded_surface`], which is elastic. A higher load is solved on the original surface with the hardness, so loading does not depend on
/// the intermediate loads.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Quantity, Stop};
/// use asperity::history::{Loading, Process};
/// use asperity::{Grid, Indenter, Problem};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 4.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-3))?;
/// let loads = [1e-3, 2e-3, 1e-3].map(Load::MeanPressure);
/// let mut areas = Vec::new();
/// Loading::new(problem, &Multilevel, Stop::default()).along(loads.into()).run(&mut (), &mut |state| {
///     areas.push(state.value(Quantity::RelativeAreaCounted));
///     Ok(())
/// })?;
/// // without friction and adhesion there is no hysteresis
/// assert!(areas[0] < areas[1] && areas[0] == areas[2]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Loading<'s> {
    problem: Problem,
    solver: &'s dyn Solver,
    stop: Stop,
    loads: Vec<Load>,
    /// The number of the next load.
    next: usize,
    /// The pressure to start from.
    start: Option<Field>,
    flattened: Option<Flattened>,
}

impl<'s> Loading<'s> {
    /// The process of a problem, whose own load is not used, without loads.
    pub fn new(problem: Problem, solver: &'s dyn Solver, stop: Stop) -> Self {
        Self { problem, solver, stop, loads: Vec::new(), next: 0, start: None, flattened: None }
    }

    /// The process along some loads.
    pub fn along(self, loads: Vec<Load>) -> Self {
        Self { loads, ..self }
    }

    /// The process whose first solve starts from a pressure, shape `(ny, nx)`.
    pub fn started_from(self, start: Option<Field>) -> Self {
        Self { start, ..self }
    }

    /// The problem under a load, on the surface that the loads before have left.
    ///
    /// # Errors
    /// For a load that cannot be, such as a mean gap after the surface has yielded.
    pub fn problem(&self, load: Load) -> Result<Problem, HistoryError> {
        let problem = self.problem.clone().with_load(load)?;
        let elastic = self.flattened.as_ref().map_or(Ok(None), |it| it.elastic(&problem))?;
        Ok(elastic.unwrap_or(problem))
    }

    /// The pressure to start the next solve from, shape `(ny, nx)`.
    pub fn start(&self) -> Option<&Field> {
        self.start.as_ref()
    }

    /// Goes on from a contact under a load that was solved elsewhere.
    pub fn take(&mut self, contact: &Contact) {
        self.flattened = Flattened::by(contact).or(self.flattened.take());
        self.start = Some(contact.pressure.clone());
    }
}

impl Process for Loading<'_> {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let (number, &load) = (self.next, self.loads.get(self.next)?);
        self.next += 1;
        let state = self.move_to(PathPoint::under(load), observer);
        if state.is_err() {
            self.next = self.loads.len();
        }
        Some(state.map(|state| state.at(Some(number))))
    }

    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let problem = self.problem(point.load)?;
        let contact = self.solver.solve_from(self.start.as_ref(), &problem, &self.stop, observer)?;
        self.take(&contact);
        Ok(State::from_contact(Sliding::measured(contact), None))
    }
}

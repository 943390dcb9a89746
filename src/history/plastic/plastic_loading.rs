//! The process of a list of loads on a solid that yields below its surface.

use super::{Plastic, PlasticErrors, PlasticState};
use crate::contact::{Load, Observer, Quantity, ResultClaim, State, StateField, StateKind, StateValues};
use crate::error::{HistoryError, PlasticError};
use crate::history::process::{PathPoint, Process};

/// The process of a list of loads, up and down, on a solid that yields below its surface, with a number of equal steps from each load to the next.
///
/// With [`PlasticLoading::with_step_errors`] the same loads are solved beside it in steps of twice the length, and the difference of both estimates the error of the
/// steps.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, PolonskyKeer, Quantity};
/// use asperity::elastic::DepthLayers;
/// use asperity::history::{Plastic, PlasticLoading, PlasticSolid, Process};
/// use asperity::{Grid, Indenter, Problem};
/// let solid = PlasticSolid::new(1.0, 0.3, 0.005, 0.05)?;
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(128, 1.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(solid.contact_modulus()), Load::MeanPressure(1e-3))?;
/// let plastic = Plastic::new(problem, solid, DepthLayers::below(1.0 / 128.0, 0.2)?, &PolonskyKeer)?;
/// let loads = [1e-3, 2e-3, 0.0].map(Load::MeanPressure);
/// let mut loading = PlasticLoading::new(plastic, loads.into(), 4)?.with_step_errors()?;
/// let mut work = Vec::new();
/// loading.run(&mut (), &mut |state| {
///     work.push(state.value(Quantity::WorkDone));
///     Ok(())
/// })?;
/// // a part of the work comes back
/// assert!(0.0 < work[0] && work[0] < work[2] && work[2] < work[1]);
/// let (imprint, errors) = (loading.plastic().state().imprint_depth(), loading.step_errors().expect("asked for"));
/// assert!(errors.imprint_depth < 0.1 * imprint);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PlasticLoading<'s> {
    plastic: Plastic<'s>,
    /// The same in half as many steps.
    coarser: Option<Plastic<'s>>,
    loads: Vec<Load>,
    steps: usize,
    next: usize,
}

impl<'s> PlasticLoading<'s> {
    /// The process along some loads, from the last state on, with a number of steps between two loads, at least one.
    ///
    /// # Errors
    /// [`PlasticError::Range`] for no steps.
    pub fn new(plastic: Plastic<'s>, loads: Vec<Load>, steps: usize) -> Result<Self, PlasticError> {
        if steps == 0 {
            return Err(PlasticError::Range { name: "the number of steps", value: 0.0, range: "[1, infinity)" });
        }
        Ok(Self { plastic, coarser: None, loads, steps, next: 0 })
    }

    /// The process with twice as many steps, beside another one with as many as now. It takes half as much work again, and twice the memory.
    ///
    /// # Errors
    /// [`PlasticError::Memory`].
    pub fn with_step_errors(self) -> Result<Self, PlasticError> {
        let coarser = Some(self.plastic.branched()?);
        Ok(Self { coarser, steps: 2 * self.steps, ..self })
    }

    /// The process of the solid, with its last state.
    pub fn plastic(&self) -> &Plastic<'s> {
        &self.plastic
    }

    /// The estimated error of the last state by its steps; none if it was not asked for.
    pub fn step_errors(&self) -> Option<PlasticErrors> {
        self.coarser.as_ref().map(|coarser| PlasticErrors::between(self.plastic.state(), coarser.state()))
    }
}

impl Process for PlasticLoading<'_> {
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
        if let Some(coarser) = &mut self.coarser {
            coarser.press_in(self.steps / 2, point.load, &mut ())?;
        }
        Ok(self.plastic.press_in(self.steps, point.load, observer)?.to_state())
    }
}

impl PlasticState {
    /// The state as one of any history, with the imprint as a further field.
    pub fn to_state(&self) -> State {
        let values = StateValues::new(StateKind::Plastic)
            .with(Quantity::ReducedPressure, self.load.and_then(|load| load.reduced_pressure()))
            .with(Quantity::Dissipated, self.energy.plastic)
            .with(Quantity::Stored, self.energy.elastic)
            .with(Quantity::WorkDone, self.energy.work);
        let fields = vec![StateField::imprint(self.residual.clone())];
        State::new(self.contact.clone().with_values(values), ResultClaim::Solution).with_fields(fields)
    }
}

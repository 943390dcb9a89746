//! The process of a list of loads on a solid that yields below its surface.

use super::companions::Companions;
use super::{Plastic, PlasticErrorSources, PlasticState};
use crate::contact::{Feels, FieldKind, Load, Observer, Quantity, ResultClaim, State, StateField, StateValues, Status};
use crate::elastic::DepthLayers;
use crate::error::{HistoryError, PlasticError};
use crate::grid::Grid;
use crate::history::process::{PathPoint, Process};
use std::collections::VecDeque;

/// The process of a list of loads, up and down, on a solid that yields below its surface, with a number of equal steps from each load to the next. Each
/// step is a state; those at the loads have a [point](State::point). The cut of each state goes through the layers that were there at first, also where more were added. If the process keeps its [iterations](Plastic::with_iterations), they are states as well,
/// with the claim [`ResultClaim::Moving`].
///
/// With [`PlasticLoading::with_errors`] the same loads are solved beside it in finer steps, coarser layers and on a coarser grid, which estimates the errors by
/// all three.
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
/// let mut loading = PlasticLoading::new(plastic, loads.into(), 4)?.with_errors()?;
/// let mut work = Vec::new();
/// loading.run(&mut (), &mut |state| {
///     work.extend(state.point.map(|_| state.value(Quantity::WorkDone)));
///     Ok(())
/// })?;
/// // four steps are too few to tell the work up to the first load within 1 %
/// assert!(work[0].is_nan());
/// // a part of the work up to the second load comes back
/// assert!(0.0 < work[2] && work[2] < work[1]);
/// let (imprint, errors) = (loading.plastic().state().imprint_depth(), loading.errors().expect("asked for"));
/// assert!(errors.steps.imprint_depth < 0.1 * imprint && errors.layers.imprint_depth < 0.1 * imprint);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PlasticLoading<'s> {
    plastic: Plastic<'s>,
    /// The same loads solved otherwise, if errors are estimated.
    companions: Option<Companions<'s>>,
    /// The layers at first, through which the cuts of all states go.
    layers: usize,
    /// The number of the load before the first one.
    start: f64,
    loads: Vec<Load>,
    steps: usize,
    /// The number of the next step.
    next: usize,
    /// States that are found, the next one first.
    queue: VecDeque<State>,
}

impl<'s> PlasticLoading<'s> {
    /// The process along some loads of one kind, from the last state on, with a number of steps between two loads, at least one.
    ///
    /// # Errors
    /// [`PlasticError::Range`] for no steps, and those of [`Plastic::check`] for one of the loads.
    pub fn new(plastic: Plastic<'s>, loads: Vec<Load>, steps: usize) -> Result<Self, PlasticError> {
        if steps == 0 {
            return Err(PlasticError::Range { name: "the number of steps", value: 0.0, range: "[1, infinity)" });
        }
        loads.iter().try_for_each(|load| plastic.check(*load))?;
        let start = loads.first().map_or(0.0, |first| plastic.start_of(*first));
        let layers = plastic.state().layers().count();
        Ok(Self { plastic, companions: None, layers, start, loads, steps, next: 0, queue: VecDeque::new() })
    }

    /// The process with [errors](Self::errors), also among the numbers of its states. It takes about four times the work, and three times the memory.
    ///
    /// # Errors
    /// [`PlasticError::HasBegun`] for a process that is not at rest, and [`PlasticError::Memory`].
    pub fn with_errors(self) -> Result<Self, PlasticError> {
        let companions = Some(Companions::new(&self.plastic)?);
        Ok(Self { companions, ..self })
    }

    /// The process of the solid, with its last state.
    pub fn plastic(&self) -> &Plastic<'s> {
        &self.plastic
    }

    /// The estimated errors of the last state; none if they were not asked for.
    pub fn errors(&self) -> Option<PlasticErrorSources> {
        self.companions.as_ref().map(|companions| companions.errors(&self.plastic))
    }

    /// The bytes of a state that is kept, besides those of its contact.
    pub fn bytes_of_state(grid: &Grid, layers: &DepthLayers) -> f64 {
        let fields = grid.len() + 2 * layers.count() * grid.shape()[1];
        fields as f64 * size_of::<f64>() as f64
    }

    /// The load of a step by its number, from 0, and the point of the path that it reaches, if it does.
    fn step(&self, number: usize) -> Option<(Load, Option<usize>)> {
        let (index, part) = (number / self.steps, number % self.steps + 1);
        let to = *self.loads.get(index)?;
        if part == self.steps {
            return Some((to, Some(index)));
        }
        let from = index.checked_sub(1).map_or(self.start, |before| self.loads[before].value());
        let share = part as f64 / self.steps as f64;
        Some((to.with_value(from + share * (to.value() - from)), None))
    }
}

impl PlasticLoading<'_> {
    /// Presses one step. Its states stand in the queue then: the iterations that are kept, and the end.
    fn press(&mut self, load: Load, point: Option<usize>, observer: &mut dyn Observer) -> Result<(), PlasticError> {
        let state = self.plastic.press(load, observer)?.to_state().at(point);
        self.companions.iter_mut().try_for_each(|companions| companions.press(load, observer))?;
        let state = state.with_numbers(&self.errors().map_or_else(Vec::new, |errors| errors.numbers()));
        let all = self.plastic.take_iterations().iter().map(PlasticState::to_frame).chain([state]).collect::<Vec<_>>();
        let framed = all.into_iter().map(|state| self.framed(state));
        self.queue.extend(framed.collect::<Vec<_>>());
        Ok(())
    }

    /// The state whose cut goes through as many layers as those of the other states.
    fn framed(&self, state: State) -> State {
        state.down_to(self.layers)
    }
}

impl Process for PlasticLoading<'_> {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        if self.queue.is_empty() {
            let (load, point) = self.step(self.next)?;
            self.next += 1;
            if let Err(error) = self.press(load, point, observer) {
                self.loads.clear();
                return Some(Err(error.into()));
            }
        }
        self.queue.pop_front().map(Ok)
    }

    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        self.companions = None;
        self.queue.clear();
        let state = self.plastic.press_in(self.steps, point.load, observer)?.to_state();
        Ok(self.framed(state))
    }
}

impl PlasticState {
    /// The state as one of any history, with the imprint as a further field and the cut below the highest peak.
    pub fn to_state(&self) -> State {
        let pressure_in_contact = self.mean_contact_pressure();
        let touches = pressure_in_contact > 0.0;
        let values = StateValues::new(Feels::EIGENSTRAIN)
            .with(Quantity::ReducedPressure, self.reduced_pressure())
            .with(Quantity::PlasticWork, self.energy.plastic)
            .with(Quantity::Stored, self.energy.elastic)
            .with(Quantity::WorkDone, self.energy.balanced_work())
            .with(Quantity::PressureInContact, touches.then_some(pressure_in_contact))
            .with(Quantity::PressureInContactError, touches.then(|| self.contact.resolution().relative_area_error))
            .with(Quantity::ContactPressureOverYield, touches.then(|| pressure_in_contact / self.solid.yield_stress()))
            .with(Quantity::MaxPlasticStrain, self.max_accumulated())
            .with(Quantity::DeepestYield, self.deepest_yield().unwrap_or(0.0))
            .with(Quantity::PlasticVolume, self.plastic_volume())
            .with(Quantity::ImprintDepth, self.imprint_depth())
            .with(Quantity::StepCertificate, self.certificate.relative_gap);
        let (layers, [plastic_strain, von_mises]) = self.cut();
        let fields = vec![StateField::new(FieldKind::Imprint, self.residual.clone()), plastic_strain, von_mises];
        let contact = self.contact.clone().with_values(values);
        State::new(contact, ResultClaim::LoadStep).with_fields(fields).with_layers(Some(layers))
    }

    /// The state as one on the way, of an iteration.
    fn to_frame(&self) -> State {
        let mut state = self.to_state();
        (state.contact.status, state.claim) = (Status::Converged, ResultClaim::Moving);
        state
    }
}

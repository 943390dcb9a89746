//! The process of adhesion along a path of loads, with its jumps.

use super::adhesive_place::{AdhesivePlace, AdhesiveStep, AdhesiveVisit};
use super::adhesive_search::PlaceSearch;
use super::adhesive_walk::BranchWalk;
use super::process::{PathPoint, Process};
use crate::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveProblem};
use crate::contact::{
    Certificate, Contact, Counted, Feels, FieldKind, Load, Observer, Quantity, ResultClaim, State, StateField,
    StateValues, Status, Stop, Work,
};
use crate::error::HistoryError;
use crate::surface::Field;
use std::collections::VecDeque;
use std::sync::Arc;

/// The part of the way from one point of the path to the next within which a jump is located.
const FINEST: f64 = 5e-5;

/// The same by hand, the longest step of a move over the range of the attraction, and the most steps of one.
const FINEST_BY_HAND: f64 = 1e-3;
const LONGEST: f64 = 0.25;
const MOST_STEPS: f64 = 64.0;

/// The error of the area of nodes that touch, over the mean excess of counted nodes at edges without adhesion. The true excess was 0.7 of it on average
/// and 2.3 times it at most, over that on grids of 3 to 8 times as many points, with process zones of 2 to 3 spacings.
const COUNTING_ERROR: f64 = 1.5;

/// Ranges of the attraction at which surfaces that have parted are drawn, where the attraction has no cut-off.
const APART: f64 = 30.0;

/// The process of adhesion: a number of equal steps from one point of its path to the next.
///
/// Each state is found from the last ones. With the energy `E = 1/2 <p u> + <V>`, the mean pressure `P` and the datum `d` of the gap, a step
/// from state 0 to state 1 loses the energy
///
/// `E_0 - E_1 - int P dd`.
///
/// On a branch it is zero, but for the error of the integral, and the work of the load is the change of the energy. So a step that loses more is
/// halved, until it loses nothing, or until the energy that it loses is known to 1 %: then it is a jump, with a state before it and one after it.
/// Steps between those of the path are not shown. Jumps that lose less than a thousandth of the energy of the attraction are not shown either, but
/// their energy is counted. With an attraction that jumps, such as Dugdale's, each node that comes within its reach or leaves it is a small jump, and
/// the part is a hundredth.
///
/// The stated error of the energy lost adds up the widths of the steps with jumps times half the changes in them, and what the integrals miss
/// on the branches. On free boundaries it is not known: the stability of states is not computed there, and a history in longer steps may stay on a branch
/// that is no longer stable, and jump later.
///
/// Under a mean pressure the surfaces may part. Then nothing is carried, so the mean pressure of the state is zero, whatever is prescribed. The load works
/// without a limit as the surfaces move apart, so that no energy lost belongs to the states from there on.
///
/// With the method `gfmd` each step is a motion. Where it is a jump, also one in which the surfaces part, its frames are states between the
/// one before and the one after. They have the claim [`ResultClaim::Moving`] and are no part of the path.
pub struct AdhesiveProcess {
    search: PlaceSearch,
    path: Vec<PathPoint>,
    steps: usize,
    /// The next point of the path, and the next step on the way to it, from 1.
    at: (usize, usize),
    /// The control at the point before.
    begin: Option<f64>,
    last: Option<AdhesiveVisit>,
    /// States that were found and not yet given.
    queue: VecDeque<State>,
    /// Why the history ends behind them.
    ended: Option<HistoryError>,
}

impl AdhesiveProcess {
    /// The process of a problem along a path of mean pressures (of any sign), mean gaps or approaches.
    pub fn new(
        problem: AdhesiveProblem,
        path: Vec<PathPoint>,
        steps: usize,
        method: AdhesiveMethod,
        stop: Stop,
    ) -> Self {
        let (queue, begin, last, ended) = Default::default();
        let search = PlaceSearch::new(problem, method, stop);
        Self { search, path, steps: steps.max(1), at: (0, 1), begin, last, queue, ended }
    }

    /// The range of the attraction.
    fn range(&self) -> f64 {
        self.search.problem().attraction().range()
    }

    /// Whether the grid is periodic: only then the stability of states is known.
    fn is_periodic(&self) -> bool {
        self.search.problem().problem().surface().grid().is_periodic()
    }

    /// What a load of the path prescribes.
    fn control(&self, load: Load) -> AdhesiveControl {
        let problem = self.search.problem().problem();
        match load {
            Load::MeanPressure(pressure) => AdhesiveControl::MeanPressure(pressure),
            Load::ReducedPressure(reduced) => {
                AdhesiveControl::MeanPressure(reduced * problem.rms_gradient() * problem.contact_modulus())
            }
            Load::Force(force) => AdhesiveControl::MeanPressure(force / problem.surface().grid().area()),
            Load::MeanGap(gap) => AdhesiveControl::MeanGap(gap),
            Load::Approach(approach) => AdhesiveControl::Approach(approach),
        }
    }

    /// A place as a state of any history.
    fn told(&self, visit: AdhesiveVisit, point: Option<usize>) -> State {
        let AdhesiveVisit { place, ledger, jump, work, .. } = visit;
        let values = StateValues::new(Feels::ATTRACTION)
            .with(Quantity::Dissipated, ledger.lost())
            .with(Quantity::DissipatedError, ledger.error().filter(|_| self.is_periodic()))
            .with(Quantity::WorkDone, ledger.work())
            .with(Quantity::LowestPressure, ledger.lowest())
            .with(Quantity::Jump, jump);
        match place {
            AdhesivePlace::State(state) => {
                let state = Arc::unwrap_or_clone(state);
                let stored = state.stored();
                let contact = state.contact;
                let values = values
                    .with(Quantity::MeanPressure, state.mean_pressure)
                    .with(Quantity::ContactPressure, contact.mean_pressure())
                    .with(Quantity::MeanAttraction, state.traction.mean())
                    .with(Quantity::RelativeArea, contact.values().get(Quantity::RelativeArea))
                    .with(Quantity::RelativeAreaError, counting_error(&contact))
                    .with(Quantity::Stored, stored)
                    .with(Quantity::Residual, state.residual)
                    .with(Quantity::LeastCurvature, state.least_curvature)
                    .with(Quantity::CurvatureError, state.curvature_error);
                let fields = vec![StateField::new(FieldKind::Attraction, state.traction)];
                let contact = contact.with_work(work).with_values(values);
                State::new(contact, state.claim).at(point).with_fields(fields)
            }
            AdhesivePlace::Apart => {
                let shape = self.search.problem().problem().surface().grid().shape();
                let nothing = [
                    Quantity::MeanPressure,
                    Quantity::ContactPressure,
                    Quantity::MeanAttraction,
                    Quantity::RelativeArea,
                    Quantity::Stored,
                    Quantity::Residual,
                ];
                let values = nothing.into_iter().fold(values, |values, it| values.with(it, 0.0));
                let contact = self.apart().with_work(work).with_values(values.parted());
                State::new(contact, ResultClaim::Separated)
                    .at(point)
                    .with_fields(vec![StateField::new(FieldKind::Attraction, Field::zeros(shape))])
            }
        }
    }

    /// The contact of surfaces that have parted, drawn beyond the attraction.
    fn apart(&self) -> Contact {
        let problem = self.search.problem().problem();
        let attraction = self.search.problem().attraction();
        let datum = problem.highest() + attraction.cutoff().min(APART * attraction.range());
        let zero = Field::zeros(problem.surface().grid().shape());
        let gap = problem.surface().height().mapv(|h| datum - h);
        let parts = (Certificate::UNKNOWN, Work::default(), Status::Converged);
        Contact::from_parts(problem.clone(), [zero.clone(), zero, gap], parts, "none", None)
            .expect("fields fit the grid")
    }
}

impl AdhesiveProcess {
    /// Begins at the first point of the path, or goes one step towards the next one. The states stand in the queue then, with the error that ends the
    /// history, if there is one.
    fn advance(&mut self, observer: &mut dyn Observer) -> Result<(), HistoryError> {
        let (number, step) = self.at;
        let target = self.control(self.path[number].load);
        let Some(from) = self.last.take() else {
            let AdhesiveStep { place, work, .. } = self.search.solve(target, None, observer)?;
            let visit = AdhesiveVisit::first(place, target, work);
            let kept = visit.kept();
            self.queue.push_back(self.told(visit, Some(number)));
            self.at = (number + 1, 1);
            return self.last.insert(kept).place.fault().map_or(Ok(()), Err).map_err(HistoryError::from);
        };
        let begin = *self.begin.get_or_insert(from.control.value());
        let (way, is_there) = (target.value() - begin, step == self.steps);
        let share = step as f64 / self.steps as f64;
        let value = if is_there { target.value() } else { begin + share * way };
        let mut visits = Vec::new();
        let walk = BranchWalk::new(&self.search, &from, target.with_value(value), FINEST * way.abs());
        let ended = walk.run(observer, &mut visits);
        let reached = if ended.is_ok() { visits.pop() } else { None };
        for visit in visits {
            let state = self.told(visit, None);
            self.queue.push_back(state);
        }
        ended?;
        let reached = reached.expect("a step has an end");
        self.last = Some(reached.kept());
        let state = self.told(reached, is_there.then_some(number));
        self.queue.push_back(state);
        self.at = if is_there { (number + 1, 1) } else { (number, step + 1) };
        if is_there {
            self.begin = None;
        }
        Ok(())
    }
}

/// The estimated relative error of the area of a contact whose nodes are counted; none where none touches.
fn counting_error(contact: &Contact) -> Option<f64> {
    let Counted { relative_area, relative_area_corrected, .. } = contact.counted();
    (relative_area > 0.0).then(|| COUNTING_ERROR * (relative_area - relative_area_corrected) / relative_area)
}

impl Process for AdhesiveProcess {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        loop {
            if let Some(state) = self.queue.pop_front() {
                return Some(Ok(state));
            }
            if let Some(error) = self.ended.take() {
                return Some(Err(error));
            }
            if self.at.0 >= self.path.len() {
                return None;
            }
            if let Err(error) = self.advance(observer) {
                // nothing comes after an error but the states before it
                (self.ended, self.at) = (Some(error), (self.path.len(), 1));
            }
        }
    }

    /// Moves from load to load in short steps where a length is given: longer ones let go of what holds. Jumps are located as on the path, and their
    /// energy counts. A contact that has not begun comes from the end of its path.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let target = self.control(point.load);
        let last = self.come_to_end(observer)?;
        let reached = self.reached(&last, target);
        let mut last = last.under(reached);
        let (begin, range) = (last.control.value(), self.range());
        let way = target.value() - begin;
        let steps = match target {
            AdhesiveControl::MeanPressure(_) => 1,
            _ => (way.abs() / (LONGEST * range)).ceil().clamp(1.0, MOST_STEPS) as usize,
        };
        for step in 1..=steps {
            let value = if step == steps { target.value() } else { begin + way * step as f64 / steps as f64 };
            last = self.walked(&last, target.with_value(value), observer)?;
        }
        let state = self.told(last.kept(), None);
        self.last = Some(last);
        Ok(state)
    }
}

impl AdhesiveProcess {
    /// The state at the end of the path, or where the hand is, without the steps of the path.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`](crate::adhesion::AdhesiveProblem::solve), and [`HistoryError::Pathless`].
    pub fn at_end(&mut self, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let last = self.come_to_end(observer)?;
        let state = self.told(last.kept(), None);
        self.last = Some(last);
        Ok(state)
    }

    /// The last place, or that at the end of the path if there is none.
    fn come_to_end(&mut self, observer: &mut dyn Observer) -> Result<AdhesiveVisit, HistoryError> {
        if let Some(last) = &self.last {
            return Ok(last.kept());
        }
        let controls: Vec<AdhesiveControl> = self.path.iter().map(|point| self.control(point.load)).collect();
        let (first, rest) = controls.split_first().ok_or(HistoryError::Pathless)?;
        self.at = (self.path.len(), 1);
        let AdhesiveStep { place, work, .. } = self.search.solve(*first, None, observer)?;
        place.fault().map_or(Ok(()), Err)?;
        let mut last = AdhesiveVisit::first(place, *first, work);
        for control in rest {
            last = self.walked(&last, *control, observer)?;
        }
        Ok(last)
    }

    /// Where a contact is, in the terms of a control.
    fn reached(&self, last: &AdhesiveVisit, target: AdhesiveControl) -> AdhesiveControl {
        let AdhesivePlace::State(state) = &last.place else { return target };
        target.with_value(match target {
            AdhesiveControl::MeanPressure(_) => state.mean_pressure,
            AdhesiveControl::MeanGap(_) => state.mean_gap(),
            AdhesiveControl::Approach(_) => self.search.problem().problem().highest() - state.datum,
        })
    }

    /// The last of the places on the way to a control.
    fn walked(
        &self,
        from: &AdhesiveVisit,
        target: AdhesiveControl,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveVisit, HistoryError> {
        let mut visits = Vec::new();
        let finest = FINEST_BY_HAND * (target.value() - from.control.value()).abs();
        BranchWalk::new(&self.search, from, target, finest).run(observer, &mut visits)?;
        Ok(visits.pop().expect("a step has an end"))
    }
}

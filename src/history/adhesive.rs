//! The process of adhesion along a path of loads, with its jumps.

use super::adhesive_place::{AdhesivePlace, AdhesiveStep, AdhesiveVisit};
use super::adhesive_search::PlaceSearch;
use super::adhesive_walk::BranchWalk;
use super::process::{EachState, PathPoint, Process};
use crate::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveProblem};
use crate::contact::{
    Certificate, Contact, Load, Observer, Quantity, ResultClaim, State, StateField, StateKind, StateValues, Status,
    Stop, Work,
};
use crate::error::HistoryError;
use crate::surface::Field;
use std::sync::Arc;

/// The part of the way from one point of the path to the next within which a jump is located.
const FINEST: f64 = 5e-5;

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
/// Under a mean pressure the surfaces may part; what is lost then depends on how far they go, and is not counted.
///
/// With the method `gfmd` each step is a motion. Where it is a jump, also one in which the surfaces part, its frames are states between the
/// one before and the one after. They have the claim [`ResultClaim::Moving`] and are no part of the path.
pub struct AdhesiveProcess {
    search: PlaceSearch,
    path: Vec<PathPoint>,
    steps: usize,
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
        Self { search: PlaceSearch::new(problem, method, stop), path, steps: steps.max(1) }
    }

    /// The search for places on the path.
    pub(super) fn search(&self) -> &PlaceSearch {
        &self.search
    }

    /// The loads of the path.
    pub(super) fn loads(&self) -> impl Iterator<Item = Load> {
        self.path.iter().map(|point| point.load)
    }

    /// The range of the attraction.
    pub(super) fn range(&self) -> f64 {
        self.search.problem().attraction().range()
    }

    /// The highest peak above the mean of the rigid surface.
    pub(super) fn highest(&self) -> f64 {
        self.search.problem().problem().highest()
    }

    /// Whether the grid is periodic: only then the stability of states is known.
    fn is_periodic(&self) -> bool {
        self.search.problem().problem().surface().grid().is_periodic()
    }

    /// What a load of the path prescribes.
    pub(super) fn control(&self, load: Load) -> AdhesiveControl {
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
    pub(super) fn told(&self, visit: AdhesiveVisit, point: Option<usize>) -> State {
        let AdhesiveVisit { place, control, ledger, jump, work, .. } = visit;
        let values = StateValues::new(StateKind::Adhesion)
            .with(Quantity::Dissipated, ledger.lost)
            .with(Quantity::DissipatedError, self.is_periodic().then(|| ledger.error()))
            .with(Quantity::WorkDone, ledger.work)
            .with(Quantity::Jump, jump);
        match place {
            AdhesivePlace::State(state) => {
                let state = Arc::unwrap_or_clone(state);
                let contact = state.contact;
                let values = values
                    .with(Quantity::MeanPressure, state.mean_pressure)
                    .with(Quantity::ContactPressure, contact.mean_pressure())
                    .with(Quantity::MeanAttraction, state.traction.mean())
                    .with(Quantity::RelativeArea, contact.values().get(Quantity::RelativeArea))
                    .with(Quantity::Stored, state.energy)
                    .with(Quantity::Residual, state.residual)
                    .with(Quantity::LeastCurvature, state.least_curvature)
                    .with(Quantity::CurvatureError, state.curvature_error);
                let fields = vec![StateField::attraction(state.traction)];
                let contact = contact.with_work(work).with_values(values);
                State { contact, point, claim: state.claim, fields }
            }
            AdhesivePlace::Apart => {
                let shape = self.search.problem().problem().surface().grid().shape();
                let nothing = [
                    Quantity::ContactPressure,
                    Quantity::MeanAttraction,
                    Quantity::RelativeArea,
                    Quantity::Stored,
                    Quantity::Residual,
                ];
                let values = values.with(Quantity::MeanPressure, control.value());
                let values = nothing.into_iter().fold(values, |values, it| values.with(it, 0.0));
                State {
                    contact: self.apart().with_work(work).with_values(values),
                    point,
                    claim: ResultClaim::Separated,
                    fields: vec![StateField::attraction(Field::zeros(shape))],
                }
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

impl Process for AdhesiveProcess {
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        let mut last: Option<AdhesiveVisit> = None;
        for (number, point) in self.path.iter().enumerate() {
            let target = self.control(point.load);
            let Some(mut from) = last.take() else {
                let AdhesiveStep { place, work, .. } = self.search.solve(target, None, observer)?;
                let visit = AdhesiveVisit::first(place, target, work);
                let kept = last.insert(visit.kept());
                each(self.told(visit, Some(number)))?;
                kept.place.fault().map_or(Ok(()), Err)?;
                continue;
            };
            let begin = from.control.value();
            let way = target.value() - begin;
            for step in 1..=self.steps {
                let share = step as f64 / self.steps as f64;
                let value = if step == self.steps { target.value() } else { begin + share * way };
                let mut visits = Vec::new();
                let walk = BranchWalk::new(&self.search, &from, target.with_value(value), FINEST * way.abs());
                let ended = walk.run(observer, &mut visits);
                let reached = if ended.is_ok() { visits.pop() } else { None };
                for visit in visits {
                    each(self.told(visit, None))?;
                }
                ended?;
                let reached = reached.expect("a step has an end");
                from = reached.kept();
                each(self.told(reached, (step == self.steps).then_some(number)))?;
            }
            last = Some(from);
        }
        Ok(())
    }
}

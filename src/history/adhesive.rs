//! The process of adhesion along a path of loads, with its jumps.

use super::adhesive_walk::{AdhesivePlace, AdhesiveStep, PathStep, Walk, sum};
use super::process::{EachState, HistoryField, HistoryNumbers, HistoryState, PathPoint, Process};
use crate::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveMotion, AdhesiveOutcome, AdhesiveProblem};
use crate::contact::{Certificate, Contact, Load, Observer, ResultClaim, StateKind, StateValues, Status, Stop, Work};
use crate::error::{AdhesionError, HistoryError};
use crate::surface::Field;

/// Energy over the work of adhesion that a step may lose before it is halved, as the part of the area of the cell.
const JUMP: f64 = 2e-3;

/// Ranges of the attraction at which surfaces that have parted are drawn, where the attraction has no cut-off.
const APART: f64 = 30.0;

/// The process of adhesion: a number of equal steps from one point of its path to the next.
///
/// Each step starts from the last state, moved rigidly. With the energy `E = 1/2 <p u> + <V>`, the mean pressure `P` and the datum `d` of the
/// gap, a step from state 0 to state 1 loses the energy
///
/// `E_0 - E_1 - (P_0 + P_1)(d_1 - d_0)/2`.
///
/// Without a jump this is an error of third order in the step. Where it is large, the step is halved until it is short: what it loses then is
/// a jump, with a state before it and one after it. Under a mean pressure the surfaces may part; what is lost then depends
/// on how far they go, and is not counted.
///
/// With the method `gfmd` each step is a motion. Where it is a jump, also one in which the surfaces part, its frames are states between the
/// one before and the one after. They have the claim [`ResultClaim::Moving`] and are no part of the path.
pub struct AdhesiveProcess {
    problem: AdhesiveProblem,
    path: Vec<PathPoint>,
    steps: usize,
    method: AdhesiveMethod,
    stop: Stop,
}

/// What a history with adhesion adds up, per area of the cell.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AdhesionLedger {
    /// Energy lost in jumps.
    lost: f64,
    /// Work of the load.
    work: f64,
}

/// A place on the path, with the energies up to it: what a state of the history is made of.
pub(super) struct AdhesiveVisit {
    pub(super) place: AdhesivePlace,
    pub(super) control: AdhesiveControl,
    pub(super) ledger: AdhesionLedger,
    /// The energy lost in the jump that ends here.
    pub(super) jump: Option<f64>,
    pub(super) work: Work,
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
        Self { problem, path, steps: steps.max(1), method, stop }
    }

    /// The loads of the path.
    pub(super) fn loads(&self) -> impl Iterator<Item = Load> {
        self.path.iter().map(|point| point.load)
    }

    /// The range of the attraction.
    pub(super) fn range(&self) -> f64 {
        self.problem.attraction().range()
    }

    /// The highest peak above the mean of the rigid surface.
    pub(super) fn highest(&self) -> f64 {
        self.problem.problem().highest()
    }

    /// What a load of the path prescribes.
    pub(super) fn control(&self, load: Load) -> AdhesiveControl {
        let problem = self.problem.problem();
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

    /// The place under a control, from the last one. What has parted under a load that pulls stays apart.
    pub(super) fn solve(
        &self,
        control: AdhesiveControl,
        from: Option<&AdhesivePlace>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveStep, AdhesionError> {
        let start = match from {
            Some(AdhesivePlace::State(state)) => Some(&**state),
            Some(AdhesivePlace::Apart) if control.value() < 0.0 => {
                return Ok(AdhesiveStep { place: AdhesivePlace::Apart, frames: Vec::new(), work: Work::default() });
            }
            Some(AdhesivePlace::Apart) | None => None,
        };
        let AdhesiveMotion { frames, outcome } = match self.method {
            AdhesiveMethod::Gfmd => self.problem.motion(control, start, &self.stop, observer)?,
            AdhesiveMethod::Fast | AdhesiveMethod::Safe => {
                let outcome = self.problem.solve(control, start, self.method, &self.stop, observer)?;
                AdhesiveMotion { frames: Vec::new(), outcome }
            }
        };
        let (place, work) = match outcome {
            AdhesiveOutcome::State(state) => {
                let work = state.work;
                (AdhesivePlace::State(Box::new(state)), work)
            }
            AdhesiveOutcome::Separated { work } => (AdhesivePlace::Apart, work),
        };
        Ok(AdhesiveStep { place, frames, work })
    }

    /// Adds the places from one to the next point of the path: both sides of each jump with the frames between them, and the end. After an
    /// error they end with the last place that was found.
    pub(super) fn visits(
        &self,
        last: &AdhesiveVisit,
        target: AdhesiveControl,
        observer: &mut dyn Observer,
        visits: &mut Vec<AdhesiveVisit>,
    ) -> Result<(), AdhesionError> {
        let allowed = JUMP * self.problem.attraction().work();
        let (begin, end, mut ledger) = (last.control.value(), target.value(), last.ledger);
        let mut walk = Walk::new(last.place.clone(), begin, end);
        loop {
            let found = self.step(&mut walk, target, observer);
            let is_new = walk.at != begin;
            let Some(PathStep { to, is_short, step }) = found.inspect_err(|_| {
                if is_new {
                    visits.push(AdhesiveVisit::calm(walk.from.clone(), target.with_value(walk.at), ledger, walk.work));
                }
            })?
            else {
                continue;
            };
            let AdhesiveStep { place: after, frames, work: spent } = step;
            let missed = lost(&walk.from, &after);
            if missed.abs() > allowed && !is_short && missed.is_finite() {
                walk.halve(to, spent);
                continue;
            }
            let is_jump = missed > allowed + trapezium_error(&walk.from, &after);
            if is_jump && is_new {
                let before = std::mem::take(&mut walk.work);
                visits.push(AdhesiveVisit::calm(walk.from.clone(), target.with_value(walk.at), ledger, before));
            }
            let mut shown = Work::default();
            for frame in frames.into_iter().filter(|_| is_jump) {
                let since = less(frame.work, std::mem::replace(&mut shown, frame.work));
                let place = AdhesivePlace::State(Box::new(frame));
                visits.push(AdhesiveVisit::calm(place, target.with_value(to), ledger, since));
            }
            walk.work = sum(walk.work, less(spent, shown));
            let jump = Some(missed).filter(|lost| is_jump && lost.is_finite());
            ledger.lost += jump.unwrap_or(0.0);
            ledger.work += work_of_load(&walk.from, &after);
            if to == end || is_jump {
                let (place, control) = (after.clone(), target.with_value(to));
                visits.push(AdhesiveVisit { place, control, ledger, jump, work: std::mem::take(&mut walk.work) });
            }
            if to == end {
                return Ok(());
            }
            walk.arrive(after, to);
        }
    }

    /// The next step of a walk; none where it is too long, and has been halved. The load that parts the surfaces is found by bisection to a part of
    /// itself, whatever the length of the path. A state that is not found is the end of the walk.
    fn step(
        &self,
        walk: &mut Walk,
        target: AdhesiveControl,
        observer: &mut dyn Observer,
    ) -> Result<Option<PathStep>, AdhesionError> {
        if let Some(known) = walk.known() {
            return Ok(Some(known));
        }
        let (to, is_short) = walk.next(target.value());
        let step = self.solve(target.with_value(to), Some(&walk.from), observer)?;
        let found = PathStep { to, is_short, step };
        match found.step.place.fault() {
            Some(error) if is_short => {
                walk.work = sum(walk.work, found.step.work);
                // close to a jump the safe method may be too slow; where the surfaces part beyond, they part here
                let Some(known) = walk.parted.take() else {
                    (walk.from, walk.at) = (found.step.place, to);
                    return Err(error);
                };
                Ok(Some(known))
            }
            Some(_) => {
                walk.halve(to, found.step.work);
                Ok(None)
            }
            None if walk.parts_far(&found) => {
                walk.halve(to, found.step.work);
                walk.parted = Some(PathStep { step: AdhesiveStep { work: Work::default(), ..found.step }, ..found });
                Ok(None)
            }
            None => Ok(Some(found)),
        }
    }

    /// A place as a state of any history.
    pub(super) fn told(&self, visit: AdhesiveVisit, point: Option<usize>) -> HistoryState {
        let AdhesiveVisit { place, control, ledger, jump, work } = visit;
        let numbers = HistoryNumbers {
            dissipated: Some(ledger.lost),
            work_done: Some(ledger.work),
            jump,
            ..HistoryNumbers::default()
        };
        match place {
            AdhesivePlace::State(state) => {
                let values = state.contact.values();
                let numbers = HistoryNumbers {
                    net_pressure: Some(state.mean_pressure),
                    attraction: state.traction.mean(),
                    relative_area: values.relative_area,
                    stored: Some(state.energy),
                    residual: Some(state.residual),
                    least_curvature: state.least_curvature,
                    curvature_error: state.curvature_error,
                    ..numbers
                };
                let fields = vec![HistoryField::attraction(state.traction)];
                HistoryState { contact: state.contact, point, claim: state.claim, numbers, fields, work }
            }
            AdhesivePlace::Apart => {
                let shape = self.problem.problem().surface().grid().shape();
                let numbers = HistoryNumbers {
                    net_pressure: Some(control.value()),
                    attraction: Some(0.0),
                    relative_area: Some(0.0),
                    stored: Some(0.0),
                    residual: Some(0.0),
                    ..numbers
                };
                HistoryState {
                    contact: self.apart(control),
                    point,
                    claim: ResultClaim::Separated,
                    numbers,
                    fields: vec![HistoryField::attraction(Field::zeros(shape))],
                    work,
                }
            }
        }
    }

    /// The contact of surfaces that have parted, drawn beyond the attraction.
    fn apart(&self, control: AdhesiveControl) -> Contact {
        let problem = self.problem.problem();
        let attraction = self.problem.attraction();
        let datum = problem.highest() + attraction.cutoff().min(APART * attraction.range());
        let zero = Field::zeros(problem.surface().grid().shape());
        let gap = problem.surface().height().mapv(|h| datum - h);
        let parts = (Certificate::UNKNOWN, Work::default(), Status::Converged);
        Contact::from_parts(problem.clone(), [zero.clone(), zero, gap], parts, "none", None)
            .expect("fields fit the grid")
            .with_values(StateValues {
                kind: StateKind::Adhesion,
                mean_pressure: Some(control.value()),
                relative_area: Some(0.0),
                kappa_r: None,
            })
    }
}

impl Process for AdhesiveProcess {
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        let mut last: Option<AdhesiveVisit> = None;
        for (number, point) in self.path.iter().enumerate() {
            let target = self.control(point.load);
            let Some(mut from) = last.take() else {
                let AdhesiveStep { place, work, .. } = self.solve(target, None, observer)?;
                let visit = AdhesiveVisit::calm(place, target, AdhesionLedger::default(), work);
                let kept = last.insert(visit.kept());
                each(self.told(visit, Some(number)))?;
                kept.place.fault().map_or(Ok(()), Err)?;
                continue;
            };
            let begin = from.control.value();
            for step in 1..=self.steps {
                let share = step as f64 / self.steps as f64;
                let value = if step == self.steps { target.value() } else { begin + share * (target.value() - begin) };
                let mut visits = Vec::new();
                let ended = self.visits(&from, target.with_value(value), observer, &mut visits);
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

impl AdhesiveVisit {
    /// A place at which no jump ends.
    pub(super) fn calm(place: AdhesivePlace, control: AdhesiveControl, ledger: AdhesionLedger, work: Work) -> Self {
        Self { place, control, ledger, jump: None, work }
    }

    /// What the next step begins with.
    pub(super) fn kept(&self) -> Self {
        Self { place: self.place.clone(), work: Work::default(), ..*self }
    }
}

/// Energy that a step loses, per area; infinite where the surfaces part, and none where they come together from afar.
fn lost(from: &AdhesivePlace, to: &AdhesivePlace) -> f64 {
    match (from, to) {
        // a convex energy has no jumps
        (AdhesivePlace::State(before), AdhesivePlace::State(after))
            if [before, after].iter().all(|it| it.claim == ResultClaim::Solution) =>
        {
            0.0
        }
        (AdhesivePlace::State(before), AdhesivePlace::State(after)) => {
            before.energy - after.energy + work_of_load(from, to)
        }
        (AdhesivePlace::State(_), AdhesivePlace::Apart) => f64::INFINITY,
        (AdhesivePlace::Apart, _) => 0.0,
    }
}

/// The largest error of the work of the load in a step without a jump, per area: half of `|dP dd|`, since the pressure changes in one sense in a
/// short step. In a jump either the load or the datum hardly changes.
fn trapezium_error(from: &AdhesivePlace, to: &AdhesivePlace) -> f64 {
    match (from, to) {
        (AdhesivePlace::State(from), AdhesivePlace::State(to)) => {
            0.5 * ((to.mean_pressure - from.mean_pressure) * (to.datum - from.datum)).abs()
        }
        _ => 0.0,
    }
}

/// Work of the load in a step, per area.
fn work_of_load(from: &AdhesivePlace, to: &AdhesivePlace) -> f64 {
    match (from, to) {
        (AdhesivePlace::State(from), AdhesivePlace::State(to)) => {
            -0.5 * (from.mean_pressure + to.mean_pressure) * (to.datum - from.datum)
        }
        _ => 0.0,
    }
}

/// The work of `all` without that of a part of it.
fn less(all: Work, part: Work) -> Work {
    Work {
        iterations: all.iterations - part.iterations,
        transforms: all.transforms - part.transforms,
        seconds: all.seconds - part.seconds,
    }
}

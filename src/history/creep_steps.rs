//! Steps in time along a path of loads.

use super::time_difference::{Difference, errors_in_time};
use super::time_errors::rms;
use super::transients::Transients;
use super::{Creep, CreepPath, CreepState};
use crate::contact::{Load, Observer, Solver, Stop, Work};
use crate::error::CreepError;
use crate::surface::Field;
use std::collections::VecDeque;

/// The first step after a jump of the load, as a part of the shortest time of the solid.
const FIRST: f64 = 0.05;
/// No step is shorter than this part of the first one: its error is counted, but it is not repeated.
const LEAST: f64 = 1e-4;
/// The part of the largest step that the tolerance allows which is tried.
const SAFETY: f64 = 0.7;
/// The least part to which a step shrinks at once, the most if it shrinks, and the most by which the next one grows.
const SHRINK: f64 = 0.1;
const SHORTER: f64 = 0.5;
const GROW: f64 = 2.0;
/// Without a memory each way from point to point is as many steps.
const ELASTIC_STEPS: f64 = 2.0;
/// The part of the tolerance that the steps within the time of the memory may add where the error is above it.
const SHARED: f64 = 0.5;
/// The least part of that which a step may add, however short it is.
const LEAST_SHARE: f64 = 1.0 / 16.0;
/// The same for energies: the least part of the energy to be lost until the next point by which a step counts.
const LEAST_LOSS: f64 = 1.0 / 64.0;
/// Under a held load the rate of the loss fades, by half or more from one step to the next of twice the length. What is still to be lost is taken to be that
/// of so many further steps; the rate of the step until the next point would be far too much, and allow errors above the tolerance.
const HELD_STEPS: f64 = 2.0;
/// Errors are divided by pressure and gap, or by this part of the largest pressure so far and of the rms height.
const SMALL: f64 = 1e-2;
/// A shorter step that does not lower the error to this part is kept: the error is that of the solver.
const LOWERED: f64 = 0.8;

/// The states of a viscoelastic contact along a path of loads, one after the other: an iterator. The path begins with the solid
/// at rest. There is a state at each point of the path; a jump of the load is a step of length zero.
///
/// **Adaptive steps.** The history is solved twice: in steps, and beside them in steps of twice the length, each from its own states. The
/// difference at the ends of these is the error in time of everything that can be read of a state: pressure, mean pressure, gap, area and energies, see
/// [`TimeErrors`](super::TimeErrors). The tolerance limits the relative errors of the contact pressure, the mean gap and the lost energy. A pair of steps is repeated
/// with shorter ones where such an error is above it and grows by more than the share of the step. The state between the two steps is
/// not shown, since nothing is compared with it. The first step after a jump is a twentieth of
/// the shortest time of the solid, and steps at most double.
///
/// **Points of the path.** Where the rate of the load changes, the elements answer with transients. Steps that are much longer than
/// these miss them in both histories, and the difference does not tell. So the first step after such a point is half of the shortest time
/// whose transient counts. What the others may change of the lost energy, at most, is part of its error, as are transients that begin within a
/// step, where surfaces touch or part. Steps end where the mean effective pressure turns under its load.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
/// use asperity::elastic::{Prony, PronyTerm};
/// use asperity::history::{Creep, CreepPath, CreepSteps};
/// use asperity::{Grid, Indenter, Problem};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 4.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-3))?;
/// let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 1.0 }])?;
/// let path = CreepPath::held(Load::MeanPressure(1e-3), 10.0)?;
/// let steps = CreepSteps::adaptive(Creep::new(problem, prony), path, 1e-3, &Multilevel, Stop::default())?;
/// let last = steps.last().expect("there is a state for each step")?;
/// assert_eq!(last.time, 10.0);
/// // the solid is relaxed
/// assert!((last.effective_modulus() - 0.1).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct CreepSteps<'a> {
    creep: Creep,
    path: CreepPath,
    solver: &'a dyn Solver,
    stop: Stop,
    pace: CreepPace,
    state: CreepState,
    /// The next point of the path.
    point: usize,
    /// The next step; none after a jump.
    step: Option<f64>,
    /// The state in doubled steps, where steps are adaptive.
    doubled: CreepState,
    difference: Difference,
    /// The largest pressure so far, root mean square over the nodes.
    largest: f64,
    /// Work since the last state that was kept.
    spent: Work,
    pending: VecDeque<CreepState>,
    rejected: usize,
    transforms: u64,
}

/// The error after a step of the quantity in which it is largest beside what the step may cause.
#[derive(Debug, Clone, Copy)]
struct Excess {
    /// The relative error that is compared with the tolerance.
    of_allowed: f64,
    /// By how much the step has made the relative error larger.
    growth: f64,
}

/// How long steps are.
enum CreepPace {
    /// To a tolerance.
    Adaptive(f64),
    /// As many from each point to the next one.
    Count(usize),
    /// At these times, besides those of the points.
    Times(Vec<f64>),
}

impl<'a> CreepSteps<'a> {
    /// Steps that keep the estimated relative error of the contact pressure below the tolerance, dimensionless; 1e-3 is a good value.
    ///
    /// # Errors
    /// [`CreepError::NotPositive`] for a tolerance that is not positive and finite.
    pub fn adaptive(
        creep: Creep,
        path: CreepPath,
        tolerance: f64,
        solver: &'a dyn Solver,
        stop: Stop,
    ) -> Result<Self, CreepError> {
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(CreepError::NotPositive { name: "the tolerance of steps in time", value: tolerance });
        }
        Ok(Self::new(creep, path, CreepPace::Adaptive(tolerance), solver, stop))
    }

    /// As many equal steps from each point to the next one.
    ///
    /// # Errors
    /// [`CreepError::NotPositive`] for no steps.
    pub fn fixed(
        creep: Creep,
        path: CreepPath,
        count: usize,
        solver: &'a dyn Solver,
        stop: Stop,
    ) -> Result<Self, CreepError> {
        if count == 0 {
            return Err(CreepError::NotPositive { name: "the number of steps in time", value: 0.0 });
        }
        Ok(Self::new(creep, path, CreepPace::Count(count), solver, stop))
    }

    /// Steps that end at given times, and at the points of the path. Times outside of the path are left out.
    ///
    /// # Errors
    /// [`CreepError::Order`] for times that fall or are not finite.
    pub fn at_times(
        creep: Creep,
        path: CreepPath,
        times: Vec<f64>,
        solver: &'a dyn Solver,
        stop: Stop,
    ) -> Result<Self, CreepError> {
        let mut before = f64::NEG_INFINITY;
        for &time in &times {
            if !(time.is_finite() && time >= before) {
                return Err(CreepError::Order { before, time });
            }
            before = time;
        }
        Ok(Self::new(creep, path, CreepPace::Times(times), solver, stop))
    }

    fn new(creep: Creep, path: CreepPath, pace: CreepPace, solver: &'a dyn Solver, stop: Stop) -> Self {
        let state = CreepState { time: path.points()[0].0, ..creep.start() };
        let (pending, rejected) = (VecDeque::new(), 0);
        Self {
            creep,
            path,
            solver,
            stop,
            pace,
            point: 0,
            step: None,
            doubled: state.clone(),
            state,
            difference: Difference::default(),
            largest: 0.0,
            spent: Work::default(),
            pending,
            rejected,
            transforms: 0,
        }
    }

    /// Lets the path go on to one more point: at a time, or at that of its last point.
    ///
    /// # Errors
    /// The errors of [`CreepPath::new`].
    pub fn extend(&mut self, time: Option<f64>, load: Load) -> Result<(), CreepError> {
        self.path = self.path.extended(time, load)?;
        Ok(())
    }

    /// Steps that were repeated with a shorter one so far.
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// Fourier transforms of all solves so far: those in doubled steps and of steps that were repeated as well.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// The next state, whose solves an observer sees; none after the last one and after an error.
    pub fn next_watched(&mut self, observer: &mut dyn Observer) -> Option<Result<CreepState, CreepError>> {
        loop {
            if let Some(state) = self.pending.pop_front() {
                return Some(Ok(state));
            }
            if self.point >= self.path.points().len() {
                return None;
            }
            if let Err(error) = self.advance(observer) {
                // nothing comes after an error
                self.point = self.path.points().len();
                return Some(Err(error));
            }
        }
    }

    fn advance(&mut self, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let (end, load) = self.path.points()[self.point];
        let left = end - self.state.time;
        if left <= 0.0 {
            // the same load again is no jump
            if self.state.load != Some(load) {
                self.jump(load, observer)?;
            }
            self.point += 1;
            return Ok(());
        }
        match &self.pace {
            CreepPace::Adaptive(tolerance) => self.adapt(*tolerance, end, observer),
            CreepPace::Count(count) => {
                let begin = self.path.points()[self.point - 1].0;
                let done = ((self.state.time - begin) / (end - begin) * *count as f64).round() + 1.0;
                let time = if done < *count as f64 { begin + (end - begin) * done / *count as f64 } else { end };
                self.go(time, observer)
            }
            CreepPace::Times(times) => {
                let next = times.iter().copied().find(|&time| time > self.state.time).unwrap_or(end);
                self.go(next.min(end), observer)
            }
        }
    }

    fn jump(&mut self, load: Load, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let from = self.state.clone();
        let next = self.solve(None, &from, from.time, load, observer)?;
        self.step = None;
        if self.is_adaptive() {
            let goal = next.effective_pressure().clone();
            let doubled = self.doubled.clone();
            self.doubled = self.solve(Some(&goal), &doubled, doubled.time, load, observer)?;
            self.difference = Difference::new(&self.doubled, &next);
            let time_errors = Some(errors_in_time([&self.doubled, &doubled], [&next, &next, &from], 0.0));
            self.keep(CreepState { time_errors, ..next });
        } else {
            self.keep(next);
        }
        Ok(())
    }

    fn is_adaptive(&self) -> bool {
        matches!(self.pace, CreepPace::Adaptive(_))
    }

    /// A given step.
    fn go(&mut self, time: f64, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let from = self.state.clone();
        let next = self.solve(None, &from, time, self.path.load(self.point, time), observer)?;
        self.keep(next);
        Ok(())
    }

    /// Two steps beside a doubled one, until the error is within the tolerance.
    fn adapt(&mut self, tolerance: f64, end: f64, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let (from, coarse, left) = (self.state.clone(), self.doubled.clone(), end - self.state.time);
        let shortest = self.creep.prony().shortest_time();
        let first = shortest.map_or(left / ELASTIC_STEPS, |time| FIRST * time);
        let [begins, ends] = [self.point - 1, self.point].map(|point| self.transients(point, tolerance));
        let is_at_point = from.time == self.path.points()[self.point - 1].0;
        let wanted = match self.step {
            // a step as long as the last one would miss the transients in both histories
            Some(step) if is_at_point => step.min(begins.first_step),
            step => step.unwrap_or(first),
        };
        let left_out = begins.left_out.max(ends.left_out);
        // the last two steps before a point are of equal length
        let mut step = if left <= wanted { left } else { wanted.min(0.5 * left) };
        // where the mean effective pressure turns, a step has no profile that follows it: it is exact on both sides
        let turn = self.creep.mean_turn(&from, left, self.path.points()[self.point].1);
        step = step.min(turn.unwrap_or(step));
        let mut repeated = f64::INFINITY;
        loop {
            let is_last = step == left;
            let times = [from.time + 0.5 * step, if is_last { end } else { from.time + step }];
            let loads = times.map(|time| self.path.load(self.point, time));
            let whole = self.solve(None, &coarse, times[1], loads[1], observer)?;
            let goal = whole.effective_pressure().clone();
            let between = 0.5 * (from.effective_pressure() + &goal);
            let half = self.solve(Some(&between), &from, times[0], loads[0], observer)?;
            let next = self.solve(Some(&goal), &half, times[1], loads[1], observer)?;
            let after = Difference::new(&whole, &next);
            let excess = self.excess(tolerance, &after, [&from, &next], end);
            let factor = (SAFETY * (tolerance / excess.of_allowed).sqrt()).clamp(SHRINK, GROW);
            // the error of what is not solved says nothing about the step
            let is_solved = [&whole, &half, &next].iter().all(|state| state.contact.is_converged());
            let factor = if is_solved { factor } else { GROW };
            // where nothing touches the solid recovers exactly in steps of any length
            let is_exact = from.is_apart() && half.is_apart() && next.is_apart();
            let is_allowed = excess.of_allowed <= tolerance || step <= LEAST * first || is_exact;
            if is_allowed || !is_solved || excess.growth > LOWERED * repeated {
                // a step that was cut off by a point does not shorten the next one, unless its error asks for that
                // the step after a repeated one does not grow
                let further = step * if repeated.is_finite() { factor.min(1.0) } else { factor };
                self.step = Some(if factor < GROW { further } else { further.max(wanted) });
                let has_event = from.is_apart() != next.is_apart();
                let left_out = if has_event {
                    left_out.max(Transients::left_out_within(step, self.creep.prony().terms()))
                } else {
                    left_out
                };
                let time_errors = Some(errors_in_time([&whole, &coarse], [&next, &half, &from], left_out));
                (self.difference, self.doubled) = (after, whole);
                self.keep(CreepState { time_errors, ..next });
                return Ok(());
            }
            self.rejected += 1;
            repeated = excess.growth;
            step *= factor.min(SHORTER);
        }
    }

    /// The relative error after a step, over what the step may cause: the largest of those of the contact pressure, the mean gap and the lost
    /// energy. A step may cause an error that leaves room for others, and else its share: of the time for which the solid remembers, and for the
    /// energy, whose errors do not fade, of the energy. That is compared with the energy lost until the next point.
    fn excess(&self, tolerance: f64, after: &Difference, [from, next]: [&CreepState; 2], end: f64) -> Excess {
        let pressure = rms(&next.contact.pressure).max(SMALL * self.largest);
        let gap = next.contact.mean_gap().max(SMALL * next.contact.problem.rms_height());
        let (step, lost) = (next.time - from.time, next.energy.lost - from.energy.lost);
        let is_held = from.load == next.load;
        let further = if is_held { (end - next.time).min(HELD_STEPS * step) } else { end - next.time };
        let to_lose = next.energy.lost + lost * further / step;
        let by_time = self.share(step);
        let by_energy = SHARED * (lost / to_lose).max(LEAST_LOSS);
        let before = &self.difference;
        let mut largest = Excess { of_allowed: 0.0, growth: 0.0 };
        for ([before, after], size, share) in [
            ([before.pressure, after.pressure], pressure, by_time),
            ([before.mean_gap, after.mean_gap], gap, by_time),
            ([before.lost, after.lost], to_lose, by_energy),
        ] {
            let least = after.min((after - before) / share);
            // an error that is there already cannot be lowered by short steps
            let size = size.max(before / tolerance);
            if least > size * largest.of_allowed {
                largest = Excess { of_allowed: least / size, growth: (after - before) / size };
            }
        }
        largest
    }

    /// The transients after a point of the path.
    fn transients(&self, point: usize, tolerance: f64) -> Transients {
        Transients::new(self.path.turn(point), self.creep.prony().terms(), tolerance)
    }

    /// The part of the tolerance that a step may use: that of the time for which the solid remembers, or for which the path lasts.
    fn share(&self, step: f64) -> f64 {
        let slowest = self.creep.prony().terms().iter().map(|term| term.time).fold(0.0, f64::max);
        let points = self.path.points();
        let lasting = points[points.len() - 1].0 - points[0].0;
        let time = slowest.min(lasting);
        let part = if time > 0.0 { -(-step / time).exp_m1() } else { 1.0 };
        SHARED * part.max(LEAST_SHARE)
    }

    fn solve(
        &mut self,
        near: Option<&Field>,
        from: &CreepState,
        time: f64,
        load: Load,
        observer: &mut dyn Observer,
    ) -> Result<CreepState, CreepError> {
        let dt = time - from.time;
        let next = self.creep.step_from(near, from, dt, load, self.solver, &self.stop, observer)?;
        let work = next.contact.work;
        self.transforms += work.transforms;
        self.spent.iterations += work.iterations;
        self.spent.transforms += work.transforms;
        self.spent.seconds += work.seconds;
        // the time of a point to the last bit
        Ok(CreepState { time, ..next })
    }

    /// Keeps a state, with the work of all solves since the last one.
    fn keep(&mut self, mut state: CreepState) {
        self.largest = self.largest.max(rms(&state.contact.pressure));
        state.contact.work = std::mem::take(&mut self.spent);
        self.state = state.clone();
        self.pending.push_back(state);
    }
}

impl Iterator for CreepSteps<'_> {
    type Item = Result<CreepState, CreepError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_watched(&mut ())
    }
}

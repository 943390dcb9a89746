//! Steps in time along a path of loads.

use super::{Creep, CreepPath, CreepState};
use crate::contact::{Load, Observer, Solver, Stop};
use crate::error::CreepError;
use crate::surface::Field;
use std::collections::VecDeque;

/// The first step after a jump of the load, as a part of the shortest time of the solid.
const FIRST: f64 = 0.05;
/// No step is shorter than this part of the first one: its error is counted, but it is not repeated.
const LEAST: f64 = 1e-4;
/// The part of the largest step that the tolerance allows which is tried.
const SAFETY: f64 = 0.9;
/// The least part to which a step shrinks at once, and the most by which the next one grows.
const SHRINK: f64 = 0.1;
const GROW: f64 = 2.0;
/// Without a memory each way from point to point is as many steps.
const ELASTIC_STEPS: f64 = 2.0;

/// The states of a viscoelastic contact along a path of loads, one after the other: an iterator. The path begins with the solid
/// at rest. There is a state at each point of the path; a jump of the load is a step of length zero.
///
/// **Adaptive steps.** Each step is solved once, and again as two halves, whose states are kept. The error of the
/// halves is estimated by the difference of both effective pressures `p + sum_j eps_j` (root mean square), divided by the
/// effective pressure. The error of one step is of second order in its length. A step with an error above the tolerance is
/// repeated with a shorter one. The first step after a jump is a twentieth of the shortest time of the solid, and steps at most double. Errors of earlier steps fade
/// as the slowest term of the solid does; [`CreepState::time_error`] is the sum of what is left of them.
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
    /// The error in time of the effective pressure, root mean square, a pressure.
    error: f64,
    pending: VecDeque<CreepState>,
    rejected: usize,
    transforms: u64,
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
    /// Steps whose estimated errors are at most the tolerance each, dimensionless; 1e-3 is a good value.
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
            state,
            point: 0,
            step: None,
            error: 0.0,
            pending,
            rejected,
            transforms: 0,
        }
    }

    /// Steps that were repeated with a shorter one so far.
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// Fourier transforms of all solves so far, those of states that were not kept as well.
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
        self.keep(next);
        Ok(())
    }

    /// A given step.
    fn go(&mut self, time: f64, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let from = self.state.clone();
        let next = self.solve(None, &from, time, self.path.load(self.point, time), observer)?;
        self.state = next.clone();
        self.pending.push_back(next);
        Ok(())
    }

    /// A step and two halves, until the error is within the tolerance.
    fn adapt(&mut self, tolerance: f64, end: f64, observer: &mut dyn Observer) -> Result<(), CreepError> {
        let (from, left) = (self.state.clone(), end - self.state.time);
        let shortest = self.creep.prony().shortest_time();
        let first = shortest.map_or(left / ELASTIC_STEPS, |time| FIRST * time);
        let wanted = self.step.unwrap_or(first);
        // the last two steps before a point are of equal length
        let mut step = if left <= wanted { left } else { wanted.min(0.5 * left) };
        loop {
            let is_last = step == left;
            let times = [from.time + 0.5 * step, if is_last { end } else { from.time + step }];
            let loads = times.map(|time| self.path.load(self.point, time));
            let whole = self.solve(None, &from, times[1], loads[1], observer)?;
            let goal = whole.effective_pressure();
            let between = 0.5 * (&from.effective_pressure() + &goal);
            let half = self.solve(Some(&between), &from, times[0], loads[0], observer)?;
            let next = self.solve(Some(&goal), &half, times[1], loads[1], observer)?;
            let found = next.effective_pressure();
            let (error, size) = (rms(&(&goal - &found)), rms(&found));
            let relative = if error > 0.0 { error / size } else { 0.0 };
            let factor = (SAFETY * (tolerance / relative).sqrt()).clamp(SHRINK, GROW);
            // the error of what is not solved says nothing about the step
            let is_solved = [&whole, &half, &next].iter().all(|state| state.contact.is_converged());
            let factor = if is_solved { factor } else { GROW };
            if relative <= tolerance || step <= LEAST * first || !is_solved {
                // a step that was cut off by a point does not shorten the next one, unless its error asks for that
                let further = step * factor;
                self.step = Some(if factor < GROW { further } else { further.max(wanted) });
                let fading = self.fading(0.5 * step);
                self.error = fading * self.error + 0.5 * error;
                self.keep(half);
                self.error = fading * self.error + 0.5 * error;
                self.keep(next);
                return Ok(());
            }
            self.rejected += 1;
            step *= factor.min(SAFETY);
        }
    }

    /// The part of an error that is left after a time.
    fn fading(&self, time: f64) -> f64 {
        let slowest = self.creep.prony().terms().iter().map(|term| term.time).fold(0.0, f64::max);
        if slowest > 0.0 { (-time / slowest).exp() } else { 0.0 }
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
        self.transforms += next.contact.work.transforms;
        // the time of a point to the last bit
        Ok(CreepState { time, ..next })
    }

    /// Keeps a state of an adaptive step, with its error in time.
    fn keep(&mut self, state: CreepState) {
        let time_error = match self.pace {
            CreepPace::Adaptive(_) if self.error == 0.0 => 0.0,
            CreepPace::Adaptive(_) => self.error / rms(&state.effective_pressure()),
            _ => f64::NAN,
        };
        self.state = CreepState { time_error, ..state };
        self.pending.push_back(self.state.clone());
    }
}

impl Iterator for CreepSteps<'_> {
    type Item = Result<CreepState, CreepError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_watched(&mut ())
    }
}

fn rms(field: &Field) -> f64 {
    (field.iter().map(|p| p * p).sum::<f64>() / field.len() as f64).sqrt()
}

//! Steps of partial slip on the way from one pair of loads to the next.

use super::slip::SlipHistory;
use super::slip_memory::SlipMemory;
use super::slip_state::SlipState;
use super::slip_totals::{SlipPathErrors, SlipTotals};
use crate::contact::{Load, Observer, ResultClaim, Status};
use crate::error::SlipError;

/// The first step on a way, over the way: in general, and without coupling where the normal load stays and only the direction of slip turns, which
/// costs little accuracy (0.2 % for a sphere in one step).
const FIRST_STEP: f64 = 0.25;
const FIRST_STEP_UNDER_ONE_LOAD: f64 = 1.0;
/// No step is shorter than this part of the way: its error is stated, but it is not repeated.
const SHORTEST_STEP: f64 = 1.0 / 1024.0;
/// The part of the largest step that the tolerance allows which is tried.
const STEP_SAFETY: f64 = 0.8;
/// The least and the most factor from one step to the next one that is tried.
const STEP_CHANGE: [f64; 2] = [0.2, 2.0];
/// The part of the tolerance that one way may use, since the errors of all ways add up.
const SHARE_OF_A_WAY: f64 = 0.5;
/// The error of the energy is compared with the energy lost, or with this part of the largest energy that tractions have stored: a path
/// on which hardly anything slips loses hardly anything.
pub(crate) const LEAST_LOSS: f64 = 1e-2;
/// The error of the shift is compared with the largest shift, or with this part of the displacement by the tractions: with coupling they may be large
/// where the shift is zero by symmetry.
pub(crate) const LEAST_SHIFT: f64 = 0.1;
/// With coupling, the first step of a contact that begins, over the way: the pressure makes the first nodes slip, and a step from nothing and
/// its halves are in error alike. The steps grow from there.
const FIRST_STEP_FROM_NOTHING: f64 = SHORTEST_STEP;
/// The least stated error of the shift and of the lost energy, over their sizes and the tolerance: a step and its halves may agree by chance, where few
/// nodes touch or where the direction of slip turns.
const LEAST_STATED: [f64; 2] = [0.2, 0.5];
/// The least stated error of the lost energy of a path that slips, over the largest energy that tractions have stored and the tolerance. Paths that lose
/// less than a hundredth of what is stored had errors of up to this size.
const LEAST_OF_STORED: f64 = 0.02;
/// The least part of the tolerance that a step may use, however short it is: where a contact begins, its first steps are alike whatever their
/// length.
const LEAST_SHARE: f64 = 1.0 / 16.0;
/// The part of an error that the next state still states: where a difference crosses zero, it says nothing.
const FADING_ERROR: f64 = 0.5;

/// The stated error, over the difference of a step from its halves. The latter is the error of the halves where it is of first order; where nodes
/// begin to slip or turn within a step, it scatters about that.
const STATED_OVER_DIFFERENCE: f64 = 2.0;

/// How many steps a path takes from one point to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SlipPace {
    /// As many equal steps.
    Count(usize),
    /// As many as an estimated relative error of the shift and of the lost energy needs.
    Tolerance(f64),
}

/// The steps of a history between pairs of a normal and a tangential load, between which both change linearly.
pub(super) struct SlipSteps<'s> {
    history: SlipHistory<'s>,
    pace: SlipPace,
    /// The history in doubled steps, where it is another one.
    doubled: Option<SlipMemory>,
    /// By how much the shift in doubled steps is larger.
    shift_apart: f64,
    totals: SlipTotals,
    /// The largest shift and the largest energy stored by tractions so far.
    largest: [f64; 2],
}

/// A way between two pairs of a normal and a tangential load.
#[derive(Clone, Copy)]
struct LoadWay {
    /// The kind of both loads.
    kind: Load,
    from: [f64; 2],
    to: [f64; 2],
}

impl LoadWay {
    /// The loads at a part of the way.
    fn at(&self, part: f64) -> (Load, f64) {
        let [load, tangential] = [0, 1].map(|i| match part >= 1.0 {
            true => self.to[i],
            false => self.from[i] + part * (self.to[i] - self.from[i]),
        });
        (self.kind.with_value(load), tangential)
    }
}

/// A step beside its two halves.
struct HalvedStep {
    whole: SlipState,
    /// The state after both halves, with what they add up to.
    fine: SlipState,
    /// What the doubled history carries after the step.
    doubled: SlipMemory,
}

impl<'s> SlipSteps<'s> {
    /// The steps of a history that has not begun.
    pub(crate) fn new(history: SlipHistory<'s>, pace: SlipPace) -> Self {
        let history = match pace {
            // steps that are given are those of the plain law, as users know it
            SlipPace::Count(_) => history,
            SlipPace::Tolerance(_) => history.counting_from_touch(),
        };
        let totals = SlipTotals { errors: Some(SlipPathErrors::default()), ..SlipTotals::default() };
        Self { history, pace, doubled: None, shift_apart: 0.0, totals, largest: [0.0; 2] }
    }

    /// How many steps a path takes.
    pub(crate) fn pace(&self) -> SlipPace {
        self.pace
    }

    /// Whether there was a step.
    pub(crate) fn has_begun(&self) -> bool {
        self.history.has_begun()
    }

    /// What all steps so far add up to.
    pub(crate) fn totals(&self) -> SlipTotals {
        self.totals
    }

    /// Goes from the loads of the last state to others, and gives the state there with the slip, the shift and the energy of the whole way. After
    /// an error the history is as it was.
    pub(crate) fn go(
        &mut self,
        kind: Load,
        [from, to]: [[f64; 2]; 2],
        observer: &mut dyn Observer,
    ) -> Result<SlipState, SlipError> {
        let begin = (self.history.memory().clone(), self.doubled.clone(), self.shift_apart, self.totals);
        let way = LoadWay { kind, from, to };
        let state = self.press_and_pass(way, observer);
        if state.is_err() {
            self.history.recall(begin.0);
            (self.doubled, self.shift_apart, self.totals) = (begin.1, begin.2, begin.3);
        }
        state
    }

    /// The way, and with coupling the first normal load before it: as it grows, the pressure makes nodes slip. Applied at once, it would
    /// make them lose three times the energy (a cylinder with Poisson's ratio .3 and a friction coefficient of .3).
    fn press_and_pass(&mut self, way: LoadWay, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        // a way that cannot be gone to its end is not begun
        self.history.check(way.at(1.0))?;
        let has_pressed = self.history.has_begun() || !self.history.is_coupled() || way.from[0] <= 0.0;
        if has_pressed {
            return self.pass(way, observer);
        }
        let pressing = LoadWay { from: [0.0; 2], to: [way.from[0], 0.0], ..way };
        let pressed = match self.pace {
            SlipPace::Count(count) => self.divide(pressing, count, observer)?,
            SlipPace::Tolerance(_) => self.pass(pressing, observer)?,
        };
        let is_there = way.from == way.to || is_stopped(&pressed);
        Ok(if is_there { pressed } else { self.pass(way, observer)?.after(pressed) })
    }

    /// The whole way: in one step where the number of steps is given or one step is exact, and else in as many as the tolerance needs.
    fn pass(&mut self, way: LoadWay, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let (load, tangential) = way.at(1.0);
        match self.pace {
            SlipPace::Tolerance(tolerance) if !self.history.is_exact_to(load, tangential) => {
                self.adapt(way, tolerance, observer)
            }
            _ => self.step(way, observer),
        }
    }

    /// The whole way in `count` equal steps, and at least one.
    fn divide(&mut self, way: LoadWay, count: usize, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let end = |step: usize| if step >= count { 1.0 } else { step as f64 / count as f64 };
        let loads = |part: f64| {
            let (load, tangential) = way.at(part);
            [load.value(), tangential]
        };
        let mut state = self.step(LoadWay { to: loads(end(1)), ..way }, observer)?;
        for step in 2..=count {
            if is_stopped(&state) {
                break;
            }
            let part = LoadWay { from: loads(end(step - 1)), to: loads(end(step)), ..way };
            state = self.step(part, observer)?.after(state);
        }
        Ok(state)
    }

    /// One step to the end of a way, also of the history in doubled steps.
    fn step(&mut self, way: LoadWay, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let (load, tangential) = way.at(1.0);
        let is_exact = self.history.is_exact_to(load, tangential);
        let state = self.history.step(load, tangential, observer)?;
        let mut apart = [0.0; 3];
        if let Some(doubled) = self.doubled.take() {
            let fine = self.history.recall(doubled);
            let other = self.history.step(load, tangential, observer)?;
            self.doubled = Some(self.history.recall(fine));
            apart = difference(&other, &state);
        }
        if !is_exact {
            self.totals.errors = None;
        }
        Ok(self.keep(state, apart))
    }

    /// Steps beside doubled ones to the end of a way, each with an error within the tolerance.
    fn adapt(&mut self, way: LoadWay, tolerance: f64, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let mut wanted = match (self.history.is_coupled(), way.from[0]) {
            (true, 0.0) => FIRST_STEP_FROM_NOTHING,
            (false, load) if load == way.to[0] => FIRST_STEP_UNDER_ONE_LOAD,
            _ => FIRST_STEP,
        };
        let (mut done, mut loss_before) = (0.0, 0.0);
        let mut passed: Option<SlipState> = None;
        loop {
            let left = 1.0 - done;
            // the last two steps are of equal length
            let step = if left <= wanted { left } else { wanted.min(0.5 * left) };
            let ends = [0.5, 1.0].map(|part| if step == left && part == 1.0 { 1.0 } else { done + part * step });
            let begin = self.history.memory().clone();
            let trial = self.trial(ends.map(|end| way.at(end)), observer)?;
            let excess = self.excess(&trial, way, [done, step], tolerance);
            let factor = (STEP_SAFETY * excess.sqrt().recip()).clamp(STEP_CHANGE[0], STEP_CHANGE[1]);
            // the error of what is not solved says nothing about the step
            let is_solved = trial.whole.is_converged() && trial.fine.is_converged();
            if excess > 1.0 && is_solved && step > SHORTEST_STEP {
                self.history.recall(begin);
                wanted = step * factor.min(0.5);
                continue;
            }
            wanted = (step * factor).max(SHORTEST_STEP);
            done = ends[1];
            let [shift, loss, share] = difference(&trial.whole, &trial.fine);
            // where a difference crosses zero, it says nothing
            let loss = loss.abs().max(FADING_ERROR * loss_before);
            loss_before = loss;
            let least_loss = LEAST_STATED[1] * tolerance * trial.fine.dissipated;
            let displaced = trial.fine.displacement_by_traction();
            self.doubled = Some(trial.doubled);
            let state = self.keep(trial.fine, [shift, loss.max(least_loss), share]);
            let least_shift = LEAST_STATED[0] * tolerance * self.largest[0].max(LEAST_SHIFT * displaced);
            let slips = self.totals.dissipated > 0.0;
            let least_loss = if slips { LEAST_OF_STORED * tolerance * self.largest[1] } else { 0.0 };
            if let Some(errors) = &mut self.totals.errors {
                errors.shift = errors.shift.max(least_shift);
                errors.dissipated = errors.dissipated.max(least_loss);
            }
            let state = match passed.take() {
                Some(earlier) => state.after(earlier),
                None => state,
            };
            if done >= 1.0 || is_stopped(&state) {
                return Ok(state);
            }
            passed = Some(state);
        }
    }

    /// A step of the doubled history, beside both of its halves.
    fn trial(&mut self, [middle, end]: [(Load, f64); 2], observer: &mut dyn Observer) -> Result<HalvedStep, SlipError> {
        let begin = self.history.memory().clone();
        if let Some(doubled) = &self.doubled {
            self.history.recall(doubled.clone());
        }
        let whole = self.history.step(end.0, end.1, observer)?;
        let doubled = self.history.recall(begin);
        let half = self.history.step(middle.0, middle.1, observer)?;
        let fine = self.history.step(end.0, end.1, observer)?.after(half);
        Ok(HalvedStep { whole, fine, doubled })
    }

    /// The largest relative error of a step, over what the step may cause: of the shift and of the lost energy, and with coupling of the energy that the
    /// tractions store. While a pressure grows on bodies that stick, neither shift nor loss shows how wrong the tractions are, and later pulls begin from them.
    fn excess(&self, trial: &HalvedStep, way: LoadWay, [done, step]: [f64; 2], tolerance: f64) -> f64 {
        let [shift_error, loss_error, _] = difference(&trial.whole, &trial.fine).map(f64::abs);
        // what the way comes to at this rate
        let left = (1.0 - done) / step;
        let shift = (self.totals.shift + left * trial.fine.shift).abs().max(self.largest[0]);
        let shift = shift.max(LEAST_SHIFT * trial.fine.displacement_by_traction());
        let lost = self.totals.dissipated + left * trial.fine.dissipated;
        let lost = lost.max(LEAST_LOSS * self.largest[1].max(trial.fine.stored));
        let allowed = SHARE_OF_A_WAY * tolerance * step.max(LEAST_SHARE);
        let over = |error: f64, size: f64| if error > 0.0 { error / (allowed * size) } else { 0.0 };
        let of_both = over(shift_error, shift).max(over(loss_error, lost));
        if !self.history.is_coupled() {
            return of_both;
        }
        // what the pressure makes tractions store grows like its square
        let grown = (way.to[0] / way.at(done + step).0.value()).max(1.0).powi(2);
        let stored = self.largest[1].max(grown * trial.fine.stored);
        // unlike the loss of a step, it has the errors of all steps before
        let stored_error = (trial.whole.stored - trial.fine.stored).abs();
        of_both.max(if stored > 0.0 { stored_error / (SHARE_OF_A_WAY * tolerance * stored) } else { 0.0 })
    }

    /// Counts a step with its differences from the doubled history, and says what its claim is.
    fn keep(&mut self, mut state: SlipState, [shift, dissipated, stick_share]: [f64; 3]) -> SlipState {
        self.totals.shift += state.shift;
        self.totals.dissipated += state.dissipated;
        self.largest = [self.largest[0].max(self.totals.shift.abs()), self.largest[1].max(state.stored)];
        self.shift_apart += shift;
        if let Some(errors) = &mut self.totals.errors {
            *errors = SlipPathErrors {
                shift: self.shift_apart.abs().max(FADING_ERROR * errors.shift),
                dissipated: errors.dissipated + dissipated.abs(),
                stick_share: stick_share.abs().max(state.stick_edge_share()),
            };
        }
        state.claim = match (state.claim, self.totals.errors) {
            (ResultClaim::Solution, None) => ResultClaim::GivenSteps,
            (ResultClaim::Solution, Some(_)) if self.doubled.is_some() => ResultClaim::PathSteps,
            (ResultClaim::RoundsConverged, None) => ResultClaim::RoundsOfGivenSteps,
            (ResultClaim::RoundsConverged, Some(_)) if self.doubled.is_some() => ResultClaim::RoundsOfPathSteps,
            (claim, _) => claim,
        };
        state
    }
}

/// Whether an observer has stopped the run: further steps would each begin, and find nothing.
fn is_stopped(state: &SlipState) -> bool {
    state.contact.status == Status::StoppedByObserver
}

/// The stated errors by how much a doubled step differs from its halves, with their signs: of shift, lost energy, and the share that sticks.
fn difference(whole: &SlipState, fine: &SlipState) -> [f64; 3] {
    let share = whole.stick_share() - fine.stick_share();
    let share = if share.is_finite() { share } else { 0.0 };
    [whole.shift - fine.shift, whole.dissipated - fine.dissipated, share]
        .map(|difference| STATED_OVER_DIFFERENCE * difference)
}

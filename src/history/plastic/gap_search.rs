//! The load step that ends at a mean gap.

use super::plastic_process::CONTACT_TOLERANCE;
use super::{Plastic, PlasticState};
use crate::contact::{Contact, Load, Observer, Status, Stop};
use crate::error::PlasticError;
use crate::history::apart::apart;
use crate::surface::Field;

/// A mean gap is reached if it is off by less than this part of the rms height, and of its distance from closure and from first touch: near these the load
/// is off by about the last part.
const TOLERANCE: f64 = 1e-6;
const ROOM_TOLERANCE: f64 = 1e-5;
/// The least part of the rms height by which a mean gap may be off, because of rounding.
const GAP_ROUNDING: f64 = 1e-13;
/// The least pressure with which a search begins, over that which moves the softest wave by the distance from first touch: contacts of a few nodes are softer.
const LEAST_START: f64 = 0.01;
/// The most load steps of a search.
const MOST_STEPS: usize = 40;

/// A mean pressure, and by how much the mean gap under it is too large.
type GapTrial = [f64; 2];

/// The trials on both sides of the pressure that is searched.
struct GapBracket {
    low: GapTrial,
    /// None as long as all pressures were too small.
    high: Option<GapTrial>,
    /// Whether the last trial was too low a pressure.
    was_low: bool,
}

impl GapBracket {
    /// Takes a trial in, and returns the pressure of the next one: that of the secant, in which an end that stays for a second time counts half, so that it moves
    /// soon (regula falsi of Illinois).
    fn next(&mut self, trial: GapTrial) -> f64 {
        let is_low = trial[1] > 0.0;
        let is_again = is_low == self.was_low;
        let half = |end: &mut GapTrial| end[1] *= if is_again { 0.5 } else { 1.0 };
        if is_low {
            self.high.iter_mut().for_each(half);
            self.low = trial;
        } else {
            half(&mut self.low);
            self.high = Some(trial);
        }
        self.was_low = is_low;
        let low = self.low;
        let Some(high) = self.high else { return 2.0 * low[0] };
        let secant = (low[0] * high[1] - high[0] * low[1]) / (high[1] - low[1]);
        if secant > low[0] && secant < high[0] { secant } else { 0.5 * (low[0] + high[0]) }
    }
}

impl Plastic<'_> {
    /// The state after the load step at whose end the mean gap is a given one, a length. The mean gap falls as the mean pressure grows: the search begins at the
    /// pressure of a solid in which nothing flows any more. Each trial is a whole load step from the last state.
    pub(super) fn step_to_gap(&mut self, gap: f64, observer: &mut dyn Observer) -> Result<PlasticState, PlasticError> {
        let free = self.step(Load::MeanPressure(0.0), observer)?;
        let touching = free.contact.mean_gap();
        if gap >= touching {
            return Ok(free.lifted_to(gap));
        }
        let (rms_height, room) = (self.problem().rms_height(), gap.min(touching - gap));
        let within = (TOLERANCE * rms_height).min(ROOM_TOLERANCE * room).max(GAP_ROUNDING * rms_height);
        let limit = self.solid().deep_limit();
        // so close to first touch the elastic contact may carry nothing that its tolerance sees; from a pressure of 0 the search would not go on
        let [softest, _] = self.problem().compliance().stiffness_range();
        let stiff = self.elastic_pressure(gap, observer)?.max(LEAST_START * softest * room);
        let mut bracket = GapBracket { low: [0.0, touching - gap], high: None, was_low: true };
        let (mut pressure, mut work, mut trials) = (stiff.min(limit), free.contact.work, 0);
        loop {
            trials += 1;
            let mut state = self.step(Load::MeanPressure(pressure), observer)?;
            work += state.contact.work;
            let excess = state.contact.mean_gap() - gap;
            if pressure == limit && excess > within {
                return Err(PlasticError::YieldsEverywhere { mean_pressure: stiff, limit });
            }
            let is_reached = excess.abs() <= within;
            if is_reached || trials == MOST_STEPS {
                (state.load, state.is_converged) = (Some(Load::MeanGap(gap)), state.is_converged && is_reached);
                state.contact = state.contact.with_work(work);
                if !is_reached {
                    state.contact.status = Status::IterationCap;
                }
                return Ok(state);
            }
            pressure = bracket.next([pressure, excess]).min(limit);
        }
    }

    /// The mean pressure at a mean gap if nothing flowed any more.
    fn elastic_pressure(&self, gap: f64, observer: &mut dyn Observer) -> Result<f64, PlasticError> {
        let problem = self.problem();
        let heights = problem.surface().height() - &self.state().residual;
        let pressed = problem.with_heights(heights)?.with_load(Load::MeanGap(gap))?;
        Ok(self.solver().solve(&pressed, &Stop::default().at(CONTACT_TOLERANCE), observer)?.mean_pressure())
    }
}

impl PlasticState {
    /// The state whose rigid surface was lifted to a mean gap, from where it just touches.
    fn lifted_to(self, gap: f64) -> Self {
        let Contact { problem, displacement, work, .. } = self.contact;
        let mean = |field: &Field| field.mean().unwrap_or(0.0);
        let datum = gap - mean(&displacement) + mean(problem.surface().height());
        Self { load: Some(Load::MeanGap(gap)), contact: apart(problem, displacement, work, Some(datum)), ..self }
    }
}

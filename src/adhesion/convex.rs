//! The safe method: each step is a contact without adhesion, of other heights.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use super::gap_energy::mean;
use super::search_limits::SearchLimits;
use crate::anderson::Anderson;
use crate::chunks;
use crate::contact::{Load, Observer, Problem, Solver, Status, Stop};
use crate::elastic::Response;
use crate::error::AdhesionError;
use crate::surface::Field;

/// Rounding of the energy, relative to its parts.
const ROUNDING: f64 = 1e-11;

/// The tolerance of the contact in a step: the square of this part of the last change of the traction, within bounds.
const PART: f64 = 0.03;
const FINEST: f64 = 1e-12;
const COARSEST: f64 = 1e-7;

/// Where the gaps of a step miss more than this part of what its traction changes, the tolerance of the next contact is sharper by a factor, down to the
/// sharpest one.
const DOMINANT: f64 = 0.3;
const SHARPER: f64 = 1e-3;
const SHARPEST: f64 = 1e-24;

/// A state on the way of the safe method.
#[derive(Clone)]
pub(super) struct ConvexState {
    /// The contact pressure.
    pub pressure: Vec<f64>,
    /// The attraction that the step was solved with, a pressure.
    pub traction: Vec<f64>,
    pub displacement: Vec<f64>,
    pub gap: Vec<f64>,
    /// The datum of the gap: `g = u - h + d`.
    pub datum: f64,
    /// `1/2 <p u> + <V(g)>`, with `P d` added under a mean pressure.
    pub energy: f64,
    /// The largest change of the traction by its gap, over the strength.
    pub change: f64,
    /// The largest gap of a node that presses and the deepest penetration of another one, over the range.
    pub missed: f64,
}

/// How a search by convex steps ended.
pub(super) enum ConvexEnd {
    Found,
    /// The attraction cannot hold the load any more.
    Separated,
    /// The steps were too many, or the contact of a step was not found.
    Failed,
    Stopped,
}

/// The convex steps of a contact with adhesion under a control, and the work that they have done.
pub(super) struct ConvexSteps<'a> {
    pub problem: &'a Problem,
    pub attraction: &'a Attraction,
    pub control: AdhesiveControl,
    pub solver: &'a dyn Solver,
    pub stop: Stop,
    /// Energies of the accepted states.
    pub energies: Vec<f64>,
    pub transforms: u64,
    /// Iterations of the contacts of all steps; the stop limits their number.
    pub iterations: usize,
    /// The factor of the tolerance of the contacts.
    sharper: f64,
    response: Response,
}

impl<'a> ConvexSteps<'a> {
    pub(crate) fn new(
        problem: &'a Problem,
        attraction: &'a Attraction,
        control: AdhesiveControl,
        solver: &'a dyn Solver,
        stop: Stop,
    ) -> Self {
        let (energies, response) = (Vec::new(), problem.response());
        let (transforms, iterations, sharper) = (0, 0, 1.0);
        Self { problem, attraction, control, solver, stop, energies, transforms, iterations, sharper, response }
    }

    /// Lowers the energy from a traction by convex steps until the traction changes by at most `tolerance` of the strength, and gaps miss by at most
    /// `tolerance` of the range.
    ///
    /// `V` is concave, so the energy lies below its tangent: the contact with the attraction `sigma_k` held fast has less energy than the
    /// last state, whatever its length. It is the contact without adhesion of the heights `h + A sigma_k` under the pressure `P + <sigma_k>`.
    /// Anderson's method combines the last tractions; where its step does not lower the energy, the plain one is taken.
    pub(crate) fn lower(
        &mut self,
        start: Vec<f64>,
        pressed: Option<Field>,
        SearchLimits { tolerance, steps }: SearchLimits,
        observer: &mut dyn Observer,
    ) -> Result<(Option<ConvexState>, ConvexEnd), AdhesionError> {
        let mut accepted: Option<ConvexState> = None;
        let mut traction = start;
        let mut pressed = pressed;
        let mut anderson = Anderson::default();
        let strength = self.attraction.strength();
        let mut change = 1.0;
        // where the traction jumps, a node is within its reach or not, and combinations of both mean nothing
        let is_smooth = self.attraction.steepest().is_finite();
        for _ in 0..steps {
            if self.iterations >= self.stop.max_iterations() {
                break;
            }
            let (state, status) = match self.step(&traction, pressed.as_ref(), change, observer)? {
                Some(found) => found,
                // an accelerated traction may be too weak where the plain one is not
                None if anderson.is_combined() => {
                    traction = self.tractions(&accepted);
                    anderson.clear();
                    continue;
                }
                None => return Ok((accepted, ConvexEnd::Separated)),
            };
            if status == Status::StoppedByObserver {
                return Ok((accepted.or(Some(state)), ConvexEnd::Stopped));
            }
            let scale = ROUNDING * (state.energy.abs() + self.attraction.work());
            let rises = accepted.as_ref().is_some_and(|last| state.energy > last.energy + scale);
            if rises && anderson.is_combined() {
                traction = self.tractions(&accepted);
                anderson.clear();
                continue;
            }
            self.energies.push(state.energy);
            change = state.change;
            pressed = Some(field(self.problem, state.pressure.clone()));
            let next: Vec<f64> = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
            let is_found = change.max(state.missed) <= tolerance;
            if state.missed > DOMINANT * change.max(tolerance) {
                self.sharper = (SHARPER * self.sharper).max(SHARPEST);
            }
            accepted = Some(state);
            if is_found {
                return Ok((accepted, ConvexEnd::Found));
            }
            let moved: Vec<f64> = next.iter().zip(&traction).map(|(to, from)| to - from).collect();
            traction = if is_smooth {
                let mut next = anderson.next(traction, moved, 1.0);
                next.iter_mut().for_each(|traction| *traction = traction.clamp(0.0, strength));
                next
            } else {
                next
            };
        }
        Ok((accepted, ConvexEnd::Failed))
    }

    /// The tractions at the gap of an accepted state.
    fn tractions(&self, accepted: &Option<ConvexState>) -> Vec<f64> {
        let gap = accepted.as_ref().map_or(&[][..], |state| &state.gap);
        gap.iter().map(|gap| self.attraction.traction(*gap)).collect()
    }

    /// The contact with a traction held fast; none if nothing carries the load.
    fn step(
        &mut self,
        traction: &[f64],
        pressed: Option<&Field>,
        change: f64,
        observer: &mut dyn Observer,
    ) -> Result<Option<(ConvexState, Status)>, AdhesionError> {
        let n = traction.len();
        let mut lifted = vec![0.0; n];
        self.response.displacement(traction, &mut lifted);
        self.transforms += 2;
        let height = self.problem.height();
        let heights: Vec<f64> = height.iter().zip(&lifted).map(|(h, u)| h + u).collect();
        let posed = self.problem.posed_for(field(self.problem, heights.clone()))?;
        // a surface keeps its heights about their mean
        let (middle, highest) = (mean(&heights), posed.highest());
        let datum = match self.control {
            AdhesiveControl::MeanPressure(_) => None,
            AdhesiveControl::MeanGap(gap) => Some(gap - middle),
            AdhesiveControl::Approach(approach) => Some(self.problem.highest() - approach - middle),
        };
        let load = match self.control {
            AdhesiveControl::MeanPressure(pressure) => pressure + mean(traction),
            AdhesiveControl::MeanGap(_) | AdhesiveControl::Approach(_) => f64::NAN,
        };
        let touches = datum.map_or(load > 0.0, |datum| highest > datum);
        let (pressure, displaced, datum, status) = if touches {
            let load = match (self.control, datum) {
                (AdhesiveControl::Approach(_), Some(datum)) => Load::Approach(posed.highest() - datum),
                (_, Some(datum)) => Load::MeanGap(datum),
                (_, None) => Load::MeanPressure(load),
            };
            let posed = posed.with_load(load)?;
            let tolerance = ((PART * change).powi(2).clamp(FINEST, COARSEST) * self.sharper).max(SHARPEST);
            let stop = self.stop.at(tolerance).within(self.stop.max_iterations() - self.iterations);
            let contact = self.solver.solve_from(pressed, &posed, &stop, observer)?;
            self.transforms += contact.work.transforms;
            self.iterations += contact.work.iterations.max(1);
            let datum = contact.gap[[0, 0]] - contact.displacement[[0, 0]] + posed.height()[0];
            let values = |field: Field| field.into_raw_vec_and_offset().0;
            (values(contact.pressure), values(contact.displacement), datum + middle, contact.status)
        } else {
            let Some(datum) = datum else { return Ok(None) };
            self.iterations += 1;
            (vec![0.0; n], vec![0.0; n], datum + middle, Status::Converged)
        };
        let displacement: Vec<f64> = displaced.iter().zip(&lifted).map(|(u, lifted)| u - lifted).collect();
        // nodes that press touch exactly, whatever rounding says
        let free_gap = |i: usize| displacement[i] - height[i] + datum;
        let gap: Vec<f64> = (0..n).map(|i| if pressure[i] > 0.0 { 0.0 } else { free_gap(i).max(0.0) }).collect();
        let (strength, attraction) = (self.attraction.strength(), self.attraction);
        let missed = (0..n).map(|i| (free_gap(i) - gap[i]).abs()).fold(0.0, f64::max) / attraction.range();
        let change = (0..n).map(|i| (attraction.traction(gap[i]) - traction[i]).abs()).fold(0.0, f64::max) / strength;
        let work = |i: usize| 0.5 * (pressure[i] - traction[i]) * displacement[i] + attraction.energy(gap[i]);
        let mut energy = chunks::sum(n, work) / n as f64;
        if let AdhesiveControl::MeanPressure(load) = self.control {
            energy += load * datum;
        }
        let traction = traction.to_vec();
        Ok(Some((ConvexState { pressure, traction, displacement, gap, datum, energy, change, missed }, status)))
    }
}

fn field(problem: &Problem, values: Vec<f64>) -> Field {
    Field::from_shape_vec(problem.surface().grid().shape(), values).expect("one value per node")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use crate::adhesion::AttractionForm;
    use crate::contact::{ContactModulus, Multilevel};
    use crate::surface::{Spectrum, Surface};

    /// Whatever the attraction: a convex step never raises the energy, accelerated or not.
    #[test]
    fn the_energy_falls_in_every_step() {
        let table = Attraction::from_table(vec![0.0, 4e-4, 2e-3], vec![0.05, 0.04, 0.0]).unwrap();
        let forms = [AttractionForm::Exponential, AttractionForm::Cubic, AttractionForm::Dugdale];
        let attractions = forms.into_iter().map(|form| Attraction::new(form, 3e-5, 7e-4).unwrap()).chain([table]);
        for (seed, attraction) in attractions.enumerate() {
            for periodic in [true, false] {
                let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.1 };
                let grid = Grid::line(512, 1.0).unwrap();
                let height = Surface::rough(grid, &spectrum, seed as u64).unwrap().height().clone();
                let surface = Surface::new(grid.with_periodic([periodic, periodic]), height).unwrap();
                let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
                let control = AdhesiveControl::MeanPressure(0.002);
                let mut steps = ConvexSteps::new(&problem, &attraction, control, &Multilevel, Stop::default());
                let start = vec![attraction.strength(); 512];
                let (found, end) =
                    steps.lower(start, None, SearchLimits { tolerance: 1e-6, steps: 300 }, &mut ()).unwrap();
                assert!(matches!(end, ConvexEnd::Found) && found.is_some(), "{attraction:?}");
                let work = attraction.work();
                let rises = steps.energies.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max);
                assert!(steps.energies.len() > 2 && rises <= 1e-9 * work, "{attraction:?}: {rises:e}");
            }
        }
    }
}

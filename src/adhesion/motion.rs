//! The method that can be watched: a damped motion of the surface, in which the attraction acts as a force.

use super::control::AdhesiveControl;
use super::gap_energy::{GapEnergy, GapState};
use super::newton::GapEnd;
use super::search_limits::SearchLimits;
use crate::contact::{Gfmd, Pace};

/// The surface in motion: the pace, and by how much the gap changed in the last step.
///
/// The time step and the friction are those of [`Gfmd`] without adhesion. The attraction only makes the energy less stiff, and so the step
/// stays stable.
pub(super) struct DampedMotion {
    pace: Pace,
    advance: Vec<f64>,
}

impl DampedMotion {
    /// The surface at rest.
    pub(crate) fn new(energy: &GapEnergy<'_>) -> Self {
        let stiffness: Vec<f64> = energy.stiffnesses().collect();
        Self { pace: Pace::new(&Gfmd::default(), &stiffness), advance: vec![0.0; energy.height.len()] }
    }

    /// Moves the surface until the residual is at most `tolerance`, or for some steps. `watch` sees each state, and whether to go on.
    pub(crate) fn run(
        &mut self,
        energy: &mut GapEnergy<'_>,
        state: &mut GapState,
        SearchLimits { tolerance, steps }: SearchLimits,
        watch: &mut dyn FnMut(&GapEnergy<'_>, &GapState, usize) -> bool,
    ) -> (GapEnd, usize) {
        for step in 0..=steps {
            if !watch(energy, state, step) {
                return (GapEnd::Stopped, step);
            }
            if parts_for_good(energy, state) {
                return (GapEnd::Separated, step);
            }
            if energy.residual(state, tolerance) <= tolerance {
                return (GapEnd::Found, step);
            }
            if step < steps {
                self.step(energy, state);
            }
        }
        (GapEnd::Failed, steps)
    }

    /// One step of the motion, and back onto the wall where it was passed. Nodes that touch are held: the wall balances their force.
    fn step(&mut self, energy: &mut GapEnergy<'_>, state: &mut GapState) {
        let force: Vec<f64> =
            (0..state.gap.len()).map(|i| if state.touches(i) { 0.0 } else { -state.gradient[i] }).collect();
        let [keep, add] = self.pace.push(&force, &self.advance, &force);
        let moved = |i: usize| if state.touches(i) { 0.0 } else { keep * self.advance[i] + add * force[i] };
        let mut gap: Vec<f64> = state.gap.iter().enumerate().map(|(i, gap)| (gap + moved(i)).max(0.0)).collect();
        energy.carry(&mut gap, |i| !state.touches(i));
        self.advance = gap.iter().zip(&state.gap).map(|(to, from)| to - from).collect();
        *state = energy.state(gap);
    }
}

/// Whether a load pulls more than the attraction wherever the surface of the solid may still go.
///
/// Its lowest point, were it below the highest peak, would be attracted by `sigma(g)`, and no point is attracted more. Where the load pulls
/// more than that, the lowest point moves away, since elasticity pulls it back as well. Then the attraction falls further, and so the
/// surfaces part for good, whatever their shape.
fn parts_for_good(energy: &GapEnergy<'_>, state: &GapState) -> bool {
    let AdhesiveControl::MeanPressure(pressure) = energy.control else { return false };
    let lowest = state.gap.iter().zip(energy.height).map(|(gap, height)| gap + height).fold(f64::INFINITY, f64::min);
    let highest = energy.height.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    pressure + energy.attraction.traction((lowest - highest).max(0.0)) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use crate::adhesion::{Attraction, AttractionForm};
    use crate::contact::{ContactModulus, Load, Problem};
    use crate::surface::Indenter;

    /// Surfaces have parted once the lowest point is out of reach, and not while a pull is still held.
    #[test]
    fn surfaces_part_where_no_point_is_held() {
        let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
        let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
        let attraction = Attraction::new(AttractionForm::Exponential, 0.1, 0.5).unwrap();
        let parted = |pressure: f64, least: f64| {
            let mut energy = GapEnergy::new(&problem, &attraction, AdhesiveControl::MeanPressure(pressure));
            let datum = problem.highest() + least;
            let state = energy.state(problem.height().iter().map(|h| datum - h).collect());
            parts_for_good(&energy, &state)
        };
        let (strength, range) = (attraction.strength(), attraction.range());
        assert!(parted(-1.01 * strength, 0.0) && !parted(-0.99 * strength, 0.0));
        // one range away the attraction is 1/e of its strength
        assert!(parted(-0.37 * strength, range) && !parted(-0.36 * strength, range));
        assert!(!parted(0.0, 5.0 * range) && !parted(0.1, 50.0 * range));
    }
}

//! The energy of a contact with adhesion as a function of the gap.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use crate::chunks;
use crate::contact::Problem;
use crate::elastic::Response;

/// Largest error of `K u` by rounding: over the stiffest wave, the root mean square of `u` and the number of doublings of the grid. It is several
/// times the bound of a transform pair (Higham, *Accuracy and Stability of Numerical Algorithms*, 2002, theorem 24.2), since this is a maximum.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The energy of a gap `g >= 0` on a periodic grid, per area:
///
/// `E(g) = 1/2 <u K u> + <V(g)> + P <g>`, with `u = g + h - d` and the stiffness `K`, the inverse of the compliance.
///
/// Under a mean pressure `P` and at a mean gap, `K` of the mean is zero, and `d` does not matter; at a mean gap there is no `P`, and the
/// mean of `g` is given. At an approach, `d` is given and `K` of the mean is the stiffness of the solid under a uniform pressure.
pub(super) struct GapEnergy<'a> {
    pub attraction: &'a Attraction,
    pub control: AdhesiveControl,
    pub height: &'a [f64],
    response: Response,
    /// Stiffness of the mean, a pressure per length.
    uniform: f64,
    /// Stiffness of the stiffest wave, a pressure per length.
    stiffest: f64,
    /// The datum at a given approach.
    datum: f64,
}

/// A gap with what belongs to it.
#[derive(Clone)]
pub(super) struct GapState {
    pub gap: Vec<f64>,
    /// `K u`.
    pub force: Vec<f64>,
    /// The gradient `K u + sigma(g) + P`, at a mean gap with the multiplier of it in place of `P`: the contact pressure where the surfaces touch, and zero elsewhere at a solution.
    pub gradient: Vec<f64>,
}

impl<'a> GapEnergy<'a> {
    pub(crate) fn new(problem: &'a Problem, attraction: &'a Attraction, control: AdhesiveControl) -> Self {
        let uniform = match control {
            AdhesiveControl::Approach(_) => problem.solid().uniform_compliance().map_or(0.0, f64::recip),
            _ => 0.0,
        };
        let datum = if let AdhesiveControl::Approach(approach) = control { problem.highest() - approach } else { 0.0 };
        let response = problem.response();
        let stiffest = response.stiffnesses().fold(uniform, f64::max);
        Self { attraction, control, height: problem.height(), response, uniform, stiffest, datum }
    }

    /// Transforms so far.
    pub(crate) fn transforms(&self) -> u64 {
        self.response.transforms()
    }

    /// The softest stiffness of a wave, a pressure per length.
    pub(crate) fn softest(&self) -> f64 {
        self.response.softest_stiffness()
    }

    /// The stiffness of each wave, a pressure per length, and that of the mean where it counts.
    pub(crate) fn stiffnesses(&self) -> impl Iterator<Item = f64> + use<> {
        self.response.stiffnesses().chain([self.uniform])
    }

    /// Whether the mean of the gap is given.
    pub(crate) fn keeps_mean(&self) -> bool {
        matches!(self.control, AdhesiveControl::MeanGap(_))
    }

    /// `K x`: two transforms.
    pub(crate) fn stiffness(&mut self, x: &[f64], result: &mut [f64]) {
        self.response.pressure(x, result);
        if self.uniform > 0.0 {
            let mean = self.uniform * mean(x);
            result.iter_mut().for_each(|value| *value += mean);
        }
    }

    /// An approximate inverse of `K` between open nodes: the compliance, and `1/k_min` for the mean where the solid has none.
    pub(crate) fn precondition(&mut self, x: &[f64], result: &mut [f64]) {
        self.response.displacement(x, result);
        if self.uniform == 0.0 && !self.keeps_mean() {
            let mean = mean(x) / self.softest();
            result.iter_mut().for_each(|value| *value += mean);
        }
    }

    /// The datum of a gap: its mean, which keeps most digits, where the datum does not matter.
    fn datum_of(&self, gap: &[f64]) -> f64 {
        if self.uniform > 0.0 { self.datum } else { mean(gap) }
    }

    /// The state of a gap that is not negative; at a mean gap it must have this mean.
    pub(crate) fn state(&mut self, gap: Vec<f64>) -> GapState {
        let datum = self.datum_of(&gap);
        let displacement: Vec<f64> = gap.iter().zip(self.height).map(|(g, h)| g - datum + h).collect();
        let mut force = vec![0.0; gap.len()];
        self.stiffness(&displacement, &mut force);
        self.with_force(gap, force)
    }

    /// The state of a gap whose `K u` is known.
    pub(crate) fn with_force(&self, gap: Vec<f64>, force: Vec<f64>) -> GapState {
        let mut gradient = force.clone();
        chunks::update(&mut gradient, |range, gradient| {
            gradient.iter_mut().zip(&gap[range]).for_each(|(r, g)| *r += self.attraction.traction(*g));
        });
        let mean_pressure = match self.control {
            AdhesiveControl::MeanPressure(pressure) => pressure,
            AdhesiveControl::Approach(_) => 0.0,
            AdhesiveControl::MeanGap(_) => multiplier(&gap, &gradient),
        };
        gradient.iter_mut().for_each(|value| *value += mean_pressure);
        GapState { gap, force, gradient }
    }

    /// The change of the energy from a state by a change of its gap with its `K dg`: `<r dg> + 1/2 <dg K dg>` and what the attraction adds
    /// beyond its traction. At a mean gap the changes must have the sum zero.
    pub(crate) fn change(&self, from: &GapState, by: &[f64], stiff: &[f64]) -> f64 {
        chunks::sum(by.len(), |i| match by[i] {
            0.0 => 0.0,
            by => by * (from.gradient[i] + 0.5 * stiff[i]) + self.attraction.excess(from.gap[i], by),
        }) / by.len() as f64
    }

    /// The largest error of the gradient that rounding causes, a pressure. On a stiff solid it is larger than the attraction.
    fn rounding(&self, state: &GapState) -> f64 {
        let (n, datum) = (state.gap.len(), self.datum_of(&state.gap));
        let square = chunks::sum(n, |i| (state.gap[i] - datum + self.height[i]).powi(2)) / n as f64;
        ROUNDING * (n as f64).log2() * self.stiffest * square.sqrt()
    }

    /// Whether rounding may hide how well a state is in equilibrium.
    pub(crate) fn is_hidden(&self, state: &GapState) -> bool {
        state.violation() <= self.rounding(state)
    }

    /// The residual of a state: the largest pressure out of balance at an open node, over the strength. Where it misses the goal and rounding may
    /// cause that, it is the largest displacement `A r` by the pressures out of balance, over the range, if that is smaller: the compliance hardly
    /// moves the solid by rounding, since that has short waves.
    pub(crate) fn residual(&mut self, state: &GapState, goal: f64) -> f64 {
        let of_pressure = state.violation() / self.attraction.strength();
        if of_pressure <= goal || !self.is_hidden(state) {
            return of_pressure;
        }
        of_pressure.min(self.displaced(state))
    }

    /// The largest displacement by the pressures out of balance over the range. Under a mean pressure, the nodes that touch carry their mean, or
    /// else it counts as it is, over the strength.
    fn displaced(&mut self, state: &GapState) -> f64 {
        let n = state.gap.len();
        let touching: Vec<bool> = (0..n).map(|i| state.touches(i)).collect();
        let mut rest: Vec<f64> = (0..n).map(|i| if touching[i] { 0.0 } else { state.gradient[i] }).collect();
        let count = touching.iter().filter(|it| **it).count();
        let is_load = matches!(self.control, AdhesiveControl::MeanPressure(_));
        let (sum, mut missed) = (chunks::sum(n, |i| rest[i]), 0.0);
        if is_load && count > 0 {
            rest.iter_mut().zip(&touching).filter(|(_, it)| **it).for_each(|(rest, _)| *rest = -sum / count as f64);
        } else if is_load {
            missed = (sum / n as f64).abs() / self.attraction.strength();
        }
        let mut moved = vec![0.0; n];
        self.response.displacement(&rest, &mut moved);
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = moved.iter().fold(ends, |[low, high], u| [low.min(*u), high.max(*u)]);
        // the datum is free under a mean pressure
        let largest = if is_load { 0.5 * (high - low) } else { high.max(-low) };
        missed.max(largest / self.attraction.range())
    }

    /// The elastic energy and that of the attraction, per area.
    pub(crate) fn parts(&self, state: &GapState) -> [f64; 2] {
        let (n, datum) = (state.gap.len(), self.datum_of(&state.gap));
        let elastic = chunks::sum(n, |i| 0.5 * state.force[i] * (state.gap[i] - datum + self.height[i])) / n as f64;
        [elastic, chunks::sum(n, |i| self.attraction.energy(state.gap[i])) / n as f64]
    }

    /// Moves a gap to the nearest one that is not negative and has the given mean, if one is given. Only nodes for which `may_move` holds are
    /// shifted, so that nodes in contact stay there.
    pub(crate) fn carry(&self, gap: &mut [f64], may_move: impl Fn(usize) -> bool) {
        if let AdhesiveControl::MeanGap(goal) = self.control {
            let goal = goal * gap.len() as f64;
            // the sum of max(g + c, 0) is convex in c, and so Newton's method is monotone after its first step
            let mut shift = 0.0;
            for _ in 0..100 {
                let (mut sum, mut open) = (0.0, 0usize);
                let (mut highest, mut movable) = (f64::NEG_INFINITY, 0usize);
                for (i, g) in gap.iter().enumerate() {
                    let is_movable = may_move(i);
                    let value = if is_movable { g + shift } else { *g };
                    sum += value.max(0.0);
                    open += usize::from(is_movable && value > 0.0);
                    movable += usize::from(is_movable);
                    highest = if is_movable { highest.max(*g) } else { highest };
                }
                let missing = goal - sum;
                if movable == 0 || missing.abs() <= 1e-15 * goal {
                    break;
                }
                shift = if open > 0 { shift + missing / open as f64 } else { goal / movable as f64 - highest };
            }
            gap.iter_mut().enumerate().filter(|(i, _)| may_move(*i)).for_each(|(_, g)| *g += shift);
        }
        gap.iter_mut().for_each(|g| *g = g.max(0.0));
    }
}

impl GapState {
    /// Whether a node touches: its gap is zero, and the surfaces press there.
    pub(crate) fn touches(&self, i: usize) -> bool {
        self.gap[i] <= 0.0 && self.gradient[i] >= 0.0
    }

    /// The largest violation of the conditions of equilibrium, a pressure: of the gradient where the surfaces do not touch.
    pub(crate) fn violation(&self) -> f64 {
        let open = (0..self.gap.len()).filter(|&i| !self.touches(i));
        open.map(|i| self.gradient[i].abs()).fold(0.0, f64::max)
    }
}

/// The multiplier of a given mean gap: minus the mean of `K u + sigma` where the surfaces do not touch. Nodes that touch and would not be
/// pressed count as open.
fn multiplier(gap: &[f64], pulled: &[f64]) -> f64 {
    let mean_of = |is_open: &dyn Fn(usize) -> bool| {
        let (mut sum, mut count) = (0.0, 0usize);
        for i in (0..gap.len()).filter(|&i| is_open(i)) {
            (sum, count) = (sum + pulled[i], count + 1);
        }
        (count > 0).then(|| -sum / count as f64)
    };
    let first = mean_of(&|i| gap[i] > 0.0).unwrap_or(0.0);
    mean_of(&|i| gap[i] > 0.0 || pulled[i] + first < 0.0).unwrap_or(first)
}

/// The mean of values.
pub(super) fn mean(x: &[f64]) -> f64 {
    chunks::sum(x.len(), |i| x[i]) / x.len() as f64
}

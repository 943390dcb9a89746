//! The iteration on one grid.

use super::correction::Correction;
use crate::contact::best::Best;
use crate::contact::{Certificate, Problem, certificate, chunks};
use crate::elastic::HalfSpace;

/// A state is better when its certificate is this part of that of the last better one.
const BETTER: f64 = 0.9;
/// Free updates without a better state after which the guard takes over.
const STALE: usize = 5;
/// The part to which guarded steps bring the best certificate before updates are free again.
const RELEASE: f64 = 0.5;

/// Reduction of the residual in a whole-set update, its part after an update that was no better, and the least. Loose
/// corrections cost less, but may let the sets cycle; tight ones have not been seen to.
const REDUCTION: f64 = 0.05;
const TIGHTENING: f64 = 0.5;
const TIGHTEST: f64 = 1e-3;

/// Pressure, its displacement, and the contact set on one grid.
pub(super) struct Level<'a> {
    pub problem: &'a Problem,
    pub half_space: HalfSpace,
    pub p: Vec<f64>,
    pub u: Vec<f64>,
    set: Vec<bool>,
    field: Vec<f64>,
    reduction: f64,
    pace: Pace,
}

/// Free updates, of which the last `stale` were no better than `mark`; or guarded steps, `steps` so far, until the certificate is
/// `release`.
enum Pace {
    Free { mark: f64, stale: usize },
    Guarded { release: f64, steps: usize },
}

impl<'a> Level<'a> {
    /// Starts from the pressure `start`, or from the uniform one.
    pub fn new(problem: &'a Problem, start: Option<Vec<f64>>) -> Self {
        let n = problem.nodes();
        let p = start.unwrap_or_else(|| vec![problem.expected_mean_pressure(); n]);
        Self {
            problem,
            half_space: HalfSpace::new(problem.surface().grid(), problem.contact_modulus()),
            set: p.iter().map(|&p| p > 0.0).collect(),
            p,
            u: vec![0.0; n],
            field: vec![0.0; n],
            reduction: REDUCTION,
            pace: Pace::Free { mark: f64::INFINITY, stale: 0 },
        }
    }

    /// Takes the displacement from a transform of the pressure, and returns the certificate of both.
    pub fn certify(&mut self) -> f64 {
        self.half_space.displacement(&self.p, &mut self.u);
        Certificate::of(self.problem, &self.p, &self.u).eta
    }

    /// The mean of `v` weighted by the pressure.
    pub fn lambda(&self) -> f64 {
        -certificate::datum(self.problem, &self.p, &self.u)
    }

    /// One free update or guarded step from a state with the certificate `eta`.
    pub fn advance(&mut self, eta: f64, best: &Best) {
        self.choose_pace(eta, best);
        match self.pace {
            Pace::Free { .. } => self.update(),
            Pace::Guarded { steps, .. } => self.descend(steps.is_multiple_of(2)),
        }
    }

    fn choose_pace(&mut self, eta: f64, best: &Best) {
        self.pace = match self.pace {
            Pace::Free { mark, .. } if eta <= BETTER * mark => Pace::Free { mark: eta, stale: 0 },
            Pace::Free { mark, stale } if stale < STALE => {
                self.reduction = (TIGHTENING * self.reduction).max(TIGHTEST);
                Pace::Free { mark, stale: stale + 1 }
            }
            Pace::Free { .. } => {
                self.return_to(best);
                Pace::Guarded { release: RELEASE * best.eta, steps: 0 }
            }
            Pace::Guarded { release, .. } if eta <= release => {
                self.admit();
                Pace::Free { mark: eta, stale: 0 }
            }
            Pace::Guarded { release, steps } => Pace::Guarded { release, steps: steps + 1 },
        };
    }

    fn return_to(&mut self, best: &Best) {
        self.p.copy_from_slice(&best.pressure);
        self.half_space.displacement(&self.p, &mut self.u);
    }

    /// Makes the set that of the pressure, and of the nodes where `v < lambda`.
    fn admit(&mut self) {
        let lambda = self.lambda();
        let (p, u, h) = (&self.p, &self.u, self.problem.height());
        self.set.iter_mut().enumerate().for_each(|(i, is_in)| *is_in = p[i] > 0.0 || u[i] - h[i] < lambda);
    }

    /// The whole-set update: corrects on the set, exchanges nodes by the signs of pressure and gap, clips and scales. The
    /// displacement is that of the signed pressure afterwards.
    fn update(&mut self) {
        let mut correction = Correction::new(&self.set, &self.u, self.problem.height());
        correction.solve(self.reduction, &mut self.half_space, &mut self.u, &mut self.field);
        let (u, h) = (&self.u, self.problem.height());
        let v_of_set: f64 = correction.nodes.iter().map(|&i| u[i] - h[i]).sum();
        let lambda = v_of_set / correction.nodes.len() as f64;
        self.set.iter_mut().enumerate().for_each(|(i, is_in)| *is_in |= u[i] - h[i] < lambda);
        for (&i, delta) in correction.nodes.iter().zip(&correction.delta) {
            self.p[i] += delta;
            self.set[i] = self.p[i] > 0.0;
            self.p[i] = self.p[i].max(0.0);
        }
        self.restore_load();
    }

    fn restore_load(&mut self) {
        let load = chunks::sum(self.p.len(), |i| self.p[i]);
        let scale = self.problem.expected_mean_pressure() * self.p.len() as f64 / load;
        chunks::update(&mut self.p, |_, p| p.iter_mut().for_each(|p| *p *= scale));
    }

    /// The guarded step: towards the pressure of a whole-set update if that is wished for and `f` falls on that way, else towards
    /// that of a projected gradient step.
    fn descend(&mut self, by_set: bool) {
        self.admit();
        if by_set {
            let from = self.p.clone();
            self.update();
            let towards = std::mem::replace(&mut self.p, from);
            self.half_space.displacement(&self.p, &mut self.u);
            if self.approach(&towards) {
                return;
            }
            self.admit();
        }
        let downhill = self.gradient_step();
        self.approach(&downhill);
    }

    /// Moves to the minimum of `f` between the pressure and `towards`, if `f` falls on that way.
    fn approach(&mut self, towards: &[f64]) -> bool {
        let (p, u, h) = (&self.p, &self.u, self.problem.height());
        let way: Vec<f64> = towards.iter().zip(p).map(|(to, from)| to - from).collect();
        let lambda = self.lambda();
        let slope = chunks::sum(way.len(), |i| way[i] * (u[i] - h[i] - lambda));
        if slope.is_nan() || slope >= 0.0 {
            return false;
        }
        self.half_space.displacement(&way, &mut self.field);
        let field = &self.field;
        let curvature = chunks::sum(way.len(), |i| way[i] * field[i]);
        let share = if curvature > 0.0 { (-slope / curvature).min(1.0) } else { 1.0 };
        chunks::update(&mut self.p, |range, p| range.zip(p).for_each(|(i, p)| *p += share * way[i]));
        true
    }

    /// The projection onto `{p >= 0, <p> fixed}` of a step against the gradient, as long as the curvature of `f` along the
    /// gradient on the set suggests.
    fn gradient_step(&mut self) -> Vec<f64> {
        let lambda = self.lambda();
        let correction = Correction::new(&self.set, &self.u, self.problem.height());
        let length = correction.cauchy_length(&mut self.half_space, &mut self.field);
        let (p, u, h) = (&self.p, &self.u, self.problem.height());
        let stepped: Vec<f64> = (0..p.len()).map(|i| p[i] - length * (u[i] - h[i] - lambda)).collect();
        onto_load(stepped, self.problem.expected_mean_pressure())
    }
}

/// The nearest values `>= 0` with the given mean: `max(value - theta, 0)`, with `theta` by Michelot's iteration, which drops ever
/// more nodes and so ends.
fn onto_load(mut values: Vec<f64>, mean: f64) -> Vec<f64> {
    let load = mean * values.len() as f64;
    let mut theta = f64::NEG_INFINITY;
    loop {
        let (sum, count) =
            values.iter().filter(|&&v| v > theta).fold((0.0, 0usize), |(sum, count), v| (sum + v, count + 1));
        let next = (sum - load) / count as f64;
        if count == 0 || next <= theta {
            break;
        }
        theta = next;
    }
    values.iter_mut().for_each(|v| *v = (*v - theta).max(0.0));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::surface::{Indenter, Surface};
    use ndarray::Array1;
    use std::f64::consts::PI;

    fn problem(height: Array1<f64>, mean_pressure: f64) -> Problem {
        Problem::new(Surface::line(height.view(), 1.0).unwrap(), 1.0, mean_pressure).unwrap()
    }

    /// Surfaces on which whole-set updates are known to stall, collapse or cycle when left alone.
    fn hard() -> Vec<Problem> {
        let indenter = |indenter: Indenter, mean_pressure| {
            let surface = indenter.surface(Grid::line(256, 1.0).unwrap()).unwrap();
            Problem::new(surface, 1.0, mean_pressure).unwrap()
        };
        let noise = |i: usize| ((i * i % 251) as f64 * 12.9898).sin() * 43758.5453 % 1.0;
        vec![
            indenter(Indenter::Sine { amplitude: 0.01 }, 0.01 * PI * (0.05 * PI).sin().powi(2)),
            indenter(Indenter::Cylinder { radius: 0.25 }, 0.22),
            problem(Array1::from_shape_fn(256, |i| if i / 16 % 2 == 0 { 0.0 } else { -0.01 }), 0.01),
            problem(Array1::from_shape_fn(256, noise), 1.0),
            problem(Array1::from_shape_fn(256, |i| if i == 100 { 1.0 } else { 0.0 }), 0.01),
        ]
    }

    fn energy(level: &Level<'_>) -> f64 {
        (0..level.p.len()).map(|i| level.p[i] * (0.5 * level.u[i] - level.problem.height()[i])).sum()
    }

    #[test]
    fn guarded_steps_alone_lower_the_energy_and_reach_the_solution() {
        for problem in hard() {
            let mut level = Level::new(&problem, None);
            level.pace = Pace::Guarded { release: 0.0, steps: 0 };
            let best = Best::new(&problem);
            let mut before = f64::INFINITY;
            let mut eta = level.certify();
            for _ in 0..2000 {
                let now = energy(&level);
                assert!(now <= before + 1e-12 * before.abs(), "{before} to {now}");
                if eta <= 1e-9 {
                    break;
                }
                before = now;
                level.advance(eta, &best);
                eta = level.certify();
            }
            assert!(eta <= 1e-9, "{eta} with {} nodes in contact", level.p.iter().filter(|&&p| p > 0.0).count());
        }
    }

    #[test]
    fn gradient_steps_alone_lower_the_energy() {
        for problem in hard() {
            let mut level = Level::new(&problem, None);
            level.certify();
            let first = energy(&level);
            for _ in 0..50 {
                let before = energy(&level);
                level.descend(false);
                level.certify();
                assert!(energy(&level) <= before + 1e-12 * before.abs());
            }
            assert!(energy(&level) < first);
        }
    }

    #[test]
    fn a_state_that_gets_no_better_is_given_up_for_the_best_one() {
        let problem = &hard()[0];
        let mut level = Level::new(problem, None);
        let mut best = Best::new(problem);
        let eta = level.certify();
        best.offer(eta, &level.p, 0);
        for _ in 0..=STALE + 1 {
            level.choose_pace(eta, &best);
        }
        assert!(matches!(level.pace, Pace::Guarded { release, .. } if release == RELEASE * best.eta));
        level.choose_pace(0.4 * best.eta, &best);
        assert!(matches!(level.pace, Pace::Free { .. }));
    }

    #[test]
    fn projection_is_the_nearest_pressure_with_the_load() {
        let projected = onto_load(vec![3.0, -1.0, 0.5, 1.0], 0.5);
        assert_eq!(projected, [2.0, 0.0, 0.0, 0.0]);
        let projected = onto_load(vec![1.0, 2.0, 3.0, 4.0], 1.5);
        assert_eq!(projected, [0.0, 1.0, 2.0, 3.0]);
    }
}

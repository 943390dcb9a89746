//! Guarded steps, which always lower the energy.

use super::correction::{dot, remove_mean};
use super::level::{Displacement, InnerStepCallback, Level};
use super::support::{SparsePressure, Support};
use crate::chunks;
use crate::contact::Status;
use crate::contact::bound::{is_uniform, to_bound};
use crate::contact::feasible::nearest;

/// Parts of a Newton step that are tried in this order. The first one nearly always lowers `f`.
const NEWTON_PARTS: [f64; 6] = [1.0, 0.25, 0.0625, 1.6e-2, 4e-3, 1e-3];

impl Level<'_> {
    /// A guarded step: on the finest grid below a hardness a projected Newton step, elsewhere towards the pressure of a whole-set update
    /// if that is wished for, and towards that of a projected gradient step if `f` does not fall by these.
    pub(crate) fn descend(&mut self, by_set: bool, watch: &mut InnerStepCallback<'_>) -> Option<Status> {
        self.admit();
        if self.is_newton_guarded() {
            let (status, is_taken) = self.newton_step(watch);
            if status.is_some() || is_taken {
                return status;
            }
        } else if by_set {
            let from = self.pressure.clone();
            let status = self.update(watch);
            let towards = std::mem::replace(&mut self.pressure, from).spread();
            self.refresh_from_pressure();
            if status.is_some() || self.approach(&towards) {
                return status;
            }
        }
        let downhill = self.gradient_step();
        self.approach(&downhill);
        None
    }

    /// A projected Newton step on the free nodes `F`. With the correction `d` that solves `A_FF d = lambda - v`, it goes
    /// towards `min(max(p + a d - t, 0), H_c)`, where the shift `t` keeps the load of `F` and is 0 at a given mean gap,
    /// for the first part `a` of [`NEWTON_PARTS`] with which `f` falls.
    ///
    /// Returns why the run is to end, if it is, and whether the step was taken.
    fn newton_step(&mut self, watch: &mut InnerStepCallback<'_>) -> (Option<Status>, bool) {
        let ceiling = self.ceiling_on_set();
        let free = self.pressure.free(&ceiling);
        let Some((delta, status)) = self.correction(free.as_ref(), watch) else { return (None, false) };
        if status.is_some() {
            return (status, false);
        }
        let set = free.as_ref().unwrap_or(&self.pressure.support);
        let (below, highest) = (self.on_free(set), set.ceiling(self.ceiling()));
        let load = chunks::sum(below.len(), |i| below[i]);
        let is_taken = NEWTON_PARTS.iter().any(|part| {
            let moved: Vec<f64> = below.iter().zip(&delta).map(|(p, delta)| p + part * delta).collect();
            let moved = match self.problem.mean_pressure() {
                Some(_) => nearest(moved, load, &highest),
                None => moved.into_iter().enumerate().map(|(i, p)| p.clamp(0.0, highest.at(i))).collect(),
            };
            let mut moved = moved.into_iter();
            let mut replaced = |(i, &p): (usize, &f64)| if p < ceiling.at(i) { moved.next().unwrap_or(p) } else { p };
            let values: Vec<f64> = self.pressure.values.iter().enumerate().map(&mut replaced).collect();
            self.approach(&self.pressure.support.spread(&values))
        });
        (None, is_taken)
    }

    /// The pressure on the free nodes of the set.
    fn on_free(&self, free: &Support) -> Vec<f64> {
        let mut values = vec![0.0; free.nodes()];
        self.pressure.support.transfer(&self.pressure.values, free, &mut values);
        values
    }

    /// Moves to the minimum of `f` between the pressure and `towards`, if `f` falls on that way.
    fn approach(&mut self, towards: &[f64]) -> bool {
        let (mut p, u, h) = (self.pressure.spread(), &self.u, self.problem.height());
        let way: Vec<f64> = towards.iter().zip(&p).map(|(to, from)| to - from).collect();
        let lambda = self.lambda();
        let slope = chunks::sum(way.len(), |i| way[i] * (u[i] - h[i] - lambda));
        if slope.is_nan() || slope >= 0.0 {
            return false;
        }
        let mut response = vec![0.0; way.len()];
        self.response.displacement(&way, &mut response);
        let curvature = dot(&way, &response);
        let share = if curvature > 0.0 { (-slope / curvature).min(1.0) } else { 1.0 };
        let ceiling = self.ceiling();
        // what is moved to the ceiling lies there to the last bit
        let moved = |p: f64, i: usize| if share == 1.0 { towards[i] } else { (p + share * way[i]).min(ceiling.at(i)) };
        chunks::update(&mut p, |range, p| range.zip(p).for_each(|(i, p)| *p = moved(*p, i)));
        self.pressure = SparsePressure::from_field(&p, self.response.rows());
        self.displacement = Displacement::Outdated;
        true
    }

    /// The projection onto `p >= 0`, and below a hardness onto `p <= H_c`, with the mean pressure if that is given, of a step against the gradient.
    fn gradient_step(&mut self) -> Vec<f64> {
        let lambda = self.lambda();
        let length = self.gradient_length();
        let (mut p, u, h) = (self.pressure.spread(), &self.u, self.problem.height());
        chunks::update(&mut p, |range, p| range.zip(p).for_each(|(i, p)| *p -= length * (u[i] - h[i] - lambda)));
        let ceiling = self.ceiling();
        match self.problem.mean_pressure() {
            Some(mean_pressure) if ceiling.is_finite() => nearest(p, mean_pressure * self.u.len() as f64, ceiling),
            Some(mean_pressure) => onto_load(p, mean_pressure),
            None => p.into_iter().enumerate().map(|(i, p)| p.max(0.0).min(ceiling.at(i))).collect(),
        }
    }

    /// Length of the step against the gradient on the free nodes that minimises `f`. Where the gradient displaces nothing, since it is
    /// uniform and all nodes touch, `f` falls evenly, and the step goes on to the bound, where the first node leaves. It is 0
    /// where there is no gradient.
    fn gradient_length(&mut self) -> f64 {
        let lambda = self.lambda();
        let free = self.pressure.free(&self.ceiling_on_set());
        let mut gradient = self.on_set(free.as_ref(), |v| v - lambda);
        if self.problem.mean_pressure().is_some() {
            remove_mean(&mut gradient);
        }
        let field = free.as_ref().unwrap_or(&self.pressure.support).spread(&gradient);
        let mut response = vec![0.0; field.len()];
        self.response.displacement(&field, &mut response);
        let (square, curvature) = (dot(&gradient, &gradient), dot(&field, &response));
        if is_uniform(square, curvature, self.response.softest_stiffness()) {
            let free = self.on_free(free.as_ref().unwrap_or(&self.pressure.support));
            return to_bound(free.into_iter().zip(gradient)).unwrap_or(0.0);
        }
        square / curvature
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
    use super::super::level::{Mode, RELEASE, STALE};
    use super::*;
    use crate::contact::Problem;
    use crate::contact::best::Best;
    use crate::contact::{ContactModulus, Law, Load};
    use crate::grid::Grid;
    use crate::surface::{Indenter, Surface};
    use ndarray::Array1;
    use std::f64::consts::PI;

    fn problem(height: Array1<f64>, mean_pressure: f64) -> Problem {
        let surface = Surface::line(height.view(), 1.0).unwrap();
        Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(mean_pressure)).unwrap()
    }

    /// Surfaces on which whole-set updates without the guard are known to stall, collapse or cycle.
    fn hard() -> Vec<Problem> {
        let indenter = |indenter: Indenter, mean_pressure| {
            let surface = indenter.surface(Grid::line(256, 1.0).unwrap()).unwrap();
            Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(mean_pressure)).unwrap()
        };
        let noise = |i: usize| ((i * i % 251) as f64 * 12.9898).sin() * 43758.5453 % 1.0;
        let below = |problem: Problem, hardness: f64| problem.with_law(Law::Hardness(hardness)).unwrap();
        let walls = vec![
            indenter(Indenter::Sine { amplitude: 0.01 }, 0.01 * PI * (0.05 * PI).sin().powi(2)),
            indenter(Indenter::Cylinder { radius: 0.25 }, 0.22),
            problem(Array1::from_shape_fn(256, |i| if i / 16 % 2 == 0 { 0.0 } else { -0.01 }), 0.01),
            problem(Array1::from_shape_fn(256, noise), 1.0),
            problem(Array1::from_shape_fn(256, |i| if i == 100 { 1.0 } else { 0.0 }), 0.01),
        ];
        let hard = |wall: &Problem| [1.5, 4.0].map(|times| below(wall.clone(), times * wall.expected_mean_pressure()));
        let hard: Vec<Problem> = walls.iter().flat_map(hard).collect();
        walls.into_iter().chain(hard).collect()
    }

    fn uniform(problem: &Problem) -> Level<'_> {
        Level::new(problem, |rows| SparsePressure::first(problem, rows))
    }

    fn energy(level: &Level<'_>) -> f64 {
        let p = level.pressure.spread();
        (0..p.len()).map(|i| p[i] * (0.5 * level.u[i] - level.problem.height()[i])).sum()
    }

    #[test]
    fn guarded_steps_alone_lower_the_energy_and_reach_the_solution() {
        for problem in hard() {
            let mut level = uniform(&problem);
            level.mode = Mode::Guarded { release: 0.0, steps: 0 };
            let best = Best::none(0);
            let mut before = f64::INFINITY;
            let mut eta = level.certify().eta;
            for _ in 0..2000 {
                let now = energy(&level);
                assert!(now <= before + 1e-12 * before.abs(), "{before} to {now}");
                if eta <= 1e-9 {
                    break;
                }
                before = now;
                level.choose_mode(eta, &best);
                level.advance(0.0, &mut |_, _| None);
                eta = level.certify().eta;
            }
            assert!(eta <= 1e-9, "{eta} with {} nodes in contact", level.pressure.values.len());
        }
    }

    #[test]
    fn gradient_steps_alone_lower_the_energy() {
        for problem in hard() {
            let mut level = uniform(&problem);
            level.certify();
            let first = energy(&level);
            for _ in 0..50 {
                let before = energy(&level);
                level.descend(false, &mut |_, _| None);
                level.certify();
                assert!(energy(&level) <= before + 1e-12 * before.abs());
            }
            assert!(energy(&level) < first);
        }
    }

    /// Pressed further than to full contact at a mean gap, all nodes have the same gradient, which displaces nothing.
    #[test]
    fn a_uniform_gradient_leads_to_the_bound() {
        for points in [255, 256] {
            let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
            let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanGap(1e-3)).unwrap();
            let full: Vec<f64> = problem.height().iter().map(|h| PI * (h + 0.03)).collect();
            let mut level = Level::new(&problem, |rows| SparsePressure::from_field(&full, rows));
            level.certify();
            let mean = |level: &Level<'_>| level.pressure.values.iter().sum::<f64>() / points as f64;
            let [before, least] = [mean(&level), full.iter().copied().fold(f64::INFINITY, f64::min)];
            assert_eq!(level.pressure.values.len(), points);
            level.descend(false, &mut |_, _| None);
            assert!((mean(&level) - (before - least)).abs() < 1e-12, "{} after {before}", mean(&level));
            assert!(level.pressure.values.len() < points);
        }
    }

    #[test]
    fn a_state_that_gets_no_better_is_given_up_for_the_best_one() {
        let problem = &hard()[0];
        let mut level = uniform(problem);
        let mut best = Best::none(0);
        let eta = level.certify().eta;
        best.offer(eta, &level.pressure, 0);
        for _ in 0..=STALE + 1 {
            level.choose_mode(eta, &best);
        }
        assert!(matches!(level.mode, Mode::Guarded { release, .. } if release == RELEASE * best.distance));
        level.choose_mode(0.4 * best.distance, &best);
        assert!(matches!(level.mode, Mode::Free { .. }));
    }

    #[test]
    fn projection_is_the_nearest_pressure_with_the_load() {
        let projected = onto_load(vec![3.0, -1.0, 0.5, 1.0], 0.5);
        assert_eq!(projected, [2.0, 0.0, 0.0, 0.0]);
        let projected = onto_load(vec![1.0, 2.0, 3.0, 4.0], 1.5);
        assert_eq!(projected, [0.0, 1.0, 2.0, 3.0]);
    }
}

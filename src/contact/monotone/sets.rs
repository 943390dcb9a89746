//! Updates of whole sets, and their safeguard.
//!
//! Letters: `p` pressure, `u` its displacement, `v = u - h`, `c` the ceiling of a node, `F` the free nodes, `lambda` the mean of `v` on
//! them or minus the given datum.

use super::bounds::{carry, cut, nearest};
use super::gmres::Gmres;
use crate::chunks;
use crate::contact::multilevel::operator::{SetOperator, Spectral};
use crate::contact::multilevel::support::Support;
use crate::contact::{Ceiling, Problem};
use crate::elastic::{Compliance, Response};
use crate::grid::Grid;
use std::sync::Arc;

/// The part of the residual that a correction leaves, at first and at the least. It is tightened when an update was no better.
const REDUCTION: f64 = 0.02;
const LEAST_REDUCTION: f64 = 1e-10;
const TIGHTEN: f64 = 0.1;

/// Updates without a better state after which only nodes that want it most are exchanged, and after which the safeguard takes over.
const TIGHT_AFTER: usize = 8;
const STALE: usize = 16;

/// A state is better if its distance from the goals is at most this part of that of the last better one. The safeguard ends when it has
/// halved.
const BETTER: f64 = 0.9;
const RELEASE: f64 = 0.5;

/// An extragradient step is accepted if the gradient changes by at most this part of what the step over its length is; it is shortened
/// and lengthened by these factors.
const CONTRACTION: f64 = 0.9;
const SHORTER: f64 = 0.6;
const LONGER: f64 = 1.3;

/// What a pressure must satisfy, besides its bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LoadOrDatum {
    /// The sum of the pressure over the nodes.
    Sum(f64),
    /// The datum `d` of `u - h + d`.
    Datum(f64),
}

/// The variational inequality `<(q - p) (u(p) - h + d)> >= 0` for all `q` within bounds, and of the same sum if that is given.
pub(crate) struct BoxInequality<'a> {
    pub height: &'a [f64],
    pub ceilings: Ceiling,
    pub goal: LoadOrDatum,
}

impl BoxInequality<'_> {
    fn load(&self) -> Option<f64> {
        match self.goal {
            LoadOrDatum::Sum(sum) => Some(sum),
            LoadOrDatum::Datum(_) => None,
        }
    }
}

/// Where a node lies between its bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum NodePlace {
    Open,
    Free,
    Ceiling,
}

/// What an update did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum UpdateKind {
    WholeSet,
    Extragradient,
}

/// The iteration.
pub(crate) struct SetIteration<'a> {
    task: BoxInequality<'a>,
    response: Response,
    operator: Spectral<f64>,
    pub p: Vec<f64>,
    pub u: Vec<f64>,
    reduction: f64,
    /// Distance of the last better state, and its pressure and displacement.
    best: (f64, Vec<f64>, Vec<f64>),
    /// Updates since then.
    stale: usize,
    /// The places that the last update found, from the pressure before it was cut.
    places: Option<Vec<NodePlace>>,
    /// Until which distance the safeguard goes on.
    guarded_until: Option<f64>,
    length: f64,
    /// Inner steps so far.
    pub inner: usize,
}

impl<'a> SetIteration<'a> {
    /// The iteration of a problem from a pressure.
    pub(crate) fn from_problem(problem: &'a Problem, first: Vec<f64>) -> Self {
        let goal = match problem.datum() {
            Some(datum) => LoadOrDatum::Datum(datum),
            None => LoadOrDatum::Sum(problem.expected_mean_pressure() * problem.nodes() as f64),
        };
        let ceilings = problem.ceiling().clone();
        let task = BoxInequality { height: problem.height(), ceilings, goal };
        Self::new(task, problem.shared_compliance(), problem.surface().grid(), first)
    }

    /// Starts from a pressure within the bounds, and of the given sum.
    pub(crate) fn new(task: BoxInequality<'a>, compliance: &Arc<Compliance>, grid: &Grid, start: Vec<f64>) -> Self {
        let mut response = Response::from_compliance(compliance.clone());
        let mut u = vec![0.0; start.len()];
        response.displacement(&start, &mut u);
        let length = compliance.least_stiffness();
        Self {
            task,
            response,
            operator: Spectral::from_compliance(compliance, grid),
            best: (f64::INFINITY, start.clone(), u.clone()),
            p: start,
            u,
            reduction: REDUCTION,
            stale: 0,
            places: None,
            guarded_until: None,
            length,
            inner: 0,
        }
    }

    /// Transforms so far.
    pub(crate) fn transforms(&self) -> u64 {
        self.response.transforms() + self.operator.transforms() as u64
    }

    /// The response, to end with.
    pub(crate) fn into_response(self) -> Response {
        self.response
    }

    /// An update of the state, which lies at some distance from the goals. `watch` is called at each inner step with the transforms so
    /// far, and ends the update early if it returns false.
    pub(crate) fn advance(&mut self, distance: f64, watch: &mut dyn FnMut(u64) -> bool) -> UpdateKind {
        if distance < BETTER * self.best.0 {
            self.best = (distance, self.p.clone(), self.u.clone());
            self.stale = 0;
        } else {
            self.stale += 1;
            if self.stale > TIGHT_AFTER {
                self.reduction = (TIGHTEN * self.reduction).max(LEAST_REDUCTION);
            }
        }
        if self.guarded_until.is_some_and(|until| distance <= until) {
            (self.guarded_until, self.stale) = (None, 0);
        }
        if self.guarded_until.is_none() && self.stale >= STALE {
            self.guarded_until = Some(RELEASE * self.best.0);
            self.p.clone_from(&self.best.1);
            self.u.clone_from(&self.best.2);
        }
        if self.guarded_until.is_some() {
            self.places = None;
            self.extragradient();
            return UpdateKind::Extragradient;
        }
        self.update(watch);
        UpdateKind::WholeSet
    }

    /// Whether updates of whole sets have come no nearer for a while.
    pub(crate) fn is_stale(&self) -> bool {
        self.stale >= STALE || self.guarded_until.is_some()
    }

    /// Starts again from another pressure.
    pub(crate) fn restart(&mut self, pressure: Vec<f64>) {
        self.p = pressure;
        self.response.displacement(&self.p, &mut self.u);
        (self.places, self.guarded_until, self.stale) = (None, None, 0);
        (self.reduction, self.best.0) = (REDUCTION, f64::INFINITY);
    }

    fn is_free(&self, i: usize) -> bool {
        self.p[i] > 0.0 && self.p[i] < self.task.ceilings.at(i)
    }

    fn v(&self, i: usize) -> f64 {
        self.u[i] - self.task.height[i]
    }

    /// `lambda`: the level of `v` below which nodes take pressure.
    fn level(&self) -> f64 {
        let load = match self.task.goal {
            LoadOrDatum::Datum(datum) => return -datum,
            LoadOrDatum::Sum(load) => load,
        };
        let free = chunks::sum(self.p.len(), |i| if self.is_free(i) { 1.0 } else { 0.0 });
        if free > 0.0 {
            return chunks::sum(self.p.len(), |i| if self.is_free(i) { self.v(i) } else { 0.0 }) / free;
        }
        knapsack_level(self.p.len(), |i| self.v(i), |i| self.task.ceilings.at(i), load)
    }

    /// An update of the whole set.
    fn update(&mut self, watch: &mut dyn FnMut(u64) -> bool) {
        let places = self.places.take().unwrap_or_else(|| self.places_of_state());
        let [count, width] = self.response.rows();
        let support = Support::choose([count, width], |row, nodes| {
            (0..width).filter(|x| places[row * width + x] == NodePlace::Free).for_each(|x| nodes.push(x));
        });
        let task = &self.task;
        let mut start = self.p.clone();
        chunks::update(&mut start, |range, p| {
            for (i, p) in range.zip(p) {
                *p = match places[i] {
                    NodePlace::Open => 0.0,
                    NodePlace::Free => *p,
                    NodePlace::Ceiling => task.ceilings.at(i),
                };
            }
        });
        if support.nodes() == 0 {
            self.p = start;
            return self.settle();
        }
        if let LoadOrDatum::Sum(load) = task.goal {
            let lost = load - chunks::sum(start.len(), |i| start[i]);
            let share = lost / support.nodes() as f64;
            let spread = support.spread(&vec![share; support.nodes()]);
            chunks::update(&mut start, |range, p| p.iter_mut().zip(&spread[range]).for_each(|(p, add)| *p += add));
        }
        let mut signed = start;
        let mut u = vec![0.0; signed.len()];
        self.response.displacement(&signed, &mut u);
        let height = support.of_field(task.height);
        let level = match task.goal {
            LoadOrDatum::Datum(datum) => -datum,
            LoadOrDatum::Sum(_) => 0.0,
        };
        let residual = support.of_field(&u).iter().zip(&height).map(|(u, h)| level - (u - h)).collect();
        let spent = self.response.transforms();
        let inner = &mut self.inner;
        let mut gmres = Gmres::new(&support, &mut self.operator, task.load().is_some());
        let delta = gmres.solve(residual, self.reduction, &mut |transforms| {
            *inner += 1;
            watch(spent + transforms as u64)
        });
        let change = support.spread(&delta);
        chunks::update(&mut signed, |range, p| p.iter_mut().zip(&change[range]).for_each(|(p, change)| *p += change));
        self.response.displacement(&signed, &mut u);
        let level = match task.goal {
            LoadOrDatum::Datum(datum) => -datum,
            LoadOrDatum::Sum(_) => {
                let u = support.of_field(&u);
                chunks::sum(u.len(), |i| u[i] - height[i]) / u.len() as f64
            }
        };
        let place = |i: usize| {
            let (p, v, ceiling) = (signed[i], u[i] - task.height[i], task.ceilings.at(i));
            match places[i] {
                _ if ceiling <= 0.0 => NodePlace::Open,
                NodePlace::Free if p <= 0.0 => NodePlace::Open,
                NodePlace::Free if p >= ceiling => NodePlace::Ceiling,
                NodePlace::Open if v < level => NodePlace::Free,
                NodePlace::Ceiling if v > level => NodePlace::Free,
                place => place,
            }
        };
        self.places = Some((0..signed.len()).map(place).collect());
        self.p = signed;
        self.settle();
    }

    /// The places of the nodes by the state.
    fn places_of_state(&self) -> Vec<NodePlace> {
        let level = self.level();
        let place = |i: usize| {
            let (p, v, ceiling) = (self.p[i], self.v(i), self.task.ceilings.at(i));
            match p {
                _ if ceiling <= 0.0 => NodePlace::Open,
                _ if p <= 0.0 && v >= level => NodePlace::Open,
                _ if p >= ceiling && v <= level => NodePlace::Ceiling,
                _ => NodePlace::Free,
            }
        };
        (0..self.p.len()).map(place).collect()
    }

    /// Makes a state of a pressure that may leave its bounds.
    fn settle(&mut self) {
        cut(&mut self.p, &self.task.ceilings);
        if let Some(load) = self.task.load() {
            carry(&mut self.p, &self.task.ceilings, load);
        }
        self.response.displacement(&self.p, &mut self.u);
    }

    /// A step of the extragradient method (Korpelevich 1976): to `q`, the projection of `p - length v(p)`, and from `p` to the projection
    /// of `p - length v(q)`. Every such step comes nearer to the solution if `length |v(p) - v(q)| < |p - q|`, whatever the monotone
    /// operator.
    fn extragradient(&mut self) {
        let datum = match self.task.goal {
            LoadOrDatum::Datum(datum) => datum,
            LoadOrDatum::Sum(_) => 0.0,
        };
        let n = self.p.len();
        let mut u = vec![0.0; n];
        loop {
            let mut q = self.stepped(&self.u, datum);
            self.response.displacement(&q, &mut u);
            let square = |a: &[f64], b: &[f64]| chunks::sum(n, |i| (a[i] - b[i]).powi(2));
            let (moved, turned) = (square(&self.p, &q), square(&self.u, &u));
            if self.length * turned.sqrt() > CONTRACTION * moved.sqrt() {
                self.length *= SHORTER;
                continue;
            }
            q = self.stepped(&u, datum);
            self.p = q;
            self.length *= LONGER;
            break;
        }
        let Self { response, p, u, .. } = self;
        response.displacement(p, u);
    }

    /// The projection of `p - length (u - h + d)`.
    fn stepped(&self, u: &[f64], datum: f64) -> Vec<f64> {
        let (h, length) = (self.task.height, self.length);
        let mut q = self.p.clone();
        chunks::update(&mut q, |range, q| {
            range.zip(q).for_each(|(i, q)| *q -= length * (u[i] - h[i] + datum));
        });
        nearest(&mut q, &self.task.ceilings, self.task.load());
        q
    }

    /// `G = <p max(v - lambda, 0)> + <(c - p) max(lambda - v, 0)>` and `lambda`: the level at which the nodes of lowest `v` carry the load,
    /// all at their ceilings, or minus the given datum. Ceilings must be finite.
    pub(crate) fn gap(&self) -> (f64, f64) {
        let n = self.p.len();
        let level = match self.task.goal {
            LoadOrDatum::Datum(datum) => -datum,
            LoadOrDatum::Sum(load) => knapsack_level(n, |i| self.v(i), |i| self.task.ceilings.at(i), load),
        };
        let term = |i: usize| {
            let above = self.v(i) - level;
            self.p[i] * above.max(0.0) + (self.task.ceilings.at(i) - self.p[i]) * (-above).max(0.0)
        };
        (chunks::sum(n, term) / n as f64, level)
    }
}

/// The value of `v` up to which the nodes of lowest `v`, all at their ceilings, carry a load.
fn knapsack_level(n: usize, v: impl Fn(usize) -> f64, ceiling: impl Fn(usize) -> f64, load: f64) -> f64 {
    let mut order: Vec<usize> = (0..n).filter(|&i| ceiling(i) > 0.0).collect();
    order.sort_unstable_by(|&a, &b| v(a).total_cmp(&v(b)));
    let mut carried = 0.0;
    for &i in &order {
        carried += ceiling(i);
        if carried >= load {
            return v(i);
        }
    }
    order.last().map_or(0.0, |&i| v(i))
}

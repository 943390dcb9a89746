//! Constrained conjugate gradients in the pressure.
//!
//! Letters of this file: `p` pressure, `u` its displacement, `v = u - h`, `g = v + d` the gap, `t` the conjugate direction, `r`
//! the displacement under `t`, `tau` the step length. The datum `d` is the mean gap if that is given, or else minus the mean of
//! `v` over the contact, so that `g` has none.

use crate::contact::bound::{is_uniform, to_bound};
use crate::contact::slack::level;
use crate::contact::{
    Ceiling, Certificate, Contact, Decision, Observer, Problem, Run, Solver, Step, Stop, certificate, chunks, feasible,
};
use crate::elastic::Response;
use crate::error::SolveError;
use crate::surface::Field;

/// Constrained conjugate gradients (Polonsky & Keer 1999).
///
/// Minimises `f(p) = 1/2 <p, u(p)> - <p, h>` over `p >= 0` with `<p>` given, or `f(p) + D <p>` with the mean gap `D`
/// given. Each iteration takes the conjugate gradient step of the nodes in contact with the exact step length, clips
/// tension, brings nodes that penetrate into contact, and under a mean pressure rescales to it. When nodes enter the
/// contact, the direction restarts from the gradient; when nodes leave, it continues without them.
///
/// When nodes enter or leave the contact, the step may be too large, and the iteration could cycle. So if the energy
/// would rise, the iteration takes a gradient step instead, scaled to the load, with the length that minimises the
/// energy. The energy always decreases in this step.
///
/// With a hardness `H_c`, nodes that reach it yield: they stay at `H_c` until their gap is positive. The direction is
/// defined on the nodes between zero and `H_c`. Under a mean pressure its mean is subtracted, so that it keeps the
/// load.
///
/// At a mean gap even the last node may leave the contact. Then all nodes that penetrate without pressure enter in the
/// same iteration, with a step that is safe for every mode.
///
/// One transform pair per iteration while the set stays (the displacement follows the step by linearity), two
/// otherwise. Memory: 6 fields of n doubles and the [`Response`](crate::elastic::Response).
///
/// # Why it is stable
/// On a fixed contact set the step is that of conjugate gradients for a symmetric positive semi-definite operator, and the
/// step length is the exact minimiser; there is no time step to choose. Nodes neither enter nor leave at the price of a
/// higher energy. What rounding adds to the displacement by linearity is removed before convergence is declared: the
/// certificate is then recomputed from a fresh transform pair.
///
/// # Source
/// Polonsky & Keer, Wear 231, 206 (1999), steps 1 to 10. Deviations: displacement by linearity; the mean gap, where there
/// is neither a mean to take off nor a load to restore; no change of the contact that raises the energy; the stop by
/// [`Certificate`].
///
/// ```
/// use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // a sine at half of the pressure of full contact: half of it touches (Westergaard)
/// let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(1024, 1.0)?)?;
/// let full = std::f64::consts::PI;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.5 * full))?;
/// let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ())?.converged()?;
/// assert!((contact.counted().relative_area - 0.5).abs() < 2.0 / 1024.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct PolonskyKeer;

impl PolonskyKeer {
    /// Number of fields of doubles that a solve needs at its peak, without the heights.
    pub const FIELDS: f64 = 7.0;
}

impl Solver for PolonskyKeer {
    fn name(&self) -> &str {
        "polonsky-keer"
    }

    fn settings(&self) -> String {
        "constrained conjugate gradients, restarted when nodes enter the contact".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        if problem.is_moving() {
            return Err(SolveError::NeedsRest { solver: self.name().into() });
        }
        let mut run = Run::begin(self, problem, stop, observer);
        let mut state = Iterate::new(start, problem);
        let mut decision = Decision::Start;
        let status = loop {
            let certificate = state.certify(&mut run);
            let work = run.work(state.response.transforms());
            let step = Step::new(problem, work, &state.p, &state.u).with_certificate(certificate);
            if let Some(status) = run.show(&step.with_decision(decision)) {
                break status;
            }
            let datum = state.datum();
            let share = state.conjugate(datum);
            state.response.displacement(&state.t, &mut state.r);
            let tau = state.step_length(datum);
            decision = state.update(datum, tau, share);
            run.advance();
        };
        Ok(run.finish(status, state.into_response()))
    }
}

/// The vectors of the iteration.
struct Iterate<'a> {
    problem: &'a Problem,
    /// The highest pressure that is allowed.
    ceiling: &'a Ceiling,
    response: Response,
    p: Vec<f64>,
    u: Vec<f64>,
    t: Vec<f64>,
    r: Vec<f64>,
    /// The pressure before the last step.
    before: Vec<f64>,
    /// `|g|^2` over the contact in the previous iteration, or none at a restart.
    previous_square: Option<f64>,
    /// Whether `u` is from a transform of `p`, not by linearity.
    fresh: bool,
    /// Whether nodes yielded as the direction was made.
    yields: bool,
}

impl<'a> Iterate<'a> {
    /// Starts from the pressure `start`, or from the uniform one, under which nothing is displaced.
    fn new(start: Option<&Field>, problem: &'a Problem) -> Self {
        let n = problem.nodes();
        let mut response = problem.response();
        let p = problem.first_pressure(start);
        let mut u = vec![0.0; n];
        if start.is_some() {
            response.displacement(&p, &mut u);
        }
        let zeros = || vec![0.0; n];
        let (t, r, before, ceiling) = (zeros(), zeros(), zeros(), problem.ceiling());
        Self { problem, ceiling, response, p, u, t, r, before, previous_square: None, fresh: true, yields: false }
    }

    /// The certificate of this iterate; one that would end the run is taken from a fresh displacement.
    fn certify(&mut self, run: &mut Run<'_>) -> Certificate {
        let mut certificate = Certificate::from_displacement(self.problem, &self.p, &self.u);
        if run.is_converged(&certificate) && !self.fresh {
            self.restart();
            certificate = Certificate::from_displacement(self.problem, &self.p, &self.u);
        }
        run.offer(&certificate, &self.p);
        certificate
    }

    /// Takes the displacement from a transform of the pressure.
    fn refresh(&mut self) {
        self.response.displacement(&self.p, &mut self.u);
        self.fresh = true;
    }

    /// Takes the displacement from a transform, and the next direction from the gradient.
    fn restart(&mut self) {
        self.refresh();
        self.previous_square = None;
    }

    /// The datum of this file's `g`.
    fn datum(&self) -> f64 {
        if let Some(gap) = self.problem.datum() {
            return gap;
        }
        let (p, u, h, ceiling) = (&self.p, &self.u, self.problem.height(), self.ceiling);
        let parts = chunks::visit(p.len(), |range| {
            let inside = range.filter(|&i| (p[i] > 0.0) & (p[i] < ceiling.at(i)));
            inside.fold((0usize, 0.0), |(n, sum), i| (n + 1, sum + (u[i] - h[i])))
        });
        let (n, sum) = parts.into_iter().fold((0, 0.0), |(n, s), (m, t)| (n + m, s + t));
        if n == 0 { -level(self.problem, p, u) } else { -sum / n as f64 }
    }

    /// `t <- g + beta t` on the contact with the share `beta = |g|^2 / |g_previous|^2` that is returned, zero elsewhere.
    fn conjugate(&mut self, datum: f64) -> f64 {
        let (p, u, h, ceiling) = (&self.p, &self.u, self.problem.height(), self.ceiling);
        let is_free = |i: usize| (p[i] > 0.0) & (p[i] < ceiling.at(i));
        let square = chunks::sum(p.len(), |i| if is_free(i) { (u[i] - h[i] + datum).powi(2) } else { 0.0 });
        let beta = self.previous_square.map_or(0.0, |previous| square / previous);
        self.previous_square = (square > 0.0).then_some(square);
        chunks::update(&mut self.t, |range, t| {
            for (i, t) in range.zip(t) {
                *t = if is_free(i) { u[i] - h[i] + datum + beta * *t } else { 0.0 };
            }
        });
        self.yields = ceiling.is_finite()
            && chunks::visit(p.len(), |range| range.into_iter().any(|i| (p[i] > 0.0) & (p[i] >= ceiling.at(i))))
                .contains(&true);
        if self.yields && self.problem.mean_pressure().is_some() {
            self.keep_load();
        }
        beta
    }

    /// Takes the mean over the free nodes off `t`: below a ceiling no scaling makes up for it.
    fn keep_load(&mut self) {
        let (p, ceiling) = (&self.p, self.ceiling);
        let is_free = |i: &usize| (p[*i] > 0.0) & (p[*i] < ceiling.at(*i));
        let t = &self.t;
        let parts = chunks::visit(p.len(), |range| {
            range.filter(is_free).fold((0usize, 0.0), |(count, sum), i| (count + 1, sum + t[i]))
        });
        let (count, sum) = parts.into_iter().fold((0, 0.0), |(n, s), (m, t)| (n + m, s + t));
        let mean = sum / count as f64;
        chunks::update(&mut self.t, |range, t| {
            range.zip(t).filter(|(i, _)| is_free(i)).for_each(|(_, t)| *t -= mean);
        });
    }

    /// The exact minimiser along `t`, `<g t> / <r t>` over the contact, where under a mean pressure `r` is taken less its mean
    /// over the contact. Where `t` is uniform and all nodes touch, at a mean gap, the step at which the first node leaves. Where
    /// there is no minimiser (a single node in contact has no gradient), the step that is safe for every mode: the smallest
    /// stiffness.
    fn step_length(&self, datum: f64) -> f64 {
        let (p, u, h, t, r) = (&self.p, &self.u, self.problem.height(), &self.t, &self.r);
        let ceiling = self.ceiling;
        let parts = chunks::visit(p.len(), |range| {
            let mut sums = [0.0; 6];
            for i in range.filter(|&i| (p[i] > 0.0) & (p[i] < ceiling.at(i))) {
                let terms = [1.0, t[i], r[i], r[i] * t[i], (u[i] - h[i] + datum) * t[i], t[i] * t[i]];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
            sums
        });
        let [n, sum_t, sum_r, sum_rt, slope, square] = parts.into_iter().fold([0.0; 6], |mut a, b| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
            a
        });
        let (softest, is_full) = (self.response.softest_stiffness(), n == p.len() as f64);
        if self.problem.datum().is_some()
            && is_full
            && !self.problem.compliance().has_uniform()
            && is_uniform(square, sum_rt, softest)
        {
            return to_bound(p.iter().copied().zip(t.iter().copied())).unwrap_or(softest);
        }
        let curvature = if self.problem.mean_pressure().is_some() { sum_rt - sum_r * sum_t / n } else { sum_rt };
        if slope > 0.0 && curvature > 0.0 { slope / curvature } else { softest }
    }

    /// `p <- max(p - tau t, 0)` on the contact, `-tau g` on nodes without pressure that penetrate, `H_c - tau g` on nodes that yield
    /// and lie apart, and `H_c` at the most; then the load, then `u`. If the energy rises by that, a gradient step instead. Returns what it came to.
    fn update(&mut self, datum: f64, tau: f64, share: f64) -> Decision {
        let change = self.step(datum, tau);
        let scale = self.carry(change.load);
        if let Some(scale) = scale.filter(|_| !change.left && !change.entered) {
            self.follow(scale, tau);
            return Decision::Conjugate { length: tau, share };
        }
        let rises = self.arrive(datum).rise() > 0.0;
        if rises {
            self.descend(tau);
        }
        if change.entered || rises {
            self.previous_square = None;
        }
        if rises { Decision::Descend } else { Decision::Exchange }
    }

    /// The step of the pressure before it carries the load.
    fn step(&mut self, datum: f64, tau: f64) -> UpdateEffect {
        let (u, h, t, ceiling) = (&self.u, self.problem.height(), &self.t, self.ceiling);
        let parts = chunks::update_both(&mut self.p, &mut self.before, |range, p, before| {
            let mut change = UpdateEffect { load: 0.0, left: false, entered: false };
            let nodes = range.clone();
            let (u, h, t) = (&u[range.clone()], &h[range.clone()], &t[range]);
            for (((((node, p), before), u), h), t) in nodes.zip(p).zip(before).zip(u).zip(h).zip(t) {
                *before = *p;
                let (gap, ceiling) = (u - h + datum, ceiling.at(node));
                if *p >= ceiling {
                    *p = (*p - tau * gap.max(0.0)).max(0.0);
                    change.entered |= *p < ceiling;
                } else if *p > 0.0 {
                    *p = (*p - tau * t).max(0.0).min(ceiling);
                    change.left |= (*p <= 0.0) | (*p >= ceiling);
                }
                if (*p <= 0.0) & (gap < 0.0) & (ceiling > 0.0) {
                    *p = (-tau * gap).min(ceiling);
                    change.entered = true;
                }
                change.load += *p;
            }
            change
        });
        parts.into_iter().fold(UpdateEffect { load: 0.0, left: false, entered: false }, |a, b| UpdateEffect {
            load: a.load + b.load,
            left: a.left || b.left,
            entered: a.entered || b.entered,
        })
    }

    /// From the pressure before, `p <- max(p - tau g, 0)` with `<p g> = 0`, and the load, or below a ceiling the nearest pressure to
    /// `p - tau g`; or where the energy is lowest on the way
    /// there. It falls along that way for certain.
    fn descend(&mut self, tau: f64) {
        std::mem::swap(&mut self.u, &mut self.r);
        let (before, u, h) = (&self.before, &self.u, self.problem.height());
        let datum = certificate::datum(self.problem, before, u);
        chunks::update(&mut self.p, |range, p| {
            range.zip(p).for_each(|(i, p)| *p = before[i] - tau * (u[i] - h[i] + datum));
        });
        self.project();
        let share = self.arrive(datum).lowest();
        let (before, before_u) = (&self.before, &self.r);
        let between = |values: &mut [f64], before: &[f64], most: &Ceiling| {
            chunks::update(values, |range, values| {
                let reached = |i: usize, value: f64| (before[i] + share * (value - before[i])).min(most.at(i));
                range.zip(values).for_each(|(i, value)| *value = reached(i, *value));
            });
        };
        between(&mut self.p, before, self.ceiling);
        between(&mut self.u, before_u, &Ceiling::Uniform(f64::INFINITY));
        self.fresh = false;
    }

    /// Makes a pressure of what a step left: the nearest one below a ceiling that carries the load; on a hard wall the nearest one,
    /// scaled to the load.
    fn project(&mut self) {
        let ceiling = self.ceiling;
        if let Some(mean) = self.problem.mean_pressure().filter(|_| ceiling.is_finite()) {
            let load = mean * self.p.len() as f64;
            self.p = feasible::nearest(std::mem::take(&mut self.p), load, ceiling);
        } else {
            chunks::update(&mut self.p, |range, p| {
                range.zip(p).for_each(|(i, p)| *p = p.max(0.0).min(ceiling.at(i)));
            });
            self.carry(chunks::sum(self.p.len(), |i| self.p[i]));
        }
    }

    /// Takes the displacement of this pressure, keeps that of the pressure before in `r`, and looks back on the way.
    fn arrive(&mut self, datum: f64) -> Way {
        std::mem::swap(&mut self.u, &mut self.r);
        self.refresh();
        let (p, u, before, before_u) = (&self.p, &self.u, &self.before, &self.r);
        let h = self.problem.height();
        Way {
            slope: chunks::sum(p.len(), |i| (p[i] - before[i]) * (before_u[i] - h[i] + datum)),
            curvature: chunks::sum(p.len(), |i| (p[i] - before[i]) * (u[i] - before_u[i])),
        }
    }

    /// The displacement after a step in which the set stayed, by linearity.
    fn follow(&mut self, scale: f64, tau: f64) {
        let r = &self.r;
        chunks::update(&mut self.u, |range, u| {
            range.zip(u).for_each(|(i, u)| *u = scale * (*u - tau * r[i]));
        });
        self.fresh = false;
    }

    /// Scales the pressure, whose sum is given, to the load, if that is prescribed, and returns the factor. Where nodes
    /// yield and the direction keeps the load, it is 1 except for rounding; none is returned where a ceiling lets some
    /// nodes scale only.
    fn carry(&mut self, sum: f64) -> Option<f64> {
        let Some(mean) = self.problem.mean_pressure() else { return Some(1.0) };
        let load = mean * self.p.len() as f64;
        if self.ceiling.is_finite() {
            let scale = feasible::carry(&mut self.p, load, self.ceiling);
            return if self.yields { Some(1.0) } else { scale };
        }
        let scale = load / sum;
        chunks::update(&mut self.p, |_, p| p.iter_mut().for_each(|p| *p *= scale));
        Some(scale)
    }

    /// The half-space, for the last transforms; the rest is freed.
    fn into_response(self) -> Response {
        self.response
    }
}

/// The effect of an update on the nodes: their load afterwards, and whether any left the contact or entered it.
struct UpdateEffect {
    load: f64,
    left: bool,
    entered: bool,
}

/// The energy on the way between two pressures: `slope x + curvature x^2 / 2` at the share `x` of it.
struct Way {
    slope: f64,
    curvature: f64,
}

impl Way {
    /// By how much the energy is higher at the end.
    fn rise(&self) -> f64 {
        self.slope + 0.5 * self.curvature
    }

    /// The share at which it is lowest.
    fn lowest(&self) -> f64 {
        if self.slope + self.curvature <= 0.0 { 1.0 } else { (-self.slope / self.curvature).max(0.0) }
    }
}

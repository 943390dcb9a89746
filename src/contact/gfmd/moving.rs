//! The surface in motion.

use super::Masses;
use super::pace::Pace;
use crate::contact::{Certificate, Problem, Step, Work, chunks};
use crate::elastic::Response;
use crate::surface::Field;

/// Place `w`, last advance `dw`, net force `f`, advance `a` under it where masses are not 1, and the wall's constraint forces `p`.
pub(super) struct Moving<'a> {
    problem: &'a Problem,
    pub response: Response,
    masses: Masses,
    softest: f64,
    w: Vec<f64>,
    dw: Vec<f64>,
    f: Vec<f64>,
    a: Vec<f64>,
    pub p: Vec<f64>,
}

impl<'a> Moving<'a> {
    /// The surface at rest under the pressure `start`, or undeformed, touching the indenter.
    pub(crate) fn new(start: Option<&Field>, problem: &'a Problem, masses: Masses) -> Self {
        let n = problem.nodes();
        let h = problem.height();
        let mut response = problem.response();
        let mut w = vec![0.0; n];
        if start.is_some() {
            response.displacement(&problem.first_pressure(start), &mut w);
        }
        let deepest = (0..n).fold(f64::NEG_INFINITY, |deepest, i| deepest.max(h[i] - w[i]));
        w.iter_mut().for_each(|w| *w += deepest);
        let softest = response.softest_stiffness();
        let zeros = || vec![0.0; n];
        let a = if masses == Masses::Uniform { Vec::new() } else { zeros() };
        Self { problem, response, masses, softest, w, dw: zeros(), f: zeros(), a, p: zeros() }
    }

    /// Finds the forces: elasticity and load; what the wall needs to hold the nodes that touch it and push; and what is left
    /// as net force, which is zero on those nodes.
    pub(crate) fn pull(&mut self) {
        self.response.respond(&self.w, &mut self.f, |k| -k);
        let (w, h, load) = (&self.w, self.problem.height(), self.problem.expected_mean_pressure());
        chunks::update_both(&mut self.f, &mut self.p, |range, f, p| {
            for ((i, f), p) in range.zip(f).zip(p) {
                *f -= load;
                *p = if w[i] <= h[i] { (-*f).max(0.0) } else { 0.0 };
                *f += *p;
            }
        });
    }

    /// The state as it is shown to observers. Held nodes lie on the wall, so that `<p g> = 0` in the frame of the indenter.
    pub(crate) fn step(&self, work: Work, certificate: Option<Certificate>) -> Step<'_> {
        let step = Step::new(self.problem, work, &self.p, &self.w).with_datum(0.0).with_force(&self.f);
        step.with_certificate(certificate)
    }

    /// One step of the dynamics, and back onto the wall where it was passed.
    pub(crate) fn advance(&mut self, pace: &mut Pace) {
        self.accelerate();
        let a = if self.masses == Masses::Uniform { &self.f } else { &self.a };
        let [keep, add] = pace.push(&self.f, &self.dw, a);
        let (h, p) = (self.problem.height(), &self.p);
        chunks::update_both(&mut self.w, &mut self.dw, |range, w, dw| {
            for ((i, w), dw) in range.zip(w).zip(dw) {
                let free = if p[i] > 0.0 { 0.0 } else { keep * *dw + add * a[i] };
                let placed = (*w + free).max(h[i]);
                *dw = placed - *w;
                *w = placed;
            }
        });
    }

    /// Stiffness `E* q / 2` of the wave that is as long as contact segments are apart along rows: longer waves are pinned by
    /// the wall and as stiff as this one.
    fn pinning_stiffness(&self) -> f64 {
        let [ny, nx] = self.problem.surface().grid().shape();
        let p = &self.p;
        let starts =
            chunks::visit(ny * nx, |range| range.filter(|&i| p[i] > 0.0 && (i % nx == 0 || p[i - 1] <= 0.0)).count());
        let per_row = starts.into_iter().sum::<usize>() as f64 / ny as f64;
        self.softest * per_row.max(1.0)
    }

    /// `a <- f / m` on the nodes that the wall does not hold, for masses `m_q = k_q`; for masses 1 it is `f`, which takes its place.
    fn accelerate(&mut self) {
        if self.masses == Masses::Uniform {
            return;
        }
        let floor = self.pinning_stiffness();
        self.response.respond(&self.f, &mut self.a, |k| 1.0 / k.max(floor));
        let p = &self.p;
        chunks::update(&mut self.a, |range, a| {
            range.zip(a).for_each(|(i, a)| *a = if p[i] > 0.0 { 0.0 } else { *a });
        });
    }
}

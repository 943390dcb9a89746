//! Work against precision: one solver on one grid.

use super::quantity::{Values, errors, of_contact, of_step};
use crate::contact::{Contact, Observer, Problem, Step, Stop, Wish};
use crate::error::{SetupError, SolveError};
use crate::lab::table::median;
use crate::lab::{Rival, Watch};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// The certificate falls by this factor from one point of a curve to the next.
const FALL: f64 = 0.5;

/// How far a solver has come at one step.
pub struct Point {
    /// Number of the step.
    pub step: usize,
    /// Certificate.
    pub eta: f64,
    /// Fourier transforms so far.
    pub transforms: u64,
    /// Seconds so far in each repeat, in ascending order.
    pub seconds: Vec<f64>,
    /// Relative error of the pressure against the reference, in the L2 norm.
    pub pressure_error: f64,
    /// Errors of the quantities against the reference.
    pub errors: Values,
    /// Steps seen before, the inner ones and those of coarse grids included.
    place: usize,
}

impl Point {
    /// Median of the seconds.
    pub fn median(&self) -> f64 {
        median(&self.seconds)
    }
}

/// One solver on one grid: a point for each halving of the certificate.
pub struct Curve {
    /// The solver.
    pub rival: Rival,
    /// Points along y and x.
    pub shape: [usize; 2],
    /// Certificate of the solution that errors are held against.
    pub reference_eta: f64,
    /// The points, in the order of the steps.
    pub points: Vec<Point>,
}

/// A problem with its all but exact solution on the same grid.
pub struct Reference {
    contact: Contact,
    values: Values,
}

impl Reference {
    /// Solves `problem`.
    pub fn of(problem: Problem, stop: &Stop, title: &str, watch: &mut Watch<'_>) -> Result<Self, SetupError> {
        let contact = solve(&Rival::MULTILEVEL, &problem, stop, &mut (), title, watch)?;
        let values = of_contact(&contact);
        Ok(Self { contact, values })
    }
}

impl Curve {
    /// Measures errors in a first run, which warms up, and seconds in `repeats` further runs, in which nobody looks at the
    /// fields.
    pub(super) fn of(
        rival: Rival,
        reference: &Reference,
        stop: &Stop,
        repeats: NonZeroUsize,
        title: &str,
        watch: &mut Watch<'_>,
    ) -> Result<Self, SetupError> {
        let problem = &reference.contact.problem;
        let mut sampler = Sampler { reference, tolerance: stop.tolerance(), seen: 0, points: Vec::new() };
        solve(&rival, problem, stop, &mut sampler, title, watch)?;
        let mut points = sampler.points;
        for _ in 0..repeats.get() {
            let mut clock = Clock { points: &mut points, seen: 0, next: 0 };
            solve(&rival, problem, stop, &mut clock, title, watch)?;
        }
        points.iter_mut().for_each(|point| point.seconds.sort_by(f64::total_cmp));
        let shape = problem.surface().grid().shape();
        Ok(Self { rival, shape, reference_eta: reference.contact.certificate.eta, points })
    }

    /// Points along the longer side.
    pub fn side(&self) -> usize {
        self.shape[1]
    }

    /// The largest error of `quantity` at a point or after it.
    pub fn error_from(&self, point: usize, quantity: usize) -> Option<f64> {
        self.points[point..].iter().try_fold(0.0, |worst: f64, point| Some(worst.max(point.errors[quantity]?.abs())))
    }

    /// The first point whose certificate is at most `eta`.
    pub fn reaching(&self, eta: f64) -> Option<&Point> {
        self.points.iter().find(|point| point.eta <= eta)
    }
}

/// The contact that a rival comes to, seen by `observer` and who else watches.
pub fn solve(
    rival: &Rival,
    problem: &Problem,
    stop: &Stop,
    observer: &mut dyn Observer,
    title: &str,
    watch: &mut Watch<'_>,
) -> Result<Contact, SolveError> {
    let others = watch(&format!("{title} {}", rival.title));
    rival.method.solver().solve(problem, stop, &mut (observer, others))
}

/// Makes the points of a curve.
struct Sampler<'a> {
    reference: &'a Reference,
    tolerance: f64,
    seen: usize,
    points: Vec<Point>,
}

impl Sampler<'_> {
    fn is_wanted(&self, eta: f64) -> bool {
        let last = self.points.last().map_or(f64::INFINITY, |point| point.eta);
        eta.is_finite() && (eta <= FALL * last || (eta <= self.tolerance && eta < last))
    }

    fn point(&self, step: &Step<'_>, eta: f64) -> Point {
        Point {
            step: step.index(),
            eta,
            transforms: step.transforms(),
            seconds: Vec::new(),
            pressure_error: relative_l2(step.pressure(), &self.reference.contact),
            errors: errors(&of_step(step), &self.reference.values),
            place: self.seen,
        }
    }
}

impl Observer for Sampler<'_> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if let Some(eta) = step.certificate().filter(|&eta| step.phase().level == 0 && self.is_wanted(eta)) {
            self.points.push(self.point(step, eta));
        }
        self.seen += 1;
        Ok(ControlFlow::Continue(()))
    }
}

/// Notes the seconds at the steps of `points`.
struct Clock<'a> {
    points: &'a mut [Point],
    seen: usize,
    next: usize,
}

impl Observer for Clock<'_> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if let Some(point) = self.points.get_mut(self.next).filter(|point| point.place == self.seen) {
            point.seconds.push(step.seconds());
            self.next += 1;
        }
        self.seen += 1;
        Ok(ControlFlow::Continue(()))
    }
}

fn relative_l2(pressure: &[f64], reference: &Contact) -> f64 {
    let pairs = pressure.iter().zip(&reference.pressure);
    let [difference, norm] = pairs.fold([0.0, 0.0], |[d, n], (a, b)| [d + (a - b).powi(2), n + b.powi(2)]);
    (difference / norm).sqrt()
}

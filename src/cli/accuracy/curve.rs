//! Work against precision: one solver on one grid.

use super::super::progress::Progress;
use super::quantity::{Values, errors, of_contact, of_step};
use crate::cli::contender::Contender;
use anyhow::Result;
use asperity::contact::{Contact, Observer, Problem, Step, Stop};
use asperity::error::SolveError;
use std::ops::ControlFlow;

/// The certificate falls by this factor from one point of a curve to the next.
const FALL: f64 = 0.5;

/// How far a solver has come at one step.
pub struct Point {
    pub step: usize,
    pub eta: f64,
    pub transforms: u64,
    /// Of each repeat, in ascending order.
    pub seconds: Vec<f64>,
    /// Relative, in the L2 norm, against the reference.
    pub pressure_error: f64,
    /// Against those of the reference.
    pub errors: Values,
    /// How many steps were seen before, the inner ones and those of coarse grids included.
    place: usize,
}

impl Point {
    /// The median of the repeats.
    pub fn median(&self) -> f64 {
        let n = self.seconds.len();
        0.5 * (self.seconds[(n - 1) / 2] + self.seconds[n / 2])
    }
}

/// One solver on one grid: a point for each halving of the certificate.
pub struct Curve {
    pub contender: Contender,
    pub shape: [usize; 2],
    /// Certificate of the solution that errors are held against.
    pub reference_eta: f64,
    pub points: Vec<Point>,
}

/// A problem with its all but exact solution on the same grid.
pub struct Reference {
    problem: Problem,
    contact: Contact,
    values: Values,
}

impl Reference {
    /// Solves `problem`.
    pub fn of(problem: Problem, stop: &Stop, title: &str) -> Result<Self> {
        let contact = solve(Contender::Multilevel, &problem, stop, &mut (), title)?;
        let values = of_contact(&contact, &problem);
        Ok(Self { problem, contact, values })
    }
}

impl Curve {
    /// Measures errors in a first run, which warms up, and seconds in `repeats` further runs, in which nobody looks at the
    /// fields.
    pub fn of(contender: Contender, reference: &Reference, stop: &Stop, repeats: usize, title: &str) -> Result<Self> {
        let mut sampler = Sampler { reference, tolerance: stop.tolerance(), seen: 0, points: Vec::new() };
        solve(contender, &reference.problem, stop, &mut sampler, title)?;
        let mut points = sampler.points;
        for _ in 0..repeats {
            let mut clock = Clock { points: &mut points, seen: 0, next: 0 };
            solve(contender, &reference.problem, stop, &mut clock, title)?;
        }
        points.iter_mut().for_each(|point| point.seconds.sort_by(f64::total_cmp));
        let shape = reference.problem.surface().grid().shape();
        Ok(Self { contender, shape, reference_eta: reference.contact.certificate.eta, points })
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

/// The best state that `contender` finds, shown to `observer` and as a bar.
pub fn solve(
    contender: Contender,
    problem: &Problem,
    stop: &Stop,
    observer: &mut dyn Observer,
    title: &str,
) -> Result<Contact> {
    let mut progress = Progress::new(stop.tolerance(), &format!("{title} {}", contender.title()));
    let solved = contender.solver()?.solve(problem, stop, &mut (observer, &mut progress));
    Ok(solved.or_else(SolveError::into_contact)?)
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
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        if let Some(eta) = step.certificate().filter(|&eta| step.phase().level == 0 && self.is_wanted(eta)) {
            self.points.push(self.point(step, eta));
        }
        self.seen += 1;
        ControlFlow::Continue(())
    }
}

/// Notes the seconds at the steps of `points`.
struct Clock<'a> {
    points: &'a mut [Point],
    seen: usize,
    next: usize,
}

impl Observer for Clock<'_> {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        if let Some(point) = self.points.get_mut(self.next).filter(|point| point.place == self.seen) {
            point.seconds.push(step.seconds());
            self.next += 1;
        }
        self.seen += 1;
        ControlFlow::Continue(())
    }
}

fn relative_l2(pressure: &[f64], reference: &Contact) -> f64 {
    let pairs = pressure.iter().zip(&reference.pressure);
    let [difference, norm] = pairs.fold([0.0, 0.0], |[d, n], (a, b)| [d + (a - b).powi(2), n + b.powi(2)]);
    (difference / norm).sqrt()
}

//! Work against precision: one solver on one grid.

use super::quantity::{QuantityValues, errors, found};
use crate::contact::{Contact, Each, Observer, Step, Stop};
use crate::error::SolveError;
use crate::lab::table::median;
use crate::lab::{ObserverMaker, Rival};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// How far a solver has come at one step.
pub(crate) struct ConvergencePoint {
    pub step: usize,
    pub eta: f64,
    pub transforms: u64,
    /// Seconds so far in each repeat, in ascending order.
    pub seconds: Vec<f64>,
    /// Relative error of the pressure against the reference, in the L2 norm.
    pub pressure_error: f64,
    /// Errors of the quantities against the reference.
    pub errors: QuantityValues,
    /// Steps seen before, the inner ones and those of coarse grids included.
    place: usize,
}

impl ConvergencePoint {
    pub(crate) fn median(&self) -> f64 {
        median(&self.seconds)
    }
}

/// One solver on one grid: a point for each halving of the certificate.
pub(crate) struct ConvergenceCurve {
    pub rival: Rival,
    /// Points along y and x, the longer side.
    pub shape: [usize; 2],
    /// Certificate of the reference solution.
    pub reference_eta: f64,
    pub points: Vec<ConvergencePoint>,
}

impl ConvergenceCurve {
    /// Measures errors against the all but exact solution `reference` in a first run, which warms up, and seconds in
    /// `repeats` further runs, in which no fields are computed.
    pub(crate) fn measure(
        rival: Rival,
        reference: &Contact,
        stop: &Stop,
        repeats: NonZeroUsize,
        title: &str,
        watch: ObserverMaker,
    ) -> Result<Self, SolveError> {
        let mut points = Vec::new();
        let run = |observer: &mut dyn Observer| {
            let others = watch(&format!("{title} {}", rival.title));
            rival.method.solver().solve(&reference.problem, stop, &mut (observer, others))
        };
        run(&mut sampler(reference, stop.tolerance(), &mut points))?;
        (0..repeats.get()).try_for_each(|_| run(&mut clock(&mut points)).map(drop))?;
        points.iter_mut().for_each(|point| point.seconds.sort_by(f64::total_cmp));
        let shape = reference.problem.surface().grid().shape();
        Ok(Self { rival, shape, reference_eta: reference.certificate.eta, points })
    }

    /// The largest error of `quantity` at a point or after it.
    pub(crate) fn error_from(&self, point: usize, quantity: usize) -> Option<f64> {
        self.points[point..].iter().try_fold(0.0, |worst: f64, point| Some(worst.max(point.errors[quantity]?.abs())))
    }

    /// The first point whose certificate is at most `eta`.
    pub(crate) fn reaching(&self, eta: f64) -> Option<&ConvergencePoint> {
        self.points.iter().find(|point| point.eta <= eta)
    }
}

/// The observer that makes the points of a curve.
fn sampler(reference: &Contact, tolerance: f64, points: &mut Vec<ConvergencePoint>) -> impl Observer {
    let (truth, mut seen) = (found(reference), 0);
    Each(move |step: &Step<'_>| {
        let last = points.last().map_or(f64::INFINITY, |point| point.eta);
        let is_wanted = |eta: f64| eta.is_finite() && (eta <= 0.5 * last || (eta <= tolerance && eta < last));
        if let Some(eta) = step.certificate().map(|it| it.eta).filter(|&eta| step.phase().level == 0 && is_wanted(eta))
        {
            points.push(ConvergencePoint {
                step: step.index(),
                eta,
                transforms: step.transforms(),
                seconds: Vec::new(),
                pressure_error: relative_l2(step.pressure(), reference),
                errors: errors(&found(step), &truth),
                place: seen,
            });
        }
        seen += 1;
        ControlFlow::Continue(())
    })
}

/// The observer that notes the seconds at the steps of the points.
fn clock(points: &mut [ConvergencePoint]) -> impl Observer {
    let (mut points, mut seen) = (points.iter_mut().peekable(), 0);
    Each(move |step: &Step<'_>| {
        if let Some(point) = points.next_if(|point| point.place == seen) {
            point.seconds.push(step.seconds());
        }
        seen += 1;
        ControlFlow::Continue(())
    })
}

fn relative_l2(pressure: &[f64], reference: &Contact) -> f64 {
    let pairs = pressure.iter().zip(&reference.pressure);
    let [difference, norm] = pairs.fold([0.0, 0.0], |[d, n], (a, b)| [d + (a - b).powi(2), n + b.powi(2)]);
    (difference / norm).sqrt()
}

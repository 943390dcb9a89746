//! Whole contact sets at once, on nested grids, with a guard that makes it certain.
//!
//! Letters of this file's folder: `p` pressure, `u` displacement, `v = u - h`, `S` the contact set, `lambda` the mean of `v` on
//! it, `r = lambda - v` the residual on `S`, `delta` the correction of `p` on `S`, `eta` the certificate.
//!
//! # Why it ends
//! Call a state *better* when its certificate is at most nine tenths of that of the last better one. Free updates (see
//! [`Multilevel`]) go on as long as one of every few is better. If none is, the best state is taken up again and *guarded
//! steps* follow until the certificate has halved:
//!
//! - **What falls.** A guarded step moves along `d = q - p` for a feasible `q`, so that every point of the way is feasible, to the
//!   exact minimum of the convex `f` on that way; it is taken only if `<d v> < 0`, so `f` falls strictly. The change of `f` is never
//!   formed as a difference of two sums. Every other `q` is the projection of a gradient step onto `{p >= 0, <p> fixed}`, for
//!   which `<d v> < 0` unless `p` is the solution; the others come from whole-set updates, which are better when they work.
//! - **Why it cannot cycle.** `f` falls strictly along guarded steps. Projected gradient steps with exact minimisation converge
//!   to the minimum of a convex function, and steps between them that lower `f` do not change that; at the minimum the
//!   certificate is zero, so it halves after finitely many of them. Between two guarded phases, and between two better states,
//!   there are at most a few free updates. Hence the certificate falls by a fixed factor again and again and reaches every
//!   tolerance above rounding.
//! - **What it costs.** Whole-set updates cycle when their corrections are loose. So a correction is tightened whenever an update
//!   was no better, and with that the guard has hardly been needed; the tests force it.

mod correction;
mod hierarchy;
mod level;

use crate::contact::best::Best;
use crate::contact::observe::{Energy, Phase, State};
use crate::contact::solver::{Run, first_pressure};
use crate::contact::{Contact, Observer, Problem, Solver, Status, Step, Stop};
use crate::error::SolveError;
use crate::surface::Field;
use hierarchy::{coarser, prolong};
use level::Level;

/// Coarse grids are solved to this certificate, or to this part of that at their own start, if that is less: the next start is
/// not better than the step between the grids, of which the own start is a measure.
const COARSE_TOLERANCE: f64 = 1e-2;
const COARSE_REDUCTION: f64 = 0.1;
/// Updates that a coarse grid gets at the most.
const COARSE_UPDATES: usize = 12;

/// Updates of the finest grid without a better state after which a run is given up, besides as many again as it took to find
/// the best one. Only rounding makes it so.
const PATIENCE: usize = 200;

/// Nested grids of whole-set updates: the fast solver.
///
/// On each grid, from the coarsest on, repeats:
/// 1. on the contact set, solve for the pressure that makes the gap vanish, whatever its sign, by conjugate gradients
///    preconditioned with the opposite operator `E* |q| / 2` restricted to the set;
/// 2. take nodes out whose pressure is negative and in where the gap is negative, all at once;
/// 3. go on from that pressure, clipped and scaled to the load, with its own displacement.
///
/// The pressure is interpolated to the next grid, whose heights were subsampled. Coarse grids end where a side becomes odd or
/// short; on any other grid the method works without them.
///
/// Iterations are updates of the finest grid; only they are shown to the observer. Transforms of coarse grids count by their
/// share of points. Memory: 4 fields of n doubles (6 in guarded steps), 1 of bytes and 6 vectors on the contact set, besides the
/// [`crate::elastic::HalfSpace`]; coarse grids are freed before the finest one is set up.
///
/// # Why it is stable
/// No step length is chosen: corrections are exact minimisers on their set, and guarded steps are exact minimisers on their way.
/// Why it ends is told at the head of the module.
///
/// # Source
/// Primal-dual active sets: Hintermueller, Ito & Kunisch, SIAM J. Optim. 13, 865 (2002). Opposite-order preconditioning:
/// Steinbach & Wendland, Adv. Comput. Math. 9, 191 (1998). Deviations: the clipped restart, the guard, and the stop by
/// [`crate::contact::Certificate`].
///
/// ```
/// use asperity::{Grid, Problem, Stop, Surface, surface::Spectrum, contact::{Multilevel, Solver}};
/// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff: 0.004, rms_gradient: 1e-3 };
/// let surface = Surface::rough(Grid::line(1 << 14, 1.0)?, &spectrum, 1)?;
/// let problem = Problem::at_reduced_pressure(surface, 1.0, 0.1)?;
/// let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?;
/// assert!(contact.work.transforms < 1000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Multilevel;

impl Solver for Multilevel {
    fn name(&self) -> &'static str {
        "multilevel"
    }

    fn settings(&self) -> String {
        "whole-set updates on nested grids, guarded".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let mut run = Run::new(problem, stop, observer).with_patience(PATIENCE);
        let (start, coarse_work) = match start {
            Some(_) => (Some(first_pressure(start, problem)), 0),
            None => coarse_start(problem),
        };
        let mut level = Level::new(problem, start);
        let status = loop {
            let eta = level.certify();
            run.best.offer(eta, &level.p, run.iterations());
            if let Some(status) = show(&level, &mut run, coarse_work, eta) {
                break status;
            }
            level.advance(eta, &run.best);
            run.advance();
        };
        let transforms = coarse_work + level.half_space.transforms();
        run.finish(problem, &mut level.half_space, self.name(), status, transforms)
    }
}

/// A start from coarser grids, where there are any, and its cost in transforms of the grid of `problem`.
fn coarse_start(problem: &Problem) -> (Option<Vec<f64>>, u64) {
    let Some(coarse) = coarser(problem) else { return (None, 0) };
    let (start, work) = coarse_start(&coarse);
    let mut level = Level::new(&coarse, start);
    let mut best = Best::new(&coarse);
    let mut tolerance = COARSE_TOLERANCE;
    for update in 0..=COARSE_UPDATES {
        let eta = level.certify();
        best.offer(eta, &level.p, update);
        if update == 0 {
            tolerance = tolerance.min(COARSE_REDUCTION * eta);
        }
        if eta <= tolerance || update == COARSE_UPDATES {
            break;
        }
        level.advance(eta, &best);
    }
    let fine_per_coarse = (problem.nodes() / coarse.nodes()) as u64;
    let work = (work + level.half_space.transforms()).div_ceil(fine_per_coarse);
    (Some(prolong(&best.pressure, coarse.surface().grid(), problem)), work)
}

fn show(level: &Level<'_>, run: &mut Run<'_>, coarse_work: u64, eta: f64) -> Option<Status> {
    let step = Step::new(State {
        problem: level.problem,
        work: run.work(coarse_work + level.half_space.transforms()),
        pressure: &level.p,
        displacement: &level.u,
        datum: -level.lambda(),
        certificate: Some(eta),
        phase: Phase::finest(run.iterations()),
        energy: Energy::Complementary,
    });
    run.show(&step)
}

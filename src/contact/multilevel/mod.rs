//! An active-set method on nested grids, with a safeguard that guarantees convergence.
//!
//! Letters of this file's folder: `p` pressure, `u` displacement, `v = u - h`, `S` the contact set, `lambda` the mean of `v` on
//! it or minus a given mean gap, `r = lambda - v` the residual on `S`, `delta` the correction of `p` on `S`, `eta` the
//! certificate.
//!
//! # Why it is fast
//! On a given set the pressure solves `A delta = r` with the compliance `A` restricted to `S`. Its inverse is the Schur complement
//! of the stiffness `K = A^-1` of the whole plane: `K` after the extension of `r` from `S` that costs the least energy. An
//! approximate extension `E` gives the preconditioner `E' K E`, symmetric and positive for any `E`. Extension by zero, the usual
//! choice of opposite-order preconditioning, tears long waves apart at the rims of many small patches; the
//! [`extension::Extension`] used here lets them fade as the capacity of a patch says, and two or three steps of conjugate gradients
//! then reduce the residual fiftyfold, on any number of nodes. On thin bonded layers the long waves are stiff, and a [`film`] takes their part.
//!
//! Most updates need two digits only. So a free update on a surface is an [`inner`] iteration: several updates of the set, among the
//! nodes near the contact, with displacements that are cheap. They are computed by transforms in single precision or, on small
//! sets, by the compliance of a half-space in two parts ([`split`]), whose cost grows with the set instead of the grid. The change of
//! the pressure is what is computed in this way, so that its error shrinks with the change. Then one displacement in double
//! precision shows the state as it is, with its certificate.
//!
//! | free update                                | displacements                               | used                          |
//! |--------------------------------------------|---------------------------------------------|-------------------------------|
//! | inner iteration, split compliance          | sums over neighbours, FFT of a coarse grid  | on small sets of half-spaces  |
//! | inner iteration, single precision          | FFT in single precision                     | on other sets of surfaces     |
//! | inner iteration, double precision          | FFT in double precision                     | from a good start, where those above are not |
//! | one update, correction in single precision | FFT in double precision                     | where nodes yield             |
//! | one update                                 | FFT in double precision, for all            | on lines, and on solids whose waves differ most in stiffness |
//!
//! Whatever is begun with, a free update that was no better moves on to the next row of the table, but from an inner iteration in
//! single precision to one update, and from one in double precision to the last row.
//!
//! A good start, such as the pressure of the last step of a history, is off at few nodes. Its inner iterations begin with the nodes that
//! penetrate, and solve loosely until the set stays as it is. From then on conjugate gradients go on to the goals of the run.
//!
//! # Why it ends
//! Call a state *better* when its distance from the goals of the run, which is proportional to the certificate, is at most nine
//! tenths of that of the last better one. Free updates (see [`Multilevel`]) go on as long as one of every few is better. Whether it
//! is, the certificate says, whose displacement is in double precision, so that no error of an inner iteration is taken for progress. If none
//! is, the best state is taken up again and *guarded steps* follow until the distance has halved:
//!
//! - **What falls.** A guarded step moves along `d = q - p` for a feasible `q`, so that every point of the way is feasible, to the
//!   exact minimum of the convex `f` on that way; it is taken only if `<d (v - lambda)> < 0`, so `f` falls strictly. The change
//!   of `f` is never formed as a difference of two sums. Every other `q` is the projection of a gradient step onto `{p >= 0}`,
//!   with `<p>` fixed if it is given, for which `f` falls unless `p` is the solution; the others come from whole-set updates,
//!   which are better when they work.
//! - **Why it cannot cycle.** `f` falls strictly along guarded steps. Projected gradient steps with exact minimisation converge
//!   to the minimum of a convex function, and steps between them that lower `f` do not change that; at the minimum the
//!   certificate is zero, so it halves after finitely many of them. Between two guarded phases, and between two better states,
//!   there are at most a few free updates. Hence the certificate falls by a fixed factor again and again and reaches every
//!   tolerance above rounding.
//! - **What it costs.** Whole-set updates cycle when their corrections are loose. So a correction is tightened whenever
//!   an update was no better, so the guard is rarely needed; the tests force it.
//!
//! # Below a hardness
//! There are three sets: open nodes without pressure, free ones, and those that yield, at `H_c` to the last bit. The correction acts on
//! the free nodes, under the pressure of those that yield, and an exchange updates all sets by signs: out go free nodes below zero,
//! in come open ones with `v < lambda`; free ones above `H_c` yield, and those that yield with `v > lambda` are free again, which
//! is represented by the number next below `H_c`. Then free nodes are scaled to the load and cut at `H_c`. Where none is free, `lambda` lies between
//! the nodes that would carry the load at `H_c` and the others, so that some enter and as many become free, unless it is the
//! solution. Inner iterations know nothing of this. They are used until the first node yields.
//!
//! Two or three neighbours at the edge of a patch, of which one yields and the next one is open, may exchange together, overshoot,
//! and exchange back for ever, which no tighter correction ends. So all nodes that want it are exchanged only if they are fewer than
//! at any update before on this grid. Else, of neighbours, the one that wants it most is. An update with fewer ones counts as a
//! better state, and its correction is not tightened. This cannot go on for ever either: numbers of nodes fall finitely often.
//! If an exchange would leave too few nodes to carry the load at `H_c`, none leaves. Patches that yield up to their edges keep
//! their load from grid to grid, as the interpolated pressure keeps its edges.
//!
//! One thing differs on the finest grid: guarded steps are projected Newton steps there. The correction
//! on the free nodes is projected onto the bounds and the load of these nodes by a common shift, and `f` is minimised
//! exactly on the way to the result. If `f` does not fall on that way, nor on shorter ones, a projected gradient step
//! follows. After the second guarded phase, updates are not free again.
//!
//! Where each node has a ceiling of its own, `H_c` is that of the node, and a node whose ceiling is zero stays open. Inner iterations
//! are not used then.
//!
//! All of the above holds with `{0 <= p <= H_c}` instead of `{p >= 0}`: it is convex, every guarded step stays within
//! it, the projection onto it and the load is exact, and for the projected gradient step `f` falls unless `p` is the
//! solution. The length of that step comes from the free nodes: after an exchange the gradient is uniform on them, and
//! the length zero, at the solution only.

mod correction;
mod exchange;
mod extension;
mod far;
mod film;
mod guard;
pub(super) mod hierarchy;
mod inner;
mod level;
mod membrane;
mod method;
mod near;
pub(super) mod operator;
mod split;
mod stiffness;
pub(super) mod support;
mod workspace;

use crate::contact::best::Best;
use crate::contact::{Certificate, Contact, Observer, Phase, Problem, Run, Solver, Status, Step, Stop, Values};
use crate::error::SolveError;
use crate::grid::Grid;
use crate::surface::Field;
use hierarchy::{coarser, halved, interpolated, prolong};
use level::{Displacement, InnerStep, Level, displace};
use support::{SparsePressure, Support};

pub(super) use stiffness::{stiffness, stiffness_of_all};

/// A given start with a worse certificate is not worth more than what coarse grids find.
const GOOD_START: f64 = 0.1;

/// Coarse grids are solved to this certificate, or to this part of that at their own start, if that is less: the next start is
/// not better than the step between the grids, of which the own start is a measure.
const COARSE_TOLERANCE: f64 = 1e-2;
/// The grid next to the finest is solved to this certificate. Its contact is compared with that of the finest grid to estimate the
/// error of the grid.
const COMPARED_TOLERANCE: f64 = 1e-3;
const COARSE_REDUCTION: f64 = 0.1;
/// The parts to which inner iterations bring the certificate: on coarse grids, in the first one of the finest grid, and, of what is
/// missing to the goals of the run, in later ones.
const COARSE_GOAL: f64 = 0.03;
const FIRST_GOAL: f64 = 1e-3;
const LAST_GOAL: f64 = 0.3;
/// A coarse grid with a worse certificate has not found its contact, as below a hardness where that of light loads is smaller than a
/// few of its nodes. The contact of the finest grid is not compared with it.
const COMPARABLE: f64 = 0.1;
/// Largest number of updates on a coarse grid.
const COARSE_UPDATES: usize = 12;

/// Number of steps on a grid without a better state after which a run stops, in addition to as many steps as it took to
/// find the best state. Only rounding causes this.
const PATIENCE: usize = 600;

/// Active-set updates on nested grids: the fastest solver.
///
/// On each grid, from the coarsest on, repeats:
/// 1. on the contact set, solve for the pressure that makes the gap vanish, of any sign, by preconditioned conjugate
///    gradients: the inner steps;
/// 2. take nodes out whose pressure is negative and in where the gap is negative, all at once;
/// 3. go on from that pressure, clipped and scaled to the load, with its own displacement.
///
/// On surfaces several of these updates follow each other with displacements in single precision, or, on small contacts of a
/// half-space, with approximate ones whose cost grows with the contact. After them, or after each update on lines, an outer step
/// computes the displacement and the certificate in double precision.
///
/// The pressure is interpolated to the next grid, whose heights were subsampled. Coarse grids end where a side becomes odd or
/// short; on any other grid the method works without them. A given start whose certificate is at most 0.1 is taken up on the
/// finest grid; from a worse one the way over coarse grids is shorter. From a start whose certificate is 1e-4 a rough contact needs about a
/// third of the transforms of a solve without one.
///
/// Outer and inner steps of all grids are shown to the observer and count as iterations. An inner step is shown as the
/// feasible pressure next to it, clipped and scaled, whose fields are made only on request. Transforms of coarse grids
/// count by their share of points, and those in single precision like others.
///
/// Memory on the finest grid, besides the heights, is the largest of three. The result has 3 fields of n doubles, and all else is freed
/// before they are made. An outer step needs 1 field and the [`crate::elastic::Response`], which an inner iteration by sums over neighbours keeps. One by transforms on a surface
/// frees both, and needs 4/3 of a field. Both need 6 vectors on the nodes near the contact
/// and as many on the contact set, with 16 bytes for each run of nodes; on a line a correction needs 6 fields, and
/// 8 vectors on the contact set. From a good start there are 2 and 1 vectors more, on lines as well. On a thin bonded layer the preconditioner takes up to 6 fields more on a surface. Below a hardness an
/// exchange takes 1 field more, guarded steps 4. Coarse grids are freed before the finest one is set up.
///
/// # Why it is stable
/// No step length is chosen: corrections are exact minimisers on their set, and guarded steps are exact minimisers on their way. The
/// documentation of the module explains why it terminates.
///
/// # Source
/// Primal-dual active sets: Hintermueller, Ito & Kunisch, SIAM J. Optim. 13, 865 (2002). Opposite-order preconditioning:
/// Steinbach & Wendland, Adv. Comput. Math. 9, 191 (1998). Deviations: the inner iterations, the extension in the preconditioner, the clipped
/// restart, the guard, and the stop by [`crate::contact::Certificate`].
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
/// use asperity::{Grid, Problem, Stop, Surface, surface::Spectrum};
/// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff: 0.004, rms_gradient: 1e-3 };
/// let surface = Surface::rough(Grid::line(1 << 14, 1.0)?, &spectrum, 1)?;
/// let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
/// let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
/// assert!(contact.work.transforms < 200);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Multilevel;

impl Multilevel {
    /// Number of fields of doubles that a solve needs at its peak, without the heights, if a share of the nodes is in
    /// contact.
    ///
    /// Measured: the resident memory of solves of `2^20` nodes, of rough lines and surfaces at 7 loads with 4 % to 99 % of the
    /// area in contact, and of a cylinder and a sphere on free boundaries at 5 and 4 loads with 3 % to 87 % of it. The
    /// straight lines through the readings are within a fifth of them.
    /// The few solves in full contact need less: half of it for lines.
    pub fn fields(grid: &Grid, relative_area: f64) -> f64 {
        match (grid.is_line(), grid.is_periodic()) {
            (true, true) => 6.0 + 13.0 * relative_area,
            (true, false) => 8.5 + 12.0 * relative_area,
            (false, true) => 2.3 + 13.4 * relative_area,
            (false, false) => 2.4 + 14.0 * relative_area,
        }
    }

    /// Number of fields that the stiffness of a contact needs, without the heights and the fields of the contact, measured
    /// in the same way.
    pub fn stiffness_fields(grid: &Grid, relative_area: f64) -> f64 {
        match (grid.is_line(), grid.is_periodic()) {
            (true, true) => 3.4 + 12.5 * relative_area,
            (true, false) => 7.0 + 10.5 * relative_area,
            (false, true) => 2.0 + 10.5 * relative_area,
            (false, false) => 4.2 + 13.0 * relative_area,
        }
    }

    /// Largest number of coarse grids above `grid`, each with half as many points per side.
    pub fn coarse_grids(grid: &Grid) -> usize {
        std::iter::successors(halved(grid), halved).count()
    }
}

impl Solver for Multilevel {
    fn name(&self) -> &str {
        "multilevel"
    }

    fn settings(&self) -> String {
        "active-set updates on nested grids, with a safeguard".into()
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
        let run = Run::begin(self, problem, stop, observer).with_patience(PATIENCE);
        let mut cascade = Cascade { run, finest: problem.nodes(), spent: 0.0 };
        let (mut level, ended) = match start {
            Some(start) => cascade.level_from(start, problem),
            None => cascade.level_on(problem, 0),
        };
        let status = cascade.relax(&mut level, 0, ended).unwrap_or(Status::Stalled);
        let transforms = cascade.transforms(&level);
        let run = cascade.run;
        if level.is_displaced(run.best.pressure.as_ref()) {
            let displacement = level.into_displacement();
            return Ok(run.finish_with(status, transforms, |_| displacement));
        }
        Ok(run.finish_after(status, transforms, level.into_response()))
    }
}

/// The run through all grids.
struct Cascade<'a> {
    run: Run<'a, SparsePressure>,
    /// Nodes of the finest grid.
    finest: usize,
    /// Work on grids that are done with, in transforms of the finest grid.
    spent: f64,
}

impl Cascade<'_> {
    /// The finest grid with the pressure `start`, unless coarser grids promise a better one.
    fn level_from<'p>(&mut self, start: &Field, problem: &'p Problem) -> (Level<'p>, Option<Status>) {
        let mut level =
            Level::new(problem, |rows| SparsePressure::from_field(&problem.first_pressure(Some(start)), rows));
        if level.certify().eta <= GOOD_START {
            return (level.near(), None);
        }
        if halved(problem.surface().grid()).is_none() {
            return (level, None);
        }
        self.spent = level.transforms();
        drop(level);
        self.level_on(problem, 0)
    }

    /// The grid of `problem`, `depth` below the finest, with the pressure of coarser grids, if there are any; and why the run
    /// ended there, if it did.
    fn level_on<'p>(&mut self, problem: &'p Problem, depth: usize) -> (Level<'p>, Option<Status>) {
        let Some(coarse) = coarser(problem) else {
            return (Level::new(problem, |rows| SparsePressure::first(problem, rows)).at_depth(depth), None);
        };
        let (mut level, ended) = self.level_on(&coarse, depth + 1);
        let ended = self.relax(&mut level, depth + 1, ended);
        self.run.coarser = (depth == 0 && level.certify().eta <= COMPARABLE).then(|| level.resolved());
        self.spent += self.share(&level) * level.transforms();
        let pressure = self.run.best.pressure.take().unwrap_or_else(|| level.pressure.clone()).spread();
        self.run.best = Best::none(self.run.iterations());
        let [from, to] = [&coarse, problem].map(|problem| problem.surface().grid());
        let ceilings = [&coarse, problem].map(Problem::ceiling);
        let finer = Level::new(problem, |rows| prolong(&pressure, [from, to], rows, ceilings)).at_depth(depth);
        (finer.with_interpolated(|| interpolated(&level.u, from, to)), ended)
    }

    /// Iterates on one grid, and says why the run ends, unless it goes on to a finer grid. A run that has `ended` gets no more
    /// than a certificate.
    fn relax(&mut self, level: &mut Level<'_>, depth: usize, mut ended: Option<Status>) -> Option<Status> {
        let coarse = (depth > 0).then_some(COARSE_GOAL);
        if level.displacement == Displacement::Interpolated && ended.is_none() {
            let phase = Phase { level: depth, outer: 0, inner: 0 };
            ended = self.advance(level, phase, coarse.unwrap_or(FIRST_GOAL));
        }
        for outer in 0.. {
            let certificate = level.certify();
            let eta = certificate.eta;
            self.run.offer(&certificate, &level.completed());
            if ended.is_some() {
                break;
            }
            let phase = Phase { level: depth, outer, inner: 0 };
            let goal = coarse.unwrap_or(LAST_GOAL * self.run.missing(&certificate));
            let distance = self.run.distance(&certificate);
            ended = self.show(level, phase, certificate);
            let tolerance = if depth == 1 { COMPARED_TOLERANCE } else { COARSE_TOLERANCE };
            let tolerance = tolerance.min(COARSE_REDUCTION * *level.first_eta.get_or_insert(eta));
            if ended.is_some() || depth > 0 && (eta <= tolerance || outer == COARSE_UPDATES) {
                break;
            }
            level.choose_mode(distance, &self.run.best);
            ended = self.advance(level, phase, goal);
        }
        ended
    }

    fn show(&mut self, level: &Level<'_>, phase: Phase, certificate: Certificate) -> Option<Status> {
        let (work, pressure) = (self.run.work(self.transforms(level)), Values::lazy(|| level.completed().spread()));
        let step = Step::new(level.problem, work, pressure, &level.u).with_certificate(certificate).with_phase(phase);
        let step = step.with_decision(level.decision);
        let ended = if phase.level == 0 { self.run.show(&step) } else { self.run.pass(&step) };
        if ended.is_none() {
            self.run.advance();
        }
        ended
    }

    /// An outer step, whose inner ones are shown as the feasible states next to them.
    fn advance(&mut self, level: &mut Level<'_>, mut phase: Phase, goal: f64) -> Option<Status> {
        let (spent, share, problem) = (self.spent, self.share(level), level.problem);
        let run = &mut self.run;
        level.advance(goal, &mut |InnerStep { set, candidates, signed, decision, transforms }, response| {
            phase.inner += 1;
            let transforms = (spent + share * transforms).ceil() as u64;
            let feasible = || feasible(set, signed(), problem);
            let displaced = || {
                let mut u = vec![0.0; problem.nodes()];
                response.uncounted(|response| displace(&feasible(), response, &mut u));
                u
            };
            let pressure = Values::lazy(|| feasible().spread());
            let step = Step::new(problem, run.work(transforms), pressure, Values::lazy(displaced)).with_phase(phase);
            let mut step = step.with_decision(decision);
            if let Some(candidates) = candidates {
                step = step.with_candidates(Values::lazy(|| candidates.spread(&vec![1.0; candidates.nodes()])));
            }
            let ended = run.pass(&step);
            drop(step);
            if ended.is_none() {
                run.advance();
            }
            ended
        })
    }

    /// A transform of this grid in those of the finest.
    fn share(&self, level: &Level<'_>) -> f64 {
        level.problem.nodes() as f64 / self.finest as f64
    }

    fn transforms(&self, level: &Level<'_>) -> u64 {
        (self.spent + self.share(level) * level.transforms()).ceil() as u64
    }
}

/// The signed pressure on `support`, clipped and scaled to the load.
fn feasible(support: &Support, mut values: Vec<f64>, problem: &Problem) -> SparsePressure {
    let ceiling = support.ceiling(problem.ceiling());
    values.iter_mut().enumerate().for_each(|(i, p)| *p = p.max(0.0).min(ceiling.at(i)));
    let mut pressure = SparsePressure { support: support.clone(), values };
    pressure.carry(problem);
    pressure
}

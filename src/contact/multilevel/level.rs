//! The iteration on one grid.

use super::correction::{Correction, mean};
use super::method::{InnerPace, UpdateMethod};
use super::operator::SetOperator;
use super::support::{SparsePressure, Support, corrected};
use super::workspace::Workspace;
use crate::chunks;
use crate::contact::best::Best;
use crate::contact::{Ceiling, Certificate, CertificateSums, Decision, Edges, Problem, Resolved, Status, slack};
use crate::elastic::Response;
use std::borrow::Cow;

/// A state is better when its distance from the goals is this part of that of the last better one.
const BETTER: f64 = 0.9;
/// Free updates without a better state after which the guard takes over.
pub(super) const STALE: usize = 5;
/// The part to which guarded steps bring the least distance before updates are free again.
pub(super) const RELEASE: f64 = 0.5;

/// Phases of guarded steps on the finest grid below a hardness after which updates are not free again.
const GUARDED_PHASES: usize = 2;

/// Reduction of the residual in a whole-set update, its part after an update that was no better, and the least. Loose
/// corrections cost less, but may let the sets cycle; tight ones have not been seen to.
const REDUCTION: f64 = 0.02;
const TIGHTENING: f64 = 0.5;
const TIGHTEST: f64 = 1e-3;

/// Pressures above this part of the ceiling differ from it by rounding only.
const ALMOST: f64 = 1.0 - 1e-12;

/// Pressure, its displacement, and the contact set on one grid.
pub(super) struct Level<'a> {
    pub problem: &'a Problem,
    pub response: Response,
    pub pressure: SparsePressure,
    pub u: Vec<f64>,
    /// Whether `u` is the displacement of the pressure.
    pub displacement: Displacement,
    /// `eta` at the start of this grid, as soon as it is known.
    pub first_eta: Option<f64>,
    reduction: f64,
    pub method: UpdateMethod,
    /// The compliance of inner steps; made on first use.
    pub operator: Option<Box<dyn SetOperator>>,
    /// Transforms by earlier operators.
    pub spent: f64,
    pub mode: Mode,
    /// The way in which this state was reached.
    pub decision: Decision,
    /// Whether it is the grid of the problem that is to be solved.
    is_finest: bool,
    /// How inner iterations go about their updates.
    pub pace: InnerPace,
    /// The fewest nodes that a free update had to exchange where some yield so far, and whether the last one had fewer than any before.
    pub fewest: usize,
    pub has_fewer: bool,
    /// Phases of guarded steps so far.
    guarded_phases: usize,
}

/// How the stored displacement `u` belongs to the stored pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Displacement {
    /// It is the displacement of the pressure, in double precision.
    Exact,
    /// It is interpolated from the coarser grid.
    Interpolated,
    /// It is the displacement of an earlier pressure, or empty.
    Outdated,
}

/// Free updates, of which the last `stale` were no better than `mark`; or guarded steps, `steps` so far, until the distance from
/// the goals is `release`.
#[derive(Clone, Copy)]
pub(super) enum Mode {
    Free { mark: f64, stale: usize },
    Guarded { release: f64, steps: usize },
}

/// An inner step of a correction.
pub(super) struct InnerStep<'s> {
    pub set: &'s Support,
    /// The nodes that the set may grow to, of an inner iteration.
    pub candidates: Option<&'s Support>,
    /// The signed pressure on the set.
    pub signed: &'s dyn Fn() -> Vec<f64>,
    pub decision: Decision,
    /// Transforms of the grid so far.
    pub transforms: f64,
}

/// The watch of inner steps, with the half-space. It may end the run.
pub(super) type InnerStepCallback<'w> = dyn FnMut(InnerStep<'_>, &mut Response) -> Option<Status> + 'w;

impl<'a> Level<'a> {
    /// Starts from a pressure, or from the uniform one, made for the rows of the half-space.
    pub(crate) fn new(problem: &'a Problem, start: impl FnOnce([usize; 2]) -> SparsePressure) -> Self {
        let response = problem.response();
        let mut pressure = start(response.rows());
        pressure.carry(problem);
        let method = UpdateMethod::first(problem, &pressure);
        Self {
            problem,
            pressure,
            response,
            u: vec![0.0; problem.nodes()],
            displacement: Displacement::Outdated,
            first_eta: None,
            reduction: REDUCTION,
            method,
            operator: None,
            spent: 0.0,
            mode: Mode::Free { mark: f64::INFINITY, stale: 0 },
            decision: Decision::Start,
            is_finest: true,
            pace: InnerPace::Wide,
            fewest: usize::MAX,
            has_fewer: false,
            guarded_phases: 0,
        }
    }

    /// The same state, from a given pressure that is near the solution.
    pub(crate) fn near(self) -> Self {
        let method = UpdateMethod::near(self.problem, &self.pressure);
        Self { method, pace: InnerPace::Near, ..self }
    }

    /// This state with a displacement that `interpolated` makes from the coarser grid, where inner iterations can begin with it.
    pub(crate) fn with_interpolated(self, interpolated: impl FnOnce() -> Vec<f64>) -> Self {
        if !self.method.has_inner_iterations() {
            return self;
        }
        Self { u: interpolated(), displacement: Displacement::Interpolated, ..self }
    }

    /// The same state on a grid that lies `depth` below the finest.
    pub(crate) fn at_depth(self, depth: usize) -> Self {
        Self { is_finest: depth == 0, ..self }
    }

    /// Sees to it that the displacement is that of the pressure, and returns the certificate of both.
    pub(crate) fn certify(&mut self) -> Certificate {
        self.refresh();
        if self.ceiling().is_finite() {
            return Certificate::from_displacement(self.problem, &self.pressure.spread(), &self.u);
        }
        Certificate::from_sums(self.problem, &self.sums())
    }

    /// The pressure for others to see: nodes that lie at the ceiling but for rounding yield.
    pub(crate) fn completed(&self) -> Cow<'_, SparsePressure> {
        if !self.ceiling().is_finite() {
            return Cow::Borrowed(&self.pressure);
        }
        let ceiling = self.ceiling_on_set();
        let almost = |i: usize, p: f64| p < ceiling.at(i) && p >= ALMOST * ceiling.at(i);
        let SparsePressure { support, values } = &self.pressure;
        if !values.iter().enumerate().any(|(i, &p)| almost(i, p)) {
            return Cow::Borrowed(&self.pressure);
        }
        let whole = |(i, &p): (usize, &f64)| if almost(i, p) { ceiling.at(i) } else { p };
        let values = values.iter().enumerate().map(whole).collect();
        Cow::Owned(SparsePressure { support: support.clone(), values })
    }

    /// Area and gradient of this state with its edges resolved.
    pub(crate) fn resolved(&self) -> Resolved {
        let (u, h, lambda) = (&self.u, self.problem.height(), self.lambda());
        Edges::new(self.problem, &self.pressure.spread(), |node| u[node] - h[node] - lambda).resolved()
    }

    /// The highest pressure that is allowed at each node.
    pub(crate) fn ceiling(&self) -> &'a Ceiling {
        self.problem.ceiling()
    }

    /// The same at each node of the set.
    pub(crate) fn ceiling_on_set(&self) -> Ceiling {
        self.pressure.support.ceiling(self.ceiling())
    }

    /// `lambda` of this state: the mean of `v` weighted by the pressure, or below a hardness by its room, or, at a given mean gap,
    /// minus that.
    pub(crate) fn lambda(&self) -> f64 {
        let of_pressure = || {
            if self.ceiling().is_finite() {
                return slack::level(self.problem, &self.pressure.spread(), &self.u);
            }
            let sums = self.sums_with(|_, _| ());
            sums.reference_v + sums.pressure_v / sums.pressure
        };
        self.problem.datum().map_or_else(of_pressure, |gap| -gap)
    }

    /// One free update or guarded step, as [`Level::choose_mode`] has it.
    pub(crate) fn advance(&mut self, goal: f64, watch: &mut InnerStepCallback<'_>) -> Option<Status> {
        match self.mode {
            Mode::Free { .. } if self.method.has_inner_iterations() => self.settle(goal, watch),
            Mode::Free { .. } => {
                self.decision = Decision::WholeSet;
                self.update(watch)
            }
            Mode::Guarded { steps, .. } => {
                self.decision = Decision::Guarded;
                self.descend(steps.is_multiple_of(2), watch)
            }
        }
    }

    /// Decides how to go on from a state that is this far from the goals.
    pub(crate) fn choose_mode(&mut self, distance: f64, best: &Best<SparsePressure>) {
        self.mode = match self.mode {
            Mode::Free { mark, .. } if distance <= BETTER * mark => Mode::Free { mark: distance, stale: 0 },
            Mode::Free { mark, .. } if self.has_fewer => Mode::Free { mark, stale: 0 },
            Mode::Free { mark, stale } if stale < STALE => {
                self.slow_down();
                self.reduction = (TIGHTENING * self.reduction).max(TIGHTEST);
                Mode::Free { mark, stale: stale + 1 }
            }
            Mode::Free { .. } => {
                self.return_to(best);
                self.guarded_phases += 1;
                let stays = self.is_newton_guarded() && self.guarded_phases >= GUARDED_PHASES;
                Mode::Guarded { release: if stays { 0.0 } else { RELEASE * best.distance }, steps: 0 }
            }
            Mode::Guarded { release, .. } if distance <= release => {
                self.admit();
                Mode::Free { mark: distance, stale: 0 }
            }
            Mode::Guarded { release, steps } => Mode::Guarded { release, steps: steps + 1 },
        };
    }

    /// Whether guarded steps are projected Newton steps, which pay on the finest grid below a hardness.
    pub(crate) fn is_newton_guarded(&self) -> bool {
        self.is_finest && self.ceiling().is_finite()
    }

    fn return_to(&mut self, best: &Best<SparsePressure>) {
        if let Some(pressure) = &best.pressure {
            self.pressure.clone_from(pressure);
            self.refresh_from_pressure();
        }
    }

    /// Takes the displacement from a transform of the pressure.
    pub(crate) fn refresh(&mut self) {
        if self.displacement != Displacement::Exact {
            self.refresh_from_pressure();
        }
    }

    /// Takes the displacement from a transform of the pressure, which has changed.
    pub(crate) fn refresh_from_pressure(&mut self) {
        // memory that comes as zeros is first touched by all threads
        if self.u.is_empty() {
            self.u = vec![0.0; self.problem.nodes()];
        }
        displace(&self.pressure, &mut self.response, &mut self.u);
        self.displacement = Displacement::Exact;
    }

    /// The sums of this state.
    fn sums(&self) -> CertificateSums {
        let (u, h, width) = (&self.u, self.problem.height(), self.pressure.support.shape()[1]);
        self.sums_with(|row, sums| {
            let nodes = row * width..(row + 1) * width;
            u[nodes.clone()].iter().zip(&h[nodes]).for_each(|(&u, &h)| sums.add_displacement(u, h));
        })
    }

    /// The sums over the set, with its first node as the reference, to which `add` adds others of each row.
    fn sums_with(&self, add: impl Fn(usize, &mut CertificateSums) + Sync) -> CertificateSums {
        let (u, h, SparsePressure { support, values }) = (&self.u, self.problem.height(), &self.pressure);
        let [count, width] = support.shape();
        let none = CertificateSums::none(support.first().map_or(0.0, |node| u[node] - h[node]));
        let parts = chunks::rows(count, width, |row| {
            let (u, h) = (&u[row * width..], &h[row * width..]);
            let mut sums = none;
            for (run, nodes) in support.runs(row) {
                run.zip(nodes).for_each(|(x, node)| sums.add_pressure(values[node], u[x], h[x]));
            }
            add(row, &mut sums);
            sums
        });
        parts.into_iter().fold(none, CertificateSums::plus)
    }

    /// The whole-set update: corrects the free nodes of the set, exchanges nodes by the signs of pressure and gap, clips and scales.
    pub(crate) fn update(&mut self, watch: &mut InnerStepCallback<'_>) -> Option<Status> {
        self.has_fewer = false;
        self.leave_extremes();
        let ceiling = self.ceiling_on_set();
        let free = self.pressure.free(&ceiling);
        let free = free.as_ref();
        let gap = self.problem.datum();
        let (delta, status) = self.correction(free, watch)?;
        let values = &mut self.pressure.values;
        match free {
            None => {
                chunks::update(values, |range, p| p.iter_mut().zip(&delta[range]).for_each(|(p, delta)| *p += delta));
            }
            Some(_) => *values = corrected(values, &delta, &ceiling),
        }
        self.refresh_from_pressure();
        let lambda = gap.map_or_else(|| mean(&self.on_set(free, |v| v)), |gap| -gap);
        if self.exchange_corrected(lambda) {
            self.pressure.carry(self.problem);
            self.displacement = Displacement::Outdated;
        }
        status
    }

    /// The correction of the pressure on the `free` nodes of the set, or on all of it, and whether the run is to end; none on no
    /// nodes.
    pub(crate) fn correction(
        &mut self,
        free: Option<&Support>,
        watch: &mut InnerStepCallback<'_>,
    ) -> Option<(Vec<f64>, Option<Status>)> {
        let (ceiling, gap) = (self.ceiling_on_set(), self.problem.datum());
        let residual = self.on_set(free, |v| -(v + gap.unwrap_or(0.0)));
        if residual.is_empty() {
            return None;
        }
        let mut operator = self.take_operator();
        let before = self.transforms();
        let Self { response, pressure: SparsePressure { support, values }, .. } = self;
        let set = free.unwrap_or(support);
        let mut workspace = Workspace::new(set.nodes());
        let mut correction = Correction::new([set; 2], residual, gap.is_none(), operator.as_mut(), &mut workspace);
        let status = correction.solve(self.reduction, operator.as_mut(), &mut |correction, spent| {
            let signed = || corrected(values, &correction.delta, &ceiling);
            let (decision, transforms) = (correction.last, before + spent);
            watch(InnerStep { set: support, candidates: None, signed: &signed, decision, transforms }, response)
        });
        let [delta, _] = correction.finish(&mut workspace);
        self.operator = Some(operator);
        Some((delta, status))
    }

    /// Where nothing touches, or all that touches yields, lets nodes in. Where all nodes do at a mean gap, the load is too large, but
    /// no correction sees that, since a uniform pressure displaces nothing: lowers it until the first node leaves.
    fn leave_extremes(&mut self) {
        let ceiling = self.ceiling_on_set();
        let values = &mut self.pressure.values;
        let is_free = |(i, p): (usize, &f64)| *p < ceiling.at(i);
        let has_free = values.iter().enumerate().any(is_free);
        if !has_free {
            self.admit();
        } else if let Some(gap) = self.problem.datum()
            && !self.problem.compliance().has_uniform()
            && values.len() == self.problem.nodes()
            && values.iter().enumerate().all(is_free)
        {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            chunks::update(values, |_, p| p.iter_mut().for_each(|p| *p -= least));
            self.exchange(-gap, |_| true);
        }
    }

    /// `of(v)` on the set, or on `other` nodes.
    pub(crate) fn on_set(&self, other: Option<&Support>, of: impl Fn(f64) -> f64 + Sync) -> Vec<f64> {
        let (h, support) = (self.problem.height(), other.unwrap_or(&self.pressure.support));
        let mut values = support.of_field(&self.u);
        let width = support.shape()[1];
        chunks::each(&mut support.pieces(&mut values), width, |row, piece| {
            let nodes = support.runs(row).flat_map(|(run, _)| run);
            piece.iter_mut().zip(nodes).for_each(|(value, x)| *value = of(*value - h[row * width + x]));
        });
        values
    }

    /// The displacement alone: all else is freed before the fields of the contact are made.
    pub(crate) fn into_displacement(self) -> Vec<f64> {
        self.u
    }

    /// The response alone.
    pub(crate) fn into_response(self) -> Response {
        self.response
    }

    /// Whether the stored displacement is that of `pressure`.
    pub(crate) fn is_displaced(&self, pressure: Option<&SparsePressure>) -> bool {
        self.displacement == Displacement::Exact && pressure == Some(&self.pressure)
    }
}

/// Writes the displacement under a pressure.
pub(super) fn displace(pressure: &SparsePressure, response: &mut Response, u: &mut [f64]) {
    let SparsePressure { support, values } = pressure;
    let mut rows: Vec<_> = u.chunks_exact_mut(support.shape()[1]).collect();
    response.displace_by_rows(
        |row, cause| {
            cause.fill(0.0);
            support.scatter(row, values, 1.0, cause);
        },
        &mut rows,
        |_, effect, row| row.copy_from_slice(effect),
    );
}

//! Inner iterations: active-set updates on candidate nodes, without a product in double precision.

use super::correction::{Correction, mean};
use super::level::{Displacement, InnerStep, InnerStepCallback, Level};
use super::method::{InnerPace, UpdateMethod};
use super::operator::{SetOperator, Spectral};
use super::split::Split;
use super::support::{RowOfNodes, SparsePressure, Support};
use super::workspace::Workspace;
use crate::chunks;
use crate::contact::{Decision, Problem, Status};

/// A node is a candidate if it is at most `HALO` rows and columns away from the contact set, or if its gap is below `NEAR` times the
/// rms height.
const HALO: usize = 2;
const NEAR: f64 = 0.02;

/// Largest number of updates of an inner iteration, and of updates without a better state after which it ends.
const UPDATES: usize = 12;
const STALE: usize = 3;
/// A state is better when its certificate is this part of that of the last better one.
const BETTER: f64 = 0.9;

/// The part of the reduction of the residual after an update that was no better, the least one, and the largest one near the solution.
const TIGHTENING: f64 = 0.5;
const TIGHTEST: f64 = 1e-3;
const LOOSEST: f64 = 0.3;

impl Level<'_> {
    /// An inner iteration on a surface, from this state: updates of the set within the candidates, whose displacements differ from
    /// that of this state by what the operator of inner steps makes of the change of the pressure. It ends where the certificate has
    /// fallen to the part `goal`, as far as the candidates show it, or as far as the operator is accurate. The best pressure is
    /// taken. A set without an edge is left to [`Level::update`].
    pub(crate) fn settle(&mut self, goal: f64, watch: &mut InnerStepCallback<'_>) -> Option<Status> {
        let nodes = self.pressure.values.len();
        if nodes == 0 || nodes == self.problem.nodes() {
            self.refresh();
            self.decision = Decision::WholeSet;
            return self.update(watch);
        }
        let candidates = self.candidates(self.lambda());
        let mut operator = self.take_operator();
        self.decision = self.method.decision();
        let SparsePressure { support, values } = &self.pressure;
        let v = if self.displacement == Displacement::Interpolated {
            let (mut v, h) = (vec![0.0; candidates.nodes()], candidates.of_field(self.problem.height()));
            operator.comply(support, values, &candidates, &mut v);
            v.iter_mut().zip(h).for_each(|(v, h)| *v -= h);
            v
        } else {
            self.on_set(Some(&candidates), |v| v)
        };
        let mut pressure = vec![0.0; candidates.nodes()];
        support.transfer(values, &candidates, &mut pressure);
        self.displacement = Displacement::Outdated;
        if self.method != UpdateMethod::Split {
            // inner steps by transforms take as much memory as a displacement in double precision, and are not used at the same time
            self.response.release();
            self.u = Vec::new();
        }
        let mut inner = Inner::new(self.problem, self.pace, candidates, pressure, v);
        self.first_eta.get_or_insert(inner.certificate() / self.problem.rms_height());
        let spent = self.transforms();
        let status = inner.iterate(goal.max(operator.accuracy()), operator.as_mut(), &mut |step| {
            watch(InnerStep { transforms: spent + step.transforms, ..step }, &mut self.response)
        });
        self.pressure = inner.into_pressure();
        self.pressure.carry(self.problem);
        operator.release();
        self.operator = Some(operator);
        self.see_yielding();
        status
    }

    /// Goes on in the next more accurate way, after a free update that was no better.
    pub(crate) fn slow_down(&mut self) {
        if self.method.has_inner_iterations() && !self.method.slower().has_inner_iterations() {
            self.admit();
        }
        self.change_method(self.method.slower());
    }

    /// Lets whole-set updates take over from inner iterations if there are nodes that yield, which only they know.
    pub(crate) fn see_yielding(&mut self) {
        if self.method.has_inner_iterations() && self.pressure.reaches(self.ceiling()) {
            while self.method.has_inner_iterations() {
                self.change_method(self.method.slower());
            }
        }
    }

    fn change_method(&mut self, method: UpdateMethod) {
        if method != self.method {
            self.spent += self.operator.take().map_or(0.0, |operator| operator.transforms());
            self.method = method;
        }
    }

    /// The operator of inner steps.
    pub(crate) fn take_operator(&mut self) -> Box<dyn SetOperator> {
        self.operator.take().unwrap_or_else(|| match self.method {
            UpdateMethod::Split => match Split::new(self.problem, self.pressure.values.len()) {
                Some(split) => Box::new(split),
                None => {
                    self.method = UpdateMethod::Single;
                    Box::new(Spectral::<f32>::new(self.problem))
                }
            },
            UpdateMethod::Single | UpdateMethod::Exact => Box::new(Spectral::<f32>::new(self.problem)),
            UpdateMethod::Nested | UpdateMethod::Double => Box::new(Spectral::<f64>::new(self.problem)),
        })
    }

    /// Transforms on this grid so far, without those of an operator that is taken.
    pub(crate) fn transforms(&self) -> f64 {
        let of_operator = self.operator.as_ref().map_or(0.0, |operator| operator.transforms());
        self.spent + self.response.transforms() as f64 + of_operator
    }

    /// The nodes of a surface that may come into contact. The cell is taken as periodic, which at most adds candidates.
    fn candidates(&self, lambda: f64) -> Support {
        let (u, h, near) = (&self.u, self.problem.height(), lambda + NEAR * self.problem.rms_height());
        let set = &self.pressure.support;
        let [height, width] = set.shape();
        let choose = |row: usize, nodes: &mut RowOfNodes| {
            let mut is_near = vec![false; width];
            for other in (0..=2 * HALO).map(|shift| (row + HALO * height + shift - HALO) % height) {
                for (run, _) in set.runs(other) {
                    (run.start..run.end + 2 * HALO).for_each(|x| is_near[(x + HALO * width - HALO) % width] = true);
                }
            }
            let at = row * width;
            let (u, h) = (&u[at..at + width], &h[at..at + width]);
            (0..width).filter(|&x| is_near[x] || u[x] - h[x] < near).for_each(|x| nodes.push(x));
        };
        Support::choose([height, width], choose)
    }
}

/// The state of an inner iteration; vectors live on the candidates.
struct Inner<'a> {
    problem: &'a Problem,
    pace: InnerPace,
    candidates: Support,
    pressure: Vec<f64>,
    /// `v` of the pressure: that at the start, and since then what the operator of inner steps adds.
    v: Vec<f64>,
    lambda: f64,
    /// The best pressure so far.
    best: Vec<f64>,
    workspace: Workspace,
}

/// The watch of inner steps, with the transforms of the operator alone.
type Watch<'w> = dyn FnMut(InnerStep<'_>) -> Option<Status> + 'w;

impl<'a> Inner<'a> {
    fn new(problem: &'a Problem, pace: InnerPace, candidates: Support, pressure: Vec<f64>, v: Vec<f64>) -> Self {
        let (best, workspace) = (pressure.clone(), Workspace::new(pressure.len()));
        let mut inner = Self { problem, pace, candidates, pressure, v, lambda: f64::NAN, best, workspace };
        inner.place_datum();
        inner
    }

    /// Updates until the certificate has fallen to the part `goal` of that at the start.
    fn iterate(&mut self, goal: f64, operator: &mut dyn SetOperator, watch: &mut Watch<'_>) -> Option<Status> {
        let goal = goal * self.certificate();
        let (mut reduction, mut mark, mut stale) = (self.pace.reduction(), f64::INFINITY, 0);
        let (mut set, mut least) = (self.first_set(), f64::INFINITY);
        for update in 0.. {
            let certificate = self.certificate();
            if certificate < least {
                least = certificate;
                self.best.clone_from(&self.pressure);
            }
            if certificate <= BETTER * mark {
                (mark, stale) = (certificate, 0);
            } else {
                (reduction, stale) = ((TIGHTENING * reduction).max(TIGHTEST), stale + 1);
            }
            if certificate <= goal || certificate.is_nan() || update == UPDATES || stale == STALE {
                break;
            }
            let loose = if self.pace == InnerPace::Near { LOOSEST.min(goal / certificate) } else { 0.0 };
            let (next, status) = self.update(&set, [reduction.max(loose), goal], operator, watch);
            let Some(next) = next else { return status };
            set = next;
            if status.is_some() {
                return status;
            }
        }
        None
    }

    /// The nodes with pressure and those that penetrate deeply.
    fn first_set(&self) -> Support {
        let Self { pressure, v, lambda, .. } = self;
        let deep = self.pace.deep(self.certificate() / self.problem.rms_height());
        let deep = lambda - deep * (lambda - lowest(v)).max(0.0);
        self.candidates.filter(|i| pressure[i] > 0.0 || v[i] < deep)
    }

    /// One update, which reduces the residual and, if the set stays near the solution, goes on to the `goal` of the certificate. Returns the next set, unless there is no pressure left, and whether the run is to end.
    fn update(
        &mut self,
        set: &Support,
        [reduction, goal]: [f64; 2],
        operator: &mut dyn SetOperator,
        watch: &mut Watch<'_>,
    ) -> (Option<Support>, Option<Status>) {
        let (gap, is_near) = (self.problem.datum(), self.pace == InnerPace::Near);
        let Self { problem, candidates, pressure, v, lambda, workspace, .. } = self;
        let [mut residual, mut on_set] = [(); 2].map(|()| workspace.zeros(set.nodes()));
        candidates.transfer(v, set, &mut residual);
        chunks::update(&mut residual, |_, v| v.iter_mut().for_each(|v| *v = -(*v + gap.unwrap_or(0.0))));
        candidates.transfer(pressure, set, &mut on_set);
        let mut correction = Correction::new([set, candidates], residual, gap.is_none(), operator, workspace);
        let mut trial = is_near.then(|| InnerTrial::new([set, candidates], workspace));
        let mut is_done = |correction: &Correction<'_>| {
            let mut certificate = |trial: &mut InnerTrial<'_>| trial.certificate(problem, [&on_set, v], correction);
            correction.is_reduced(reduction) && trial.as_mut().and_then(&mut certificate).is_none_or(|it| it <= goal)
        };
        let status = correction.solve_until(&mut is_done, operator, &mut |correction, spent| {
            let sum = || on_set.iter().zip(&correction.delta).map(|(p, delta)| p + delta).collect();
            let candidates = Some(&*candidates);
            watch(InnerStep { set, candidates, signed: &sum, decision: correction.last, transforms: spent })
        });
        trial.into_iter().for_each(|trial| workspace.keep(trial.vectors));
        let [delta, moved] = correction.finish(workspace);
        add(&mut on_set, &delta);
        set.transfer(&on_set, candidates, pressure);
        add(v, &moved);
        *lambda = datum(gap, || {
            candidates.transfer(v, set, &mut on_set);
            mean(&on_set)
        });
        workspace.keep([delta, moved, on_set]);
        let next = candidates.filter(|i| pressure[i] > 0.0 || pressure[i] == 0.0 && v[i] < *lambda);
        self.clip(operator);
        (self.carry().then_some(next), status)
    }

    /// Lifts negative pressures to zero, and adds the displacement of that.
    fn clip(&mut self, operator: &mut dyn SetOperator) {
        let Self { candidates, pressure, v, workspace, .. } = self;
        let negative = candidates.filter(|i| pressure[i] < 0.0);
        if negative.nodes() == 0 {
            return;
        }
        let (mut lifted, mut moved) = (workspace.zeros(negative.nodes()), workspace.zeros(candidates.nodes()));
        candidates.transfer(pressure, &negative, &mut lifted);
        operator.comply(&negative, &lifted, candidates, &mut moved);
        chunks::update(v, |range, v| range.zip(v).for_each(|(i, v)| *v -= moved[i]));
        chunks::update(pressure, |_, p| p.iter_mut().for_each(|p| *p = p.max(0.0)));
        workspace.keep([lifted, moved]);
    }

    /// Scales pressure and displacement to the load, if that is given. Returns whether there is any pressure.
    fn carry(&mut self) -> bool {
        if let Some(mean_pressure) = self.problem.mean_pressure() {
            let load = chunks::sum(self.pressure.len(), |i| self.pressure[i]);
            if load <= 0.0 || load.is_nan() {
                return false;
            }
            let scale = mean_pressure * self.problem.nodes() as f64 / load;
            let Self { candidates, pressure, v, .. } = self;
            chunks::update(pressure, |_, p| p.iter_mut().for_each(|p| *p *= scale));
            let (h, [_, width]) = (self.problem.height(), candidates.shape());
            chunks::each(&mut candidates.pieces(v), width, |row, piece| {
                let h = candidates.runs(row).flat_map(|(run, _)| &h[row * width..][run]);
                piece.iter_mut().zip(h).for_each(|(v, h)| *v = scale * (*v + h) - h);
            });
        }
        self.place_datum();
        true
    }

    /// Takes `lambda` from the state.
    fn place_datum(&mut self) {
        self.lambda = datum(self.problem.datum(), || weighted_mean(&self.pressure, &self.v));
    }

    /// The certificate of this state.
    fn certificate(&self) -> f64 {
        certificate(self.problem, &self.pressure, &self.v)
    }

    /// The best pressure.
    fn into_pressure(self) -> SparsePressure {
        let Self { candidates, best, .. } = self;
        let support = candidates.filter(|i| best[i] > 0.0);
        let mut values = vec![0.0; support.nodes()];
        candidates.transfer(&best, &support, &mut values);
        SparsePressure { support, values }
    }
}

/// A look at the state that an update would lead to, for whether the set stays; vectors live on the set, and twice on the candidates.
struct InnerTrial<'s> {
    set: &'s Support,
    candidates: &'s Support,
    vectors: [Vec<f64>; 3],
}

impl<'s> InnerTrial<'s> {
    fn new([set, candidates]: [&'s Support; 2], workspace: &mut Workspace) -> Self {
        let vectors = [set, candidates, candidates].map(|nodes| workspace.zeros(nodes.nodes()));
        Self { set, candidates, vectors }
    }

    /// The certificate after a correction of the pressure on the set and of `v`, if no node would leave or enter.
    fn certificate(&mut self, problem: &Problem, [on_set, v]: [&[f64]; 2], correction: &Correction<'_>) -> Option<f64> {
        let Self { set, candidates, vectors: [of_set, pressure, moved] } = self;
        let Correction { delta, moved: change, .. } = correction;
        chunks::update(of_set, |range, p| range.zip(p).for_each(|(i, p)| *p = on_set[i] + delta[i]));
        set.transfer(of_set, candidates, pressure);
        chunks::update(moved, |range, to| range.zip(to).for_each(|(i, to)| *to = v[i] + change[i]));
        let lambda = datum(problem.datum(), || {
            candidates.transfer(moved, set, of_set);
            mean(of_set)
        });
        let changes = |i: usize| pressure[i] < 0.0 || pressure[i] == 0.0 && moved[i] < lambda;
        let stays = chunks::visit(moved.len(), |range| !range.into_iter().any(changes)).into_iter().all(|stays| stays);
        stays.then(|| certificate(problem, pressure, moved))
    }
}

/// `lambda`: minus the mean gap if that is given, or else a mean.
fn datum(gap: Option<f64>, mean: impl FnOnce() -> f64) -> f64 {
    gap.map_or_else(mean, |gap| -gap)
}

/// The depth below the datum, as in the certificate, as far as the candidates know it, a length.
fn certificate(problem: &Problem, pressure: &[f64], v: &[f64]) -> f64 {
    let mean = weighted_mean(pressure, v);
    (mean - lowest(v)).max(0.0) + (mean - datum(problem.datum(), || mean)).abs()
}

/// The mean of `v` weighted by the pressure.
fn weighted_mean(p: &[f64], v: &[f64]) -> f64 {
    let load = chunks::sum(p.len(), |i| p[i]);
    chunks::sum(p.len(), |i| p[i] / load * v[i])
}

/// The least `v`.
fn lowest(v: &[f64]) -> f64 {
    let parts = chunks::visit(v.len(), |range| v[range].iter().copied().fold(f64::INFINITY, f64::min));
    parts.into_iter().fold(f64::INFINITY, f64::min)
}

fn add(to: &mut [f64], values: &[f64]) {
    chunks::update(to, |range, to| range.zip(to).for_each(|(i, to)| *to += values[i]));
}

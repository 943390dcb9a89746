//! One load step as one convex minimum.

use super::accelerated::Accelerated;
use super::flow::{FlowLaw, FlowPlace, PlaceFlow};
use super::pressing::Pressing;
use super::{PlasticCertificate, PlasticState};
use crate::chunks::{self, spread};
use crate::clock::Instant;
use crate::contact::{Contact, Observer, Problem, Solver, Status, Stop, Work};
use crate::elastic::DepthResponse;
use crate::error::{PlasticError, SolveError};
use crate::surface::Field;
use ndarray::{Array3, ArrayView1, ArrayView2, ArrayViewMut2, Axis};
use std::ops::ControlFlow;
use std::sync::Arc;

/// The part of the elastic energy that is added to the dissipated energy by which the gap is divided. Else a step that hardly flows would need a gap below
/// rounding.
const ELASTIC_SHARE: f64 = 1e-3;
/// The tolerance `eta` of the first contact of a step.
const FIRST_CONTACT: f64 = 1e-11;
/// The least tolerance of a contact, over the rounding that its certificate states: solvers do not come much closer.
const LEAST_CONTACT: f64 = 2.0;
/// A step is done, whatever its goal, where its gap is below this many times the stated rounding of the contact, plus that of its waves: a step that is elastic
/// and close to flat has a goal of 1e-8 of so little energy that no pressure in doubles reaches it.
const LEAST_GAP_OVER_ROUNDING: f64 = 4.0;
/// A step has stalled after this many iterations in which its gap has not fallen to [`STALLED_PROGRESS`] times the least one so far.
const STALLED_ITERATIONS: usize = 300;
const STALLED_PROGRESS: f64 = 0.9;
/// The largest tolerance of a contact.
const LOOSEST_CONTACT: f64 = 1e-3;
/// The parts of the goal, and of the last gap, that the gap of a contact may have.
const OF_GOAL: f64 = 0.1;
const OF_LAST_GAP: f64 = 0.02;
/// Rounding of energies that cancel, relative to the largest of them.
const ROUNDING: f64 = 1e-13;

/// A load step, with its increment of the plastic strain.
///
/// The step of size `1/(2 G)` along the gradient of the energy, followed by the proximal step of the dissipation, is radial return at a fixed total strain. Since
/// the contact is solved anew for each increment, the gradient is that of a convex function whose second derivative is between 0 and `2 G`: so the iteration
/// lowers the energy, without a relaxation to choose. (With the pressure frozen meanwhile it may diverge.) Anderson's method speeds it up; where
/// it raises the energy, the iteration goes back, and on by a plain step.
pub(super) struct LoadStep<'s, 'o> {
    pub law: FlowLaw,
    pub before: &'s PlasticState,
    /// The problem under the load; none without a load.
    pub problem: Option<Problem>,
    pub response: &'s mut DepthResponse,
    pub solver: &'s dyn Solver,
    pub observer: &'o mut dyn Observer,
    /// Gets each iterate but the last one.
    pub each: &'o mut dyn FnMut(&FlowIterate),
    pub tolerance: f64,
    pub most_iterations: usize,
}

/// An increment, and what belongs to it.
#[derive(Clone)]
pub(super) struct FlowIterate {
    pub increment: Array3<f64>,
    pub stress: Array3<f64>,
    pub residual: Field,
    /// The contact on the heights less the residual displacement; none without a load.
    pub contact: Option<Contact>,
    pub certificate: PlasticCertificate,
    pub elastic: f64,
    /// The work against the stress that kinematic hardening has left.
    pub back_work: f64,
    pub iterations: usize,
    /// How the step ended; the iteration cap before it did.
    pub status: Status,
    /// The contact before anything flows in the step.
    pub unflowed: Option<Pressing>,
    /// Work of all contacts of the step, with the seconds of the flow.
    pub work: Work,
    /// A lower bound of `Phi`, and the size of its terms.
    energy: [f64; 2],
}

/// What the flow of one layer is made of, all of one node after the other.
struct LayerFlow<'a> {
    strain: ArrayView2<'a, f64>,
    accumulated: ArrayView1<'a, f64>,
    increment: ArrayView2<'a, f64>,
    stress: ArrayView2<'a, f64>,
    next: ArrayViewMut2<'a, f64>,
    flows: &'a mut [bool],
}

/// The flow in all layers: sums per area, and the places that begin to flow.
#[derive(Default)]
struct FlowSums {
    flow: PlaceFlow,
    begun: Vec<[usize; 2]>,
}

impl LoadStep<'_, '_> {
    /// Iterates until the certificate meets the tolerance, or at most as often as allowed.
    pub(crate) fn run(mut self) -> Result<FlowIterate, PlasticError> {
        let mut now = FlowIterate::first(self.before);
        let mut next = now.increment.clone();
        let mut flows = vec![false; self.before.accumulated.len()];
        let mut accelerated = Accelerated::new(&self.before.layers);
        let (mut best, mut progress) = (f64::INFINITY, GapProgress::new());
        loop {
            // the contact of an iteration may be solved without a step, and then nobody else asks
            self.ask()?;
            let begun = self.evaluate(&mut now, &mut next, &mut flows)?;
            if now.iterations == 0 {
                now.unflowed = now.contact.as_ref().map(|contact| Pressing::new(contact, &now.residual));
            }
            if now.status == Status::Converged || now.iterations >= self.most_iterations {
                return Ok(now);
            }
            if progress.has_stalled(&now) {
                now.status = Status::Stalled;
                return Ok(now);
            }
            (self.each)(&now);
            accelerated.add(begun, next.dim().1);
            let [energy, size] = now.energy;
            if accelerated.is_combined() && energy > best {
                accelerated.go_back(&mut now.increment);
            } else {
                best = energy + now.certificate.contact_gap + ROUNDING * size;
                accelerated.advance(&mut now.increment, &next);
            }
            now.iterations += 1;
        }
    }

    /// Ends the step if the observer wishes that.
    fn ask(&mut self) -> Result<(), PlasticError> {
        match self.observer.ask() {
            Ok(ControlFlow::Continue(())) => Ok(()),
            Ok(ControlFlow::Break(())) => Err(PlasticError::Stopped),
            Err(failure) => Err(SolveError::Observer(Arc::new(failure)).into()),
        }
    }

    /// Finds contact, stress, certificate and the plain successor of an increment, and the places that begin to flow.
    fn evaluate(
        &mut self,
        now: &mut FlowIterate,
        next: &mut Array3<f64>,
        flows: &mut [bool],
    ) -> Result<Vec<[usize; 2]>, PlasticError> {
        let (begun, before, increment) = (Instant::now(), self.before, &now.increment);
        self.response.load(strained_layers(before, increment), |layer, component, field| {
            let rows = [&before.strain, increment].map(|field| values(field, layer, component));
            field.iter_mut().enumerate().for_each(|(i, value)| *value = rows[0][i] + rows[1][i]);
        });
        self.response.displace(now.residual.as_slice_mut().expect("standard layout"));
        let pressing = Instant::now();
        self.press(now)?;
        let pressed = pressing.elapsed();
        let pressure = now.contact.as_ref().map(|it| it.pressure.as_slice().expect("standard layout"));
        self.response.stress(pressure, &mut now.stress);
        let sums = match next.dim().1 {
            4 => self.flow::<4>(now, next, flows),
            _ => self.flow::<6>(now, next, flows),
        };
        self.certify(now, &sums.flow);
        // the contact has a clock of its own, without what watches it
        now.work.seconds += begun.elapsed().saturating_sub(pressed).as_secs_f64();
        Ok(sums.begun)
    }

    /// Solves the contact on the heights less the residual displacement, from the last pressure.
    fn press(&mut self, now: &mut FlowIterate) -> Result<(), PlasticError> {
        let Some(problem) = &self.problem else { return Ok(()) };
        let pressed = problem.with_heights(problem.surface().height() - &now.residual)?;
        let start = now.contact.as_ref().or(Some(&self.before.contact)).map(|it| &it.pressure);
        let start = start.filter(|pressure| pressure.iter().any(|&p| p > 0.0));
        let stop = Stop::default().at(self.contact_tolerance(problem, now));
        let contact = self.solver.solve_from(start, &pressed, &stop, self.observer)?;
        match (contact.status, &contact.failure) {
            (_, Some(failure)) => return Err(SolveError::Observer(failure.clone()).into()),
            (Status::StoppedByObserver, None) => return Err(PlasticError::Stopped),
            _ => (),
        }
        now.work += contact.work;
        now.contact = Some(contact);
        Ok(())
    }

    /// The tolerance of the next contact: as loose as the last gap allows, and as the goal allows in the end. The error of a stress makes a gap that is larger
    /// than its energy by the contrast of elastic modulus and hardening.
    fn contact_tolerance(&self, problem: &Problem, now: &FlowIterate) -> f64 {
        let Some(contact) = &now.contact else {
            return FIRST_CONTACT.max(rounding_of_waves(problem, problem.expected_mean_pressure()));
        };
        let certificate = &now.certificate;
        let goal = self.tolerance * (certificate.dissipated + ELASTIC_SHARE * now.elastic);
        let gap = (OF_GOAL * goal).max(OF_LAST_GAP * certificate.flow_gap) * self.law.contrast();
        let waves = rounding_of_waves(problem, rms(&contact.pressure));
        let least = (LEAST_CONTACT * contact.certificate.rounding + waves).min(LOOSEST_CONTACT);
        (gap / (contact.mean_pressure() * problem.rms_height())).clamp(least, LOOSEST_CONTACT)
    }

    /// Writes the plain successor of an increment and sums up what the law says of it.
    fn flow<const N: usize>(&self, now: &FlowIterate, next: &mut Array3<f64>, flows: &mut [bool]) -> FlowSums {
        let (before, law, nodes) = (self.before, self.law, now.increment.dim().2);
        let strained = before.strain.outer_iter().zip(before.accumulated.outer_iter());
        let given = now.increment.outer_iter().zip(now.stress.outer_iter());
        let made = next.outer_iter_mut().zip(flows.chunks_mut(nodes));
        let layers =
            strained.zip(given).zip(made).map(|(((strain, accumulated), (increment, stress)), (next, flows))| {
                LayerFlow { strain, accumulated, increment, stress, next, flows }
            });
        let sums = spread(layers.collect::<Vec<_>>().into_iter(), |layer| layer.flow::<N>(law));
        let mut all = FlowSums::default();
        for (layer, (flow, begun)) in sums.into_iter().enumerate() {
            let part = before.layers.thickness(layer) / nodes as f64;
            let add = |sum: &mut f64, value: f64| *sum += part * value;
            add(&mut all.flow.psi, flow.psi);
            add(&mut all.flow.gap, flow.gap);
            add(&mut all.flow.back_work, flow.back_work);
            add(&mut all.flow.product, flow.product);
            all.begun.extend(begun.into_iter().map(|node| [layer, node]));
        }
        all
    }

    /// Certificate and energies of an increment.
    fn certify(&self, now: &mut FlowIterate, flow: &PlaceFlow) {
        let residual = now.residual.as_slice().expect("standard layout");
        let mean = |a: &[f64], b: &[f64]| chunks::sum(a.len(), |i| a[i] * b[i]) / a.len() as f64;
        let (mut contact_gap, mut floor, mut of_contact) = (0.0, 0.0, [0.0; 3]);
        if let (Some(contact), Some(problem)) = (&now.contact, &self.problem) {
            let [p, u] = [&contact.pressure, &contact.displacement].map(|it| it.as_slice().expect("standard layout"));
            let energy = contact.mean_pressure() * problem.rms_height();
            contact_gap = contact.certificate.eta * energy;
            let waves = rounding_of_waves(problem, rms(&contact.pressure));
            floor = (LEAST_GAP_OVER_ROUNDING * contact.certificate.rounding + waves) * energy;
            of_contact = [mean(p, problem.height()), mean(p, residual), mean(p, u)];
        }
        let [heights, sunk, pressed] = of_contact;
        now.elastic = 0.5 * (pressed + sunk - flow.product);
        let terms = [-0.5 * flow.product, heights, -0.5 * sunk, -0.5 * pressed, flow.psi + flow.back_work];
        now.energy = [terms.iter().sum(), terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()))];
        now.back_work = flow.back_work;
        let scale = flow.psi + ELASTIC_SHARE * now.elastic;
        let gap = contact_gap + flow.gap;
        now.certificate = PlasticCertificate {
            contact_gap,
            flow_gap: flow.gap,
            relative_gap: if gap > 0.0 { gap / scale } else { 0.0 },
            dissipated: flow.psi,
        };
        let is_done = now.certificate.relative_gap <= self.tolerance || gap <= floor;
        now.status = if is_done { Status::Converged } else { Status::IterationCap };
    }
}

/// How the gap of a step falls.
struct GapProgress {
    least: f64,
    /// Iterations since it fell.
    waited: usize,
}

impl GapProgress {
    fn new() -> Self {
        Self { least: f64::INFINITY, waited: 0 }
    }

    /// Whether a step stalls at an iterate: its gap does not fall any more, or it is that of a contact alone, whose solver makes no progress either.
    fn has_stalled(&mut self, now: &FlowIterate) -> bool {
        let gap = now.certificate.gap();
        if gap <= STALLED_PROGRESS * self.least {
            (self.least, self.waited) = (gap, 0);
        } else {
            self.waited += 1;
        }
        let is_contact_stuck = now.contact.as_ref().is_some_and(|contact| contact.status == Status::Stalled);
        self.waited >= STALLED_ITERATIONS || (is_contact_stuck && now.certificate.flow_gap == 0.0)
    }
}

impl LayerFlow<'_> {
    /// The plain successor of the increment in this layer, the sums over its nodes, and the nodes that begin to flow.
    fn flow<const N: usize>(mut self, law: FlowLaw) -> (PlaceFlow, Vec<usize>) {
        let rows = |field: &ArrayView2<'_, f64>, node: usize| std::array::from_fn(|c| field[[c, node]]);
        let (mut sum, mut begun) = (PlaceFlow::default(), Vec::new());
        for node in 0..self.accumulated.len() {
            let place = FlowPlace::<N> {
                strain: rows(&self.strain, node),
                accumulated: self.accumulated[node],
                increment: rows(&self.increment, node),
                stress: rows(&self.stress, node),
            };
            let (next, flow) = law.returned(&place);
            (0..N).for_each(|c| self.next[[c, node]] = next[c]);
            sum.psi += flow.psi;
            sum.gap += flow.gap;
            sum.back_work += flow.back_work;
            sum.product += flow.product;
            if !self.flows[node] && next.iter().any(|&value| value != 0.0) {
                self.flows[node] = true;
                begun.push(node);
            }
        }
        (sum, begun)
    }
}

impl FlowIterate {
    /// No increment: all else is still to be found.
    fn first(before: &PlasticState) -> Self {
        Self {
            increment: Array3::zeros(before.strain.dim()),
            stress: Array3::zeros(before.strain.dim()),
            residual: Field::zeros(before.residual.dim()),
            contact: None,
            certificate: PlasticCertificate::default(),
            elastic: 0.0,
            back_work: 0.0,
            iterations: 0,
            status: Status::IterationCap,
            unflowed: None,
            work: Work::default(),
            energy: [0.0; 2],
        }
    }
}

/// The rounding of the displacement by a pressure of a root mean square, over the rms height: that of its largest wave, a uniform pressure included, in the
/// softest one. It counts where the rms height is far below what the pressure would displace.
fn rounding_of_waves(problem: &Problem, pressure: f64) -> f64 {
    let [softest, _] = problem.compliance().stiffness_range();
    f64::EPSILON * pressure / (softest * problem.rms_height())
}

fn rms(field: &Field) -> f64 {
    (field.iter().map(|value| value * value).sum::<f64>() / field.len() as f64).sqrt()
}

/// The number of layers from the surface on in which there is any plastic strain.
fn strained_layers(before: &PlasticState, increment: &Array3<f64>) -> usize {
    let is_strained = |layer: &usize| {
        [&before.strain, increment].into_iter().any(|it| it.index_axis(Axis(0), *layer).iter().any(|&e| e != 0.0))
    };
    (0..increment.dim().0).rev().find(is_strained).map_or(0, |layer| layer + 1)
}

/// The values of a component in a layer.
fn values(field: &Array3<f64>, layer: usize, component: usize) -> &[f64] {
    let (_, components, nodes) = field.dim();
    let all = field.as_slice().expect("fields are made in standard layout");
    &all[(layer * components + component) * nodes..][..nodes]
}

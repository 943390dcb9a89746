//! The search for one state of a contact with adhesion.

use super::attraction::Attraction;
use super::claim::claim;
use super::control::AdhesiveControl;
use super::convex::{ConvexEnd, ConvexState, ConvexSteps};
use super::curvature::{LeastCurvature, least_curvature, leave_saddle};
use super::frames::MotionFrames;
use super::gap_energy::{GapEnergy, GapState, mean};
use super::method::AdhesiveMethod;
use super::motion::DampedMotion;
use super::newton::{self, GapEnd};
use super::search_limits::SearchLimits;
use super::start::{first_state, moved};
use super::state::{AdhesiveMotion, AdhesiveOutcome, AdhesiveState};
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{
    Certificate, Contact, Feels, Load, Multilevel, Observer, Problem, Quantity, ResultClaim, Solver, StateValues,
    Status, Step, Stop, Work,
};
use crate::error::AdhesionError;
use crate::surface::Field;
use std::ops::ControlFlow;

/// Newton steps for one search, and convex steps where they fail.
const NEWTON_STEPS: usize = 200;
const CONVEX_STEPS: usize = 12;

/// Convex steps where there is no other method.
const ALL_CONVEX_STEPS: usize = 400;

/// The goal of a residual of the safe method, which converges linearly, over that of the fast one.
const SLOWER: f64 = 100.0;

/// Searches by Newton steps, with convex steps or a step off a saddle between them.
const SEARCHES: usize = 12;

/// A search for one state.
pub(super) struct StateSearch<'a> {
    problem: &'a Problem,
    attraction: &'a Attraction,
    control: AdhesiveControl,
    stop: Stop,
    work: Work,
    start: Instant,
    tests_stability: bool,
}

/// Numbers of a state that its fields do not have.
struct SearchNumbers {
    datum: f64,
    energy: f64,
    transforms: u64,
}

/// The numbers of a state that a search has found, without its fields.
struct FoundState {
    method: &'static str,
    residual: f64,
    least: Option<LeastCurvature>,
}

impl<'a> StateSearch<'a> {
    pub(crate) fn new(problem: &'a Problem, attraction: &'a Attraction, control: AdhesiveControl, stop: Stop) -> Self {
        let (work, start) = (Work::default(), Instant::now());
        Self { problem, attraction, control, stop, work, start, tests_stability: true }
    }

    /// The search for a state whose stability is not tested.
    pub(crate) fn without_stability(self) -> Self {
        Self { tests_stability: false, ..self }
    }

    /// The state that is found from the last one, or, without one, from the contact without adhesion.
    pub(crate) fn run(
        mut self,
        from: Option<&AdhesiveState>,
        method: AdhesiveMethod,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let is_periodic = self.problem.surface().grid().is_periodic();
        match method {
            AdhesiveMethod::Gfmd => self.motion(from, observer).map(|motion| motion.outcome),
            AdhesiveMethod::Fast if is_periodic => {
                let gap = self.first_gap(from, observer)?;
                self.fast(gap, observer)
            }
            AdhesiveMethod::Fast | AdhesiveMethod::Safe => {
                let gap = self.first_gap(from, observer)?;
                self.safe(gap, from, observer)
            }
        }
    }

    /// The gap that a search begins with: that of the last state, or, without one, of the contact without adhesion.
    fn first_gap(
        &mut self,
        from: Option<&AdhesiveState>,
        observer: &mut dyn Observer,
    ) -> Result<Vec<f64>, AdhesionError> {
        match from {
            Some(state) => Ok(moved(self.problem, state, self.control)),
            None => self.wall(observer),
        }
    }

    /// A damped motion until the surface is at rest in a state that is no saddle, with its frames.
    pub(crate) fn motion(
        mut self,
        from: Option<&AdhesiveState>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveMotion, AdhesionError> {
        if !self.problem.surface().grid().is_periodic() {
            return Err(AdhesionError::FreeMotion);
        }
        let gap = self.first_gap(from, observer)?;
        let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
        let mut state = first_state(&mut energy, gap);
        let mut frames = MotionFrames::new(self.attraction.range(), &state);
        for _ in 0..SEARCHES {
            let mut watch = |energy: &GapEnergy<'_>, state: &GapState, step: usize| {
                if frames.is_due(state) {
                    frames.keep(state, self.frame(energy, state, step));
                }
                let work = self.worked(step, energy.transforms());
                goes_on(self.problem, self.control, state, work, observer)
            };
            let limits = SearchLimits { tolerance: self.tolerance(), steps: self.left() };
            let (end, taken) = DampedMotion::new(&energy).run(&mut energy, &mut state, limits, &mut watch);
            self.work.iterations += taken;
            let outcome = match end {
                GapEnd::Stopped => return Err(AdhesionError::Stopped),
                GapEnd::Failed => break,
                GapEnd::Separated => Some(self.separated(energy.transforms())),
                GapEnd::Found => self.settled(&mut energy, &mut state, "gfmd", observer)?,
            };
            if let Some(outcome) = outcome {
                return Ok(AdhesiveMotion { frames: frames.into_vec(), outcome });
            }
        }
        let outcome = self.missed(&mut energy, &state, "gfmd", observer)?;
        Ok(AdhesiveMotion { frames: frames.into_vec(), outcome })
    }

    /// A frame of a motion.
    fn frame(&self, energy: &GapEnergy<'_>, state: &GapState, step: usize) -> AdhesiveState {
        let residual = state.violation() / self.attraction.strength();
        let found = self.state(energy, state, FoundState { method: "gfmd", residual, least: None });
        let work = self.worked(step, energy.transforms());
        let mut frame = AdhesiveState { claim: ResultClaim::Moving, steps: work.iterations, work, ..found };
        frame.contact.status = Status::Converged;
        frame
    }

    /// The gap of the contact without adhesion; where nothing presses the surfaces, the one at which they first touch, or that of two
    /// rigid surfaces.
    fn wall(&mut self, observer: &mut dyn Observer) -> Result<Vec<f64>, AdhesionError> {
        let (problem, highest) = (self.problem, self.problem.highest());
        let (load, datum) = match self.control {
            AdhesiveControl::MeanPressure(pressure) => {
                ((pressure > 0.0).then_some(Load::MeanPressure(pressure)), highest)
            }
            AdhesiveControl::MeanGap(gap) => ((gap < highest).then_some(Load::MeanGap(gap)), gap),
            AdhesiveControl::Approach(approach) => {
                ((approach > 0.0).then_some(Load::Approach(approach)), highest - approach)
            }
        };
        let Some(load) = load else { return Ok(problem.height().iter().map(|h| datum - h).collect()) };
        let posed = problem.clone().with_load(load)?;
        // one iteration is left for a state, also where the contact takes all others
        let stop = self.stop.within(self.stop.max_iterations() - 1);
        let contact = Multilevel.solve(&posed, &stop, observer)?;
        self.work.transforms += contact.work.transforms;
        self.work.iterations += contact.work.iterations;
        if contact.status == Status::StoppedByObserver {
            return Err(AdhesionError::Stopped);
        }
        Ok(contact.gap.iter().map(|g| g.max(0.0)).collect())
    }

    /// Newton steps, with convex steps where they fail and a step off each saddle.
    fn fast(mut self, gap: Vec<f64>, observer: &mut dyn Observer) -> Result<AdhesiveOutcome, AdhesionError> {
        let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
        let mut state = first_state(&mut energy, gap);
        let mut by_convex: Option<ConvexState> = None;
        for _ in 0..SEARCHES {
            let mut watch = |state: &GapState, step: usize, transforms: u64| {
                goes_on(self.problem, self.control, state, self.worked(step, transforms), observer)
            };
            let limits = SearchLimits { tolerance: self.tolerance(), steps: NEWTON_STEPS.min(self.left()) };
            let (end, taken) = newton::lower(&mut energy, &mut state, limits, &mut watch);
            self.work.iterations += taken;
            match end {
                GapEnd::Stopped => return Err(AdhesionError::Stopped),
                GapEnd::Separated => return Ok(self.separated(energy.transforms())),
                GapEnd::Found => {
                    by_convex = None;
                    if let Some(outcome) = self.settled(&mut energy, &mut state, "newton", observer)? {
                        return Ok(outcome);
                    }
                }
                GapEnd::Failed if self.left() == 0 => break,
                GapEnd::Failed => {
                    if let Some(found) = by_convex {
                        return Ok(AdhesiveOutcome::State(self.safe_state(found, observer)?));
                    }
                    let sigma = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
                    let limits = SearchLimits { tolerance: self.tolerance(), steps: CONVEX_STEPS };
                    let (found, end) = self.convex_steps(sigma, None, limits, observer)?;
                    match (found, end) {
                        (_, ConvexEnd::Separated) => return Ok(self.separated(energy.transforms())),
                        (_, ConvexEnd::Stopped) => return Err(AdhesionError::Stopped),
                        (Some(found), end) => {
                            let mut gap = found.gap.clone();
                            energy.carry(&mut gap, |i| found.pressure[i] == 0.0);
                            state = energy.state(gap);
                            by_convex = matches!(end, ConvexEnd::Found).then_some(found);
                        }
                        (None, _) => break,
                    }
                }
            }
        }
        self.missed(&mut energy, &state, "newton", observer)
    }

    /// Convex steps from a traction, whose work counts.
    fn convex_steps(
        &mut self,
        sigma: Vec<f64>,
        pressed: Option<Field>,
        limits: SearchLimits,
        observer: &mut dyn Observer,
    ) -> Result<(Option<ConvexState>, ConvexEnd), AdhesionError> {
        let stop = self.stop.within(self.left());
        let mut convex = ConvexSteps::new(self.problem, self.attraction, self.control, &Multilevel, stop);
        let found = convex.lower(sigma, pressed, limits, observer)?;
        self.work.transforms += convex.transforms;
        self.work.iterations += convex.iterations;
        Ok(found)
    }

    /// What a state in equilibrium is claimed as; none where it was a saddle, which it has left then.
    fn settled(
        &self,
        energy: &mut GapEnergy<'_>,
        state: &mut GapState,
        method: &'static str,
        observer: &mut dyn Observer,
    ) -> Result<Option<AdhesiveOutcome>, AdhesionError> {
        let least = if self.tests_stability { least_curvature(energy, state, observer)? } else { None };
        Ok(match &least {
            Some(least) if least.is_saddle(energy.softest()) => {
                leave_saddle(energy, state, least);
                None
            }
            _ => {
                let residual = energy.residual(state, self.tolerance());
                Some(AdhesiveOutcome::State(self.state(energy, state, FoundState { method, residual, least })))
            }
        })
    }

    /// The last state of a search that found none.
    fn missed(
        &self,
        energy: &mut GapEnergy<'_>,
        state: &GapState,
        method: &'static str,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let residual = energy.residual(state, self.tolerance());
        // a state from which a search goes on may be in equilibrium, such as a saddle
        let least = if residual <= self.tolerance() { least_curvature(energy, state, observer)? } else { None };
        Ok(AdhesiveOutcome::State(self.state(energy, state, FoundState { method, residual, least })))
    }

    /// Convex steps only.
    fn safe(
        mut self,
        gap: Vec<f64>,
        from: Option<&AdhesiveState>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let sigma = gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
        let pressed = from.map(|state| state.contact.pressure.clone()).filter(|it| it.iter().any(|p| *p > 0.0));
        let limits = SearchLimits { tolerance: self.safe_tolerance(), steps: ALL_CONVEX_STEPS };
        match self.convex_steps(sigma, pressed, limits, observer)? {
            (_, ConvexEnd::Separated) => Ok(self.separated(0)),
            (_, ConvexEnd::Stopped) => Err(AdhesionError::Stopped),
            (Some(found), _) => Ok(AdhesiveOutcome::State(self.safe_state(found, observer)?)),
            (None, _) => Err(AdhesionError::NotFound { steps: self.work.iterations, residual: f64::INFINITY }),
        }
    }

    /// The goal of the residual.
    fn tolerance(&self) -> f64 {
        self.stop.tolerance().clamp(1e-11, 0.1)
    }

    /// The goal of the residual of the safe method.
    fn safe_tolerance(&self) -> f64 {
        SLOWER * self.tolerance()
    }

    /// Iterations that are left for the state.
    fn left(&self) -> usize {
        self.stop.max_iterations().saturating_sub(self.work.iterations)
    }

    fn separated(&self, transforms: u64) -> AdhesiveOutcome {
        AdhesiveOutcome::Separated { work: self.worked(0, transforms) }
    }

    /// The work so far, with further iterations and transforms.
    fn worked(&self, iterations: usize, transforms: u64) -> Work {
        Work {
            iterations: self.work.iterations + iterations,
            transforms: self.work.transforms + transforms,
            seconds: self.start.elapsed().as_secs_f64(),
        }
    }

    /// The state of a safe search. On a periodic grid its stability is computed as well.
    fn safe_state(self, found: ConvexState, observer: &mut dyn Observer) -> Result<AdhesiveState, AdhesionError> {
        let n = found.gap.len();
        let mut least = None;
        let mut transforms = 0;
        let residual = found.change.max(found.missed);
        if self.problem.surface().grid().is_periodic() && residual <= self.safe_tolerance() {
            let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
            let mut gap = found.gap.clone();
            energy.carry(&mut gap, |i| found.pressure[i] == 0.0);
            let mut state = energy.state(gap);
            // nodes touch where they press, whatever rounding says
            state.gradient.iter_mut().zip(&found.pressure).filter(|(_, p)| **p > 0.0).for_each(|(r, p)| *r = *p);
            least = least_curvature(&mut energy, &state, observer)?;
            transforms = energy.transforms();
        }
        let elastic = |i: usize| 0.5 * (found.pressure[i] - found.traction[i]) * found.displacement[i];
        let energy = |i: usize| elastic(i) + self.attraction.energy(found.gap[i]);
        let numbers = SearchNumbers { datum: found.datum, energy: chunks::sum(n, energy) / n as f64, transforms };
        let traction = found.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
        let fields = [found.pressure, found.displacement, found.gap];
        Ok(self.assemble(fields, traction, numbers, FoundState { method: "safe", residual, least }))
    }

    /// The state of a gap.
    fn state(&self, energy: &GapEnergy<'_>, state: &GapState, found: FoundState) -> AdhesiveState {
        let [elastic, sticking] = energy.parts(state);
        let traction: Vec<f64> = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
        let datum = datum(self.problem, self.control, &state.gap);
        let numbers = SearchNumbers { datum, energy: elastic + sticking, transforms: energy.transforms() };
        self.assemble(contact_fields(self.problem, state, datum), traction, numbers, found)
    }

    fn assemble(
        &self,
        fields: [Vec<f64>; 3],
        traction: Vec<f64>,
        SearchNumbers { datum, energy, transforms }: SearchNumbers,
        FoundState { method, residual, least }: FoundState,
    ) -> AdhesiveState {
        let shape = self.problem.surface().grid().shape();
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let work = self.worked(0, transforms);
        let mean_pressure = match self.control {
            AdhesiveControl::MeanPressure(pressure) => pressure,
            _ => mean(&fields[0]) - mean(&traction),
        };
        let [softest, _] = self.problem.compliance().stiffness_range();
        let [least_curvature, curvature_error] = [|it: &LeastCurvature| it.value, |it: &LeastCurvature| it.error]
            .map(|of| least.as_ref().map(|it| of(it) / softest));
        let goal = if method == "safe" { self.safe_tolerance() } else { self.tolerance() };
        let (claim, status) = if residual <= goal {
            let curvature = least_curvature.zip(curvature_error);
            (claim(self.problem, self.attraction, self.control, &fields[2], curvature), Status::Converged)
        } else {
            (ResultClaim::NotConverged, if self.left() == 0 { Status::IterationCap } else { Status::Stalled })
        };
        let parts = (Certificate::UNKNOWN, work, status);
        let touching = fields[0].iter().filter(|p| **p > 0.0).count();
        let values = StateValues::new(Feels::ATTRACTION)
            .with(Quantity::MeanPressure, mean_pressure)
            .with(Quantity::RelativeArea, touching as f64 / fields[0].len() as f64);
        let contact = Contact::from_parts(self.problem.clone(), fields.map(field), parts, method, None);
        AdhesiveState {
            control: self.control,
            contact: contact.expect("fields fit the grid").with_values(values),
            traction: field(traction),
            mean_pressure,
            datum,
            energy,
            residual,
            least_curvature,
            curvature_error,
            claim,
            method,
            steps: work.iterations,
            work,
        }
    }
}

/// Whether the observer lets a search go on after it has seen a state.
fn goes_on(
    problem: &Problem,
    control: AdhesiveControl,
    state: &GapState,
    work: Work,
    observer: &mut dyn Observer,
) -> bool {
    let datum = datum(problem, control, &state.gap);
    let [pressure, displacement, _] = contact_fields(problem, state, datum);
    let step = Step::new(problem, work, &pressure, &displacement).with_datum(datum);
    matches!(observer.step(&step), Ok(ControlFlow::Continue(())))
}

/// Contact pressure, displacement and gap of a state.
fn contact_fields(problem: &Problem, state: &GapState, datum: f64) -> [Vec<f64>; 3] {
    let n = state.gap.len();
    let pressure = (0..n).map(|i| if state.touches(i) { state.gradient[i] } else { 0.0 }).collect();
    let displacement = state.gap.iter().zip(problem.height()).map(|(g, h)| g + h - datum).collect();
    [pressure, displacement, state.gap.clone()]
}

/// The datum `d` of a gap: its mean, unless a uniform pressure displaces.
fn datum(problem: &Problem, control: AdhesiveControl, gap: &[f64]) -> f64 {
    match control {
        AdhesiveControl::Approach(approach) => problem.highest() - approach,
        _ => mean(gap),
    }
}

//! The search for one state of a contact with adhesion.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use super::convex::{ConvexEnd, ConvexState, ConvexSteps};
use super::curvature::{LeastCurvature, least_curvature};
use super::frames::MotionFrames;
use super::gap_energy::{GapEnergy, GapState, mean};
use super::method::AdhesiveMethod;
use super::motion::DampedMotion;
use super::newton::{self, GapEnd};
use super::state::{AdhesiveMotion, AdhesiveOutcome, AdhesiveState};
use crate::clock::Instant;
use crate::contact::{
    Certificate, Contact, Load, Multilevel, Observer, Problem, ResultClaim, Solver, Status, Step, Stop, Work,
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

/// Curvatures below this part of the softest stiffness are marginal.
const MARGINAL: f64 = 1e-3;

/// The part of the range by which a step off a saddle moves the gap.
const NUDGE: f64 = 0.05;

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

impl<'a> StateSearch<'a> {
    pub fn new(problem: &'a Problem, attraction: &'a Attraction, control: AdhesiveControl, stop: Stop) -> Self {
        let (work, start) = (Work::default(), Instant::now());
        Self { problem, attraction, control, stop, work, start, tests_stability: true }
    }

    /// The search for a state whose stability is not tested.
    pub fn without_stability(self) -> Self {
        Self { tests_stability: false, ..self }
    }

    /// The state that is found from the last one, or, without one, from the contact without adhesion.
    pub fn run(
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
    pub fn motion(
        mut self,
        from: Option<&AdhesiveState>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveMotion, AdhesionError> {
        if !self.problem.surface().grid().is_periodic() {
            return Err(AdhesionError::FreeMotion);
        }
        let mut gap = self.first_gap(from, observer)?;
        let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
        energy.carry(&mut gap, |_| true);
        let mut state = energy.state(gap);
        let mut frames = MotionFrames::new(self.attraction.range(), &state);
        let mut steps = 0;
        for _ in 0..SEARCHES {
            let mut watch = |energy: &GapEnergy<'_>, state: &GapState, step: usize| {
                let transforms = self.work.transforms + energy.transforms();
                if frames.is_due(state) {
                    frames.keep(state, self.frame(energy, state, steps + step));
                }
                let work = Work { iterations: steps + step, transforms, seconds: 0.0 };
                goes_on((self.problem, self.control), state, work, observer)
            };
            let limits = (self.tolerance(), self.stop.max_iterations().saturating_sub(steps));
            let (end, taken) = DampedMotion::new(&energy).run(&mut energy, &mut state, limits, &mut watch);
            steps += taken;
            let outcome = match end {
                GapEnd::Stopped => return Err(AdhesionError::Stopped),
                GapEnd::Failed => break,
                GapEnd::Separated => Some(self.separated(steps, energy.transforms())),
                GapEnd::Found => self.settled(&mut energy, &mut state, ("gfmd", steps)),
            };
            if let Some(outcome) = outcome {
                return Ok(AdhesiveMotion { frames: frames.into_vec(), outcome });
            }
        }
        Err(AdhesionError::NotFound { steps, residual: state.violation() / self.attraction.strength() })
    }

    /// A frame of a motion.
    fn frame(&self, energy: &GapEnergy<'_>, state: &GapState, steps: usize) -> AdhesiveState {
        AdhesiveState { claim: ResultClaim::Moving, ..self.state(energy, state, None, ("gfmd", steps)) }
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
        let contact = Multilevel.solve(&posed, &self.stop, observer)?;
        self.work.transforms += contact.work.transforms;
        if contact.status == Status::StoppedByObserver {
            return Err(AdhesionError::Stopped);
        }
        Ok(contact.gap.iter().map(|g| g.max(0.0)).collect())
    }

    /// Newton steps, with convex steps where they fail and a step off each saddle.
    fn fast(mut self, gap: Vec<f64>, observer: &mut dyn Observer) -> Result<AdhesiveOutcome, AdhesionError> {
        let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
        let mut gap = gap;
        energy.carry(&mut gap, |_| true);
        let mut state = energy.state(gap);
        let mut steps = 0;
        for _ in 0..SEARCHES {
            let before = self.work.transforms;
            let (problem, control) = (self.problem, self.control);
            let mut watch = |state: &GapState, step: usize, transforms: u64| {
                let work = Work { iterations: steps + step, transforms: before + transforms, seconds: 0.0 };
                goes_on((problem, control), state, work, observer)
            };
            let limits = (self.tolerance(), NEWTON_STEPS.min(self.stop.max_iterations()));
            let (end, taken) = newton::lower(&mut energy, &mut state, limits, &mut watch);
            steps += taken;
            match end {
                GapEnd::Stopped => return Err(AdhesionError::Stopped),
                GapEnd::Separated => return Ok(self.separated(steps, energy.transforms())),
                GapEnd::Found => {
                    if let Some(outcome) = self.settled(&mut energy, &mut state, ("newton", steps)) {
                        return Ok(outcome);
                    }
                }
                GapEnd::Failed => {
                    let sigma = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
                    let mut convex =
                        ConvexSteps::new(self.problem, self.attraction, self.control, &Multilevel, self.stop);
                    let (found, end) = convex.lower(sigma, None, (self.tolerance(), CONVEX_STEPS), observer)?;
                    self.work.transforms += convex.transforms;
                    steps += convex.steps;
                    match (found, end) {
                        (_, ConvexEnd::Separated) => return Ok(self.separated(steps, energy.transforms())),
                        (_, ConvexEnd::Stopped) => return Err(AdhesionError::Stopped),
                        (Some(found), _) => {
                            let mut gap = found.gap;
                            energy.carry(&mut gap, |i| found.pressure[i] == 0.0);
                            state = energy.state(gap);
                        }
                        (None, _) => break,
                    }
                }
            }
        }
        Err(AdhesionError::NotFound { steps, residual: state.violation() / self.attraction.strength() })
    }

    /// What a state in equilibrium is claimed as; none where it was a saddle, which it has left then.
    fn settled(
        &self,
        energy: &mut GapEnergy<'_>,
        state: &mut GapState,
        found: (&'static str, usize),
    ) -> Option<AdhesiveOutcome> {
        let least = if self.tests_stability { least_curvature(energy, state) } else { None };
        match &least {
            Some(least) if least.value < -MARGINAL * energy.softest() => {
                leave_saddle(energy, state, least);
                None
            }
            _ => Some(AdhesiveOutcome::State(self.state(energy, state, least, found))),
        }
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
        let mut convex = ConvexSteps::new(self.problem, self.attraction, self.control, &Multilevel, self.stop);
        let limits = (SLOWER * self.tolerance(), ALL_CONVEX_STEPS.min(self.stop.max_iterations()));
        let (found, end) = convex.lower(sigma, pressed, limits, observer)?;
        self.work.transforms += convex.transforms;
        let steps = convex.steps;
        match (found, end) {
            (_, ConvexEnd::Separated) => Ok(self.separated(steps, 0)),
            (_, ConvexEnd::Stopped) => Err(AdhesionError::Stopped),
            (Some(found), ConvexEnd::Found) => Ok(AdhesiveOutcome::State(self.safe_state(found, steps))),
            (found, _) => {
                let residual = found.map_or(f64::NAN, |state| state.change);
                Err(AdhesionError::NotFound { steps, residual })
            }
        }
    }

    /// The goal of the residual.
    fn tolerance(&self) -> f64 {
        self.stop.tolerance().clamp(1e-11, 0.1)
    }

    fn separated(&self, iterations: usize, transforms: u64) -> AdhesiveOutcome {
        AdhesiveOutcome::Separated { work: self.worked(iterations, transforms) }
    }

    fn worked(&self, iterations: usize, transforms: u64) -> Work {
        Work { iterations, transforms: self.work.transforms + transforms, seconds: self.start.elapsed().as_secs_f64() }
    }

    /// The state of a safe search. On a periodic grid its stability is computed as well.
    fn safe_state(self, found: ConvexState, steps: usize) -> AdhesiveState {
        if self.problem.surface().grid().is_periodic() {
            let mut energy = GapEnergy::new(self.problem, self.attraction, self.control);
            let mut gap = found.gap;
            energy.carry(&mut gap, |i| found.pressure[i] == 0.0);
            let state = energy.state(gap);
            let least = least_curvature(&mut energy, &state);
            return self.state(&energy, &state, least, ("safe", steps));
        }
        let n = found.gap.len();
        let elastic: f64 = (0..n).map(|i| 0.5 * (found.pressure[i] - found.traction[i]) * found.displacement[i]).sum();
        let sticking: f64 = found.gap.iter().map(|gap| self.attraction.energy(*gap)).sum();
        let work = self.worked(steps, 0);
        let (residual, datum, energy) = (found.change, found.datum, (elastic + sticking) / n as f64);
        let fields = [found.pressure, found.displacement, found.gap];
        self.assemble(fields, found.traction, (datum, energy, residual), None, ("safe", steps), work)
    }

    /// The state of a gap.
    fn state(
        &self,
        energy: &GapEnergy<'_>,
        state: &GapState,
        least: Option<LeastCurvature>,
        (method, steps): (&'static str, usize),
    ) -> AdhesiveState {
        let least = least.map(|least| least.value / energy.softest());
        let [elastic, sticking] = energy.parts(state);
        let residual = state.violation() / self.attraction.strength();
        let traction: Vec<f64> = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
        let datum = datum(self.problem, self.control, &state.gap);
        let work = self.worked(steps, energy.transforms());
        let fields = contact_fields(self.problem, state, datum);
        self.assemble(fields, traction, (datum, elastic + sticking, residual), least, (method, steps), work)
    }

    fn assemble(
        &self,
        fields: [Vec<f64>; 3],
        traction: Vec<f64>,
        (datum, energy, residual): (f64, f64, f64),
        least_curvature: Option<f64>,
        (method, steps): (&'static str, usize),
        work: Work,
    ) -> AdhesiveState {
        let shape = self.problem.surface().grid().shape();
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let parts = (Certificate::UNKNOWN, work, Status::Converged);
        let mean_pressure = match self.control {
            AdhesiveControl::MeanPressure(pressure) => pressure,
            _ => mean(&fields[0]) - mean(&traction),
        };
        let claim = self.claim(&fields[2], least_curvature);
        let contact = Contact::from_parts(self.problem.clone(), fields.map(field), parts, method, None);
        AdhesiveState {
            control: self.control,
            contact: contact.expect("fields fit the grid"),
            traction: field(traction),
            mean_pressure,
            datum,
            energy,
            residual,
            least_curvature,
            claim,
            method,
            steps,
            work,
        }
    }

    /// The claim of a state with a gap and a least curvature. A state in which all nodes touch has no curvature and is stable.
    fn claim(&self, gap: &[f64], least: Option<f64>) -> ResultClaim {
        let uniform = self.problem.solid().uniform_compliance().map_or(0.0, f64::recip);
        let [softest, _] = self.problem.compliance().stiffness_range();
        let is_periodic = self.problem.surface().grid().is_periodic();
        let stiffness = match self.control {
            AdhesiveControl::MeanPressure(_) => 0.0,
            AdhesiveControl::MeanGap(_) => softest,
            AdhesiveControl::Approach(_) if is_periodic => softest.min(uniform),
            AdhesiveControl::Approach(_) => 0.0,
        };
        match least {
            _ if self.attraction.steepest() < stiffness => ResultClaim::Solution,
            None if is_periodic && gap.iter().all(|gap| *gap == 0.0) => ResultClaim::Stable,
            None => ResultClaim::Stationary,
            Some(least) if least > MARGINAL => ResultClaim::Stable,
            Some(least) if least >= -MARGINAL => ResultClaim::Marginal,
            Some(_) => ResultClaim::Saddle,
        }
    }
}

/// Whether the observer lets a search go on after it has seen a state.
fn goes_on(
    (problem, control): (&Problem, AdhesiveControl),
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

/// Moves a state off a saddle, to the side of the unstable direction with the lower energy.
fn leave_saddle(energy: &mut GapEnergy<'_>, state: &mut GapState, least: &LeastCurvature) {
    let largest = least.vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut best: Option<(f64, GapState)> = None;
    for sign in [1.0, -1.0] {
        let length = sign * NUDGE * energy.attraction.range() / largest;
        let mut gap: Vec<f64> = state.gap.iter().zip(&least.vector).map(|(g, x)| g + length * x).collect();
        energy.carry(&mut gap, |i| !state.touches(i));
        let by: Vec<f64> = gap.iter().zip(&state.gap).map(|(to, from)| to - from).collect();
        let mut stiff = vec![0.0; by.len()];
        energy.stiffness(&by, &mut stiff);
        let change = energy.change(state, &by, &stiff);
        if best.as_ref().is_none_or(|(least, _)| change < *least) {
            let force = state.force.iter().zip(&stiff).map(|(f, k)| f + k).collect();
            best = Some((change, energy.with_force(gap, force)));
        }
    }
    if let Some((_, moved)) = best {
        *state = moved;
    }
}

/// The gap of a state, moved rigidly to another control.
fn moved(problem: &Problem, state: &AdhesiveState, control: AdhesiveControl) -> Vec<f64> {
    let gap = state.contact.gap.as_slice().expect("results are made in standard layout");
    let by = match control {
        AdhesiveControl::MeanPressure(_) => 0.0,
        AdhesiveControl::MeanGap(goal) => goal - mean(gap),
        AdhesiveControl::Approach(approach) => problem.highest() - approach - state.datum,
    };
    gap.iter().map(|g| (g + by).max(0.0)).collect()
}

//! The problem of a contact with adhesion, and how a state of it is found.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use super::convex::{ConvexEnd, ConvexState, ConvexSteps};
use super::curvature::{LeastCurvature, least_curvature};
use super::gap_energy::{GapEnergy, GapState, mean};
use super::newton::{self, GapEnd};
use super::scales::AdhesionScales;
use super::state::AdhesiveState;
use crate::clock::Instant;
use crate::contact::{
    Certificate, Contact, Law, Load, Multilevel, Observer, Problem, ResultClaim, Solver, Status, Step, Stop, Work,
};
use crate::error::AdhesionError;
use crate::surface::Field;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Process zones below this many spacings hold the edges of contacts fast: refused.
const FEWEST_SPACINGS: f64 = 2.0;

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

/// The method that finds states with adhesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum AdhesiveMethod {
    /// Newton steps in the gap on periodic grids, with safe steps where they fail; safe steps on free boundaries.
    #[default]
    Fast,
    /// Each step is a contact without adhesion: the energy falls in every step.
    Safe,
}

impl AdhesiveMethod {
    /// The name of the method in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "Newton steps",
            Self::Safe => "convex steps",
        }
    }

    /// The method in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Fast => "projected Newton steps in the gap, with convex steps where they fail and on free boundaries",
            Self::Safe => "contacts without adhesion one after the other, whose energy falls",
        }
    }
}

/// A contact with adhesion: a [`Problem`] with an [`Attraction`].
///
/// Find `g >= 0` and `p_c >= 0` with `p_c g = 0` such that the solid, under `p = p_c - sigma(g)`, has the displacement `u = A p = g + h - d`.
/// Given is the mean pressure `P = <p_c> - <sigma>`, the mean gap or the approach. The solutions are the stationary points of
///
/// `E(g) = 1/2 <p u> + <V(g)> [+ P d under a mean pressure]`.
///
/// # Methods
/// The **safe** method holds the attraction `sigma_k` fast and solves the contact without adhesion of the heights `h + A sigma_k`. The energy
/// falls in each step, since `V` is concave. Anderson's method shortens the sequence. The **fast** method takes projected Newton steps in
/// the gap by conjugate gradients, on periodic grids; where no step lowers the energy, safe steps follow.
///
/// # What is claimed
/// Each state has the largest violation of equilibrium, and on periodic grids the least curvature of the energy: a state is *stable*,
/// *marginal* or a *saddle*. It is *the solution* only at a given mean gap or approach where the attraction is less steep than the softest
/// wave of the solid is stiff, since the energy is convex then.
///
/// ```
/// use asperity::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, Attraction, AttractionForm};
/// use asperity::contact::{ContactModulus, Load, ResultClaim};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // a sine that sticks without load: Johnson's alpha is 0.2
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(512, 1.0)?)?;
/// let full = std::f64::consts::PI * 0.01;
/// let work = 0.04 * 0.01 * full * std::f64::consts::FRAC_PI_2;
/// let attraction = Attraction::new(AttractionForm::Exponential, work, 1e-3)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(full))?;
/// let problem = AdhesiveProblem::new(problem, attraction)?;
/// let control = AdhesiveControl::MeanPressure(0.0);
/// let found = problem.solve(control, None, AdhesiveMethod::Fast, &Stop::default(), &mut ())?;
/// let AdhesiveOutcome::State(state) = found else { panic!("it sticks") };
/// assert_eq!(state.claim, ResultClaim::Stable);
/// assert!((state.relative_area() / 2.0 - 0.114).abs() < 0.01 && state.residual < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct AdhesiveProblem {
    problem: Problem,
    attraction: Attraction,
    scales: AdhesionScales,
}

/// What a solve with adhesion ends with.
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "nearly all outcomes are states")]
pub enum AdhesiveOutcome {
    /// A state.
    State(AdhesiveState),
    /// The attraction does not hold the load: the surfaces part for good.
    Separated {
        /// The work until this was known.
        work: Work,
    },
}

impl AdhesiveProblem {
    /// The problem of a surface and a solid with an attraction between them. The load of `problem` is not used.
    ///
    /// # Errors
    /// [`AdhesionError::NotElastic`] for a hardness or a contact that moves, and [`AdhesionError::Coarse`] for a process zone below two
    /// spacings.
    pub fn new(problem: Problem, attraction: Attraction) -> Result<Self, AdhesionError> {
        if problem.law() != Law::HardWall {
            return Err(AdhesionError::NotElastic { what: "hardness" });
        }
        if problem.is_moving() {
            return Err(AdhesionError::NotElastic { what: "speed" });
        }
        let scales = AdhesionScales::new(&problem, &attraction);
        if scales.spacings < FEWEST_SPACINGS {
            let (zone, spacings) = (scales.process_zone, scales.spacings);
            let points =
                (problem.surface().grid().shape()[1] as f64 * 2.0 * FEWEST_SPACINGS / spacings).ceil() as usize;
            return Err(AdhesionError::Coarse { zone, spacings, points });
        }
        Ok(Self { problem, attraction, scales })
    }

    /// The problem without adhesion.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The attraction.
    pub fn attraction(&self) -> &Attraction {
        &self.attraction
    }

    /// How the attraction compares with surface and solid.
    pub fn scales(&self) -> &AdhesionScales {
        &self.scales
    }

    /// The state under a control that is found from the last state, or, without one, from the contact without adhesion. The observer
    /// sees each step, with the contact pressure `p_c` as its pressure.
    ///
    /// The residual is at most the tolerance of `stop`, and at most 100 times as large with the safe method.
    ///
    /// # Errors
    /// [`AdhesionError::NotFinite`], [`AdhesionError::MeanGap`] and [`AdhesionError::Control`] for a control that is impossible,
    /// [`AdhesionError::NotFound`] where no method found a state, [`AdhesionError::Stopped`] if the observer stopped the solve, and those
    /// of the contacts without adhesion.
    pub fn solve(
        &self,
        control: AdhesiveControl,
        from: Option<&AdhesiveState>,
        method: AdhesiveMethod,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let problem = self.under(control)?;
        let mut search = Search {
            problem: &problem,
            attraction: &self.attraction,
            control,
            stop: *stop,
            work: Work::default(),
            start: Instant::now(),
        };
        let gap = match from {
            Some(state) => moved(&problem, state, control),
            None => search.wall(observer)?,
        };
        let is_fast = method == AdhesiveMethod::Fast && problem.surface().grid().is_periodic();
        if is_fast { search.fast(gap, observer) } else { search.safe(gap, from, observer) }
    }

    /// The problem whose compliance suits a control.
    fn under(&self, control: AdhesiveControl) -> Result<Problem, AdhesionError> {
        let (name, value) = (control.name(), control.value());
        if !value.is_finite() {
            return Err(AdhesionError::NotFinite { name, value });
        }
        let grid = self.problem.surface().grid();
        let problem = self.problem.clone();
        let is_with_uniform = matches!(problem.load(), Load::Approach(_));
        match control {
            AdhesiveControl::MeanGap(_) if !grid.is_periodic() => {
                let reason = "a mean gap has no meaning on a free boundary: give an approach";
                Err(AdhesionError::Control { control: name, reason })
            }
            AdhesiveControl::MeanGap(value) if value <= 0.0 => Err(AdhesionError::MeanGap { value }),
            AdhesiveControl::Approach(_) if is_with_uniform => Ok(problem),
            AdhesiveControl::Approach(_) if grid.is_periodic() && problem.solid().uniform_compliance().is_none() => {
                let reason = "an approach has no meaning on a periodic half-space: give a mean gap";
                Err(AdhesionError::Control { control: name, reason })
            }
            AdhesiveControl::Approach(_) => {
                let highest = problem.highest();
                Ok(problem.with_load(Load::Approach(0.5 * highest))?)
            }
            _ if is_with_uniform => {
                let pressure = 0.01 * problem.rms_gradient() * problem.contact_modulus();
                Ok(problem.with_load(Load::MeanPressure(pressure))?)
            }
            _ => Ok(problem),
        }
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

/// A search for one state.
struct Search<'a> {
    problem: &'a Problem,
    attraction: &'a Attraction,
    control: AdhesiveControl,
    stop: Stop,
    work: Work,
    start: Instant,
}

impl Search<'_> {
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
            let problem = self.problem;
            let mut watch = |state: &GapState, step: usize, transforms: u64| {
                let work = Work { iterations: steps + step, transforms: before + transforms, seconds: 0.0 };
                goes_on(problem, state, work, observer)
            };
            let limits = (self.tolerance(), NEWTON_STEPS.min(self.stop.max_iterations()));
            let (end, taken) = newton::lower(&mut energy, &mut state, limits, &mut watch);
            steps += taken;
            match end {
                GapEnd::Stopped => return Err(AdhesionError::Stopped),
                GapEnd::Separated => return Ok(self.separated(steps, energy.transforms())),
                GapEnd::Found => {
                    let least = least_curvature(&mut energy, &state);
                    let softest = energy.softest();
                    match &least {
                        Some(least) if least.value < -MARGINAL * softest => {
                            leave_saddle(&mut energy, &mut state, least);
                        }
                        _ => return Ok(AdhesiveOutcome::State(self.state(energy, state, least, ("newton", steps)))),
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
                            state = energy.state(closed(&energy, found));
                        }
                        (None, _) => break,
                    }
                }
            }
        }
        Err(AdhesionError::NotFound { steps, residual: state.violation() / self.attraction.strength() })
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
            let state = energy.state(closed(&energy, found));
            let least = least_curvature(&mut energy, &state);
            return self.state(energy, state, least, ("safe", steps));
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
        energy: GapEnergy<'_>,
        state: GapState,
        least: Option<LeastCurvature>,
        (method, steps): (&'static str, usize),
    ) -> AdhesiveState {
        let least = least.map(|least| least.value / energy.softest());
        let [elastic, sticking] = energy.parts(&state);
        let residual = state.violation() / self.attraction.strength();
        let traction: Vec<f64> = state.gap.iter().map(|gap| self.attraction.traction(*gap)).collect();
        let datum = datum(self.problem, self.control, &state.gap);
        let work = self.worked(steps, energy.transforms());
        let fields = contact_fields(self.problem, &state, datum);
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
            claim: self.claim(least_curvature),
            method,
            steps,
            work,
        }
    }

    /// What may be claimed of a state with a least curvature.
    fn claim(&self, least: Option<f64>) -> ResultClaim {
        let uniform = self.problem.solid().uniform_compliance().map_or(0.0, f64::recip);
        let softest = self.problem.response().softest_stiffness();
        let stiffness = match self.control {
            AdhesiveControl::MeanPressure(_) => 0.0,
            AdhesiveControl::MeanGap(_) => softest,
            AdhesiveControl::Approach(_) if self.problem.surface().grid().is_periodic() => softest.min(uniform),
            AdhesiveControl::Approach(_) => 0.0,
        };
        match least {
            _ if self.attraction.steepest() < stiffness => ResultClaim::Solution,
            None if self.problem.surface().grid().is_periodic() => ResultClaim::Stable,
            None => ResultClaim::Stationary,
            Some(least) if least > MARGINAL => ResultClaim::Stable,
            Some(least) if least >= -MARGINAL => ResultClaim::Marginal,
            Some(_) => ResultClaim::Saddle,
        }
    }
}

/// Whether the observer lets a search go on after it has seen a state.
fn goes_on(problem: &Problem, state: &GapState, work: Work, observer: &mut dyn Observer) -> bool {
    let datum = mean(&state.gap);
    let [pressure, displacement, _] = contact_fields(problem, state, datum);
    let step = Step::new(problem, work, &pressure, &displacement).with_datum(datum);
    matches!(observer.step(&step), Ok(ControlFlow::Continue(())))
}

/// The gap of a convex state, with zero where the surfaces press each other: there the step leaves the rounding of the displacement.
fn closed(energy: &GapEnergy<'_>, found: ConvexState) -> Vec<f64> {
    let ConvexState { mut gap, pressure, .. } = found;
    gap.iter_mut().zip(&pressure).filter(|(_, p)| **p > 0.0).for_each(|(g, _)| *g = 0.0);
    energy.carry(&mut gap, |i| pressure[i] <= 0.0);
    gap
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

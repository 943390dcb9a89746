//! Contacts whose compliance is not symmetric.

mod bounds;
mod continuation;
mod gmres;
mod sets;

use crate::contact::best::Best;
use crate::contact::multilevel::hierarchy::{coarser, prolong};
use crate::contact::{Certificate, Contact, Decision, Observer, Phase, Problem, Run, Solver, Status, Step, Stop};
use crate::error::SolveError;
use crate::surface::Field;
use sets::UpdateKind;
pub(crate) use sets::{BoxInequality, LoadOrDatum, SetIteration};

/// Updates of whole sets for contacts that move steadily over their solid, see [`Problem::sliding`]. It solves contacts at rest as well.
///
/// Such a contact is the solution of a monotone variational inequality, and not the minimum of an energy. Each update
/// 1. takes for free the nodes with pressure below the ceiling, those without pressure whose gap is negative, and those at the
///    ceiling whose gap is positive;
/// 2. solves for the pressure that makes the gap uniform on the free nodes, of any sign, under the load, or zero, at a given datum, by
///    preconditioned GMRES;
/// 3. cuts the pressure at zero and the ceiling, scales it to the load, and computes its displacement and certificate.
///
/// The sets are those of the pressure before it is cut, as in a primal-dual active-set method: sets of the pressure that was cut and scaled
/// wander about, and need several times as many updates. Nested grids are used as by [`crate::contact::Multilevel`], whose preconditioner
/// this is as well, `E' K E`, but with the complex stiffness `K` of each wave.
///
/// # Why it is stable
/// When updates stop to come nearer to the goals, corrections become tighter. Then the solid is made softer by an elastic part that falls
/// to zero from solution to solution, in proximal steps, which guide the updates to the contact of solids that creep much. If this does not
/// help, extragradient steps follow from the best state, until it has come to half of its distance. Each of them comes nearer to the
/// solution, whatever the monotone operator, if its length is small enough, which is checked at each step. So the method cannot cycle,
/// but extragradient steps are slow.
///
/// # What it costs
/// Rough lines of 2^14 points and surfaces of 256^2 with a creep of 1 and 9 need 50 to 670 transforms for a certificate of 1e-8 (100 to 220
/// on average). With a creep of 1000 most need some hundreds, and the hardest, where the retardation time is that in which a wave passes,
/// about 25 000.
///
/// # Its claim
/// The certificate bounds the pressure. It does not bound an energy, and not the mean gap, see [`Certificate`].
///
/// Memory: about 8 fields of n doubles, and up to 82 vectors on the contact set.
///
/// # Source
/// Extragradient steps: Korpelevich, Matecon 12, 747 (1976), with the steps of Khobotov, USSR Comput. Math. Math. Phys. 27, 120 (1987).
/// GMRES: Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986).
///
/// ```
/// use asperity::contact::{ContactModulus, Load, MonotoneSets, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // a sine that slides so slowly, or so fast, that the solid is elastic: half of it touches (Westergaard)
/// let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(256, 1.0)?)?;
/// let full = std::f64::consts::PI;
/// for (speed, modulus) in [(1e-9, 1.0 / 4.0), (1e9, 1.0)] {
///     let problem = Problem::new(sine.clone(), ContactModulus(1.0), Load::MeanPressure(0.5 * full * modulus))?;
///     let contact = MonotoneSets.solve(&problem.sliding(speed, &[(3.0, 1.0)])?, &Stop::default(), &mut ())?.converged()?;
///     assert!((contact.counted().relative_area - 0.5).abs() < 4.0 / 256.0);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct MonotoneSets;

/// Updates without a better state after which a run stops, in addition to as many as it took to find the best one.
const PATIENCE: usize = 3000;

/// A coarse grid is solved until its certificate is below the tolerance and below this part of its first certificate, or for this number
/// of updates.
const COARSE_TOLERANCE: f64 = 1e-2;
const COARSE_REDUCTION: f64 = 0.1;
const COARSE_UPDATES: usize = 60;

/// How often a grid is approached by continuation, before extragradient steps.
const APPROACHES: usize = 4;

impl Solver for MonotoneSets {
    fn name(&self) -> &str {
        "monotone"
    }

    fn settings(&self) -> String {
        "updates of whole sets by GMRES, with extragradient steps as a safeguard".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let run = Run::begin(self, problem, stop, observer).with_patience(PATIENCE);
        let mut descent = NestedRun { run, finest: problem.nodes(), spent: 0.0 };
        let (first, ended) = match start {
            Some(start) => (problem.first_pressure(Some(start)), None),
            None => descent.first(problem, 0),
        };
        let mut state = SetIteration::from_problem(problem, first);
        let status = descent.relax(problem, &mut state, 0, ended).unwrap_or(Status::Stalled);
        let transforms = descent.transforms(problem, &state);
        Ok(descent.run.finish_after(status, transforms, state.into_response()))
    }
}

/// The run through all grids.
struct NestedRun<'a> {
    run: Run<'a>,
    /// Nodes of the finest grid.
    finest: usize,
    /// Work on grids that are done with, in transforms of the finest grid.
    spent: f64,
}

impl NestedRun<'_> {
    /// The pressure to start from, of coarser grids if there are any; and why the run ended there, if it did.
    fn first(&mut self, problem: &Problem, depth: usize) -> (Vec<f64>, Option<Status>) {
        let Some(coarse) = coarser(problem) else { return (problem.first_pressure(None), None) };
        let (first, ended) = self.first(&coarse, depth + 1);
        let mut state = SetIteration::from_problem(&coarse, first);
        let ended = self.relax(&coarse, &mut state, depth + 1, ended);
        self.spent += self.share(&coarse) * state.transforms() as f64;
        let best = self.run.best.pressure.take().unwrap_or(state.p);
        self.run.best = Best::none(self.run.iterations());
        let [from, to] = [&coarse, problem].map(|problem| problem.surface().grid());
        let rows = to.shape();
        let mut pressure = prolong(&best, [from, to], rows, [&coarse, problem].map(Problem::ceiling));
        if pressure.values.is_empty() {
            return (problem.first_pressure(None), ended);
        }
        pressure.carry(problem);
        (pressure.spread(), ended)
    }

    /// Iterates on one grid, and says why the run ends, unless it goes on to a finer grid.
    fn relax(
        &mut self,
        problem: &Problem,
        state: &mut SetIteration<'_>,
        depth: usize,
        ended: Option<Status>,
    ) -> Option<Status> {
        let (mut decision, mut first_eta, mut approaches) = (Decision::Start, None, 0);
        for outer in 0.. {
            let certificate = Certificate::from_displacement(problem, &state.p, &state.u);
            self.run.offer(&certificate, &state.p);
            if ended.is_some() {
                break;
            }
            let step = Step::new(problem, self.run.work(self.transforms(problem, state)), &state.p, &state.u);
            let phase = Phase { level: depth, outer, inner: 0 };
            let step = step.with_certificate(certificate).with_phase(phase).with_decision(decision);
            let ended = if depth == 0 { self.run.show(&step) } else { self.run.pass(&step) };
            drop(step);
            if ended.is_some() {
                return ended;
            }
            self.run.advance();
            let eta = certificate.eta;
            let tolerance = COARSE_TOLERANCE.min(COARSE_REDUCTION * *first_eta.get_or_insert(eta));
            let is_done = eta <= tolerance || outer == COARSE_UPDATES;
            if depth > 0 && is_done {
                break;
            }
            if state.is_stale() && approaches < APPROACHES {
                approaches += 1;
                let from = self.run.best.pressure.clone().unwrap_or_else(|| state.p.clone());
                if let Some((pressure, transforms)) = continuation::approach(problem, from, self.run.best.distance) {
                    self.spent += self.share(problem) * transforms as f64;
                    state.restart(pressure);
                    decision = Decision::Start;
                    continue;
                }
            }
            decision = match state.advance(self.run.distance(&certificate), &mut |_| true) {
                UpdateKind::WholeSet => Decision::WholeSet,
                UpdateKind::Extragradient => Decision::Guarded,
            };
        }
        ended
    }

    /// A transform of a grid in those of the finest.
    fn share(&self, problem: &Problem) -> f64 {
        problem.nodes() as f64 / self.finest as f64
    }

    fn transforms(&self, problem: &Problem, state: &SetIteration<'_>) -> u64 {
        (self.spent + self.share(problem) * state.transforms() as f64).ceil() as u64
    }
}

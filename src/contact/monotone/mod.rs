//! Contacts whose compliance is not symmetric.

mod bounds;
mod gmres;
mod sets;

use crate::contact::{Certificate, Contact, Decision, Observer, Phase, Problem, Run, Solver, Step, Stop};
use crate::error::SolveError;
use crate::surface::Field;
pub(crate) use bounds::NodeCeilings;
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
/// The preconditioner is that of [`crate::contact::Multilevel`], `E' K E`, with the complex stiffness `K` of each wave.
///
/// # Why it is stable
/// When updates stop to come nearer to the goals, corrections become tighter, and fewer nodes change; then extragradient steps follow
/// from the best state, until it has come to half of its distance. Each of them comes nearer to the solution, whatever the monotone
/// operator, if its length is small enough, which is checked at each step. So the method cannot cycle.
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
        let mut run = Run::begin(self, problem, stop, observer).with_patience(PATIENCE);
        let goal = match problem.datum() {
            Some(datum) => LoadOrDatum::Datum(datum),
            None => LoadOrDatum::Sum(problem.expected_mean_pressure() * problem.nodes() as f64),
        };
        let ceilings = NodeCeilings::Uniform(problem.law().ceiling());
        let task = BoxInequality { height: problem.height(), ceilings, goal };
        let first = problem.first_pressure(start);
        let mut state = SetIteration::new(task, problem.shared_compliance(), problem.surface().grid(), first);
        let mut decision = Decision::Start;
        let status = loop {
            let certificate = Certificate::from_displacement(problem, &state.p, &state.u);
            run.offer(&certificate, &state.p);
            let step = Step::new(problem, run.work(state.transforms()), &state.p, &state.u);
            let phase = Phase { level: 0, outer: run.iterations(), inner: 0 };
            let step = step.with_certificate(certificate).with_phase(phase).with_decision(decision);
            let ended = run.show(&step);
            drop(step);
            if let Some(status) = ended {
                break status;
            }
            let distance = run.distance(&certificate);
            decision = match state.advance(distance, &mut |_| true) {
                UpdateKind::WholeSet => Decision::WholeSet,
                UpdateKind::Extragradient => Decision::Guarded,
            };
            run.advance();
        };
        let transforms = state.transforms();
        Ok(run.finish_after(status, transforms, state.into_response()))
    }
}

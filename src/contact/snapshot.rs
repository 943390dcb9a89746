//! Copies of the states of a solver.

use crate::contact::{Certificate, Decision, Energy, Phase, Problem, Step, Work};

/// A copy of the state that a [`Step`] shows, for later use, or for use on another thread.
///
/// ```
/// use asperity::contact::{ContactModulus, Each, Load, PolonskyKeer, Snapshot, Solver, Step};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::ops::ControlFlow;
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
/// let mut last = None;
/// let mut keep = Each(|step: &Step<'_>| {
///     last = Some(last.take().map_or_else(|| Snapshot::from_step(step), |kept: Snapshot| kept.replaced_by(step)));
///     ControlFlow::Continue(())
/// });
/// let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut keep)?;
/// let last = std::thread::spawn(move || last.unwrap().step().counted().kappa_r).join().unwrap();
/// assert_eq!(last, contact.counted().kappa_r);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Snapshot {
    problem: Problem,
    work: Work,
    phase: Phase,
    decision: Option<Decision>,
    certificate: Option<Certificate>,
    datum: Option<f64>,
    pressure: Vec<f64>,
    displacement: Vec<f64>,
    /// The energy, for methods that move the surface. It is stored because their forces are not.
    potential: Option<Energy>,
}

impl Snapshot {
    /// A copy of `step`, for which its fields are made.
    pub fn from_step(step: &Step<'_>) -> Self {
        Self::within([Vec::new(), Vec::new()], step)
    }

    /// A copy of another step in the memory of this one.
    pub fn replaced_by(self, step: &Step<'_>) -> Self {
        Self::within([self.pressure, self.displacement], step)
    }

    fn within([pressure, displacement]: [Vec<f64>; 2], step: &Step<'_>) -> Self {
        // a problem remembers this one number, so that its copies need not find it again
        step.problem().rms_gradient();
        Self {
            problem: step.problem().clone(),
            work: step.work(),
            phase: step.phase(),
            decision: step.decision(),
            certificate: step.certificate().copied(),
            datum: step.given_datum(),
            pressure: copied(pressure, step.pressure()),
            displacement: copied(displacement, step.displacement()),
            potential: step.moves_surface().then(|| step.energy()),
        }
    }

    /// The step again.
    pub fn step(&self) -> Step<'_> {
        let step = Step::new(&self.problem, self.work, &self.pressure, &self.displacement).with_phase(self.phase);
        let step = step.with_certificate(self.certificate).with_decision(self.decision);
        let step = match self.datum {
            Some(datum) => step.with_datum(datum),
            None => step,
        };
        match self.potential {
            Some(energy) => step.with_potential(energy),
            None => step,
        }
    }
}

/// A copy of `values` in the memory of others.
fn copied(mut memory: Vec<f64>, values: &[f64]) -> Vec<f64> {
    memory.clear();
    memory.extend_from_slice(values);
    memory
}

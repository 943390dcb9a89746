//! The contact that a solver returns.

use crate::contact::{Certificate, Edges, Failure, Measures, Patches, Problem, Resolved, certificate, chunks};
use crate::elastic::HalfSpace;
use crate::error::SolveError;
use crate::surface::Field;
use std::sync::Arc;

/// A solved (or best found) contact.
///
/// | field          | shape      | unit     | meaning                                        |
/// |----------------|------------|----------|------------------------------------------------|
/// | `pressure`     | `(ny, nx)` | pressure | `p >= 0`, `<p>` the load if that is given      |
/// | `displacement` | `(ny, nx)` | length   | `u(p)` into the solid, zero mean               |
/// | `gap`          | `(ny, nx)` | length   | `u - h + d`, `<p g> = 0` or `d` the mean gap   |
#[derive(Debug, Clone)]
pub struct Contact {
    /// The problem that it solves.
    pub problem: Problem,
    /// Pressure.
    pub pressure: Field,
    /// Displacement of the solid's surface.
    pub displacement: Field,
    /// Gap between the surfaces.
    pub gap: Field,
    /// Error bounds of this very pressure, from a fresh transform pair.
    pub certificate: Certificate,
    /// Work done.
    pub work: Work,
    /// How the solver stopped.
    pub status: Status,
    /// Name of the solver.
    pub solver: String,
    /// Why an observer failed, if one did.
    pub failure: Option<Arc<Failure>>,
}

/// Work of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Relaxation steps.
    pub iterations: usize,
    /// Fourier transforms, forward and inverse counted alike.
    pub transforms: u64,
    /// Seconds, without those spent in observers.
    pub seconds: f64,
}

/// How a solver stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// The certificate met the tolerance.
    Converged,
    /// The iteration cap was reached.
    IterationCap,
    /// Nothing improved any more: the tolerance lies below what rounding, or the method, attains.
    Stalled,
    /// The observer wished to stop.
    StoppedByObserver,
    /// The observer failed.
    ObserverFailed,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::IterationCap => "iteration cap reached",
            Self::Stalled => "no further progress",
            Self::StoppedByObserver => "stopped by the observer",
            Self::ObserverFailed => "the observer failed",
        })
    }
}

impl Contact {
    /// The contact with `pressure`, its displacement and certificate recomputed. No more than two fields are made besides it at
    /// a time, that of the half-space included.
    pub(super) fn new(
        problem: &Problem,
        pressure: Vec<f64>,
        mut half_space: HalfSpace,
        work: Work,
        solver: &str,
    ) -> Self {
        let mut displacement = vec![0.0; pressure.len()];
        half_space.displacement(&pressure, &mut displacement);
        drop(half_space);
        let certificate = Certificate::of_displaced(problem, &pressure, &displacement);
        let datum = certificate::datum(problem, &pressure, &displacement);
        let gap = displacement.iter().zip(problem.height()).map(|(u, h)| u - h + datum).collect();
        let shape = problem.surface().grid().shape();
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        Self {
            problem: problem.clone(),
            pressure: field(pressure),
            displacement: field(displacement),
            gap: field(gap),
            certificate,
            work: Work { transforms: work.transforms + 2, ..work },
            status: Status::Stalled,
            solver: solver.into(),
            failure: None,
        }
    }

    /// Whether the certificate met the tolerance.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// The contact, if it converged and no observer failed.
    ///
    /// # Errors
    /// The [`Contact::fault`].
    pub fn converged(self) -> Result<Self, SolveError> {
        self.fault().map_or(Ok(self), Err)
    }

    /// Why the contact is not what was asked for, if it is not: [`SolveError::Observer`] with the failure of an observer, or
    /// [`SolveError::NotConverged`] with the certificate that was reached.
    pub fn fault(&self) -> Option<SolveError> {
        if let Some(failure) = &self.failure {
            return Some(SolveError::Observer(failure.clone()));
        }
        let (iterations, reason, certificate) = (self.work.iterations, self.status.to_string(), self.certificate.eta);
        let fault = SolveError::NotConverged { solver: self.solver.clone(), iterations, reason, certificate };
        (!self.is_converged()).then_some(fault)
    }

    /// Notes that something that watched the run failed after it.
    pub fn fail(&mut self, failure: impl Into<Failure>) {
        self.failure.get_or_insert_with(|| Arc::new(failure.into()));
    }

    /// Area, gradients and proportionality factors.
    pub fn measures(&self) -> Measures {
        Measures::of(&self.problem, self.pressures())
    }

    /// The edges of the contact, between the nodes.
    pub fn edges(&self) -> Edges<'_, impl Fn(usize) -> f64 + Sync> {
        let gap = self.gap.as_slice().expect("results are made in standard layout");
        Edges::of(&self.problem, self.pressures(), |node| gap[node])
    }

    /// Area and gradient with the edges resolved between the nodes.
    pub fn resolved(&self) -> Resolved {
        self.edges().resolved()
    }

    /// Contact patches.
    pub fn patches(&self) -> Patches {
        let [ny, nx] = self.pressure.dim().into();
        Patches::of(self.pressures(), [ny, nx])
    }

    /// The pressures, row by row.
    fn pressures(&self) -> &[f64] {
        self.pressure.as_slice().expect("results are made in standard layout")
    }

    /// Mean pressure.
    pub fn mean_pressure(&self) -> f64 {
        self.pressure.mean().unwrap_or(0.0)
    }

    /// Mean gap.
    pub fn mean_gap(&self) -> f64 {
        self.gap.mean().unwrap_or(0.0)
    }

    /// Elastic energy `<p u>/2` per area of the cell, pressure times length. Under one load after the other it falls with the
    /// mean gap as `<p> = -dU/d<g>`.
    pub fn elastic_energy(&self) -> f64 {
        let displacement = self.displacement.as_slice().expect("results are made in standard layout");
        let pressure = self.pressures();
        0.5 * chunks::sum(pressure.len(), |i| pressure[i] * displacement[i]) / pressure.len() as f64
    }

    /// Largest pressure.
    pub fn max_pressure(&self) -> f64 {
        self.pressure.fold(0.0, |max: f64, &p| max.max(p))
    }

    /// Largest gap.
    pub fn max_gap(&self) -> f64 {
        self.gap.fold(0.0, |max: f64, &gap| max.max(gap))
    }

    /// The active set: nodes with `p > 0`.
    pub fn mask(&self) -> ndarray::Array2<bool> {
        self.pressure.mapv(|p| p > 0.0)
    }
}

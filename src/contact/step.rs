//! The state of a solver at one relaxation step.

use crate::contact::{
    Certificate, Counted, Decision, Edge, Edges, Patches, Problem, Resolved, Work, certificate, chunks,
};
use std::cell::{LazyCell, OnceCell};
use std::ops::Deref;

/// The state of a solver at one step. Values that are not used are not computed; others are computed once.
///
/// | part           | given by                     | where it is not given                                    |
/// |----------------|------------------------------|----------------------------------------------------------|
/// | datum          | [`Step::with_datum`]         | the one where `<p g> = 0`, or the mean gap if it is prescribed |
/// | certificate    | [`Step::with_certificate`]   | unknown                                                  |
/// | phase          | [`Step::with_phase`]         | the finest grid, every step an outer one                 |
/// | decision       | [`Step::with_decision`]      | unknown                                                  |
/// | energy         | [`Step::with_force`]         | that of methods that move the pressure                   |
pub struct Step<'a> {
    problem: &'a Problem,
    work: Work,
    pressure: Values<'a>,
    displacement: Values<'a>,
    datum: Option<f64>,
    certificate: Option<Certificate>,
    phase: Phase,
    decision: Option<Decision>,
    /// Ones at the candidates, zeros elsewhere.
    candidates: Option<Values<'a>>,
    /// The net force, of methods that move the surface.
    force: Option<&'a [f64]>,
    /// The potential energy, if it is known without the force.
    potential: Option<Energy>,
    /// The datum, if it was not given, after its first use.
    found_datum: OnceCell<f64>,
    gap: OnceCell<Vec<f64>>,
    counted: OnceCell<Counted>,
    all_edges: OnceCell<Vec<Edge>>,
    resolved: OnceCell<Resolved>,
    patches: OnceCell<Patches>,
}

/// A field of a state, row by row: given, or computed on first use.
pub enum Values<'a> {
    /// A field that the solver holds.
    AtHand(&'a [f64]),
    /// A field that is computed on first use.
    Lazy(LazyField<'a>),
}

type LazyField<'a> = LazyCell<Vec<f64>, Box<dyn FnOnce() -> Vec<f64> + 'a>>;

impl<'a> Values<'a> {
    /// The field that `make` will make.
    pub fn lazy(make: impl FnOnce() -> Vec<f64> + 'a) -> Self {
        Self::Lazy(LazyCell::new(Box::new(make)))
    }
}

impl<'a> From<&'a [f64]> for Values<'a> {
    fn from(values: &'a [f64]) -> Self {
        Self::AtHand(values)
    }
}

impl<'a> From<&'a Vec<f64>> for Values<'a> {
    fn from(values: &'a Vec<f64>) -> Self {
        Self::AtHand(values)
    }
}

impl Deref for Values<'_> {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        match self {
            Self::AtHand(values) => values,
            Self::Lazy(values) => values,
        }
    }
}

/// The position of a solver in its scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Phase {
    /// Grid level: 0 is the finest, each further one has half as many points per side.
    pub level: usize,
    /// Outer steps on this level so far; these change the contact set.
    pub outer: usize,
    /// Inner steps within the outer one so far; 0 at the outer step itself.
    pub inner: usize,
}

/// The energy that a method lowers, divided by `<p> h_rms`. At the solution both kinds have the same magnitude and
/// opposite signs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Energy {
    /// `<p u> / 2 - <p h>`, of methods that move the pressure; at a given mean gap `D` with `D <p>` added.
    Complementary(f64),
    /// `<w k w> / 2 + <p> <w>`, of methods that move the surface `w` of the solid.
    Potential(f64),
}

impl Energy {
    /// The number, whichever kind it is.
    pub fn value(self) -> f64 {
        match self {
            Self::Complementary(value) | Self::Potential(value) => value,
        }
    }
}

impl<'a> Step<'a> {
    /// The step of a solver of `problem` after some work: pressure and displacement, row by row.
    pub fn new(
        problem: &'a Problem,
        work: Work,
        pressure: impl Into<Values<'a>>,
        displacement: impl Into<Values<'a>>,
    ) -> Self {
        Self {
            problem,
            work,
            pressure: pressure.into(),
            displacement: displacement.into(),
            datum: None,
            certificate: None,
            phase: Phase { level: 0, outer: work.iterations, inner: 0 },
            decision: None,
            candidates: None,
            force: None,
            potential: None,
            found_datum: OnceCell::new(),
            gap: OnceCell::new(),
            counted: OnceCell::new(),
            all_edges: OnceCell::new(),
            resolved: OnceCell::new(),
            patches: OnceCell::new(),
        }
    }

    /// The step with the datum `d` of its gap `u - h + d`.
    pub fn with_datum(self, datum: f64) -> Self {
        Self { datum: Some(datum), ..self }
    }

    /// The step with the certificate of its pressure, where it is known.
    pub fn with_certificate(self, certificate: impl Into<Option<Certificate>>) -> Self {
        Self { certificate: certificate.into(), ..self }
    }

    /// The step in a phase of the solver's scheme.
    pub fn with_phase(self, phase: Phase) -> Self {
        Self { phase, ..self }
    }

    /// The step with the decision of the solver.
    pub fn with_decision(self, decision: impl Into<Option<Decision>>) -> Self {
        Self { decision: decision.into(), ..self }
    }

    /// The step of an iteration that lets only some nodes come into contact: ones at these candidates, zeros elsewhere, row by row.
    pub fn with_candidates(self, candidates: Values<'a>) -> Self {
        Self { candidates: Some(candidates), ..self }
    }

    /// The step of a method that moves the surface `w`, the displacement, under the net force `f`: then
    /// `k w = p - f - <p>` with the stiffness `k`, and the energy is the potential one.
    pub fn with_force(self, force: &'a [f64]) -> Self {
        Self { force: Some(force), ..self }
    }

    /// Whether the method moves the surface: then the displacement is its own, and not that under the pressure.
    pub fn moves_surface(&self) -> bool {
        self.force.is_some() || self.potential.is_some()
    }

    /// The step of a method that moves the surface, with the energy that it lowers.
    pub(super) fn with_potential(self, energy: Energy) -> Self {
        Self { potential: Some(energy), ..self }
    }

    /// The problem being solved; on a coarse level, the problem on its grid, which has the size of the fields.
    pub fn problem(&self) -> &'a Problem {
        self.problem
    }

    /// Number of this step, from 0, the state at the start.
    pub fn index(&self) -> usize {
        self.work.iterations
    }

    /// Grid level, outer and inner step.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// What the solver did in this step, if it reports it.
    pub fn decision(&self) -> Option<Decision> {
        self.decision
    }

    /// Ones at the nodes that may come into contact in this iteration, the candidates, and zeros elsewhere, row by row; none if all
    /// nodes may.
    pub fn candidates(&self) -> Option<&[f64]> {
        self.candidates.as_deref()
    }

    /// Work of the solver so far; observers are not counted.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Transforms so far.
    pub fn transforms(&self) -> u64 {
        self.work.transforms
    }

    /// Seconds so far, without those spent in observers.
    pub fn seconds(&self) -> f64 {
        self.work.seconds
    }

    /// Pressure `p >= 0`, row by row. Before convergence its mean may differ from the load (GFMD).
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Displacement of the solid's surface into the solid, row by row; its datum is free.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Gap `g = u - h + d`, row by row; negative where the surfaces still penetrate. Where nodes yield it is cut off at zero: what is
    /// below it there is their overlap.
    pub fn gap(&self) -> &[f64] {
        let (datum, yields) = (self.datum(), self.problem.yields(&self.pressure));
        let (u, h) = (&self.displacement, self.problem.height());
        let gap = move |(u, h): (&f64, &f64)| if yields { (u - h + datum).max(0.0) } else { u - h + datum };
        self.gap.get_or_init(|| u.iter().zip(h).map(gap).collect())
    }

    /// Mean gap.
    pub fn mean_gap(&self) -> f64 {
        match self.problem.yields(&self.pressure) {
            false => self.separation() + self.problem.flattened_by(),
            true => self.gap().iter().sum::<f64>() / self.gap().len() as f64,
        }
    }

    /// Distance of the mean planes, see [`crate::contact::Contact::separation`].
    pub fn separation(&self) -> f64 {
        let sum: f64 = self.displacement.iter().sum();
        let mean = sum / self.displacement.len() as f64;
        mean + (self.datum() - self.problem.mean_height()) - self.problem.flattened_by()
    }

    fn datum(&self) -> f64 {
        let find = || certificate::datum(self.problem, &self.pressure, &self.displacement);
        self.datum.unwrap_or_else(|| *self.found_datum.get_or_init(find))
    }

    /// The datum, if it was given.
    pub(super) fn given_datum(&self) -> Option<f64> {
        self.datum
    }

    /// The certificate of this state, where the solver knows it without further work.
    pub fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }

    /// The energy that the method lowers. [`Problem::expected_mean_pressure`] stands in for a load that is not prescribed.
    pub fn energy(&self) -> Energy {
        if let Some(energy) = self.potential {
            return energy;
        }
        let (p, u): (&[f64], &[f64]) = (&self.pressure, &self.displacement);
        let (h, load) = (self.problem.height(), self.problem.expected_mean_pressure());
        let unit = p.len() as f64 * load * self.problem.rms_height();
        if let Some(force) = self.force {
            return Energy::Potential(chunks::sum(p.len(), |i| 0.5 * u[i] * (load + p[i] - force[i])) / unit);
        }
        let gap = self.problem.datum().unwrap_or(0.0);
        Energy::Complementary(chunks::sum(p.len(), |i| p[i] * (0.5 * u[i] - h[i] + gap)) / unit)
    }

    /// Area, gradients and proportionality factors by counting nodes.
    pub fn counted(&self) -> &Counted {
        self.counted.get_or_init(|| Counted::new(self.problem, &self.pressure))
    }

    /// The edges of the contact, between the nodes.
    pub fn edges(&self) -> Edges<'_, impl Fn(usize) -> f64 + Sync> {
        let (u, h, datum): (&[f64], _, _) = (&self.displacement, self.problem.height(), self.datum());
        Edges::new(self.problem, &self.pressure, move |node| u[node] - h[node] + datum)
    }

    /// All edges of the contact, in the order of their nodes.
    pub fn all_edges(&self) -> &[Edge] {
        self.all_edges.get_or_init(|| self.edges().all())
    }

    /// Area, gradient and `kappa_r` with edges interpolated between the nodes.
    pub fn resolved(&self) -> &Resolved {
        self.resolved.get_or_init(|| self.edges().resolved_of(self.all_edges()))
    }

    /// Contact patches.
    pub fn patches(&self) -> &Patches {
        self.patches.get_or_init(|| Patches::new(&self.pressure, self.problem.surface().grid()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load};
    use crate::grid::Grid;
    use crate::surface::Indenter;
    use std::cell::Cell;

    #[test]
    fn fields_are_made_once_and_only_if_they_are_asked_for() {
        let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(8, 1.0).unwrap()).unwrap();
        let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(1.0)).unwrap();
        let made = [const { Cell::new(0) }; 2];
        let values = |which: usize| {
            let made = &made[which];
            Values::lazy(move || {
                made.set(made.get() + 1);
                vec![1.0; 8]
            })
        };
        let step = Step::new(&problem, Work::default(), values(0), values(1)).with_datum(0.0);
        let made = || [made[0].get(), made[1].get()];
        assert_eq!((step.index(), step.transforms(), step.certificate(), step.phase().level), (0, 0, None, 0));
        assert_eq!(made(), [0, 0]);
        assert_eq!((step.counted().contact_nodes, step.patches().count()), (8, 1));
        assert_eq!(made(), [1, 0]);
        assert!((step.mean_gap() - 1.0).abs() < 1e-15 && step.gap.get().is_none());
        assert_eq!((step.gap().len(), step.gap.get().map(Vec::len)), (8, Some(8)));
        assert_eq!((made(), step.energy().value().is_finite()), ([1, 1], true));
    }
}

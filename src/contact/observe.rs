//! Watching a solver, step by step.

use crate::contact::{Measures, Patches, Problem, Work, certificate, chunks};
use std::cell::{LazyCell, OnceCell};
use std::ops::{ControlFlow, Deref};

/// Watches a solver. Solvers know this interface and never who watches.
///
/// A closure will do; `&mut ()` watches nothing.
pub trait Observer {
    /// Sees one relaxation step; `Break` ends the run with what it has found.
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()>;
}

impl<F: FnMut(&Step<'_>) -> ControlFlow<()>> Observer for F {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        self(step)
    }
}

impl Observer for () {
    fn step(&mut self, _: &Step<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Two observers of one run; it ends when either wishes.
impl<A: Observer + ?Sized, B: Observer + ?Sized> Observer for (&mut A, &mut B) {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        let (a, b) = (self.0.step(step), self.1.step(step));
        if a.is_break() { a } else { b }
    }
}

/// The state of a solver at one step. What is not asked for is not computed, and what is asked for is computed once.
pub struct Step<'a> {
    state: State<'a>,
    gap: OnceCell<Vec<f64>>,
    measures: OnceCell<Measures>,
    patches: OnceCell<Patches>,
}

/// What a solver hands over at a step.
pub(super) struct State<'a> {
    pub problem: &'a Problem,
    pub work: Work,
    pub pressure: Values<'a>,
    pub displacement: Values<'a>,
    /// `d` of the gap `u - h + d`, where the solver knows it.
    pub datum: Option<f64>,
    /// `eta`, where the solver knows it.
    pub certificate: Option<f64>,
    pub phase: Phase,
    pub energy: Energy<'a>,
}

/// A field of a state, at hand or made when it is asked for.
pub(super) enum Values<'a> {
    Given(&'a [f64]),
    Made(Made<'a>),
}

type Made<'a> = LazyCell<Vec<f64>, Box<dyn FnOnce() -> Vec<f64> + 'a>>;

impl<'a> Values<'a> {
    /// What `make` will make.
    pub fn made(make: impl FnOnce() -> Vec<f64> + 'a) -> Self {
        Self::Made(LazyCell::new(Box::new(make)))
    }
}

impl Deref for Values<'_> {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        match self {
            Self::Given(values) => values,
            Self::Made(values) => values,
        }
    }
}

/// Where in its scheme a solver stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Phase {
    /// Grid level: 0 is the finest, each further one has half as many points along a side.
    pub level: usize,
    /// Outer steps on this level so far: those that change the contact set.
    pub outer: usize,
    /// Inner steps within the outer one so far; 0 at the outer step itself.
    pub inner: usize,
}

impl Phase {
    /// That of a solver on one grid, without inner steps.
    pub(super) fn finest(outer: usize) -> Self {
        Self { level: 0, outer, inner: 0 }
    }
}

/// The energy that the method lowers.
pub(super) enum Energy<'a> {
    /// `<p u> / 2 - <p h>`, of methods that move the pressure.
    Complementary,
    /// `<w k w> / 2 + <p_mean> <w>`, of methods that move the surface `w`, where `k w = p - f - p_mean` with the net `force` `f`.
    Potential { force: &'a [f64] },
}

impl<'a> Step<'a> {
    pub(super) fn new(state: State<'a>) -> Self {
        Self { state, gap: OnceCell::new(), measures: OnceCell::new(), patches: OnceCell::new() }
    }

    /// The problem being solved; on a coarse level that of its grid, with as many nodes as there are values of each field.
    pub fn problem(&self) -> &'a Problem {
        self.state.problem
    }

    /// Number of this step, from 0, the state at the start.
    pub fn index(&self) -> usize {
        self.state.work.iterations
    }

    /// Grid level, outer and inner step.
    pub fn phase(&self) -> Phase {
        self.state.phase
    }

    /// Work of the solver so far; observers are not counted.
    pub fn work(&self) -> Work {
        self.state.work
    }

    /// Transforms so far.
    pub fn transforms(&self) -> u64 {
        self.state.work.transforms
    }

    /// Seconds so far, without those spent in observers.
    pub fn seconds(&self) -> f64 {
        self.state.work.seconds
    }

    /// Pressure `p >= 0`, row by row. Before convergence its mean may differ from the load (GFMD).
    pub fn pressure(&self) -> &[f64] {
        &self.state.pressure
    }

    /// Displacement of the solid's surface into the solid, row by row; its datum is free.
    pub fn displacement(&self) -> &[f64] {
        &self.state.displacement
    }

    /// Gap `g = u - h + d`, row by row; negative where the surfaces still penetrate.
    pub fn gap(&self) -> &[f64] {
        let datum = self.datum();
        let State { problem, displacement, .. } = &self.state;
        self.gap.get_or_init(|| displacement.iter().zip(problem.height()).map(|(u, h)| u - h + datum).collect())
    }

    /// Mean gap.
    pub fn mean_gap(&self) -> f64 {
        let sum: f64 = self.state.displacement.iter().sum();
        sum / self.state.displacement.len() as f64 + self.datum()
    }

    fn datum(&self) -> f64 {
        let State { problem, pressure, displacement, datum, .. } = &self.state;
        datum.unwrap_or_else(|| certificate::datum(problem, pressure, displacement))
    }

    /// The certificate `eta` of this state, where the solver knows it without further work.
    pub fn certificate(&self) -> Option<f64> {
        self.state.certificate
    }

    /// The energy that the method lowers, over `mean_pressure h_rms`: for methods that move the pressure the complementary
    /// energy `<p u> / 2 - <p h>`, for methods that move the surface the potential energy `<w k w> / 2 + <p> <w>`. They end
    /// at the same magnitude with opposite signs. At a given mean gap `D` the complementary energy has `D <p>` added, and
    /// [`Problem::expected_mean_pressure`] stands in for the load.
    pub fn energy(&self) -> f64 {
        let State { problem, pressure, displacement, .. } = &self.state;
        let (p, u): (&[f64], &[f64]) = (pressure, displacement);
        let (h, load) = (problem.height(), problem.expected_mean_pressure());
        let gap = problem.load().mean_gap().unwrap_or(0.0);
        let sum = match self.state.energy {
            Energy::Complementary => chunks::sum(p.len(), |i| p[i] * (0.5 * u[i] - h[i] + gap)),
            Energy::Potential { force } => chunks::sum(p.len(), |i| 0.5 * u[i] * (load + p[i] - force[i])),
        };
        sum / (p.len() as f64 * load * problem.rms_height())
    }

    /// Area, gradients and proportionality factors.
    pub fn measures(&self) -> &Measures {
        self.measures.get_or_init(|| Measures::of(self.state.problem, &self.state.pressure))
    }

    /// Contact patches.
    pub fn patches(&self) -> &Patches {
        self.patches.get_or_init(|| Patches::of(&self.state.pressure, self.state.problem.surface().grid().shape()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::surface::Indenter;
    use std::cell::Cell;

    #[test]
    fn fields_are_made_once_and_only_if_they_are_asked_for() {
        let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(8, 1.0).unwrap()).unwrap();
        let problem = Problem::new(sine, 1.0, 1.0).unwrap();
        let made = [const { Cell::new(0) }; 2];
        let values = |which: usize| {
            let made = &made[which];
            Values::made(move || {
                made.set(made.get() + 1);
                vec![1.0; 8]
            })
        };
        let step = Step::new(State {
            problem: &problem,
            work: Work::default(),
            pressure: values(0),
            displacement: values(1),
            datum: Some(0.0),
            certificate: Some(1.0),
            phase: Phase::finest(0),
            energy: Energy::Complementary,
        });
        let made = || [made[0].get(), made[1].get()];
        assert_eq!((step.index(), step.transforms(), step.certificate(), step.phase().level), (0, 0, Some(1.0), 0));
        assert_eq!(made(), [0, 0]);
        assert_eq!((step.measures().contact_nodes, step.patches().count()), (8, 1));
        assert_eq!(made(), [1, 0]);
        assert!((step.mean_gap() - 1.0).abs() < 1e-15 && step.gap.get().is_none());
        assert_eq!((step.gap().len(), step.gap.get().map(Vec::len)), (8, Some(8)));
        assert_eq!((made(), step.energy().is_finite()), ([1, 1], true));
    }
}

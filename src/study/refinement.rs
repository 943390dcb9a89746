//! A contact on successively finer grids.

use crate::contact::{Contact, Resolution};
use crate::error::SetupError;
use crate::setup::{Auto, Extras, Setup};
use crate::warning::Warning;

/// The finest grid has this many times as many points per side as the first one.
const MOST: usize = 64;
/// Points per shortest wave of the roughness on the first grid, where points are not given.
const PER_WAVE: f64 = 4.0;
/// The fewest points per side of such a grid.
const FEWEST: usize = 64;

/// A contact on successively finer grids, each of twice as many points per side, until the errors of area and `kappa_r`
/// that [`Resolution`] estimates are within a tolerance. It stops at once if plateaus cause a larger error on any grid.
///
/// Heights of a file are interpolated; everything else is generated on the finer grid.
///
/// ```
/// use asperity::contact::Load;
/// use asperity::setup::{Auto, Cell, Recipe, Setup};
/// use asperity::{Indenter, error::SetupError, study::Refinement};
/// let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
/// let setup = Setup::new(cylinder, Cell::line(64, 4.0), Load::ReducedPressure(0.1));
/// let auto = Auto { tolerance: 1e-3, axes: None };
/// let settled = Refinement::new(setup, auto).settle(|setup| {
///     Ok::<_, SetupError>(setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?)
/// })?;
/// assert!(settled.is_within && settled.setup.grid.refine() > 1);
/// let (found, grid) = (&settled.contact, settled.contact.problem.surface().grid());
/// let exact = settled.setup.exact(grid, found.mean_pressure()).and_then(|exact| exact.kappa_r).unwrap();
/// assert!((found.resolved().kappa_r / exact - 1.0).abs() < 1e-3);
/// # Ok::<(), SetupError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    setup: Setup,
    tolerance: f64,
}

/// The contact on the first grid that is accurate enough, or on the finest grid for which there is memory.
pub struct Settled {
    /// The setup on that grid.
    pub setup: Setup,
    /// The contact.
    pub contact: Contact,
    /// Whether the estimated errors are within the tolerance.
    pub is_within: bool,
}

impl Refinement {
    /// The refinement of a setup. It starts with the grid of the setup or, for automatic points, with 4 points per
    /// shortest wavelength of its roughness.
    pub fn new(mut setup: Setup, auto: Auto) -> Self {
        let shortest = |axes: usize| setup.surface.spectrum.as_ref()?.shortest_wavelength(axes == 1);
        if let Some((axes, shortest)) = auto.axes.and_then(|axes| Some((axes, shortest(axes)?))) {
            let along = |size: f64| ((PER_WAVE * size / shortest).ceil() as usize).next_power_of_two().max(FEWEST);
            let sizes = setup.grid.size.iter().copied().cycle().take(axes);
            setup.grid.points = sizes.map(along).collect();
        }
        Self { setup, tolerance: auto.tolerance }
    }

    /// The setups on all grids, coarsest first.
    pub fn setups(&self) -> impl Iterator<Item = Setup> {
        let first = self.setup.grid.refine();
        let factors = std::iter::successors(Some(1), |factor| Some(2 * factor)).take_while(|factor| *factor <= MOST);
        factors.map(move |factor| {
            let mut setup = self.setup.clone();
            setup.grid.refine = (first * factor > 1).then_some(first * factor);
            setup
        })
    }

    /// Solves on successively finer grids with `solve`, which is not called for a grid that needs too much memory.
    ///
    /// # Errors
    /// Those of `solve`, and of the first grid.
    pub fn settle<E: From<SetupError>>(&self, solve: impl FnMut(&Setup) -> Result<Contact, E>) -> Result<Settled, E> {
        let check =
            |setup: &Setup| Ok(setup.cost(&Extras::default()).and_then(|cost| cost.check(setup.solver.name()))?);
        self.settle_if(check, solve)
    }

    /// The same for heights that no setup describes; `check` returns an error if there is not enough memory for a grid.
    ///
    /// # Errors
    /// Those of `solve`, and of `check` on the first grid.
    pub fn settle_if<E>(
        &self,
        mut check: impl FnMut(&Setup) -> Result<(), E>,
        mut solve: impl FnMut(&Setup) -> Result<Contact, E>,
    ) -> Result<Settled, E> {
        let mut last = None;
        for setup in self.setups() {
            let fits = check(&setup);
            if let (Err(_), Some(settled)) = (&fits, last.take()) {
                return Ok(settled);
            }
            fits?;
            let contact = solve(&setup)?;
            let resolution = contact.resolution();
            let (is_within, can_settle) =
                (self.is_within(&resolution), resolution.least_area_error() <= self.tolerance);
            let settled = Settled { setup, contact, is_within };
            if is_within || !can_settle || !settled.contact.is_converged() {
                return Ok(settled);
            }
            last = Some(settled);
        }
        Ok(last.expect("there is a first grid"))
    }

    /// The warning that the errors are above the tolerance on the finest grid that could be tried.
    pub fn warning() -> Warning {
        Warning::new(
            "Area and kappa_r are not accurate enough on the finest possible grid (limited by memory, by 64-fold \
             refinement, or by plateaus in the heights)",
            "Use a larger tolerance, or heights that are smoother and have more digits",
        )
        .with_remedy("grid.area-tolerance", None)
    }

    fn is_within(&self, resolution: &Resolution) -> bool {
        resolution.relative_area_error <= self.tolerance && resolution.kappa_r_error <= self.tolerance
    }
}

//! The solvers to choose from.

use crate::contact::{Gfmd, Multilevel, PolonskyKeer, Solver};
use crate::error::SettingError;
use crate::grid::Grid;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// A solver with its settings. This is the only list of solvers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, EnumIter, EnumMessage, EnumString, IntoStaticStr)]
#[serde(tag = "method", rename_all = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
pub enum Method {
    /// An active-set method on nested grids, the fastest.
    ///
    /// See [`Multilevel`].
    Multilevel {},
    /// Constrained conjugate gradients.
    ///
    /// See [`PolonskyKeer`].
    PolonskyKeer {},
    /// Green's function molecular dynamics, the paper's method.
    ///
    /// See [`Gfmd`].
    Gfmd(Gfmd),
}

impl Default for Method {
    /// The fastest solver.
    fn default() -> Self {
        Self::Multilevel {}
    }
}

impl Method {
    /// The solver.
    pub fn solver(&self) -> &dyn Solver {
        match self {
            Self::Multilevel {} => &Multilevel,
            Self::PolonskyKeer {} => &PolonskyKeer,
            Self::Gfmd(solver) => solver,
        }
    }

    /// The name of the solver.
    pub fn name(&self) -> &str {
        self.solver().name()
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// For a setting outside its range.
    pub fn check(&self) -> Result<(), SettingError> {
        match self {
            Self::Multilevel {} | Self::PolonskyKeer {} => Ok(()),
            Self::Gfmd(gfmd) => gfmd.check(),
        }
    }

    /// Whether the solver works at a given mean gap, too, not only under a pressure.
    pub fn takes_mean_gap(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Whether the solver works with a free boundary, too, not only with a periodic one.
    pub fn takes_free_boundary(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Whether the solver works with a hardness.
    pub fn takes_hardness(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Coarse grids of the solver.
    pub fn coarse_grids(&self, grid: &Grid) -> usize {
        match self {
            Self::Multilevel {} => Multilevel::coarse_grids(grid),
            Self::PolonskyKeer {} | Self::Gfmd(_) => 0,
        }
    }

    /// Number of fields of doubles that a solve needs at its peak, without the heights, if a share of the nodes is in
    /// contact.
    pub fn fields(&self, grid: &Grid, relative_area: f64) -> f64 {
        match self {
            Self::Multilevel {} => Multilevel::fields(grid, relative_area),
            Self::PolonskyKeer {} => PolonskyKeer::FIELDS,
            Self::Gfmd(_) => Gfmd::FIELDS,
        }
    }

    /// Fields that a recording adds to them, as measured: a state is copied to be written while the solver continues,
    /// and one of the multilevel solver has fields to be made that others have at hand.
    pub(super) fn recorded_fields(&self) -> f64 {
        match self {
            Self::Multilevel {} => 4.0,
            Self::PolonskyKeer {} | Self::Gfmd(_) => 1.5,
        }
    }

    /// Transforms that a solve takes, in words.
    pub fn transforms(&self) -> &'static str {
        match self {
            Self::Multilevel {} => "about 100, on any grid",
            Self::PolonskyKeer {} => "two to four per step; finer grids need more steps",
            Self::Gfmd(_) => "two to four per step, and some for certificates",
        }
    }

    /// Estimate of the largest number of steps on the finest grid.
    pub fn steps(&self, max_iterations: usize) -> usize {
        match self {
            Self::Multilevel {} => max_iterations.min(40),
            Self::PolonskyKeer {} | Self::Gfmd(_) => max_iterations,
        }
    }
}

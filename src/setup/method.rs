//! The solvers to choose from.

use crate::contact::{Gfmd, Multilevel, PolonskyKeer, Solver};
use crate::error::SettingError;
use crate::grid::Grid;
use serde::{Deserialize, Serialize};

/// A solver with its settings: the one list of solvers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "method", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Method {
    /// [`Multilevel`].
    Multilevel {},
    /// [`PolonskyKeer`].
    PolonskyKeer {},
    /// [`Gfmd`].
    Gfmd(Gfmd),
}

impl Default for Method {
    /// The fast one.
    fn default() -> Self {
        Self::Multilevel {}
    }
}

impl Method {
    /// The methods by their names in scenes, in a few words.
    pub const METHODS: [(&str, &str); 3] = [
        ("multilevel", "Active-set method on nested grids; the fastest"),
        ("polonsky-keer", "Constrained conjugate gradients"),
        ("gfmd", "Green's function molecular dynamics, the paper's method"),
    ];

    /// The method of a name, with its usual settings.
    pub fn named(name: &str) -> Option<Self> {
        [Self::Multilevel {}, Self::PolonskyKeer {}, Self::Gfmd(Gfmd::default())].into_iter().find(|m| m.name() == name)
    }

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

    /// Whether the solver works at a given mean gap, not under a pressure only.
    pub fn takes_mean_gap(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Whether the solver works on a free boundary, not with images only.
    pub fn takes_free_boundary(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Whether the solver takes on a hardness.
    pub fn takes_hardness(&self) -> bool {
        !matches!(self, Self::Gfmd(_))
    }

    /// Coarse grids that the solver goes through.
    pub fn coarse_grids(&self, grid: &Grid) -> usize {
        match self {
            Self::Multilevel {} => Multilevel::coarse_grids(grid),
            Self::PolonskyKeer {} | Self::Gfmd(_) => 0,
        }
    }

    /// Fields of doubles that a solve holds at its peak when a share of the nodes touches, the heights left out.
    pub fn fields(&self, grid: &Grid, relative_area: f64) -> f64 {
        match self {
            Self::Multilevel {} => Multilevel::fields(grid, relative_area),
            Self::PolonskyKeer {} => PolonskyKeer::FIELDS,
            Self::Gfmd(_) => Gfmd::FIELDS,
        }
    }

    /// Fields that a recording adds to them, as measured: a state is copied to be written while the solver goes on, and one of the
    /// multilevel solver has fields to be made that others have at hand.
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

    /// Steps on the finest grid at the most, rather more than are usual.
    pub fn steps(&self, max_iterations: usize) -> usize {
        match self {
            Self::Multilevel {} => max_iterations.min(40),
            Self::PolonskyKeer {} | Self::Gfmd(_) => max_iterations,
        }
    }
}

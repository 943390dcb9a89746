//! The solvers to choose from.

use asperity::contact::{Gfmd, Multilevel, PolonskyKeer, Solver};
use clap::ValueEnum;

/// A solver.
#[derive(Clone, Copy, ValueEnum)]
pub enum Method {
    /// Whole-set updates on nested grids, the fast one
    Multilevel,
    /// Constrained conjugate gradients
    PolonskyKeer,
    /// Green's function molecular dynamics, the paper's method
    Gfmd,
}

impl Method {
    /// The solver with its default settings.
    pub fn solver(self) -> Box<dyn Solver> {
        match self {
            Self::Multilevel => Box::new(Multilevel),
            Self::PolonskyKeer => Box::new(PolonskyKeer),
            Self::Gfmd => Box::new(Gfmd::default()),
        }
    }
}

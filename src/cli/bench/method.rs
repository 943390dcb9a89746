//! The solvers to choose from.

use asperity::contact::{Gfmd, Multilevel, PolonskyKeer, Solver};
use clap::ValueEnum;

/// A solver with its default settings.
#[derive(Clone, Copy, ValueEnum)]
pub enum Method {
    /// Whole-set updates on nested grids
    Multilevel,
    /// Constrained conjugate gradients
    PolonskyKeer,
    /// Green's function molecular dynamics, which takes by far the longest
    Gfmd,
}

impl Method {
    /// The solver.
    pub fn solver(self) -> Box<dyn Solver> {
        match self {
            Self::Multilevel => Box::new(Multilevel),
            Self::PolonskyKeer => Box::new(PolonskyKeer),
            Self::Gfmd => Box::new(Gfmd::default()),
        }
    }
}

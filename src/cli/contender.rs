//! The solvers that are compared, with the settings in which they are.

use asperity::contact::{Dynamics, Gfmd, Masses, Multilevel, PolonskyKeer, Solver};
use asperity::error::SettingError;
use clap::ValueEnum;
use serde::Serialize;

/// A solver.
#[derive(Clone, Copy, PartialEq, Debug, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contender {
    /// Whole-set updates on nested grids
    Multilevel,
    /// Constrained conjugate gradients
    PolonskyKeer,
    /// Green's function molecular dynamics: masses proportional to stiffness, FIRE
    Gfmd,
    /// The same with uniform masses and plain damping, which long waves make slow
    GfmdUniform,
}

impl Contender {
    /// The solvers of most cases.
    pub const USUAL: &[Self] = &[Self::Multilevel, Self::PolonskyKeer, Self::Gfmd];
    /// All of them, where stiffness matters.
    pub const ALL: [Self; 4] = [Self::Multilevel, Self::PolonskyKeer, Self::Gfmd, Self::GfmdUniform];

    /// Its name, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Multilevel => "multilevel",
            Self::PolonskyKeer => "polonsky-keer",
            Self::Gfmd => "gfmd",
            Self::GfmdUniform => "gfmd-uniform",
        }
    }

    /// Its name with its settings.
    pub fn title(self) -> &'static str {
        match self {
            Self::Multilevel | Self::PolonskyKeer => self.name(),
            Self::Gfmd => "gfmd, stiffness masses, FIRE",
            Self::GfmdUniform => "gfmd, uniform masses",
        }
    }

    /// Whether it works under a given mean pressure only.
    pub fn needs_pressure(self) -> bool {
        matches!(self, Self::Gfmd | Self::GfmdUniform)
    }

    /// The solver.
    pub fn solver(self) -> Result<Box<dyn Solver>, SettingError> {
        Ok(match self {
            Self::Multilevel => Box::new(Multilevel),
            Self::PolonskyKeer => Box::new(PolonskyKeer),
            Self::Gfmd => Box::new(Gfmd::new(Masses::Stiffness, Dynamics::Fire, 0.5, 1.0)?),
            Self::GfmdUniform => Box::new(Gfmd::default()),
        })
    }
}

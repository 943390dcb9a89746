//! The solvers that are compared.

use anyhow::Result;
use asperity::contact::{Dynamics, Gfmd, Masses, Multilevel, PolonskyKeer, Solver};
use serde::Serialize;

/// A solver.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contender {
    Multilevel,
    PolonskyKeer,
    /// Masses proportional to stiffness, with FIRE.
    GfmdStiffness,
    /// Uniform masses, damped: the paper's way.
    GfmdUniform,
}

impl Contender {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Multilevel, Self::PolonskyKeer, Self::GfmdStiffness, Self::GfmdUniform];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Multilevel => "multilevel",
            Self::PolonskyKeer => "polonsky-keer",
            Self::GfmdStiffness => "gfmd, stiffness masses, FIRE",
            Self::GfmdUniform => "gfmd, uniform masses",
        }
    }

    /// The solver.
    pub fn solver(self) -> Result<Box<dyn Solver>> {
        Ok(match self {
            Self::Multilevel => Box::new(Multilevel),
            Self::PolonskyKeer => Box::new(PolonskyKeer),
            Self::GfmdStiffness => Box::new(Gfmd::new(Masses::Stiffness, Dynamics::Fire, 0.5, 1.0)?),
            Self::GfmdUniform => Box::new(Gfmd::default()),
        })
    }
}

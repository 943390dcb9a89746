//! The solvers that are compared.

use crate::contact::{Dynamics, Gfmd, Masses};
use crate::setup::Method;

/// A method with the settings in which it is compared, and a name for tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rival {
    /// Name, as on the command line.
    pub name: &'static str,
    /// Name with the settings.
    pub title: &'static str,
    /// A few words on the method.
    pub about: &'static str,
    /// The method.
    pub method: Method,
}

impl Rival {
    /// All rivals, where stiffness matters.
    pub const ALL: [Self; 4] = [
        Self {
            name: "multilevel",
            title: "multilevel",
            about: "Whole-set updates on nested grids",
            method: Method::Multilevel {},
        },
        Self {
            name: "polonsky-keer",
            title: "polonsky-keer",
            about: "Constrained conjugate gradients",
            method: Method::PolonskyKeer {},
        },
        Self {
            name: "gfmd",
            title: "gfmd, stiffness masses, FIRE",
            about: "Green's function molecular dynamics: masses proportional to stiffness, FIRE",
            method: gfmd(Masses::Stiffness, Dynamics::Fire),
        },
        Self {
            name: "gfmd-uniform",
            title: "gfmd, uniform masses",
            about: "Green's function molecular dynamics: uniform masses and plain damping, which long waves make slow",
            method: gfmd(Masses::Uniform, Dynamics::Damped),
        },
    ];
    /// The rivals of most experiments.
    pub const USUAL: &'static [Self] = Self::ALL.split_at(3).0;
    /// The fast one, which experiments rely on.
    pub const MULTILEVEL: Self = Self::ALL[0];

    /// The rival of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rival| rival.name == name)
    }
}

const fn gfmd(masses: Masses, dynamics: Dynamics) -> Method {
    Method::Gfmd(Gfmd { masses, dynamics, time_step: 0.5, damping: 1.0 })
}

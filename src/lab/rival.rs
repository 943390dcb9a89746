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
    /// The fast one, which experiments rely on.
    pub const MULTILEVEL: Self =
        rival("multilevel", "multilevel", "Active-set method on nested grids", Method::Multilevel {});
    /// All rivals, where stiffness matters.
    #[rustfmt::skip]
    pub const ALL: [Self; 4] = [
        Self::MULTILEVEL,
        rival("polonsky-keer", "polonsky-keer", "Constrained conjugate gradients", Method::PolonskyKeer {}),
        rival("gfmd", "gfmd, stiffness masses, FIRE", "Green's function molecular dynamics: masses proportional to stiffness, FIRE", gfmd(Masses::Stiffness, Dynamics::Fire)),
        rival("gfmd-uniform", "gfmd, uniform masses", "The paper's molecular dynamics: uniform masses and constant damping; slow because of the long waves", gfmd(Masses::Uniform, Dynamics::Damped)),
    ];
    /// The rivals of most experiments.
    pub const USUAL: &'static [Self] = Self::ALL.split_at(3).0;

    /// The rival of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rival| rival.name == name)
    }
}

const fn rival(name: &'static str, title: &'static str, about: &'static str, method: Method) -> Rival {
    Rival { name, title, about, method }
}

const fn gfmd(masses: Masses, dynamics: Dynamics) -> Method {
    Method::Gfmd(Gfmd { masses, dynamics, time_step: 0.5, damping: 1.0 })
}

//! The tables, figures and sections of the paper.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// A table, a figure or a section of the paper.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, IntoStaticStr)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Item {
    /// Contact parameters of cylinder and sphere.
    Table1,
    /// kappa_r of cylinder and sphere against p_r*.
    Fig1,
    /// Rough lines: a_rel, kappa and kappa_r.
    Fig2,
    /// Fits of Eq. 11 to the points of Fig. 2.
    Fig3,
    /// Rough surfaces: a_rel, kappa and kappa_r.
    Fig4,
    /// Lines over surfaces, from the points of Figs. 2 and 4.
    Fig5,
    /// Section 6: Greenwood and Williamson with the gradient in contact.
    Gw,
    /// Indenters that the paper leaves out: power laws, and a sine to full contact.
    Beyond,
    /// Rough lines on three grids: kappa_r in the continuum depends on the Hurst exponent.
    Hurst,
    /// Pressures of lines and surfaces beside Persson's theory: distributions, spectra, and the contact stiffness.
    Persson,
    /// Lines and surfaces of one gradient and several breadths: kappa and kappa_r against Nayak's parameter.
    Nayak,
}

impl Item {
    /// The name, as on the command line and in file names.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The items whose solved points it is made of.
    pub(super) fn sources(self) -> &'static [Self] {
        match self {
            Self::Table1 => &[Self::Table1],
            Self::Fig1 => &[Self::Fig1],
            Self::Fig2 | Self::Fig3 => &[Self::Fig2],
            Self::Fig4 => &[Self::Fig4],
            Self::Fig5 => &[Self::Fig2, Self::Fig4],
            Self::Gw | Self::Persson => &[],
            Self::Beyond => &[Self::Beyond],
            Self::Hurst => &[Self::Hurst],
            Self::Nayak => &[Self::Nayak],
        }
    }
}

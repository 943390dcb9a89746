//! The ways to measure the area of a contact and the gradient in it.

use crate::contact::Observables;

/// A quantity of a point.
pub(crate) type ObservableFn = fn(&Observables) -> f64;

/// A way to measure the area of a contact and the gradient in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, strum::IntoStaticStr)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Measure {
    /// By the nodes in contact, as the paper does.
    Counted,
    /// By the edges between the nodes.
    Resolved,
}

impl Measure {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Counted, Self::Resolved];

    /// The name in tables and figures.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The relative area.
    pub const fn area(self) -> ObservableFn {
        match self {
            Self::Counted => |it| it.relative_area_counted,
            Self::Resolved => |it| it.relative_area,
        }
    }

    /// `p_r*`, the reduced pressure with the rms gradient of the contact.
    pub const fn reduced_pressure_contact(self) -> ObservableFn {
        match self {
            Self::Counted => |it| it.reduced_pressure_contact_counted,
            Self::Resolved => |it| it.reduced_pressure_contact,
        }
    }

    /// `kappa`.
    pub const fn kappa(self) -> ObservableFn {
        match self {
            Self::Counted => |it| it.kappa_counted,
            Self::Resolved => |it| it.kappa,
        }
    }

    /// `kappa_r`.
    pub const fn kappa_r(self) -> ObservableFn {
        match self {
            Self::Counted => |it| it.kappa_r_counted,
            Self::Resolved => |it| it.kappa_r,
        }
    }

    /// The power of the grid spacing with which its error vanishes.
    pub fn order(self) -> i32 {
        match self {
            Self::Counted => 1,
            Self::Resolved => 2,
        }
    }
}

//! A solid that yields.

use crate::error::PlasticError;

/// An elastic half-space that yields by the criterion of von Mises and hardens linearly.
///
/// The solid yields where the equivalent stress `s_eq = sqrt(3/2) |s - (2/3) C e|` reaches `Y + H alpha`, with the deviator `s` of the stress, the plastic
/// strain `e` and the accumulated plastic strain `alpha`, `d alpha = sqrt(2/3) |de|`. Strains are small.
///
/// ```
/// use asperity::history::PlasticSolid;
/// let steel = PlasticSolid::new(210e9, 0.3, 350e6, 2e9)?;
/// assert!((steel.contact_modulus() - 210e9 / 0.91).abs() < 1.0);
/// // the certificate divides by the hardening
/// assert!(PlasticSolid::new(210e9, 0.3, 350e6, 0.0).is_err());
/// # Ok::<(), asperity::error::PlasticError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlasticSolid {
    young: f64,
    poisson: f64,
    yield_stress: f64,
    hardening: f64,
    kinematic: f64,
}

impl PlasticSolid {
    /// The solid of Young's modulus, Poisson's ratio, yield stress `Y` in tension and hardening modulus `H`, all but the ratio pressures.
    ///
    /// # Errors
    /// [`PlasticError::NotPositive`] for a modulus or a yield stress that is not positive and finite, [`PlasticError::Poisson`] for a ratio outside
    /// `(-1, 1/2]`, and [`PlasticError::NoHardening`] for a hardening modulus that is not positive and finite: the certificate divides by it. A
    /// millionth of Young's modulus hardly differs from none.
    pub fn new(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Result<Self, PlasticError> {
        for (name, value) in [("Young's modulus", young), ("yield stress", yield_stress)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(PlasticError::NotPositive { name, value });
            }
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return Err(PlasticError::Poisson { poisson });
        }
        if !(hardening.is_finite() && hardening > 0.0) {
            return Err(PlasticError::NoHardening { hardening, least: 1e-6 * young });
        }
        Ok(Self { young, poisson, yield_stress, hardening, kinematic: 0.0 })
    }

    /// The solid with a linear kinematic hardening `C` besides, a pressure, which may be zero.
    ///
    /// # Errors
    /// [`PlasticError::Kinematic`] for a modulus that is negative or not finite.
    pub fn with_kinematic_hardening(self, kinematic: f64) -> Result<Self, PlasticError> {
        if !(kinematic.is_finite() && kinematic >= 0.0) {
            return Err(PlasticError::Kinematic { kinematic });
        }
        Ok(Self { kinematic, ..self })
    }

    /// Young's modulus, a pressure.
    pub fn young(&self) -> f64 {
        self.young
    }

    /// Poisson's ratio.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// The yield stress in tension, a pressure.
    pub fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    /// The modulus of isotropic hardening, a pressure.
    pub fn hardening(&self) -> f64 {
        self.hardening
    }

    /// The modulus of kinematic hardening, a pressure.
    pub fn kinematic_hardening(&self) -> f64 {
        self.kinematic
    }

    /// The contact modulus `E* = E / (1 - nu^2)` against a rigid body, a pressure.
    pub fn contact_modulus(&self) -> f64 {
        self.young / (1.0 - self.poisson * self.poisson)
    }

    /// The shear modulus, a pressure.
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }

    /// The largest mean pressure in full contact under which the solid is still elastic at great depths: there `zz` is the mean pressure, and the
    /// neighbouring cells hold the cell along the surface. It is infinite for `nu = 1/2`.
    pub fn deep_limit(&self) -> f64 {
        self.yield_stress * (1.0 - self.poisson) / (1.0 - 2.0 * self.poisson).max(0.0)
    }
}

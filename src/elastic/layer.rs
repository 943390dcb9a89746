//! A layer on a rigid base.

use super::{ElasticSolid, LongWaves};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// From this `q t` on the factor of a wave is 1 to the last bit.
const DEEP: f64 = 24.0;

/// Below this `q t` the factor is taken from the first terms of its series, since the closed form is a difference of like numbers.
const SHALLOW: f64 = 0.05;

/// An elastic layer of uniform thickness on a rigid base.
///
/// With `x = q t`, the thickness `t` and Poisson's ratio `nu`, the compliance of a wave over that of the half-space is
///
/// | base    | factor                                                                                          |
/// |---------|-------------------------------------------------------------------------------------------------|
/// | sliding | `(cosh 2x - 1) / (sinh 2x + 2x)`                                                                |
/// | bonded  | `((3 - 4 nu) sinh 2x - 2x) / ((3 - 4 nu) cosh 2x + 2 x^2 + 5 - 12 nu + 8 nu^2)`                   |
///
/// Both tend to 1 for waves that are short compared with the thickness. Under a uniform pressure, a periodic cell has
/// no lateral displacement, for both bases: `u = p t (1 + nu)(1 - 2 nu) / (E (1 - nu)) = p t (1 - 2 nu) / (E* (1 -
/// nu)^2)`. Of a bonded layer this is the limit of long waves, Winkler's foundation; a sliding layer also has lateral
/// displacements under long waves, so it is softer for them, by `t / E*`. An incompressible bonded layer, `nu = 1/2`,
/// has for long waves `q^2 t^3 / E = 4 q^2 t^3 / (3 E*)`.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 5.8; Carbone & Mangialardi, J. Mech. Phys. Solids 56, 684 (2008). Tests hold both
/// factors against the equations of elasticity, solved wave by wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Contact modulus `E* = E / (1 - nu^2)`, a pressure.
    pub contact_modulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Thickness, a length.
    pub thickness: f64,
    /// How it is held on its base.
    pub base: Base,
}

/// How a layer is held on its rigid base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Base {
    /// The layer sticks to the base.
    #[default]
    Bonded,
    /// The layer slides without friction.
    ///
    /// It does not separate from the base.
    Sliding,
}

impl Layer {
    /// The factor of a bonded layer, with numerator and denominator over `cosh 2x`.
    fn bonded(&self, x: f64) -> f64 {
        let nu = self.poisson;
        let stiff = 3.0 - 4.0 * nu;
        if x < SHALLOW {
            return self.bonded_series(x);
        }
        let sech = (2.0 * x).cosh().recip();
        (stiff * (2.0 * x).tanh() - 2.0 * x * sech) / (stiff + (2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu) * sech)
    }

    /// The same for small `x`, with the difference of the numerator taken term by term.
    fn bonded_series(&self, x: f64) -> f64 {
        let nu = self.poisson;
        let stiff = 3.0 - 4.0 * nu;
        let (first, square) = (4.0 * (1.0 - 2.0 * nu), x * x);
        let above = x * (first + stiff * square * (4.0 / 3.0 + square * (4.0 / 15.0 + square * 8.0 / 315.0)));
        above / (stiff * (2.0 * x).cosh() + 2.0 * square + 5.0 - 12.0 * nu + 8.0 * nu * nu)
    }
}

/// The factor of a sliding layer: `tanh x / (1 + 2x / sinh 2x)`, which is the closed form above without its differences.
fn sliding(x: f64) -> f64 {
    x.tanh() / (1.0 + 2.0 * x / (2.0 * x).sinh())
}

impl ElasticSolid for Layer {
    fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    fn factor(&self, q: f64) -> f64 {
        let x = q * self.thickness;
        match self.base {
            _ if x > DEEP => 1.0,
            Base::Bonded => self.bonded(x),
            Base::Sliding => sliding(x),
        }
    }

    fn uniform_compliance(&self) -> Option<f64> {
        let nu = self.poisson;
        Some(self.thickness * (1.0 - 2.0 * nu) / (self.contact_modulus * (1.0 - nu).powi(2)))
    }

    /// The next term of a bonded layer, from the series of the closed form: with `k = 3 - 4 nu` and
    /// `d = k + 5 - 12 nu + 8 nu^2 = 8 (1 - nu)^2`,
    ///
    /// `c2 = (2 t^3 / E*) (4 k / (3 d) - 8 (1 - 2 nu) (k + 1) / d^2)`,
    ///
    /// which is negative below `nu = 1/4` and taken as zero there.
    fn long_waves(&self) -> Option<LongWaves> {
        if self.base == Base::Sliding {
            return None;
        }
        let (nu, thickness) = (self.poisson, self.thickness);
        let (k, d) = (3.0 - 4.0 * nu, 8.0 * (1.0 - nu).powi(2));
        let square = 4.0 * k / (3.0 * d) - 8.0 * (1.0 - 2.0 * nu) * (k + 1.0) / (d * d);
        let square = 2.0 * thickness.powi(3) / self.contact_modulus * square.max(0.0);
        Some(LongWaves { thickness, longest: self.uniform_compliance()?, square })
    }

    fn description(&self) -> String {
        let base = match self.base {
            Base::Bonded => "bonded to",
            Base::Sliding => "sliding on",
        };
        format!("layer of thickness {:.4e}, nu {}, {base} a rigid base", self.thickness, self.poisson)
    }
}

impl From<Layer> for Arc<dyn ElasticSolid> {
    fn from(layer: Layer) -> Self {
        Arc::new(layer)
    }
}

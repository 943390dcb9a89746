//! Hertz contact: the parabola, which is the power law with `n = 2` and `A = 1/(2R)`.
//!
//! | quantity     | cylinder (line)             | sphere (point)              |
//! |--------------|-----------------------------|-----------------------------|
//! | load `P`     | `pi E* a^2/(4R)`            | `4 E* a^3/(3R)`             |
//! | approach     | undefined                   | `a^2/R`                     |
//! | pressure     | `p0 sqrt(1 - x^2/a^2)`      | `p0 sqrt(1 - r^2/a^2)`      |
//! | `p0`         | `E* a/(2R)`                 | `2 E* a/(pi R)`             |
//! | `gbar_r`     | `a/(R sqrt 3)`              | `a/(R sqrt 2)`              |
//! | `kappa_r`    | `8/(pi sqrt 3)`             | `3 pi/(4 sqrt 2)`           |
//!
//! Source: Johnson (1985), sections 4.2; Eqs. 2 to 7 and Table 1 of the paper.

use super::{Geometry, PowerLaw};

/// `kappa_r` of the cylinder, `8/(pi sqrt 3)` (Eq. 7).
pub const KAPPA_R_LINE: f64 = 1.470_210_387_791_445_6;

/// `kappa_r` of the sphere, `3 pi/(4 sqrt 2)` (Mueser, Tribol. Lett. 65:129, 2017).
pub const KAPPA_R_POINT: f64 = 1.666_081_101_809_387;

/// A parabolic cylinder of radius `radius` on a half-space.
///
/// ```
/// use asperity::theory::hertz;
/// let contact = hertz::cylinder(0.5, 2.0);
/// let load = std::f64::consts::PI * 2.0 * 0.1 * 0.1 / (4.0 * 0.5);
/// assert!((contact.half_width(load) - 0.1).abs() < 1e-15);
/// assert!((contact.pressure(0.1, 0.0) - 2.0 * 0.1 / (2.0 * 0.5)).abs() < 1e-15);
/// ```
pub fn cylinder(radius: f64, contact_modulus: f64) -> PowerLaw {
    PowerLaw { geometry: Geometry::Line, coefficient: 0.5 / radius, exponent: 2.0, contact_modulus }
}

/// A paraboloid of radius `radius` on a half-space.
pub fn sphere(radius: f64, contact_modulus: f64) -> PowerLaw {
    PowerLaw { geometry: Geometry::Point, ..cylinder(radius, contact_modulus) }
}

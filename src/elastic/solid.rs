//! The interface of elastic solids.

use std::fmt::Debug;

/// A linear elastic, frictionless solid with a flat surface, homogeneous and isotropic in its plane. It is defined by
/// its response to each wave of the pressure.
///
/// The displacement by a wave of wavenumber `q` is `u_q = c(q) p_q` with the compliance `c(q) = factor(q) 2 / (E* q)`.
/// The factor is positive, and 1 (as for a half-space) for waves that are short compared with all other lengths of the
/// solid. The uniform pressure is a special case: it displaces a periodic half-space without limit, so the datum is
/// free, but it compresses a layer on a rigid base by a finite length.
///
/// Solvers, certificates and recordings use only these methods, through [`crate::elastic::Response`]: your own solid
/// needs only these methods.
///
/// ```
/// use asperity::contact::{Load, Multilevel, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop, elastic::ElasticSolid};
/// use std::sync::Arc;
/// // a half-space under a soft skin: short waves meet the skin, long ones what is below
/// #[derive(Debug)]
/// struct Coated;
/// impl ElasticSolid for Coated {
///     fn contact_modulus(&self) -> f64 {
///         1.0
///     }
///     fn factor(&self, q: f64) -> f64 {
///         (1.0 + 0.1 * q) / (2.0 + 0.1 * q)
///     }
///     fn description(&self) -> String {
///         "a soft skin on a stiff body".into()
///     }
/// }
/// let surface = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(512, 1.0)?)?;
/// let problem = Problem::new(surface, Arc::new(Coated) as Arc<dyn ElasticSolid>, Load::MeanPressure(0.01))?;
/// assert!(Multilevel.solve(&problem, &Stop::default(), &mut ())?.is_converged());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait ElasticSolid: Debug + Send + Sync {
    /// The contact modulus `E*` for the shortest waves, a pressure.
    fn contact_modulus(&self) -> f64;

    /// Compliance of a wave over that of the half-space of the contact modulus, for `q = 2 pi / wavelength > 0`: dimensionless and
    /// positive.
    fn factor(&self, q: f64) -> f64;

    /// Displacement divided by uniform pressure in a periodic cell, a length per pressure; none if the datum is free.
    fn uniform_compliance(&self) -> Option<f64> {
        None
    }

    /// The smallest and the largest wavenumber for which the factor is known; none if it is known for all.
    fn known_waves(&self) -> Option<[f64; 2]> {
        None
    }

    /// The compliance of long waves as a polynomial, for solids that are thin between them and a rigid base; none for others. Solvers
    /// may be faster with it.
    fn long_waves(&self) -> Option<LongWaves> {
        None
    }

    /// Whether it is a half-space, whose factor is 1 for every wave.
    fn is_half_space(&self) -> bool {
        false
    }

    /// The distance `D` from a line load at which the displacement is zero, a length, if the boundary is free: a line
    /// load displaces the surface at the distance `x` by `(2 / (pi E*)) ln(D / x)` per unit of force. If instead a
    /// point at the depth `z` under the load is fixed, `D = z exp(-1 / (2 - 2 nu))` (Johnson 1985, section 2.3). None
    /// means the length of the cell.
    fn datum(&self) -> Option<f64> {
        None
    }

    /// A short description of the solid, with its numbers.
    fn description(&self) -> String;
}

/// The compliance `c0 + c2 q^2` of waves that are long compared with the thickness of a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongWaves {
    /// The thickness, a length.
    pub thickness: f64,
    /// `c0`, the compliance of the longest waves, a length per pressure; zero if the solid cannot be compressed.
    pub longest: f64,
    /// `c2`, by which shorter waves are more compliant, a cubed length per pressure; not negative.
    pub square: f64,
}

impl LongWaves {
    /// The stiffness `1 / (c0 + c2 q^2)` of a wave, a pressure per length.
    pub fn stiffness(&self, q: f64) -> f64 {
        (self.longest + self.square * q * q).recip()
    }
}

/// Stiffness `k = E* q / (2 factor(q))` of a wave, a pressure per length; 0 for the mean.
pub(crate) fn stiffness(solid: &dyn ElasticSolid, q: f64) -> f64 {
    if q > 0.0 { 0.5 * solid.contact_modulus() * q / solid.factor(q) } else { 0.0 }
}

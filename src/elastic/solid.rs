//! What a solver needs to know of a solid.

use std::fmt::Debug;

/// A linear elastic, frictionless solid with a flat surface, the same at every place of it and along every direction: by what it
/// makes of each wave of the pressure.
///
/// A wave of wavenumber `q` is displaced by `u_q = c(q) p_q` with the compliance `c(q) = factor(q) 2 / (E* q)`. The factor is that of
/// a half-space, 1, for waves that are short against all that lies below, and positive. The uniform pressure is on its own: under it
/// a periodic half-space sinks without end, so its datum is free, while a layer on a rigid base is compressed by a definite length.
///
/// A solver, a certificate or a recording knows no more of a solid than this, through [`crate::elastic::Response`]: a solid of one's
/// own needs these few methods.
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
    /// The contact modulus `E*` that the shortest waves meet, a pressure.
    fn contact_modulus(&self) -> f64;

    /// Compliance of a wave over that of the half-space of the contact modulus, for `q = 2 pi / wavelength > 0`: dimensionless and
    /// positive.
    fn factor(&self, q: f64) -> f64;

    /// Displacement over uniform pressure in a periodic cell, a length per pressure; none where the datum is free.
    fn uniform_compliance(&self) -> Option<f64> {
        None
    }

    /// Whether it is a half-space, whose factor is 1 for every wave.
    fn is_half_space(&self) -> bool {
        false
    }

    /// The distance `D` from a line load at which the surface stands still, a length, where the boundary is free: a line load displaces
    /// the surface at the distance `x` by `(2 / (pi E*)) ln(D / x)` per unit of force. If it is a point at the depth `z` under the load
    /// that stands still, `D = z exp(-1 / (2 - 2 nu))` (Johnson 1985, section 2.3). None leaves it at the length of the cell.
    fn datum(&self) -> Option<f64> {
        None
    }

    /// The solid in a few words, with its numbers.
    fn description(&self) -> String;
}

/// Stiffness `k = E* q / (2 factor(q))` of a wave, a pressure per length; 0 for the mean.
pub(crate) fn stiffness(solid: &dyn ElasticSolid, q: f64) -> f64 {
    if q > 0.0 { 0.5 * solid.contact_modulus() * q / solid.factor(q) } else { 0.0 }
}

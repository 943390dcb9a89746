//! The problem that all solvers solve.

use crate::contact::{Load, chunks};
use crate::error::ProblemError;
use crate::surface::Surface;
use std::sync::OnceLock;

/// Per reduced pressure, the mean gap of rough surfaces near full contact falls by this power of e: 5 to 6, as measured.
const GAP_DECAY: f64 = 5.5;

/// A rigid surface pressed on an elastic half-space, frictionless and without adhesion, under a given mean pressure or at a
/// given mean gap.
///
/// Find `p >= 0` and a datum `d` such that the gap `g = u(p) - h + d >= 0` and `p g = 0`, with `u(p)` from
/// [`crate::elastic::HalfSpace`]. Heights and displacements have no mean, so the datum is the mean gap.
///
/// | prescribed      | minimises over `p >= 0`                        | found                                   |
/// |-----------------|------------------------------------------------|-----------------------------------------|
/// | `<p>`           | `f(p) = 1/2 <p, u(p)> - <p, h>`, `<p>` as given | `d`, minus the mean of `u - h` weighted by `p` |
/// | mean gap `D`    | `f(p) + D <p>`                                 | `<p>`, with `d = D`                     |
///
/// | quantity                  | symbol  | unit     |
/// |---------------------------|---------|----------|
/// | heights                   | `h`     | length   |
/// | contact modulus           | `E*`    | pressure |
/// | mean pressure             | `<p>`   | pressure |
/// | mean gap                  | `D`     | length   |
///
/// Any consistent set of units will do; tolerances are dimensionless.
///
/// ```
/// use asperity::{Grid, Problem, Stop, surface::Indenter, contact::{PolonskyKeer, Solver}};
/// let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(1024, 1.0)?)?;
/// let pressed = PolonskyKeer.solve(&Problem::new(sine.clone(), 1.0, 2.0)?, &Stop::default(), &mut ())?;
/// let problem = Problem::at_mean_gap(sine, 1.0, pressed.mean_gap())?;
/// let kept_apart = PolonskyKeer.solve(&problem, &Stop::default(), &mut ())?;
/// assert!((kept_apart.pressure.mean().unwrap() - 2.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Problem {
    surface: Surface,
    contact_modulus: f64,
    load: Load,
    expected_mean_pressure: f64,
    rms_height: f64,
    rms_gradient: OnceLock<f64>,
}

impl Problem {
    /// Poses the problem under a mean pressure.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a modulus or pressure that is not positive and finite, [`ProblemError::Flat`] if all
    /// heights are equal, [`ProblemError::OutOfRange`] for magnitudes whose squares leave the range of doubles.
    pub fn new(surface: Surface, contact_modulus: f64, mean_pressure: f64) -> Result<Self, ProblemError> {
        Self::under(surface, contact_modulus, Load::MeanPressure(mean_pressure))
    }

    /// Poses the problem at a mean gap, which must lie between 0 and the highest peak above the mean height.
    ///
    /// # Errors
    /// As [`Problem::new`], and [`ProblemError::NothingTouches`] or [`ProblemError::EverythingTouches`] for a mean gap at which
    /// there is nothing to solve.
    pub fn at_mean_gap(surface: Surface, contact_modulus: f64, mean_gap: f64) -> Result<Self, ProblemError> {
        Self::under(surface, contact_modulus, Load::MeanGap(mean_gap))
    }

    /// Poses the problem at the reduced pressure `p* = <p> / (gbar E*)`, with `gbar` of this surface.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn at_reduced_pressure(
        surface: Surface,
        contact_modulus: f64,
        reduced_pressure: f64,
    ) -> Result<Self, ProblemError> {
        check_magnitude("reduced pressure", reduced_pressure)?;
        let unloaded = Self::new(surface, contact_modulus, contact_modulus)?;
        let mean_pressure = reduced_pressure * unloaded.rms_gradient() * contact_modulus;
        unloaded.with_load(Load::MeanPressure(mean_pressure))
    }

    /// Poses the problem under either load.
    ///
    /// # Errors
    /// As [`Problem::new`] and [`Problem::at_mean_gap`].
    pub fn under(surface: Surface, contact_modulus: f64, load: Load) -> Result<Self, ProblemError> {
        check_magnitude("contact modulus", contact_modulus)?;
        let height = surface.heights();
        if height.iter().all(|&h| h == height[0]) {
            return Err(ProblemError::Flat { height: height[0] + surface.mean_height() });
        }
        let rms_height = (chunks::sum(height.len(), |i| height[i].powi(2)) / height.len() as f64).sqrt();
        check_magnitude("rms height", rms_height)?;
        check_magnitude("length of the cell", surface.grid().longest_wavelength())?;
        let (expected_mean_pressure, rms_gradient) = (f64::NAN, OnceLock::new());
        Self { surface, contact_modulus, load, expected_mean_pressure, rms_height, rms_gradient }.with_load(load)
    }

    /// The same surface and solid under another load.
    ///
    /// # Errors
    /// Those of [`Problem::new`] and [`Problem::at_mean_gap`] that concern the load.
    pub fn with_load(self, load: Load) -> Result<Self, ProblemError> {
        let expected_mean_pressure = match load {
            Load::MeanPressure(mean_pressure) => {
                check_magnitude("mean pressure", mean_pressure)?;
                mean_pressure
            }
            Load::MeanGap(mean_gap) => {
                self.check_mean_gap(mean_gap)?;
                self.pressure_at(mean_gap)
            }
        };
        Ok(Self { load, expected_mean_pressure, ..self })
    }

    fn check_mean_gap(&self, mean_gap: f64) -> Result<(), ProblemError> {
        let highest = self.height().iter().fold(0.0, |highest: f64, &h| highest.max(h));
        if mean_gap.is_finite() && mean_gap <= 0.0 {
            return Err(ProblemError::EverythingTouches { mean_gap, highest });
        }
        check_magnitude("mean gap", mean_gap)?;
        if mean_gap < highest { Ok(()) } else { Err(ProblemError::NothingTouches { mean_gap, highest }) }
    }

    /// A rough estimate of the mean pressure at a mean gap. Far apart, half of the nodes above it touch, and the share of the
    /// area that touches is twice the reduced pressure. Close together, the gap falls exponentially with the pressure, as
    /// measured on rough lines and surfaces down to a thousandth of the rms height.
    fn pressure_at(&self, mean_gap: f64) -> f64 {
        let above = self.height().iter().filter(|&&h| h > mean_gap).count();
        let far = 0.25 * above as f64 / self.nodes() as f64;
        let close = (self.rms_height / mean_gap).ln() / GAP_DECAY;
        far.max(close) * self.rms_gradient() * self.contact_modulus
    }

    /// The rigid surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Contact modulus `E*`.
    pub fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    /// What is prescribed.
    pub fn load(&self) -> Load {
        self.load
    }

    /// The mean pressure that is prescribed or, at a given mean gap, that of `pressure`.
    pub fn mean_pressure_of(&self, pressure: &[f64]) -> f64 {
        match self.load {
            Load::MeanPressure(mean_pressure) => mean_pressure,
            Load::MeanGap(_) => chunks::sum(pressure.len(), |i| pressure[i]) / pressure.len() as f64,
        }
    }

    /// The mean pressure to start from: the one that is prescribed or, at a given mean gap, an estimate that may be several
    /// times too large or small, but is positive and finite.
    pub fn expected_mean_pressure(&self) -> f64 {
        self.expected_mean_pressure
    }

    /// Heights about their mean, row by row: those of the surface.
    pub fn height(&self) -> &[f64] {
        self.surface.heights()
    }

    /// Root mean square of the heights about their mean.
    pub fn rms_height(&self) -> f64 {
        self.rms_height
    }

    /// Root-mean-square gradient `gbar` of the whole surface; computed when first asked for.
    pub fn rms_gradient(&self) -> f64 {
        *self.rms_gradient.get_or_init(|| self.surface.rms_gradient())
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.surface.grid().len()
    }
}

fn check_magnitude(name: &'static str, value: f64) -> Result<(), ProblemError> {
    if !(value.is_finite() && value > 0.0) {
        return Err(ProblemError::NotPositive { name, value });
    }
    if (1e-100..=1e100).contains(&value) { Ok(()) } else { Err(ProblemError::OutOfRange { name, value }) }
}

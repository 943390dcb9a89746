//! The problem that all solvers solve.

use crate::contact::{Load, chunks};
use crate::error::ProblemError;
use crate::surface::{Field, Surface};
use std::sync::{Arc, OnceLock};

/// Per reduced pressure, the mean gap of rough surfaces near full contact falls by this power of e: 5 to 6, as measured.
const GAP_DECAY: f64 = 5.5;

/// A pressure to start from at a mean gap is so many times the expected one at the most.
const FARTHEST: f64 = 1e6;

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
/// use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
/// use asperity::{Grid, Problem, Stop, surface::Indenter};
/// let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(1024, 1.0)?)?;
/// let pressed = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(2.0))?;
/// let contact = PolonskyKeer.solve(&pressed, &Stop::default(), &mut ())?.converged()?;
/// let apart = pressed.with_load(Load::MeanGap(contact.mean_gap()))?;
/// let contact = PolonskyKeer.solve(&apart, &Stop::default(), &mut ())?.converged()?;
/// assert!((contact.mean_pressure() - 2.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Problem {
    surface: Arc<Surface>,
    contact_modulus: f64,
    load: Load,
    /// The mean pressure that is prescribed, in whatever form.
    mean_pressure: Option<f64>,
    expected_mean_pressure: f64,
    rms_height: f64,
    highest: f64,
    rms_gradient: OnceLock<f64>,
}

/// The contact modulus `E* = E / (1 - nu^2)` of an elastic half-space, a pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactModulus(pub f64);

impl Problem {
    /// Poses the problem of a surface, pressed by a load on a solid of a contact modulus. A mean gap must lie between 0 and the
    /// highest peak above the mean height.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a modulus or load that is not positive and finite, [`ProblemError::Flat`] if all
    /// heights are equal, [`ProblemError::OutOfRange`] for magnitudes whose squares leave the range of doubles, and
    /// [`ProblemError::NothingTouches`] or [`ProblemError::EverythingTouches`] for a mean gap at which there is nothing to
    /// solve.
    pub fn new(
        surface: impl Into<Arc<Surface>>,
        ContactModulus(contact_modulus): ContactModulus,
        load: Load,
    ) -> Result<Self, ProblemError> {
        let surface = surface.into();
        check_magnitude("contact modulus", contact_modulus)?;
        let height = surface.heights();
        if height.iter().all(|&h| h == height[0]) {
            return Err(ProblemError::Flat { height: height[0] + surface.mean_height() });
        }
        let rms_height = (chunks::sum(height.len(), |i| height[i].powi(2)) / height.len() as f64).sqrt();
        check_magnitude("rms height", rms_height)?;
        check_magnitude("length of the cell", surface.grid().longest_wavelength())?;
        let highest = height.iter().fold(0.0, |highest: f64, &h| highest.max(h));
        let (mean_pressure, expected_mean_pressure, rms_gradient) = (None, f64::NAN, OnceLock::new());
        Self {
            surface,
            contact_modulus,
            load,
            mean_pressure,
            expected_mean_pressure,
            rms_height,
            highest,
            rms_gradient,
        }
        .with_load(load)
    }

    /// The problem of the same surface and solid under another load.
    ///
    /// # Errors
    /// The errors of [`Problem::new`] that concern the load.
    pub fn with_load(self, load: Load) -> Result<Self, ProblemError> {
        let mean_pressure = match load {
            Load::MeanPressure(mean_pressure) => Some(mean_pressure),
            Load::ReducedPressure(reduced_pressure) => {
                check_magnitude("reduced pressure", reduced_pressure)?;
                Some(reduced_pressure * self.rms_gradient() * self.contact_modulus)
            }
            Load::MeanGap(mean_gap) => {
                self.check_mean_gap(mean_gap)?;
                None
            }
        };
        mean_pressure.map_or(Ok(()), |mean_pressure| check_magnitude("mean pressure", mean_pressure))?;
        let expected_mean_pressure = match (mean_pressure, load) {
            (None, Load::MeanGap(mean_gap)) => self.pressure_at(mean_gap),
            _ => mean_pressure.unwrap_or(f64::NAN),
        };
        Ok(Self { load, mean_pressure, expected_mean_pressure, ..self })
    }

    fn check_mean_gap(&self, mean_gap: f64) -> Result<(), ProblemError> {
        let highest = self.highest;
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

    /// The load, as it was given.
    pub fn load(&self) -> Load {
        self.load
    }

    /// The mean pressure, where it is prescribed, as itself or as a reduced pressure.
    pub fn mean_pressure(&self) -> Option<f64> {
        self.mean_pressure
    }

    /// The mean gap, where it is prescribed.
    pub fn mean_gap(&self) -> Option<f64> {
        match self.load {
            Load::MeanGap(mean_gap) => Some(mean_gap),
            Load::MeanPressure(_) | Load::ReducedPressure(_) => None,
        }
    }

    /// The mean pressure that is prescribed or, at a given mean gap, that of `pressure`.
    pub fn mean_pressure_of(&self, pressure: &[f64]) -> f64 {
        self.mean_pressure.unwrap_or_else(|| chunks::sum(pressure.len(), |i| pressure[i]) / pressure.len() as f64)
    }

    /// The pressure that a run starts from: what `start` holds of one, or the uniform pressure. It is scaled to the mean pressure if
    /// that is given, and to the expected one if it is so much higher that rounding would hide what it displaces. Values that are no
    /// pressures (negative, not finite) count as none.
    ///
    /// # Panics
    /// If the shape of `start` is not that of the grid.
    pub fn first_pressure(&self, start: Option<&Field>) -> Vec<f64> {
        let load = self.expected_mean_pressure;
        let Some(start) = start else { return vec![load; self.nodes()] };
        assert_eq!(start.shape(), self.surface.grid().shape(), "the start must fit the grid");
        let pressure: Vec<f64> = start.iter().map(|&p| if p.is_finite() { p.max(0.0) } else { 0.0 }).collect();
        let highest = chunks::visit(pressure.len(), |range| range.fold(0.0, |high: f64, i| high.max(pressure[i])));
        let highest = highest.into_iter().fold(0.0, f64::max);
        if highest <= 0.0 {
            return vec![load; pressure.len()];
        }
        let mean = chunks::sum(pressure.len(), |i| pressure[i] / highest) / pressure.len() as f64;
        if self.mean_pressure.is_none() && highest * mean <= FARTHEST * load {
            return pressure;
        }
        pressure.into_iter().map(|p| p / highest * (load / mean)).collect()
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

    /// The highest peak above the mean height, above which no mean gap lets the surfaces touch.
    pub fn highest(&self) -> f64 {
        self.highest
    }

    /// Root-mean-square gradient `gbar` of the whole surface; computed when first asked for.
    pub fn rms_gradient(&self) -> f64 {
        *self.rms_gradient.get_or_init(|| self.surface.rms_gradient())
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.surface.grid().len()
    }
}

fn check_magnitude(name: &'static str, value: f64) -> Result<(), ProblemError> {
    if !(value.is_finite() && value > 0.0) {
        return Err(ProblemError::NotPositive { name, value });
    }
    if (1e-100..=1e100).contains(&value) { Ok(()) } else { Err(ProblemError::OutOfRange { name, value }) }
}

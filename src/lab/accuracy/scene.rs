//! The scenes: surface, load and grids.

use crate::contact::Load;
use crate::error::SetupError;
use crate::setup::{Cell, Recipe, Setup, Solid};
use crate::surface::{Indenter, Spectrum};
use crate::theory::Exact;
use std::f64::consts::PI;

/// Length of the cell; the contact modulus is 1 as well.
const CELL: f64 = 1.0;
/// Radius of cylinder and sphere.
pub(crate) const RADIUS: f64 = CELL / 4.0;
/// Amplitude of the sine.
pub(crate) const AMPLITUDE: f64 = 0.01;
const RMS_GRADIENT: f64 = 1e-3;
const REDUCED_PRESSURE: f64 = 0.05;

/// A contact on successively finer grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum AccuracyScene {
    /// A sine on a line, at a fifth of the pressure of full contact
    Sine,
    /// A cylinder on a line
    Cylinder,
    /// A sphere on a surface
    Sphere,
    /// A self-affine line of Hurst exponent 0.8, p* = 0.05
    RoughLine,
    /// A self-affine surface of Hurst exponent 0.8, p* = 0.05
    RoughSurface,
}

impl AccuracyScene {
    /// The name of the scene, as on the command line.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether the scene is a line.
    pub fn is_line(self) -> bool {
        matches!(self, Self::Sine | Self::Cylinder | Self::RoughLine)
    }

    /// Whether the scene is rough.
    pub fn is_rough(self) -> bool {
        matches!(self, Self::RoughLine | Self::RoughSurface)
    }

    /// Points along each side of the grids if none are named.
    pub fn sides(self, is_quick: bool) -> &'static [usize] {
        match (self, is_quick) {
            (Self::Sine | Self::Cylinder, false) => &[256, 1024, 4096, 16384],
            (Self::Sine | Self::Cylinder, true) => &[128, 512, 2048],
            (Self::RoughLine, false) => &[1024, 4096, 16384, 65536],
            (Self::RoughLine, true) => &[512, 1024, 2048],
            (Self::Sphere | Self::RoughSurface, false) => &[64, 128, 256, 512],
            (Self::Sphere | Self::RoughSurface, true) => &[32, 64, 128],
        }
    }

    /// The mean pressure that the curves are measured at, the least of those of the ladder.
    pub fn mean_pressure(self) -> f64 {
        match self {
            Self::Sine => 0.2 * PI * AMPLITUDE,
            Self::Cylinder => 8e-3,
            Self::Sphere => 0.03,
            Self::RoughLine | Self::RoughSurface => REDUCED_PRESSURE * RMS_GRADIENT,
        }
    }

    /// Points along y and x with `points` along each side.
    pub fn shape(self, points: usize) -> [usize; 2] {
        [if self.is_line() { 1 } else { points }, points]
    }

    /// The cell with `points` along each side.
    pub fn cell(self, points: usize) -> Cell {
        if self.is_line() { Cell::line(points, CELL) } else { Cell::surface([points; 2], [CELL; 2]) }
    }

    /// The setup under the load of the curves, with roughness that is scaled on this grid.
    pub fn setup(self, points: usize, seed: u64) -> Setup {
        let load = Load::MeanPressure(self.mean_pressure());
        Setup::new(self.recipe(seed), self.cell(points), load).on(Solid::ContactModulus(1.0))
    }

    /// The exact solution, if it is one of the periodic problem.
    pub(super) fn exact(self, points: usize, mean_pressure: f64) -> Result<Option<Exact>, SetupError> {
        let setup = self.setup(points, 1);
        let exact = setup.exact(&setup.grid.grid()?, mean_pressure);
        Ok(exact.filter(|exact| exact.mean_gap.is_some()))
    }

    fn recipe(self, seed: u64) -> Recipe {
        match self {
            Self::Sine => Recipe::indenter(Indenter::Sine { amplitude: AMPLITUDE }),
            Self::Cylinder => Recipe::indenter(Indenter::Cylinder { radius: RADIUS }),
            Self::Sphere => Recipe::indenter(Indenter::Sphere { radius: RADIUS }),
            Self::RoughLine => rough(CELL / 8.0, CELL / 256.0, seed),
            Self::RoughSurface => rough(CELL / 2.0, CELL / 16.0, seed),
        }
    }
}

fn rough(rolloff_wavelength: f64, short_cutoff: f64, seed: u64) -> Recipe {
    Recipe::rough(Spectrum { hurst: 0.8, rolloff_wavelength, short_cutoff, rms_gradient: RMS_GRADIENT }, seed)
}

//! The scenes: what is pressed, how hard, and on which ladder of grids.

use anyhow::Result;
use asperity::surface::{Indenter, Spectrum};
use asperity::theory::Exact;
use asperity::{Grid, Problem, Surface};
use clap::ValueEnum;
use serde::Serialize;
use std::f64::consts::PI;

/// Length of the cell; the contact modulus is 1 as well.
const CELL: f64 = 1.0;
/// Of cylinder and sphere.
pub const RADIUS: f64 = CELL / 4.0;
/// Of the sine.
pub const AMPLITUDE: f64 = 0.01;
const RMS_GRADIENT: f64 = 1e-3;
const REDUCED_PRESSURE: f64 = 0.05;

/// One contact on ever finer grids.
#[derive(Clone, Copy, PartialEq, Debug, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scene {
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

impl Scene {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Sine, Self::Cylinder, Self::Sphere, Self::RoughLine, Self::RoughSurface];

    /// Its name, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sine => "sine",
            Self::Cylinder => "cylinder",
            Self::Sphere => "sphere",
            Self::RoughLine => "rough-line",
            Self::RoughSurface => "rough-surface",
        }
    }

    /// Whether it is a line.
    pub fn is_line(self) -> bool {
        matches!(self, Self::Sine | Self::Cylinder | Self::RoughLine)
    }

    /// Points along each side of the grids if none are named.
    pub fn ladder(self, quick: bool) -> &'static [usize] {
        match (self, quick) {
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

    /// Its grid of `points` along each side.
    pub fn grid(self, points: usize) -> Result<Grid> {
        let shape = if self.is_line() { Grid::line(points, CELL) } else { Grid::surface([points; 2], [CELL; 2]) };
        Ok(shape?)
    }

    /// The problem under the load of the curves.
    pub fn problem(self, points: usize, seed: u64) -> Result<Problem> {
        let grid = self.grid(points)?;
        let surface = match self.indenter() {
            Some(indenter) => indenter.surface(grid)?,
            None => Surface::rough(grid, &self.spectrum(), seed)?,
        };
        Ok(Problem::new(surface, 1.0, self.mean_pressure())?)
    }

    /// The exact solution, if it is one of the periodic problem.
    pub fn exact(self, points: usize, mean_pressure: f64) -> Result<Option<Exact>> {
        let grid = self.grid(points)?;
        let exact = self.indenter().and_then(|indenter| Exact::of(&indenter, &grid, 1.0, mean_pressure));
        Ok(exact.filter(|exact| exact.mean_gap.is_some()))
    }

    fn indenter(self) -> Option<Indenter> {
        match self {
            Self::Sine => Some(Indenter::Sine { amplitude: AMPLITUDE }),
            Self::Cylinder => Some(Indenter::Cylinder { radius: RADIUS }),
            Self::Sphere => Some(Indenter::Sphere { radius: RADIUS }),
            Self::RoughLine | Self::RoughSurface => None,
        }
    }

    /// Self-affine between 1/8 and 1/256 of the cell on lines, 1/2 and 1/16 on surfaces.
    fn spectrum(self) -> Spectrum {
        let [rolloff_wavelength, short_cutoff] =
            if self.is_line() { [CELL / 8.0, CELL / 256.0] } else { [CELL / 2.0, CELL / 16.0] };
        Spectrum { hurst: 0.8, rolloff_wavelength, short_cutoff, rms_gradient: RMS_GRADIENT }
    }
}

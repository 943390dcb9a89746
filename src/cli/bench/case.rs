//! The cases: what is pressed, how hard, and on how many points.

use crate::cli::method::Method;
use anyhow::Result;
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Problem, Surface};
use clap::ValueEnum;
use serde::Serialize;
use std::f64::consts::{PI, SQRT_2};
use std::fmt;

/// Points of the series on lines, and along each side of the series on surfaces.
const LINES: [usize; 4] = [1 << 12, 1 << 14, 1 << 16, 1 << 18];
const SURFACES: [usize; 4] = [256, 512, 1024, 2048];
/// The most points of a quick case, and the spacings that its shortest wavelength has at the least.
const QUICK_LINE: usize = 1 << 14;
const QUICK_SURFACE: usize = 256;
const QUICK_SPACINGS: f64 = 4.0;

/// Length of the cell; the contact modulus is 1 as well.
const CELL: f64 = 1.0;
/// Of cylinder and sphere.
const RADIUS: f64 = CELL / 4.0;
/// Of the waves.
const AMPLITUDE: f64 = 0.01;
/// Of wedge and cone.
const SLOPE: f64 = 0.1;

/// Indenters and their mean pressures: a relative area of about 0.1, and half of full contact for the waves.
const ON_LINES: [(&str, Indenter, f64); 4] = [
    ("cylinder", Indenter::Cylinder { radius: RADIUS }, 8e-3),
    ("sine", Indenter::Sine { amplitude: AMPLITUDE }, 0.5 * PI * AMPLITUDE),
    ("wedge", Indenter::Wedge { slope: SLOPE }, 0.05 * SLOPE),
    ("fourth power", Indenter::PowerLaw { coefficient: 100.0, exponent: 4.0 }, 1.5e-3),
];
const ON_SURFACES: [(&str, Indenter, f64); 3] = [
    ("sphere", Indenter::Sphere { radius: RADIUS }, 0.03),
    ("crossed sine", Indenter::CrossedSine { amplitude: AMPLITUDE }, 0.5 * SQRT_2 * PI * AMPLITUDE),
    ("cone", Indenter::Cone { slope: SLOPE }, 0.05 * SLOPE),
];

const HURST: [f64; 3] = [0.2, 0.5, 0.8];
const REDUCED_PRESSURES: [f64; 3] = [1e-3, 1e-2, 1e-1];

/// Cases that belong together.
#[derive(Clone, Copy, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Indenters on lines of 2^12 to 2^18 and surfaces of 256^2 to 2048^2 points
    Smooth,
    /// Rough surfaces of 2048^2 points, short cut-off 1/64 of the roll-off
    Surfaces,
    /// Rough lines of 2^18 points, short cut-off 1/512 of the roll-off
    Lines,
    /// Rough lines and surfaces of a fixed spectrum on ever finer grids
    Growth,
    /// A rough surface of 2048^2 and a line of 2^18 points, by conjugate gradients as well
    Peers,
    /// A rough surface of 16384^2 points, which takes minutes and many GiB of memory
    Large,
}

impl Group {
    /// The groups that run if none is named.
    pub const USUAL: [Self; 5] = [Self::Smooth, Self::Surfaces, Self::Lines, Self::Growth, Self::Peers];

    /// Its cases, or smaller ones of the kind.
    pub fn cases(self, quick: bool) -> Vec<Case> {
        let cases = match self {
            Self::Smooth => smooth(),
            Self::Surfaces => grades(Size::Surface(2048), 64.0),
            Self::Lines => grades(Size::Line(1 << 18), 512.0),
            Self::Growth => growth(),
            Self::Peers => {
                vec![
                    Case::rough(Size::Surface(2048), 64.0, 0.8, 1e-1),
                    Case::rough(Size::Line(1 << 18), 512.0, 0.2, 1e-2),
                ]
            }
            Self::Large => vec![Case::rough(Size::Surface(1 << 14), 64.0, 0.8, 1e-2)],
        };
        if !quick {
            return cases;
        }
        let mut cases: Vec<Case> = cases.into_iter().map(Case::quick).collect();
        cases.dedup();
        cases
    }

    /// The solvers to use if none is named.
    pub fn methods(self) -> &'static [Method] {
        match self {
            Self::Peers => &[Method::Multilevel, Method::PolonskyKeer],
            _ => &[Method::Multilevel],
        }
    }

    /// The certificate to reach if none is named.
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Large => 1e-6,
            _ => 1e-8,
        }
    }
}

/// Every indenter on every grid of its kind.
fn smooth() -> Vec<Case> {
    let case = |(name, indenter, mean_pressure): (&str, _, _), size| {
        let relief = Relief::Smooth { indenter, mean_pressure };
        Case { name: name.into(), size, relief }
    };
    let lines = ON_LINES.into_iter().flat_map(|body| LINES.map(|n| case(body, Size::Line(n))));
    let surfaces = ON_SURFACES.into_iter().flat_map(|body| SURFACES.map(|n| case(body, Size::Surface(n))));
    lines.chain(surfaces).collect()
}

/// Every Hurst exponent at every load.
fn grades(size: Size, waves: f64) -> Vec<Case> {
    let of_hurst = |hurst| REDUCED_PRESSURES.map(|reduced| Case::rough(size, waves, hurst, reduced));
    HURST.into_iter().flat_map(of_hurst).collect()
}

/// Fixed spectra on every grid.
fn growth() -> Vec<Case> {
    let lines = |hurst| LINES.map(|n| Case::rough(Size::Line(n), 64.0, hurst, 1e-2));
    let surfaces = |hurst| SURFACES.map(|n| Case::rough(Size::Surface(n), 16.0, hurst, 1e-2));
    [lines(0.8), lines(0.2), surfaces(0.8), surfaces(0.2)].concat()
}

/// One contact to be solved.
#[derive(Clone, PartialEq)]
pub struct Case {
    pub name: String,
    pub size: Size,
    relief: Relief,
}

/// Points of a line, or along each side of a surface.
#[derive(Clone, Copy, PartialEq)]
pub enum Size {
    Line(usize),
    Surface(usize),
}

#[derive(Clone, Copy, PartialEq)]
enum Relief {
    Smooth { indenter: Indenter, mean_pressure: f64 },
    Rough { spectrum: Spectrum, reduced_pressure: f64 },
}

impl Case {
    /// Self-affine roughness with a roll-off at 1/8 of the cell for lines, 1/4 for surfaces, and a short cut-off at
    /// `1/waves` of that.
    fn rough(size: Size, waves: f64, hurst: f64, reduced_pressure: f64) -> Self {
        let rolloff_wavelength = match size {
            Size::Line(_) => CELL / 8.0,
            Size::Surface(_) => CELL / 4.0,
        };
        let short_cutoff = rolloff_wavelength / waves;
        let spectrum = Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient: 1e-3 };
        let name = format!("H {hurst} p* {reduced_pressure}");
        Self { name, size, relief: Relief::Rough { spectrum, reduced_pressure } }
    }

    /// The same on a small grid, without the waves that are too short for it.
    fn quick(mut self) -> Self {
        self.size = self.size.quick();
        if let Relief::Rough { spectrum, .. } = &mut self.relief {
            let shortest = QUICK_SPACINGS * CELL / self.size.side() as f64;
            spectrum.short_cutoff = spectrum.short_cutoff.max(shortest);
        }
        self
    }

    /// Makes the surface and poses the problem.
    pub fn problem(&self, seed: u64) -> Result<Problem> {
        let grid = self.size.grid()?;
        Ok(match &self.relief {
            Relief::Smooth { indenter, mean_pressure } => Problem::new(indenter.surface(grid)?, 1.0, *mean_pressure)?,
            Relief::Rough { spectrum, reduced_pressure } => {
                Problem::at_reduced_pressure(Surface::rough(grid, spectrum, seed)?, 1.0, *reduced_pressure)?
            }
        })
    }
}

impl Size {
    fn grid(self) -> Result<Grid> {
        Ok(match self {
            Self::Line(n) => Grid::line(n, CELL)?,
            Self::Surface(n) => Grid::surface([n, n], [CELL, CELL])?,
        })
    }

    fn side(self) -> usize {
        match self {
            Self::Line(n) | Self::Surface(n) => n,
        }
    }

    fn quick(self) -> Self {
        match self {
            Self::Line(n) => Self::Line(n.min(QUICK_LINE)),
            Self::Surface(n) => Self::Surface(n.min(QUICK_SURFACE)),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(n) => f.pad(&n.to_string()),
            Self::Surface(n) => f.pad(&format!("{n}x{n}")),
        }
    }
}

//! The contests of each group: what is pressed, how hard, and on how many points.

use super::group::Group;
use crate::contact::Load;
use crate::setup::{Cell, Recipe, Setup, Solid};
use crate::surface::{Indenter, SpectralDensity, Spectrum};
use std::f64::consts::{PI, SQRT_2};

/// Length of the cell; the contact modulus is 1 as well.
const CELL: f64 = 1.0;
/// Points of the series on lines, and along each side of the series on surfaces.
const LINES: [usize; 4] = [1 << 12, 1 << 14, 1 << 16, 1 << 18];
const SURFACES: [usize; 4] = [256, 512, 1024, 2048];

/// Radius of cylinder and sphere.
const RADIUS: f64 = CELL / 4.0;
/// Amplitude of the waves.
const AMPLITUDE: f64 = 0.01;
/// Slope of wedge and cone.
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

/// One contact to be solved.
#[derive(Clone, PartialEq)]
pub struct Contest {
    pub(super) group: Group,
    /// Name in tables.
    pub name: String,
    /// The contact; the methods and their stop come later.
    pub(super) setup: Setup,
}

impl Contest {
    /// The contests of a group, or smaller ones of their kind, with rough surfaces of a seed.
    pub fn all(group: Group, is_quick: bool, seed: u64) -> Vec<Self> {
        let rough = |cell, waves, hurst, pressure| Self::rough(group, cell, waves, hurst, pressure, seed);
        // every Hurst exponent at every load
        let grades = |cell: Cell, waves| {
            let of_hurst = |hurst| [1e-3, 1e-2, 1e-1].map(|pressure| rough(cell.clone(), waves, hurst, pressure));
            [0.2, 0.5, 0.8].into_iter().flat_map(of_hurst).collect()
        };
        let mut contests = match group {
            Group::Smooth => Self::smooth(group),
            Group::Surfaces => grades(surface(2048), 64.0),
            Group::Lines => grades(line(1 << 18), 512.0),
            Group::Growth => {
                let lines = |hurst| LINES.map(|n| rough(line(n), 64.0, hurst, 1e-2));
                let surfaces = |hurst| SURFACES.map(|n| rough(surface(n), 16.0, hurst, 1e-2));
                [lines(0.8), lines(0.2), surfaces(0.8), surfaces(0.2)].concat()
            }
            Group::Peers => vec![rough(surface(2048), 64.0, 0.8, 1e-1), rough(line(1 << 18), 512.0, 0.2, 1e-2)],
            Group::Rivals => {
                // the short cut-off is four spacings
                let of_cell = |cell: Cell, hurst, load| rough(cell.clone(), cell.points[0] as f64 / 16.0, hurst, load);
                let of_load = |is_free, hurst, load| {
                    let cells = [512, 1024, 2048].map(surface).map(|cell| if is_free { cell.free() } else { cell });
                    cells.map(|cell| of_cell(cell, hurst, load))
                };
                let of_hurst = |is_free, hurst| [1e-3, 1e-2, 1e-1].map(|load| of_load(is_free, hurst, load)).concat();
                [false, true].map(|is_free| [0.8, 0.2].map(|hurst| of_hurst(is_free, hurst)).concat()).concat()
            }
            Group::Contact => {
                let cells = [surface(4096), surface(4096).free()];
                let loads = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1];
                let of_cell = |cell: Cell| loads.map(|load| rough(cell.clone(), 64.0, 0.8, load));
                cells.map(of_cell).concat()
            }
            // these are no single contacts
            Group::Histories => Vec::new(),
            Group::Large => vec![rough(surface(1 << 14), 64.0, 0.8, 1e-2)],
        };
        if is_quick {
            contests.iter_mut().for_each(Self::shrink);
            contests.dedup();
        }
        contests
    }

    /// Every indenter on every grid of its kind, under its mean pressure.
    fn smooth(group: Group) -> Vec<Self> {
        let lines = ON_LINES.into_iter().flat_map(|body| LINES.map(|n| (body, line(n))));
        let surfaces = ON_SURFACES.into_iter().flat_map(|body| SURFACES.map(|n| (body, surface(n))));
        let contest = |((name, indenter, pressure), cell): ((&str, _, _), _)| Self {
            group,
            name: name.into(),
            setup: Setup::new(Recipe::indenter(indenter), cell, Load::MeanPressure(pressure))
                .on(Solid::ContactModulus(1.0)),
        };
        lines.chain(surfaces).map(contest).collect()
    }

    /// Self-affine roughness with a roll-off at 1/8 of the cell for lines, 1/4 for surfaces, and a short cut-off at
    /// `1/waves` of that.
    fn rough(group: Group, cell: Cell, waves: f64, hurst: f64, reduced_pressure: f64, seed: u64) -> Self {
        let rolloff_wavelength = if is_line(&cell) { CELL / 8.0 } else { CELL / 4.0 };
        let short_cutoff = rolloff_wavelength / waves;
        let spectrum = Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient: 1e-3 };
        let setup = Setup::new(Recipe::rough(spectrum, seed), cell, Load::ReducedPressure(reduced_pressure));
        let boundary = if setup.grid.boundary.is_empty() { "" } else { " free" };
        // the names of a group with one exponent leave it out, so that they fit the column
        let exponent = if group == Group::Contact { String::new() } else { format!("H {hurst} ") };
        Self { group, name: format!("{exponent}p* {reduced_pressure}{boundary}"), setup }
    }

    /// Makes the grid small, and leaves out the waves that are shorter than four of its spacings.
    fn shrink(&mut self) {
        let Setup { grid, surface, .. } = &mut self.setup;
        let most = if is_line(grid) { 1 << 14 } else { 256 };
        grid.points.iter_mut().for_each(|points| *points = most.min(*points));
        if let Some(SpectralDensity::SelfAffine(spectrum)) = surface.spectrum.as_mut().map(|it| &mut it.spectrum) {
            spectrum.short_cutoff = spectrum.short_cutoff.max(4.0 * CELL / grid.points[0] as f64);
        }
    }

    /// Points of the grid, in words.
    pub fn points(&self) -> String {
        self.setup.grid.points.iter().map(usize::to_string).collect::<Vec<_>>().join("x")
    }
}

fn is_line(cell: &Cell) -> bool {
    cell.points.len() == 1
}

fn line(points: usize) -> Cell {
    Cell::line(points, CELL)
}

fn surface(side: usize) -> Cell {
    Cell::surface([side; 2], [CELL; 2])
}

//! The contests of each group: what is pressed, how hard, and on how many points.

use super::contest::{CELL, Contest};
use super::group::Group;
use crate::setup::Cell;
use crate::surface::Indenter;
use std::f64::consts::{PI, SQRT_2};

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

const HURST: [f64; 3] = [0.2, 0.5, 0.8];
const REDUCED_PRESSURES: [f64; 3] = [1e-3, 1e-2, 1e-1];

impl Group {
    /// The contests of the group, or smaller ones of their kind, with rough surfaces of a seed.
    pub fn contests(self, is_quick: bool, seed: u64) -> Vec<Contest> {
        let rough = |cell, waves, hurst, pressure| Contest::rough(self, cell, waves, hurst, pressure, seed);
        // every Hurst exponent at every load
        let grades = |cell: Cell, waves| {
            let of_hurst = |hurst| REDUCED_PRESSURES.map(|pressure| rough(cell.clone(), waves, hurst, pressure));
            HURST.into_iter().flat_map(of_hurst).collect()
        };
        let contests = match self {
            Self::Smooth => self.smooth(),
            Self::Surfaces => grades(surface(2048), 64.0),
            Self::Lines => grades(line(1 << 18), 512.0),
            Self::Growth => {
                let lines = |hurst| LINES.map(|n| rough(line(n), 64.0, hurst, 1e-2));
                let surfaces = |hurst| SURFACES.map(|n| rough(surface(n), 16.0, hurst, 1e-2));
                [lines(0.8), lines(0.2), surfaces(0.8), surfaces(0.2)].concat()
            }
            Self::Peers => vec![rough(surface(2048), 64.0, 0.8, 1e-1), rough(line(1 << 18), 512.0, 0.2, 1e-2)],
            Self::Large => vec![rough(surface(1 << 14), 64.0, 0.8, 1e-2)],
        };
        if !is_quick {
            return contests;
        }
        let mut contests: Vec<Contest> = contests.into_iter().map(Contest::quick).collect();
        contests.dedup();
        contests
    }

    /// Every indenter on every grid of its kind.
    fn smooth(self) -> Vec<Contest> {
        let lines = ON_LINES.into_iter().flat_map(|body| LINES.map(|n| (body, line(n))));
        let surfaces = ON_SURFACES.into_iter().flat_map(|body| SURFACES.map(|n| (body, surface(n))));
        lines.chain(surfaces).map(|(body, cell)| Contest::smooth(self, body, cell)).collect()
    }
}

fn line(points: usize) -> Cell {
    Cell::line(points, CELL)
}

fn surface(side: usize) -> Cell {
    Cell::surface([side; 2], [CELL; 2])
}

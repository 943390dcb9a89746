//! The patches of a contact, for the page: each beside its Hertz twin.

use super::columns::columns;
use crate::contact::{Contact, Law, Patch, Problem, Resolution};
use crate::grid::Grid;
use crate::theory::hertz;
use serde::Serialize;
use std::f64::consts::PI;
use std::ops::Range;

/// Largest number of patches that are reported, the largest first, and of patches that are drawn.
const MOST: usize = 4000;
const DRAWN: usize = 100;
/// The most columns of the map of a line, and rows and columns of that of a surface.
const LINE_COLUMNS: usize = 1024;
const SURFACE_COLUMNS: usize = 160;
/// The most points of a drawn patch.
const POINTS: usize = 49;

/// All patches of a contact, and where they are.
#[derive(Serialize)]
pub(crate) struct PatchTable {
    /// The largest ones, these first.
    pub patches: Vec<PatchRow>,
    /// How many there are.
    pub count: usize,
    /// The fewest nodes of a patch whose numbers mean something.
    pub fewest_nodes: usize,
    /// Whether they lie on an elastic half-space, as their twins do.
    pub is_hertzian: bool,
    /// Rows and columns of the grid.
    pub grid: [usize; 2],
    /// Rows and columns of the map.
    pub shape: [usize; 2],
    /// Lengths of the cell along both.
    pub size: [f64; 2],
    /// The number of the patch at each place of the map, from 1 on, row by row; 0 for none.
    pub map: Vec<u16>,
}

/// One patch. Lengths in metres, pressures over the contact modulus.
#[derive(Serialize)]
pub(crate) struct PatchRow {
    /// Nodes in contact.
    pub nodes: usize,
    /// Where its pressure is largest, along the rows and along the columns.
    pub place: [f64; 2],
    /// Area, or length of a line, of its nodes.
    pub area: f64,
    /// The share of the whole load that it carries.
    pub share: f64,
    /// Largest pressure.
    pub max_pressure: f64,
    /// Its own area-load factor, with the gradient of its own nodes.
    pub kappa_r: f64,
    /// Mean curvature over its nodes, an inverse length.
    pub curvature: f64,
    /// The parabola of the same load and curvature; none for a patch that is hollow.
    pub twin: Option<HertzParabola>,
    /// Heights and pressures along it; left out of the smaller patches.
    pub profile: Option<PatchProfile>,
}

/// A parabola on a half-space that carries the load of a patch with its curvature (Hertz).
#[derive(Serialize)]
pub(crate) struct HertzParabola {
    /// Half-width or radius of its contact.
    pub half_width: f64,
    /// Area, or length of a line, of its contact.
    pub area: f64,
    /// Largest pressure.
    pub max_pressure: f64,
    /// Its area-load factor, the same for all parabolas.
    pub kappa_r: f64,
}

/// A patch along the row of its largest pressure, with as much again on both sides.
#[derive(Serialize)]
pub(crate) struct PatchProfile {
    /// Places, from that of the largest pressure on.
    pub x: Vec<f32>,
    /// Heights of the rigid surface above that place.
    pub height: Vec<f32>,
    /// Pressures.
    pub pressure: Vec<f32>,
}

impl PatchTable {
    /// The patches of a contact.
    pub(crate) fn new(contact: &Contact) -> Self {
        let (problem, pressure) = (&contact.problem, contact.pressure.as_slice().unwrap_or_default());
        let grid = problem.surface().grid();
        let [ny, nx] = grid.shape();
        let most = if grid.is_line() { LINE_COLUMNS } else { SURFACE_COLUMNS };
        let shape = [ny.min(most), nx.min(most)];
        let mut all = Patch::with_nodes(problem, pressure);
        let count = all.len();
        all.truncate(MOST);
        let mut map = vec![0; shape[0] * shape[1]];
        // smaller patches are not hidden by larger ones
        for (number, (_, runs)) in (1..).zip(&all) {
            for node in runs.iter().cloned().flatten() {
                map[(node / nx * shape[0] / ny) * shape[1] + node % nx * shape[1] / nx] = number;
            }
        }
        let whole: f64 = contact.mean_pressure() * grid.area();
        let row = |(number, (patch, runs)): (usize, &(Patch, Vec<Range<usize>>))| PatchRow {
            profile: (number < DRAWN).then(|| PatchProfile::new(problem, pressure, patch, runs)),
            ..PatchRow::new(problem, pressure, patch, whole)
        };
        Self {
            patches: all.iter().enumerate().map(row).collect(),
            count,
            fewest_nodes: Resolution::fewest_nodes(grid),
            is_hertzian: problem.solid().is_half_space() && problem.law() == Law::HardWall && !problem.is_moving(),
            grid: grid.shape(),
            shape,
            size: grid.size(),
            map,
        }
    }
}

impl PatchRow {
    fn new(problem: &Problem, pressure: &[f64], patch: &Patch, whole: f64) -> Self {
        let (grid, modulus) = (problem.surface().grid(), problem.contact_modulus());
        let ([dy, dx], nx) = (grid.spacing(), grid.shape()[1]);
        Self {
            nodes: patch.nodes,
            place: [(patch.peak / nx) as f64 * dy, (patch.peak % nx) as f64 * dx],
            area: patch.area,
            share: patch.load / whole,
            max_pressure: pressure[patch.peak] / modulus,
            kappa_r: patch.kappa_r,
            curvature: patch.curvature,
            twin: (patch.curvature > 0.0).then(|| HertzParabola::new(grid, patch.curvature, patch.load, modulus)),
            profile: None,
        }
    }
}

impl HertzParabola {
    fn new(grid: &Grid, curvature: f64, load: f64, modulus: f64) -> Self {
        let body = if grid.is_line() { hertz::cylinder } else { hertz::sphere }(curvature.recip(), modulus);
        let half_width = body.half_width(load);
        let area = if grid.is_line() { 2.0 * half_width } else { PI * half_width.powi(2) };
        Self { half_width, area, max_pressure: body.pressure(half_width, 0.0) / modulus, kappa_r: body.kappa_r() }
    }
}

impl PatchProfile {
    fn new(problem: &Problem, pressure: &[f64], patch: &Patch, runs: &[Range<usize>]) -> Self {
        let (grid, modulus) = (problem.surface().grid(), problem.contact_modulus());
        let (nx, dx, heights) = (grid.shape()[1], grid.spacing()[1], problem.surface().heights());
        let peak_row = patch.peak / nx;
        let wide = runs.iter().filter(|run| run.start / nx == peak_row).map(Range::len).sum::<usize>().max(2);
        let places = columns(2 * wide + 1, POINTS).map(|range| range.start as isize - wide as isize);
        let [mut x, mut height, mut of_pressure] = [const { Vec::new() }; 3];
        for place in places {
            let node = grid.neighbour(patch.peak, [0, place]);
            x.push((place as f64 * dx) as f32);
            height.push((heights[node] - heights[patch.peak]) as f32);
            of_pressure.push((pressure[node] / modulus) as f32);
        }
        Self { x, height, pressure: of_pressure }
    }
}

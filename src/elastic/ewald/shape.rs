//! The grids of both parts.

use super::far::FarKernel;
use super::window::{CoarseWindow, SIDE};
use crate::fourier::smooth;
use crate::grid::Grid;
use std::f64::consts::PI;

/// How well both parts add up. The error of a displacement falls as `exp(-sharpness)` and as `10^(-width)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::elastic) struct Fineness {
    /// The product of the radius `R` and the largest wavenumber of the far part.
    sharpness: f64,
    /// Coarse nodes along each axis that a node is spread to.
    width: usize,
}

/// The parts of fields in double precision: errors of some 3e-15 of the largest displacement on 512^2 nodes.
pub(super) const DOUBLE: Fineness = Fineness { sharpness: 28.0, width: 16 };
/// The parts of fields in single precision: errors of some 3e-8 of the largest displacement, besides the rounding of the numbers.
pub(super) const SINGLE: Fineness = Fineness { sharpness: 14.0, width: 8 };

/// The grids of both parts.
#[derive(Debug, Clone, Copy)]
pub(in crate::elastic) struct EwaldShape {
    nodes: [usize; 2],
    pub(super) window: CoarseWindow,
    pub(super) sharpness: f64,
    /// The radius of the near part.
    pub(super) radius: f64,
    /// The grid of the near part, and that of the far part.
    pub(super) near: Grid,
    pub(super) far: Grid,
}

impl EwaldShape {
    /// The grids of the parts of a grid; none if they have too many points.
    pub(crate) fn new(grid: &Grid, Fineness { sharpness, width }: Fineness) -> Option<Self> {
        let (nodes, spacing, window) = (grid.shape(), grid.spacing(), CoarseWindow::new(width));
        // the shortest wave of the far part is four coarse spacings long
        let coarse = spacing.map(|d| SIDE as f64 * d);
        let radius = sharpness * coarse[0].max(coarse[1]) * 2.0 / PI;
        // an element reaches half a diagonal beyond its middle
        let reach = |axis: usize| ((radius + 0.5 * spacing[0].hypot(spacing[1])) / spacing[axis]).ceil() as usize;
        // within the radius on either side of the seam the kernel goes over into its image
        let seam = |axis: usize| (2.0 * radius / coarse[axis]).ceil() as usize;
        let surface = |points: [usize; 2], spacing: [f64; 2]| {
            Grid::surface(points, [0, 1].map(|axis| points[axis] as f64 * spacing[axis])).ok()
        };
        let near = surface([0, 1].map(|axis| smooth(nodes[axis] + reach(axis))), spacing)?;
        let far = surface([0, 1].map(|axis| smooth(2 * window.coarse(nodes[axis]) + seam(axis))), coarse)?;
        Some(Self { nodes, window, sharpness, radius, near, far })
    }

    /// For each coarse distance along an axis up to the middle of the grid, the distances whose kernels make up the one there.
    pub(super) fn images(&self, axis: usize, kernel: &FarKernel) -> Vec<Vec<ImageDistance>> {
        let ([spacing, size], points) = ([self.far.spacing()[axis], self.far.size()[axis]], self.far.shape()[axis]);
        let at = |x: f64| {
            let own = 0.5 * (1.0 + kernel.step((0.5 * size - x) / kernel.radius()));
            let image = |share: f64, x: f64| ImageDistance { share, square: x * x };
            [image(own, x), image(1.0 - own, size - x)].into_iter().filter(|image| image.share > 0.0).collect()
        };
        (0..=points / 2).map(|i| at(spacing * i as f64)).collect()
    }

    /// Points of both grids.
    pub(crate) fn points(&self) -> usize {
        self.near.len() + self.far.len()
    }

    /// The shape of the far field.
    pub(crate) fn coarse(&self) -> [usize; 2] {
        self.nodes.map(|nodes| self.window.coarse(nodes))
    }

    /// Values of the tables, of half spectra, and of fields that are spread.
    pub(crate) fn values(&self) -> usize {
        let [rows, width] = self.coarse();
        let tables = self.points() / 4;
        let spectra = self.nodes[0] * self.near.shape()[1] + rows * self.far.shape()[1];
        tables + spectra + (self.nodes[0] + rows) * width
    }
}

/// A distance along an axis, or that of its image.
pub(super) struct ImageDistance {
    pub share: f64,
    pub square: f64,
}

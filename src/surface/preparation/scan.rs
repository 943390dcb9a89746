//! What a preparation reads of heights between measurement and surface.

use crate::error::GridError;
use crate::formats::Scan;
use crate::grid::Grid;
use crate::surface::Surface;
use ndarray::Axis;

impl Scan {
    /// The heights of a surface at every `every`-th node along each axis; for a line, along x only.
    pub fn from_surface(surface: &Surface, every: usize) -> Self {
        let (grid, heights) = (surface.grid(), surface.heights_as_given());
        let every = grid.shape().map(|n| if n == 1 { 1 } else { every });
        let step = |axis: ndarray::AxisDescription| ndarray::Slice::new(0, None, every[axis.axis.index()] as isize);
        let height = heights.slice_each_axis(step).as_standard_layout().into_owned();
        Self { height, spacing: [0, 1].map(|axis| grid.spacing()[axis] * every[axis] as f64) }
    }

    /// The periodic grid under the heights.
    ///
    /// # Errors
    /// For less nodes than a grid has, and lengths that are not positive.
    pub(in crate::surface) fn grid(&self) -> Result<Grid, GridError> {
        let ([ny, nx], [dy, dx]) = (self.shape(), self.spacing);
        match ny {
            1 => Grid::line(nx, nx as f64 * dx),
            _ => Grid::surface([ny, nx], [ny as f64 * dy, nx as f64 * dx]),
        }
    }

    /// The height of the highest peak above the deepest valley.
    pub(in crate::surface) fn reach(&self) -> f64 {
        let there = || self.height.iter().copied().filter(|h| !h.is_nan());
        there().fold(f64::NEG_INFINITY, f64::max) - there().fold(f64::INFINITY, f64::min)
    }

    /// The root mean square of the differences between neighbours along an axis, 0 for y and 1 for x, that are not void; 0 without any.
    pub(in crate::surface) fn rms_step(&self, axis: usize) -> f64 {
        let pairs = self.height.axis_windows(Axis(axis), 2).into_iter();
        let steps = pairs.flat_map(|pair| &pair.index_axis(Axis(axis), 1) - &pair.index_axis(Axis(axis), 0));
        let (count, sum) = steps.filter(|s| !s.is_nan()).fold((0usize, 0.0), |(n, sum), s| (n + 1, sum + s * s));
        if count == 0 { 0.0 } else { (sum / count as f64).sqrt() }
    }

    /// The root mean square of the slope between neighbours that are not void.
    pub fn rms_gradient(&self) -> f64 {
        self.axes().map(|axis| (self.rms_step(axis) / self.spacing[axis]).powi(2)).sum::<f64>().sqrt()
    }

    /// Places of the nodes that are there from the middle of the map, `(y, x)`, over half of its longer side, and their heights.
    pub(super) fn points(&self) -> Vec<([f64; 2], f64)> {
        let half = self.half();
        let place =
            |i: usize, axis: usize| (i as f64 - 0.5 * (self.shape()[axis] as f64 - 1.0)) * self.spacing[axis] / half;
        let there = self.height.indexed_iter().filter(|(_, h)| !h.is_nan());
        there.map(|((y, x), h)| ([place(y, 0), place(x, 1)], *h)).collect()
    }

    /// Whether it is a line, one row.
    pub fn is_line(&self) -> bool {
        self.shape()[0] == 1
    }

    /// The axes along which there are several nodes: a line has no extent along y, and its spacing there says nothing.
    pub(in crate::surface) fn axes(&self) -> impl Iterator<Item = usize> + use<> {
        let shape = self.shape();
        (0..2).filter(move |axis| shape[*axis] > 1)
    }

    /// Half of the longer side.
    pub(in crate::surface) fn half(&self) -> f64 {
        let sides = self.axes().map(|axis| self.shape()[axis] as f64 * self.spacing[axis]);
        0.5 * sides.reduce(f64::max).unwrap_or(1.0)
    }

    /// The heights minus a form, which is a function of the places of [`Scan::points`].
    pub(super) fn less(mut self, form: impl Fn([f64; 2]) -> f64) -> Self {
        let (shape, half, spacing) = (self.shape(), self.half(), self.spacing);
        let place = |i: usize, axis: usize| (i as f64 - 0.5 * (shape[axis] as f64 - 1.0)) * spacing[axis] / half;
        self.height.indexed_iter_mut().for_each(|((y, x), h)| *h -= form([place(y, 0), place(x, 1)]));
        self
    }
}

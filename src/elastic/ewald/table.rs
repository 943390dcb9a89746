//! The transformed parts of a half-space without images.

use super::super::element;
use super::super::free::transformed_quarter;
use super::far::FarKernel;
use super::shape::{EwaldShape, Fineness, ImageDistance};
use super::window::{CoarseWindow, SIDE};
use crate::chunks;
use crate::grid::Grid;
use std::f64::consts::{PI, TAU};

/// Values of a field that take as long as the near influence of an element.
const WORK: usize = 256;

/// The parts of the influence of an element, transformed: displacement over pressure by the places of the filters of both grids.
#[derive(Debug, Clone)]
pub(in crate::elastic) struct EwaldTable {
    shape: EwaldShape,
    near: Vec<f64>,
    far: Vec<f64>,
}

impl EwaldTable {
    pub(crate) fn new(grid: &Grid, modulus: f64, fineness: Fineness) -> Self {
        let shape = EwaldShape::new(grid, fineness).expect("checked when the tables were made");
        let kernel = FarKernel::new(shape.radius, shape.sharpness);
        let (near, far) = (near(&shape, &kernel, modulus), far(&shape, &kernel, modulus));
        Self { shape, near, far }
    }

    pub(crate) fn window(&self) -> CoarseWindow {
        self.shape.window
    }

    /// The shape of the far field.
    pub(crate) fn coarse(&self) -> [usize; 2] {
        self.shape.coarse()
    }

    /// The grid of the near part and its weights.
    pub(crate) fn near(&self) -> (&Grid, &[f64]) {
        (&self.shape.near, &self.near)
    }

    /// The grid of the far part and its weights.
    pub(crate) fn far(&self) -> (&Grid, &[f64]) {
        (&self.shape.far, &self.far)
    }
}

/// The influence of an element less its far part, which is the mean of the kernel over the element.
fn near(shape: &EwaldShape, kernel: &FarKernel, modulus: f64) -> Vec<f64> {
    let sides @ [dy, dx] = shape.near.spacing();
    let reach = kernel.radius() + 0.5 * dy.hypot(dx);
    let influence = |at: [f64; 2]| {
        let smooth = dx * dy * element::mean(at, sides, |y, x| kernel.at((y * y + x * x).sqrt()));
        element::rectangle(at, sides, modulus) - smooth / (PI * modulus)
    };
    // on square elements both axes are alike, and the columns before the diagonal are rows
    let is_square = dy == dx;
    let first = |row: usize| if is_square { row } else { 0 };
    let [height, width] = [dy, dx].map(|d| (reach / d) as usize + 1);
    let rows = chunks::rows(height, WORK * width, |row| {
        let y = dy * row as f64;
        let columns =
            (first(row)..width).map(|column| dx * column as f64).take_while(|x| y * y + x * x <= reach * reach);
        columns.map(|x| influence([y, x])).collect::<Vec<f64>>()
    });
    let value = |row: usize, column: usize| rows[row].get(column - first(row)).copied().unwrap_or(0.0);
    transformed_quarter(&shape.near, |row, values| {
        if row < height {
            let values = values.iter_mut().enumerate().take(width);
            values.for_each(|(x, to)| *to = if x < first(row) { value(x, row) } else { value(row, x) });
        }
    })
}

/// The transform of the kernel on the coarse grid, with that of an element, and divided by that of the window, which acts twice.
///
/// Distances end in the middle of the grid. There the kernel goes over into its image without short waves, which the division would
/// amplify.
fn far(shape: &EwaldShape, kernel: &FarKernel, modulus: f64) -> Vec<f64> {
    let (grid, [dy, dx]) = (&shape.far, shape.near.spacing());
    let images = [0, 1].map(|axis| shape.images(axis, kernel));
    let mut weights = transformed_quarter(grid, |row, values| {
        for (value, along_x) in values.iter_mut().zip(&images[1]) {
            let of_row = |y: &ImageDistance| -> f64 {
                along_x.iter().map(|x| y.share * x.share * kernel.at((y.square + x.square).sqrt())).sum()
            };
            *value = images[0][row].iter().map(of_row).sum();
        }
    });
    let factors = [0, 1].map(|axis| {
        let points = grid.shape()[axis];
        let factor = |wave: usize| {
            let k = TAU * wave as f64 / points as f64;
            element_transform(k) / shape.window.transform(k).powi(2)
        };
        (0..=points / 2).map(factor).collect::<Vec<f64>>()
    });
    let unit = dx * dy / (PI * modulus);
    let columns = weights.chunks_exact_mut(factors[0].len()).zip(&factors[1]);
    columns.for_each(|(column, x)| column.iter_mut().zip(&factors[0]).for_each(|(weight, y)| *weight *= unit * x * y));
    weights
}

/// The mean of a wave of wavenumber `k` per coarse spacing over an element.
fn element_transform(k: f64) -> f64 {
    let half = 0.5 * k / SIDE as f64;
    if half > 0.0 { half.sin() / half } else { 1.0 }
}

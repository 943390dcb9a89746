//! A cut through the layers below a surface.

use crate::surface::Field;
use ndarray::{Axis, Slice};

/// A vertical cut through a solid that yields, below one row of its surface or below a line: plastic strain and stress in each layer.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthCut {
    /// The row, from 0.
    pub row: usize,
    /// The depths of the interfaces of the layers, lengths, from 0 on: one more than there are layers.
    pub interfaces: Vec<f64>,
    /// Accumulated plastic strain, shape `(layers, nx)`.
    pub plastic_strain: Field,
    /// Von Mises stress, a pressure, means over the layers, shape `(layers, nx)`.
    pub von_mises: Field,
}

impl DepthCut {
    /// The cut through the first layers, at most as many as there are.
    pub fn above(mut self, layers: usize) -> Self {
        let count = layers.min(self.plastic_strain.nrows());
        self.interfaces.truncate(count + 1);
        for field in [&mut self.plastic_strain, &mut self.von_mises] {
            *field = field.slice_axis(Axis(0), Slice::from(..count)).to_owned();
        }
        self
    }
}

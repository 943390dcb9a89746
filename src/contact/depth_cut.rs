//! A cut through the layers below a surface.

use crate::surface::Field;

/// What lies in the layers below one row of a surface, or below a line, of a solid that yields.
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

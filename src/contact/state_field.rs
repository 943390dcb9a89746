//! The values of the fields of a state besides those of its contact.

use crate::contact::{FieldKind, On};
use crate::surface::Field;
use ndarray::{Axis, Slice};

/// A field of a state besides those of its contact.
#[derive(Debug, Clone, PartialEq)]
pub struct StateField {
    /// The kind of the field, whose row has its name, its unit and where it lies.
    pub kind: FieldKind,
    /// Its values: shape `(ny, nx)` on the surface, `(layers, nx)` in a cut.
    pub values: Field,
}

/// The layers of the vertical cut that fields of a state lie in, below one row of its surface or below a line.
#[derive(Debug, Clone, PartialEq)]
pub struct CutLayers {
    /// The row of the surface, from 0.
    pub row: usize,
    /// The depths of the interfaces of the layers, lengths, from 0 on: one more than there are layers.
    pub interfaces: Vec<f64>,
}

impl StateField {
    /// A field with its values.
    pub fn new(kind: FieldKind, values: Field) -> Self {
        Self { kind, values }
    }

    /// The name of the field.
    pub fn name(&self) -> &'static str {
        self.kind.row().name
    }

    /// Whether it lies on the surface.
    pub fn is_on_surface(&self) -> bool {
        self.kind.row().on == On::Surface
    }

    /// The field in the first layers alone, if it lies in a cut.
    pub(super) fn down_to(self, layers: usize) -> Self {
        if self.is_on_surface() {
            return self;
        }
        let count = layers.min(self.values.nrows());
        Self { values: self.values.slice_axis(Axis(0), Slice::from(..count)).to_owned(), ..self }
    }
}

//! Heights made periodic by their mirror images.

use crate::formats::Scan;
use crate::surface::Field;
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The axes along which heights are mirrored at their last node, so that they are periodic without a jump: `n` nodes become `2 n - 2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Mirror {
    /// Along x, the columns.
    X,
    /// Along y, the rows.
    Y,
    /// Along both axes; for a profile, along its axis.
    Both,
}

impl Mirror {
    /// Rows and columns of the heights and their images.
    pub fn shape(self, [ny, nx]: [usize; 2]) -> [usize; 2] {
        let twice = |n: usize, is_mirrored: bool| if is_mirrored && n > 2 { 2 * n - 2 } else { n };
        [twice(ny, self != Self::X), twice(nx, self != Self::Y)]
    }

    /// Rows and columns of the heights without their images, of which there are some.
    pub fn original_shape(self, [ny, nx]: [usize; 2]) -> [usize; 2] {
        let once = |n: usize, is_mirrored: bool| if is_mirrored && n > 2 { n / 2 + 1 } else { n };
        [once(ny, self != Self::X && ny > 1), once(nx, self != Self::Y)]
    }

    /// The heights without their images, of which there are some.
    pub fn original(self, scan: &Scan) -> Scan {
        let shape = self.original_shape(scan.shape());
        Scan { height: Field::from_shape_fn(shape, |node| scan.height[node]), ..*scan }
    }

    /// The heights and their images.
    pub fn apply(self, scan: &Scan) -> Scan {
        Scan { height: self.images(&scan.height), ..*scan }
    }

    /// Values at the nodes of a map, and at their images.
    pub(super) fn images<T: Copy>(self, values: &Array2<T>) -> Array2<T> {
        let shape: [usize; 2] = values.dim().into();
        let mirrored = self.shape(shape);
        let back = |i: usize, axis: usize| if i < shape[axis] { i } else { mirrored[axis] - i };
        Array2::from_shape_fn(mirrored, |(y, x)| values[[back(y, 0), back(x, 1)]])
    }
}

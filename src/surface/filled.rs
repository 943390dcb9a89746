//! Heights that were not measured but filled in.

use super::{Fill, Surface};
use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::grid::Grid;
use ndarray::Array2;
use std::sync::Arc;

impl Surface {
    /// The surface with the nodes whose heights were not measured but filled in, such as those of [`Prepared::filled`](super::Prepared), of the shape of
    /// its grid. What touches there is told with each contact.
    ///
    /// # Panics
    /// If the shape is not that of the grid.
    pub fn with_filled(self, filled: Option<&Array2<bool>>) -> Self {
        let filled = filled.map(|nodes| {
            assert_eq!(nodes.dim(), self.grid.shape().into(), "filled nodes are of the shape of the grid");
            nodes.iter().copied().collect()
        });
        Self { filled, ..self }
    }

    /// The surface on another grid of as many nodes, such as one of rounded lengths.
    ///
    /// # Errors
    /// The errors of [`Surface::new`].
    pub(crate) fn on(&self, grid: Grid) -> Result<Self, SurfaceError> {
        Ok(Self { filled: self.filled.clone(), ..Self::new(grid, self.heights_as_given())? })
    }

    /// Whether the height of each node was filled in, row by row; none if all were measured.
    pub fn filled(&self) -> Option<&[bool]> {
        self.filled.as_deref()
    }

    /// How much larger areas may be since filled heights are smooth, as a part of them: by the rms gradients of all nodes and of the measured ones.
    pub(crate) fn area_error_by_fill(&self) -> f64 {
        let Some(filled) = &self.filled else { return 0.0 };
        let full = Scan { height: self.height.clone(), spacing: self.grid.spacing() };
        let mut measured = full.clone();
        for (height, _) in measured.height.iter_mut().zip(filled.iter()).filter(|(_, is_filled)| **is_filled) {
            *height = f64::NAN;
        }
        Fill::area_error(&measured, &full)
    }

    /// The nodes that are filled in one of two surfaces of a grid.
    pub(super) fn filled_with(&self, other: &Self) -> Option<Arc<[bool]>> {
        match (&self.filled, &other.filled) {
            (Some(one), Some(two)) => Some(one.iter().zip(two.iter()).map(|(one, two)| *one || *two).collect()),
            (one, two) => one.clone().or(two.clone()),
        }
    }

    /// The filled nodes on a grid of `factor` times as many points along each side: those whose nearest node here is filled.
    pub(super) fn filled_on(&self, factor: usize) -> Option<Arc<[bool]>> {
        let filled = self.filled.as_ref()?;
        let ([_, nx], [fine_ny, fine_nx]) = (self.grid.shape(), self.grid.refined(factor).ok()?.shape());
        let shape = self.grid.shape();
        let nearest = |i: usize, axis: usize| match shape[axis] {
            1 => 0,
            n => (i + factor / 2) / factor % n,
        };
        let nodes = (0..fine_ny).flat_map(|y| (0..fine_nx).map(move |x| [y, x]));
        Some(nodes.map(|[y, x]| filled[nearest(y, 0) * nx + nearest(x, 1)]).collect())
    }
}

//! How a solid yields below its surface.

use crate::elastic::DepthLayers;
use crate::error::PlasticError;
use crate::grid::Grid;
use crate::history::PlasticSolid;

/// The part of the longest side of the cell at which layers end whose depth is not given.
const DEPTH: f64 = 0.5;

/// How a solid yields below its surface, and the layers in which it may. In a scene these are keys of the section `solid`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct YieldLaw {
    /// Yield stress `Y` in tension, a pressure.
    pub yield_stress: Option<f64>,
    /// Modulus `H` of isotropic hardening, a pressure: after an accumulated plastic strain `alpha` the solid yields at `Y + H alpha`.
    pub hardening_modulus: Option<f64>,
    /// Modulus `C` of linear kinematic hardening, a pressure; none if it is left out.
    pub kinematic_hardening: Option<f64>,
    /// The depth at which the layers end, a length; half the longest side of the cell if it is left out. If it and the number of layers are left
    /// out, layers are added where the last one yields.
    pub depth: Option<f64>,
    /// A number of layers of equal thickness. If it is left out, the first layer is half as thick as the shorter spacing of the grid, and each further one is thicker by
    /// a tenth.
    pub layers: Option<usize>,
    /// Whether the errors by steps, layers and grid are estimated.
    pub errors: bool,
}

impl YieldLaw {
    /// Whether anything is given.
    pub fn is_given(&self) -> bool {
        *self != Self::default()
    }

    /// Whether layers are added where the last one yields.
    pub fn grows(&self) -> bool {
        self.depth.is_none() && self.layers.is_none()
    }

    /// The solid of an elastic body of Young's modulus, a pressure, and Poisson's ratio.
    ///
    /// # Errors
    /// The errors of [`PlasticSolid::new`] and of [`PlasticSolid::with_kinematic_hardening`].
    pub fn solid(&self, young: f64, poisson: f64) -> Result<PlasticSolid, PlasticError> {
        let [yield_stress, hardening] = [self.yield_stress, self.hardening_modulus].map(Option::unwrap_or_default);
        PlasticSolid::new(young, poisson, yield_stress, hardening)?
            .with_kinematic_hardening(self.kinematic_hardening.unwrap_or_default())
    }

    /// The layers below a grid.
    ///
    /// # Errors
    /// The errors of [`DepthLayers::uniform`] and [`DepthLayers::below`].
    pub fn layers(&self, grid: &Grid) -> Result<DepthLayers, PlasticError> {
        let longest = |lengths: [f64; 2]| if grid.is_line() { lengths[1] } else { lengths[0].max(lengths[1]) };
        let depth = self.depth.unwrap_or(DEPTH * longest(grid.size()));
        if !(depth.is_finite() && depth > 0.0) {
            return Err(PlasticError::NotPositive { name: "depth at which the layers end", value: depth });
        }
        match self.layers {
            Some(count) => DepthLayers::uniform(count, depth),
            None => DepthLayers::below(grid.shortest_spacing(), depth),
        }
    }
}

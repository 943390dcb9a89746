//! How well a grid resolves a contact.

use crate::contact::{Counted, Patches, Resolved};
use crate::grid::Grid;

/// Nodes of the patches that are too small to trust, fewer than these: lines, surfaces.
const FEWEST_NODES: [usize; 2] = [4, 12];

/// Share of the differences between measures, and between grids, in the error of the resolved values. Calibrated on
/// rough lines and surfaces of H = 0.2 to 0.8 at reduced pressures of 0.001 to 0.5, from 2 to 256 points per shortest
/// wave: of 235 contacts, one had an estimated error of the area below a third of the true one, none had an estimated
/// error of `kappa_r` below the true one, and half had estimates up to three times the error of the area and seven
/// times that of `kappa_r`.
const SHARE: f64 = 0.5;

/// Share of the contact on plateaus above which the error of the gradient is not known.
const MOST_LEVEL: f64 = 0.5;

/// How well a grid resolves a contact: the size of its patches, and the estimated errors of area and `kappa_r` compared
/// with an infinitely fine grid of the same surface. All values are dimensionless.
///
/// The errors are estimates, not bounds. If the solver has found the contact on the next coarser grid too (to a
/// certificate of 0.1), they are half of the difference between the resolved values of the two grids, which for errors
/// of second order is three times the error, and half of that between resolved and corrected values; else they are all
/// of the latter. The error of `kappa_r` is the sum of
/// those of area and gradient, which may cancel in it. They do not contain the effect of wavelengths that are too short
/// for the grid.
///
/// Where the pressure at an edge is limited, by a hardness or by the flow of the solid, the error of the place of such edges is added, see [`Resolved::edge_error`].
///
/// Nodes in contact whose heights were not measured but filled in, see [`crate::surface::Surface::filled`], may not touch at all, or others
/// of their void may: their share in the contact is added to the error of the area, and so to that of `kappa_r`.
///
/// Nodes on plateaus, see [`crate::surface::Surface::is_level`], do not determine the surface between them, as where
/// heights are rounded or clipped. Half of their share in the contact is added to the errors of area and gradient, and
/// if they are most of the contact, the error of `kappa_r` is unknown. Of 582 contacts of rough, clipped, worn, rounded
/// and spiky heights, two had an estimate below a third of the error, compared with the same heights, unrounded, on a
/// fine grid; without the addition there were 56.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Nodes in contact for each patch; 0 without contact.
    pub nodes_per_patch: f64,
    /// Share of the nodes in contact that are in patches of fewer than 4 nodes on lines, 12 on surfaces, whose pressure is that
    /// of single nodes; 0 without contact.
    pub unresolved_share: f64,
    /// Share of the nodes in contact that lie on plateaus; 0 without contact.
    pub level_share: f64,
    /// Share of the nodes in contact whose heights were not measured but filled in; 0 without contact.
    pub filled_share: f64,
    /// Estimated relative error of the resolved area.
    pub relative_area_error: f64,
    /// Estimated relative error of the resolved `kappa_r`; NaN where most of the contact lies on plateaus.
    pub kappa_r_error: f64,
}

impl Resolution {
    /// The error of the area that plateaus and filled heights leave on any grid.
    pub fn least_area_error(&self) -> f64 {
        SHARE * self.level_share + self.filled_share
    }

    /// The fewest nodes of a patch whose pressure is not that of single nodes: 4 on lines, 12 on surfaces.
    pub fn fewest_nodes(grid: &Grid) -> usize {
        FEWEST_NODES[usize::from(!grid.is_line())]
    }

    /// The resolution of a contact on `grid`, with the state on the next coarser grid, if that is known.
    pub fn new(
        grid: &Grid,
        counted: &Counted,
        resolved: &Resolved,
        patches: &Patches,
        coarser: Option<&Resolved>,
    ) -> Self {
        let fewest = Self::fewest_nodes(grid);
        let small: usize = patches.sizes().iter().filter(|nodes| **nodes < fewest).sum();
        let nodes = counted.contact_nodes as f64;
        let level_share = counted.level_nodes as f64 / nodes.max(1.0);
        let error = |value: f64, corrected: f64, coarser: Option<f64>| {
            let of_measures = (value - corrected).abs();
            let error = coarser.map_or(of_measures, |coarser| SHARE * (of_measures + (value - coarser).abs()));
            error / value + SHARE * level_share
        };
        let relative_area_error = resolved.edge_error
            + counted.filled_area_share
            + error(
                resolved.relative_area,
                counted.relative_area_corrected,
                coarser.map(|coarser| coarser.relative_area),
            );
        let rms_gradient_error = error(
            resolved.rms_gradient_contact,
            counted.rms_gradient_contact_corrected,
            coarser.map(|coarser| coarser.rms_gradient_contact),
        );
        Self {
            nodes_per_patch: nodes / patches.count().max(1) as f64,
            unresolved_share: small as f64 / nodes.max(1.0),
            level_share,
            filled_share: counted.filled_area_share,
            relative_area_error,
            kappa_r_error: if level_share > MOST_LEVEL { f64::NAN } else { relative_area_error + rms_gradient_error },
        }
    }
}

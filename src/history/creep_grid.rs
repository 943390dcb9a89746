//! Errors of a creeping contact by its grid.

use super::CreepState;
use super::creep_state::NEGLIGIBLE;
use crate::contact::{Counted, Edges, Law, Patches, Resolution};
use crate::surface::largest;

/// The least errors of area and `kappa_r` that are stated, in spacings at each edge; `kappa_r` has those of area and gradient. A creeping state is not solved
/// on a coarser grid too, and a single difference of two measures may be zero by chance. Without this, the error of the area was below the true one in 386
/// of 2059 states on lines and surfaces with 6 to 16 points for each of the shortest waves, up to 130 times; with it in 24, and 99 % were
/// below 1.1 times the stated one.
const EDGE_ERROR: [f64; 2] = [0.1, 0.15];
/// The area that is not known besides, in nodes: a patch or a gap that lies between the nodes. Where a contact was nearly full, the area was off by
/// up to 1.1 nodes with few edges or none.
const UNSEEN_NODES: f64 = 0.5;

/// Estimated relative errors of a state by the spacing of its grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CreepGridErrors {
    /// Of the relative area.
    pub relative_area: f64,
    /// Of `kappa_r`; NaN where most of the contact lies on plateaus.
    pub kappa_r: f64,
}

impl CreepState {
    /// The estimated relative errors of [`CreepState::resolved`] by the grid, compared with the same history on an infinitely fine one; none where
    /// nothing touches.
    ///
    /// They are those of an elastic contact with the effective pressure, see [`Resolution`], but at least a part of a spacing at each
    /// edge, and what is not known of edges that have receded. The solid behind such an edge remembers the contact. At an edge that
    /// recedes fast the pressure falls as that of the glassy solid does, and at one that recedes slowly as that of the relaxed one. Between these lie the laws with the pressure and with the effective pressure, and the
    /// difference of both is added.
    pub fn grid_errors(&self) -> Option<CreepGridErrors> {
        let problem = self.contact.problem.clone().with_law(Law::HardWall).expect("any load suits a hard wall");
        let touching = self.touching();
        let pairs = touching.iter().zip(&self.contact.pressure);
        let now: Vec<f64> = pairs.map(|(&effective, &p)| if effective > 0.0 { p } else { 0.0 }).collect();
        let gap = self.contact.gap.as_slice().expect("results are made in standard layout");
        let grid = problem.surface().grid();
        let by_effective = Edges::new(&problem, &touching, |node| gap[node]);
        let mut all = by_effective.all();
        let resolved = by_effective.resolved_of(&all);
        if resolved.relative_area <= 0.0 {
            return None;
        }
        let effective = self.effective_pressure().as_slice().expect("results are made in standard layout");
        let least = NEGLIGIBLE * largest(self.effective_pressure());
        // both fields touch at the same nodes, so that their edges are the same ones
        for (edge, of_pressure) in all.iter_mut().zip(Edges::new(&problem, &now, |node| gap[node]).all()) {
            if effective[grid.neighbour(edge.node, edge.towards)] > least {
                *edge = of_pressure;
            }
        }
        let other = by_effective.resolved_of(&all);
        let counted = Counted::new(&problem, &touching);
        let elastic = Resolution::new(grid, &counted, &resolved, &Patches::new(&touching, grid), None);
        let (edges, nodes) = (counted.switches as f64, counted.contact_nodes as f64);
        let [least_area, least_kappa_r] = EDGE_ERROR.map(|error| (error * edges + UNSEEN_NODES) / nodes);
        let relative = |value: f64, other: f64| (value - other).abs() / value;
        let area = relative(resolved.relative_area, other.relative_area);
        let gradient = relative(resolved.rms_gradient_contact, other.rms_gradient_contact);
        // an unknown error stays unknown
        let at_least = |error: f64, least: f64| if error < least { least } else { error };
        Some(CreepGridErrors {
            relative_area: at_least(elastic.relative_area_error, least_area) + area,
            kappa_r: at_least(elastic.kappa_r_error, least_kappa_r) + area + gradient,
        })
    }
}

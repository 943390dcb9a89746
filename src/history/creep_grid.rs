//! Errors of a creeping contact by its grid.

use super::CreepState;
use super::creep_state::NEGLIGIBLE;
use crate::contact::{Counted, Edges, Law, Patches, Resolution, largest};

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
    /// They are those of an elastic contact with the effective pressure, see [`Resolution`], and what is not known of edges that
    /// have receded. The solid behind such an edge remembers the contact. At an edge that recedes fast the pressure falls as that of the glassy solid does, and at
    /// one that recedes slowly as that of the relaxed one. Between these lie the laws with the pressure and with the effective pressure, and the
    /// difference of both is added.
    pub fn grid_errors(&self) -> Option<CreepGridErrors> {
        let problem = self.contact.problem.clone().with_law(Law::HardWall).expect("any load suits a hard wall");
        let touching = self.touching();
        let pairs = touching.iter().zip(&self.contact.pressure);
        let now: Vec<f64> = pairs.map(|(&effective, &p)| if effective > 0.0 { p } else { 0.0 }).collect();
        let gap = self.contact.gap.as_slice().expect("results are made in standard layout");
        let grid = problem.surface().grid();
        let edges = Edges::new(&problem, &touching, |node| gap[node]);
        let mut all = edges.all();
        let resolved = edges.resolved_of(&all);
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
        let other = edges.resolved_of(&all);
        let counted = Counted::new(&problem, &touching);
        let elastic = Resolution::new(grid, &counted, &resolved, &Patches::new(&touching, grid), None);
        let relative = |value: f64, other: f64| (value - other).abs() / value;
        let area = relative(resolved.relative_area, other.relative_area);
        let gradient = relative(resolved.rms_gradient_contact, other.rms_gradient_contact);
        Some(CreepGridErrors {
            relative_area: elastic.relative_area_error + area,
            kappa_r: elastic.kappa_r_error + area + gradient,
        })
    }
}

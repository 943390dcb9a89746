//! Measures of a contact, as the paper defines them.

use crate::contact::{Problem, chunks};
use crate::surface::Surface;

/// Excess of counted nodes over the true contact of a line, per switch between contact and gap, in nodes.
///
/// Counting nodes with `p > 0` finds about 0.37 spacings too many per segment, at both its ends together: measured on the
/// sine, the periodic parabola and rough profiles, whose area is known exactly or from finer grids.
pub const NODE_EXCESS_PER_SWITCH_LINE: f64 = 0.185;

/// Excess of counted nodes of a surface per switch along rows and columns: `(pi - 1 + ln 2) / 24` (Yastrebov, Anciaux &
/// Molinari, Tribol. Int. 2017, arXiv:1701.02727).
pub const NODE_EXCESS_PER_SWITCH_SURFACE: f64 = (std::f64::consts::PI - 1.0 + std::f64::consts::LN_2) / 24.0;

/// Area, gradients and proportionality factors of a contact, as Eqs. 1, 3, 8 and 9 of van Dokkum et al. (2018) define them.
///
/// A node is in contact when its pressure is positive. Dimensionless all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Nodes in contact.
    pub contact_nodes: usize,
    /// Switches between contact and gap along rows (and columns): the length of the contact line in spacings.
    pub switches: usize,
    /// `a_rel`, the share of nodes in contact: what the paper plots.
    pub relative_area: f64,
    /// `a_rel` less the excess of counting nodes, see [`NODE_EXCESS_PER_SWITCH_LINE`] and
    /// [`NODE_EXCESS_PER_SWITCH_SURFACE`].
    pub relative_area_corrected: f64,
    /// `gbar`, root-mean-square gradient of the whole surface (Eq. 8).
    pub rms_gradient: f64,
    /// `gbar_r`, the same over the nodes in contact (Eq. 9); 0 without contact.
    pub rms_gradient_contact: f64,
    /// `p* = <p> / (gbar E*)`.
    pub reduced_pressure: f64,
    /// `p_r* = <p> / (gbar_r E*)`.
    pub reduced_pressure_contact: f64,
    /// `kappa = a_rel / p*`.
    pub kappa: f64,
    /// `kappa_r = a_rel / p_r*`.
    pub kappa_r: f64,
    /// `kappa_r` with the corrected area.
    pub kappa_r_corrected: f64,
}

impl Measures {
    /// Measures the contact of nodes with `pressure > 0` (row by row) under the load of `problem`.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn of(problem: &Problem, pressure: &[f64]) -> Self {
        let grid = problem.surface().grid();
        assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
        let (contact_nodes, sum_squares) = contact_sums(pressure, problem.surface());
        let switches = switches(pressure, grid.shape());
        let excess = if grid.is_line() { NODE_EXCESS_PER_SWITCH_LINE } else { NODE_EXCESS_PER_SWITCH_SURFACE };
        let nodes = grid.len() as f64;
        let relative_area = contact_nodes as f64 / nodes;
        let relative_area_corrected = ((contact_nodes as f64 - excess * switches as f64) / nodes).max(0.0);
        let rms_gradient_contact = if contact_nodes > 0 { (sum_squares / contact_nodes as f64).sqrt() } else { 0.0 };
        let strain = problem.mean_pressure_of(pressure) / problem.contact_modulus();
        let reduced_pressure = strain / problem.rms_gradient();
        Self {
            contact_nodes,
            switches,
            relative_area,
            relative_area_corrected,
            rms_gradient: problem.rms_gradient(),
            rms_gradient_contact,
            reduced_pressure,
            reduced_pressure_contact: strain / rms_gradient_contact,
            kappa: relative_area / reduced_pressure,
            kappa_r: relative_area * rms_gradient_contact / strain,
            kappa_r_corrected: relative_area_corrected * rms_gradient_contact / strain,
        }
    }
}

/// Nodes in contact and the sum of their square gradients.
fn contact_sums(pressure: &[f64], surface: &Surface) -> (usize, f64) {
    let square_gradient = surface.square_gradient();
    let parts = chunks::visit(pressure.len(), |range| {
        let (mut nodes, mut squares) = (0, 0.0);
        for i in range {
            if pressure[i] > 0.0 {
                nodes += 1;
                squares += square_gradient(i);
            }
        }
        (nodes, squares)
    });
    parts.into_iter().fold((0, 0.0), |(n, s), (nodes, squares)| (n + nodes, s + squares))
}

/// Switches between contact and gap along rows and columns; periodic.
fn switches(pressure: &[f64], [ny, nx]: [usize; 2]) -> usize {
    let last = pressure.len() - nx;
    let is_switch = |a: usize, b: usize| (pressure[a] > 0.0) != (pressure[b] > 0.0);
    let in_order = differences(&pressure[1..], &pressure[..pressure.len() - 1]);
    let across_rows = (1..ny).filter(|y| is_switch(y * nx - 1, y * nx)).count();
    let across_period = (0..ny).filter(|y| is_switch(y * nx, (y + 1) * nx - 1)).count();
    let columns = differences(&pressure[nx..], &pressure[..last]) + differences(&pressure[..nx], &pressure[last..]);
    in_order - across_rows + across_period + columns
}

/// Nodes that are in contact in one of two fields only.
fn differences(a: &[f64], b: &[f64]) -> usize {
    let parts = chunks::visit(a.len(), |range| {
        let pairs = a[range.clone()].iter().zip(&b[range]);
        pairs.filter(|(a, b)| (**a > 0.0) != (**b > 0.0)).count()
    });
    parts.into_iter().sum()
}

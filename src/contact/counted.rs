//! Contact measures by counting nodes, as the paper defines them.

use super::links::for_each_in_contact;
use crate::contact::{NODE_EXCESS_PER_SWITCH_LINE, Problem, chunks};

/// Excess of counted nodes of a surface per switch along rows and columns of a square grid, the mean over edges of all
/// directions: [`crate::theory::counting_excess`] averages to 0.129078 spacings, and an edge has `4/pi` switches a spacing. It depends
/// on the direction: 0.190 along the grid, 0.082 at 35 degrees. (From the perimeter of a digital disc alone, without the law of
/// contact edges, Yastrebov, Anciaux & Molinari, Tribol. Int. 2017, arXiv:1701.02727, have 0.118.)
pub const NODE_EXCESS_PER_SWITCH_SURFACE: f64 = 0.101_378;

/// Area, gradients and proportionality factors of a contact by counting nodes, as Eqs. 1, 3, 8 and 9 of van Dokkum et
/// al. (2018) define them; all are dimensionless. Below a contact that slides over a viscoelastic solid `E*` is the
/// [`Problem::effective_modulus`].
///
/// A node is in contact when its pressure is positive. Counting nodes is of first order in the spacing;
/// [`Resolved`](crate::contact::Resolved) has the same quantities to second order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counted {
    /// Nodes in contact.
    pub contact_nodes: usize,
    /// Nodes in contact that lie on plateaus, see [`Surface::is_level`](crate::surface::Surface::is_level).
    pub level_nodes: usize,
    /// Share of the nodes in contact whose heights were not measured but filled in, see [`Surface::filled`](crate::surface::Surface::filled);
    /// 0 without contact.
    pub filled_area_share: f64,
    /// Share of the load that these nodes bear.
    pub filled_load_share: f64,
    /// Switches between contact and gap along rows (and columns): the length of the contact line in spacings.
    pub switches: usize,
    /// `a_rel`, the fraction of nodes in contact, which the paper plots.
    pub relative_area: f64,
    /// `a_rel` minus the excess of counted nodes at edges where the pressure falls to zero, see
    /// [`NODE_EXCESS_PER_SWITCH_LINE`] and [`NODE_EXCESS_PER_SWITCH_SURFACE`]. At the edge of nodes that yield nothing
    /// is subtracted.
    pub relative_area_corrected: f64,
    /// `gbar`, root-mean-square gradient of the whole surface (Eq. 8).
    pub rms_gradient: f64,
    /// `gbar_r`, the same over the nodes in contact (Eq. 9); 0 without contact.
    pub rms_gradient_contact: f64,
    /// `gbar_r` minus the contribution of the excess nodes, which are the steepest of the contact; not below 0.
    pub rms_gradient_contact_corrected: f64,
    /// `p* = <p> / (gbar E*)`.
    pub reduced_pressure: f64,
    /// `p_r* = <p> / (gbar_r E*)`.
    pub reduced_pressure_contact: f64,
    /// `kappa = a_rel / p*`.
    pub kappa: f64,
    /// `kappa_r = a_rel / p_r*`.
    pub kappa_r: f64,
    /// `kappa_r` with area and gradient corrected.
    pub kappa_r_corrected: f64,
}

impl Counted {
    /// Counts the contact of nodes with `pressure > 0` (row by row) under the load of `problem`.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn new(problem: &Problem, pressure: &[f64]) -> Self {
        let grid = problem.surface().grid();
        assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
        let CountedSums { nodes, level, filled, pressures, squares, switches, falling, falling_squares } =
            CountedSums::new(pressure, problem);
        let excess = if grid.is_line() { NODE_EXCESS_PER_SWITCH_LINE } else { NODE_EXCESS_PER_SWITCH_SURFACE };
        let corrected = (nodes as f64 - excess * falling as f64).max(0.0);
        let relative_area = nodes as f64 / grid.len() as f64;
        let relative_area_corrected = corrected / grid.len() as f64;
        let rms_gradient_contact = rms(squares, nodes as f64);
        let rms_gradient_contact_corrected = rms(squares - excess * falling_squares, corrected);
        let strain = problem.mean_pressure_of(pressure) / problem.effective_modulus(pressure);
        let reduced_pressure = strain / problem.rms_gradient();
        Self {
            contact_nodes: nodes,
            level_nodes: level,
            filled_area_share: filled as f64 / nodes.max(1) as f64,
            filled_load_share: if pressures[0] > 0.0 { pressures[1] / pressures[0] } else { 0.0 },
            switches,
            relative_area,
            relative_area_corrected,
            rms_gradient: problem.rms_gradient(),
            rms_gradient_contact,
            rms_gradient_contact_corrected,
            reduced_pressure,
            reduced_pressure_contact: strain / rms_gradient_contact,
            kappa: relative_area / reduced_pressure,
            kappa_r: relative_area * rms_gradient_contact / strain,
            kappa_r_corrected: relative_area_corrected * rms_gradient_contact_corrected / strain,
        }
    }
}

/// Root mean square of `count` values with the sum of squares `squares`; 0 without values.
fn rms(squares: f64, count: f64) -> f64 {
    if count > 0.0 { (squares.max(0.0) / count).sqrt() } else { 0.0 }
}

/// Sums over nodes in contact, and over switches between contact and gap.
#[derive(Default)]
struct CountedSums {
    nodes: usize,
    /// Nodes on plateaus.
    level: usize,
    /// Nodes whose heights were filled in.
    filled: usize,
    /// Sums of the pressures of all nodes in contact, and of the filled ones.
    pressures: [f64; 2],
    /// Square gradients (Eq. 8).
    squares: f64,
    switches: usize,
    /// Switches at which the pressure falls to zero, as it does where the node in contact does not yield.
    falling: usize,
    /// Square gradients of the nodes in contact, once for each of these switches.
    falling_squares: f64,
}

impl CountedSums {
    fn new(pressure: &[f64], problem: &Problem) -> Self {
        let (surface, law) = (problem.surface(), problem.law());
        let (grid, square_gradient, is_level) = (surface.grid(), surface.square_gradient(), surface.is_level());
        let filled = surface.filled();
        let parts = chunks::visit(pressure.len(), |range| {
            let mut sums = Self::default();
            for_each_in_contact(grid, pressure, range, |node, ends| {
                let square = square_gradient(node);
                sums.nodes += 1;
                sums.level += usize::from(is_level(node));
                let is_filled = filled.is_some_and(|it| it[node]);
                sums.filled += usize::from(is_filled);
                sums.pressures[0] += pressure[node];
                sums.pressures[1] += if is_filled { pressure[node] } else { 0.0 };
                sums.squares += square;
                sums.switches += ends;
                if ends > 0 && !law.yields(pressure[node]) {
                    sums.falling += ends;
                    sums.falling_squares += ends as f64 * square;
                }
            });
            sums
        });
        parts.into_iter().fold(Self::default(), Self::plus)
    }

    fn plus(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            level: self.level + other.level,
            filled: self.filled + other.filled,
            pressures: [0, 1].map(|i| self.pressures[i] + other.pressures[i]),
            squares: self.squares + other.squares,
            switches: self.switches + other.switches,
            falling: self.falling + other.falling,
            falling_squares: self.falling_squares + other.falling_squares,
        }
    }
}

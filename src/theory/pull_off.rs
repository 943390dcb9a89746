//! The pull-off of a round indenter that adheres.

use super::Periodic;
use crate::grid::Grid;
use crate::surface::{Indenter, shortest_period};
use std::f64::consts::PI;

/// Factor from one half-width to the next in the search for the lowest load.
const GROWTH: f64 = 1.02;
/// Halvings of the interval with the lowest load: its load is then known to rounding.
const HALVINGS: usize = 60;

/// The lowest mean pressure that a smooth sphere or cylinder holds on an elastic half-space, negative, in the two limits of the range of the
/// attraction. With the work of adhesion `w`, the contact modulus `E*`, the radius `R`, and the size of the cell `L` or `A = Lx Ly`,
///
/// ```text
/// sphere            JKR  -3/2 pi w R/A,  DMT  -2 pi w R/A
/// cylinder, free    JKR  -3 (pi E* w^2 R/16)^(1/3)/L
/// cylinder, cell    JKR  the lowest  P(a)/L - sqrt(2 E* w tan(pi a/L)/L)  over the half-width a
/// ```
///
/// where `P(a)` is the load of the periodic contact without adhesion, [`Periodic::load`]. The root is the tension of a periodic strip punch whose
/// stress intensity at the edge, `sqrt(L/tan(pi a/L))` times its mean pressure, releases the energy `w`. The sphere stands alone: the neighbouring
/// cells are left out.
///
/// # Source
/// Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 301 (1971); Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53, 314 (1975); Barquins, J. Adhesion
/// 26, 1 (1988), for the cylinder; the cell as Johnson, Int. J. Solids Struct. 32, 423 (1995), for a sine.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::Indenter;
/// use asperity::theory::PullOff;
/// let grid = Grid::surface([64, 64], [2.0, 2.0])?;
/// let pull_off = PullOff::new(&Indenter::Sphere { radius: 4.0 }, &grid, 1.0, 1e-3).unwrap();
/// assert!((pull_off.jkr / (-1.5 * std::f64::consts::PI * 1e-3 * 4.0 / 4.0) - 1.0).abs() < 1e-12);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PullOff {
    /// For an attraction of short range (Johnson, Kendall and Roberts): a mean pressure.
    pub jkr: f64,
    /// For an attraction of long range (Derjaguin, Muller and Toporov): a mean pressure; none for a cylinder, where it depends on the form of the
    /// attraction.
    pub dmt: Option<f64>,
}

impl PullOff {
    /// The pull-off of an indenter on a grid at the contact modulus `E*` and the work of adhesion `w`, an energy per area.
    ///
    /// `None` for other indenters than spheres and cylinders, where the contact would not fit the cell, and where a cylinder sticks to all of it.
    pub fn new(indenter: &Indenter, grid: &Grid, contact_modulus: f64, work: f64) -> Option<Self> {
        match *indenter {
            Indenter::Sphere { radius } => {
                let force = PI * work * radius / grid.area();
                let half_width = (9.0 * PI * work * radius * radius / (8.0 * contact_modulus)).cbrt();
                let fits = half_width < 0.5 * shortest_period(grid);
                fits.then_some(Self { jkr: -1.5 * force, dmt: Some(-2.0 * force) })
            }
            Indenter::Cylinder { radius } if grid.is_line() => {
                let length = grid.size()[1];
                let half_width = (2.0 * radius * radius * work / (PI * contact_modulus)).cbrt();
                let alone = -3.0 * (PI * contact_modulus * work * work * radius / 16.0).cbrt() / length;
                let slope = |s: f64| s / radius;
                let contact = Periodic { slope, period: length, contact_modulus };
                let jkr = if grid.is_periodic() { lowest(&contact, work, half_width)? } else { alone };
                (half_width < 0.5 * length).then_some(Self { jkr, dmt: None })
            }
            _ => None,
        }
    }
}

/// The first minimum of the mean pressure over the half-width of a periodic contact, near that of one that stands alone.
fn lowest<S: Fn(f64) -> f64>(contact: &Periodic<S>, work: f64, half_width: f64) -> Option<f64> {
    let &Periodic { period, contact_modulus, .. } = contact;
    let pressure = |a: f64| {
        let tension = (2.0 * contact_modulus * work * (PI * a / period).tan() / period).sqrt();
        contact.load(a) / period - tension
    };
    let widths = std::iter::successors(Some(0.1 * half_width), |a| Some(GROWTH * a));
    let rises = |a: &f64| pressure(GROWTH * a) > pressure(*a);
    let turn = widths.take_while(|a| GROWTH * a < 0.5 * period).find(rises)?;
    let (mut low, mut high) = (turn / GROWTH, GROWTH * turn);
    for _ in 0..HALVINGS {
        let third = (high - low) / 3.0;
        if pressure(low + third) < pressure(high - third) { high -= third } else { low += third }
    }
    Some(pressure(0.5 * (low + high)))
}

//! Table 1: load, gradient and `kappa_r` of cylinder and sphere in terms of the half-width of their contact.

use super::means::Points;
use super::measure::Measure;
use super::reproduction::Reproduction;
use super::smooth::{LINE, PERIOD, RADIUS, cylinder, half_width, sphere, strain, widths};
use super::verdict::Verdict;
use crate::study::{Estimate, Point, Realisation};

/// Half-widths of the contacts over the period, from and to: so small that the neighbouring cells do not matter.
const WIDTHS: [f64; 2] = [0.01, 0.03];

/// Cylinder and sphere, the sphere on a grid of `side` points per side.
pub(crate) fn realisations(side: usize) -> Vec<Realisation> {
    vec![cylinder(LINE, &widths(WIDTHS, 24)), sphere(side, &widths(WIDTHS, 6))]
}

/// Load, gradient and `kappa_r` of each, in units of `E*`, `R` and the half-width `c`.
pub(crate) fn reproduce(points: &Points) -> Reproduction {
    let of = |name, quantity: fn(&Point) -> f64| Estimate::from_values(points.named(name).map(quantity));
    let kappa_r = ["cylinder", "sphere"].map(|name| of(name, |row| Measure::Resolved.kappa_r()(&row.observables)));
    let gradient = |row: &Point| row.observables.rms_gradient_contact * RADIUS / half_width(row);
    let line_load = |row: &Point| strain(row) * PERIOD * RADIUS / half_width(row).powi(2);
    let point_load = |row: &Point| strain(row) * PERIOD * PERIOD * RADIUS / half_width(row).powi(3);
    let verdicts = vec![
        Verdict::number("table1.load.line", "", of("cylinder", line_load)),
        Verdict::number("table1.gradient.line", "", of("cylinder", gradient)),
        Verdict::number("table1.kappa_r.line", "resolved", kappa_r[0]),
        Verdict::number("table1.load.point", "", of("sphere", point_load)),
        Verdict::number("table1.gradient.point", "", of("sphere", gradient)),
        Verdict::number("table1.kappa_r.point", "resolved", kappa_r[1]),
        Verdict::number("table1.ratio", "resolved", kappa_r[0].over(kappa_r[1])),
    ];
    Reproduction { figure: None, verdicts }
}

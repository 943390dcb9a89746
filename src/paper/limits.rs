//! Tables of factors extrapolated to other grids, with their errors.

use super::means::Points;
use super::measure::Measure;
use serde::Serialize;

/// The factors at one Hurst exponent and load on a grid that need not be solved on, or in the continuum.
#[derive(Serialize)]
pub(crate) struct LimitRow {
    hurst: f64,
    reduced_pressure: f64,
    measure: Measure,
    /// Points along a side; none for the continuum.
    nx: Option<usize>,
    kappa: f64,
    kappa_error: f64,
    kappa_grid_error: f64,
    kappa_r: f64,
    kappa_r_error: f64,
    kappa_r_grid_error: f64,
}

/// The factors at all Hurst exponents and loads: counted on a grid of `nx` points along x, and both measures in the continuum.
pub(crate) fn limits(points: &Points, nx: usize) -> Vec<LimitRow> {
    let kinds = [(Measure::Counted, Some(nx)), (Measure::Counted, None), (Measure::Resolved, None)];
    let mut rows = Vec::new();
    for (measure, nx) in kinds {
        for hurst in points.exponents() {
            rows.extend(points.loads().into_iter().map(|load| LimitRow::new(points, hurst, load, measure, nx)));
        }
    }
    rows
}

impl LimitRow {
    fn new(points: &Points, hurst: f64, reduced_pressure: f64, measure: Measure, nx: Option<usize>) -> Self {
        let limit = |quantity| points.limit(Some(hurst), Some(reduced_pressure), nx, measure, quantity);
        let [kappa, kappa_r] = [limit(measure.kappa()), limit(measure.kappa_r())];
        Self {
            hurst,
            reduced_pressure,
            measure,
            nx,
            kappa: kappa.mean,
            kappa_error: kappa.error,
            kappa_grid_error: kappa.grid,
            kappa_r: kappa_r.mean,
            kappa_r_error: kappa_r.error,
            kappa_r_grid_error: kappa_r.grid,
        }
    }
}

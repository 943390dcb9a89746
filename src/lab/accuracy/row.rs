//! The file of all points.

use super::experiment::Measurements;
use super::quantity::QuantityValues;
use crate::error::FileError;
use crate::files::write_csv;
use crate::lab::Rival;
use serde::Serialize;
use std::path::Path;

/// One point; errors are relative.
#[derive(Serialize, Default)]
struct AccuracyRow {
    scene: &'static str,
    kind: &'static str,
    solver: Option<&'static str>,
    theory: Option<&'static str>,
    ny: Option<usize>,
    nx: Option<usize>,
    step: Option<usize>,
    eta: Option<f64>,
    transforms: Option<u64>,
    /// Median over the repeats.
    seconds: Option<f64>,
    least_seconds: Option<f64>,
    most_seconds: Option<f64>,
    pressure_error: Option<f64>,
    area_error: Option<f64>,
    kappa_r_error: Option<f64>,
    mean_gap_error: Option<f64>,
    peak_pressure_error: Option<f64>,
    area_counted_error: Option<f64>,
    kappa_r_counted_error: Option<f64>,
}

impl AccuracyRow {
    fn new(kind: &'static str, errors: QuantityValues) -> Self {
        let [area_error, kappa_r_error, mean_gap_error, peak_pressure_error, ..] = errors;
        let [.., area_counted_error, kappa_r_counted_error] = errors;
        Self {
            kind,
            area_error,
            kappa_r_error,
            mean_gap_error,
            peak_pressure_error,
            area_counted_error,
            kappa_r_counted_error,
            ..Self::default()
        }
    }

    /// The row of a solver on a grid.
    fn on_grid(kind: &'static str, rival: &Rival, [ny, nx]: [usize; 2], errors: QuantityValues) -> Self {
        Self { solver: Some(rival.name), ny: Some(ny), nx: Some(nx), ..Self::new(kind, errors) }
    }
}

/// Writes all points of all scenes as CSV, in full precision.
///
/// # Errors
/// The errors of [`write_csv`].
pub fn write_rows(path: &Path, all: &[Measurements]) -> Result<(), FileError> {
    write_csv(path, all.iter().flat_map(rows))
}

/// Errors of steps against the solution on the same grid, of grids against the truth, and of theories against the truth.
fn rows(Measurements { scene, ladder, models, curves }: &Measurements) -> impl Iterator<Item = AccuracyRow> {
    let steps = curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    let algebraic = steps.map(|(curve, point)| AccuracyRow {
        step: Some(point.step),
        eta: Some(point.eta),
        transforms: Some(point.transforms),
        seconds: Some(point.median()),
        least_seconds: point.seconds.first().copied(),
        most_seconds: point.seconds.last().copied(),
        pressure_error: Some(point.pressure_error),
        ..AccuracyRow::on_grid("algebraic", &curve.rival, curve.shape, point.errors)
    });
    let discretisation = ladder.rungs.iter().map(|rung| AccuracyRow {
        transforms: Some(rung.work.transforms),
        seconds: Some(rung.work.seconds),
        ..AccuracyRow::on_grid("discretisation", &Rival::MULTILEVEL, rung.shape, rung.errors)
    });
    let model = models
        .iter()
        .map(|model| AccuracyRow { theory: Some(model.theory), ..AccuracyRow::new("model", model.errors) });
    algebraic.chain(discretisation).chain(model).map(|row| AccuracyRow { scene: scene.name(), ..row })
}

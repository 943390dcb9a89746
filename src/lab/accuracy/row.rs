//! The file of all points.

use super::curve::{Curve, Point};
use super::findings::Findings;
use super::ladder::Rung;
use super::model::Model;
use super::quantity::Values;
use crate::error::FileError;
use crate::files::write_csv;
use crate::lab::Rival;
use serde::Serialize;
use std::path::Path;

/// One point; errors are relative.
#[derive(Serialize, Default)]
struct Row {
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
}

impl Row {
    fn new(kind: &'static str, [area_error, kappa_r_error, mean_gap_error, peak_pressure_error]: Values) -> Self {
        Self { kind, area_error, kappa_r_error, mean_gap_error, peak_pressure_error, ..Self::default() }
    }

    /// The error of a step against the solution on the same grid.
    fn of_point(curve: &Curve, point: &Point) -> Self {
        Self {
            solver: Some(curve.rival.name),
            step: Some(point.step),
            eta: Some(point.eta),
            transforms: Some(point.transforms),
            seconds: Some(point.median()),
            least_seconds: point.seconds.first().copied(),
            most_seconds: point.seconds.last().copied(),
            pressure_error: Some(point.pressure_error),
            ..Self::new("algebraic", point.errors).on(curve.shape)
        }
    }

    /// The error of a grid against the truth, root mean square over the loads.
    fn of_rung(rung: &Rung) -> Self {
        Self {
            solver: Some(Rival::MULTILEVEL.name),
            transforms: Some(rung.work.transforms),
            seconds: Some(rung.work.seconds),
            ..Self::new("discretisation", rung.errors).on(rung.shape)
        }
    }

    /// The error of a theory against the truth.
    fn of_model(model: &Model) -> Self {
        Self { theory: Some(model.theory), ..Self::new("model", model.errors) }
    }

    fn on(self, [ny, nx]: [usize; 2]) -> Self {
        Self { ny: Some(ny), nx: Some(nx), ..self }
    }
}

/// Writes all points of all scenes as CSV, in full precision.
///
/// # Errors
/// As [`write_csv`].
pub fn write_rows(path: &Path, all: &[Findings]) -> Result<(), FileError> {
    write_csv(path, all.iter().flat_map(rows))
}

fn rows(findings: &Findings) -> impl Iterator<Item = Row> {
    let algebraic = findings.curves.iter().flat_map(|c| c.points.iter().map(|point| Row::of_point(c, point)));
    let discretisation = findings.ladder.rungs.iter().map(Row::of_rung);
    let model = findings.models.iter().map(Row::of_model);
    let scene = findings.scene.name();
    algebraic.chain(discretisation).chain(model).map(move |row| Row { scene, ..row })
}

//! The file of all points.

use super::Measured;
use super::curve::{Curve, Point};
use super::ladder::Rung;
use super::model::Model;
use super::quantity::Values;
use super::scene::Scene;
use crate::cli::contender::Contender;
use asperity::error::FileError;
use asperity::files::write_csv;
use serde::Serialize;
use std::path::Path;

/// Which error.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    /// Of a step against the solution on the same grid.
    Algebraic,
    /// Of a grid against the truth, root mean square over the loads.
    Discretisation,
    /// Of a theory against the truth.
    Model,
}

/// One point; errors are relative.
#[derive(Serialize)]
struct Row<'a> {
    scene: Scene,
    kind: Kind,
    solver: Option<Contender>,
    theory: Option<&'a str>,
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

impl<'a> Row<'a> {
    fn new(scene: Scene, kind: Kind, [area, kappa_r, mean_gap, peak_pressure]: Values) -> Self {
        Self {
            scene,
            kind,
            solver: None,
            theory: None,
            ny: None,
            nx: None,
            step: None,
            eta: None,
            transforms: None,
            seconds: None,
            least_seconds: None,
            most_seconds: None,
            pressure_error: None,
            area_error: area,
            kappa_r_error: kappa_r,
            mean_gap_error: mean_gap,
            peak_pressure_error: peak_pressure,
        }
    }

    fn on(self, [ny, nx]: [usize; 2]) -> Self {
        Self { ny: Some(ny), nx: Some(nx), ..self }
    }

    fn of_point(scene: Scene, curve: &Curve, point: &Point) -> Self {
        Self {
            solver: Some(curve.contender),
            step: Some(point.step),
            eta: Some(point.eta),
            transforms: Some(point.transforms),
            seconds: Some(point.median()),
            least_seconds: point.seconds.first().copied(),
            most_seconds: point.seconds.last().copied(),
            pressure_error: Some(point.pressure_error),
            ..Self::new(scene, Kind::Algebraic, point.errors).on(curve.shape)
        }
    }

    fn of_rung(scene: Scene, rung: &Rung) -> Self {
        Self {
            solver: Some(Contender::Multilevel),
            transforms: Some(rung.work.transforms),
            seconds: Some(rung.work.seconds),
            ..Self::new(scene, Kind::Discretisation, rung.errors).on(rung.shape)
        }
    }

    fn of_model(scene: Scene, model: &'a Model) -> Self {
        Self { theory: Some(model.theory), ..Self::new(scene, Kind::Model, model.errors) }
    }
}

/// Writes all points of all scenes as CSV, in full precision.
pub fn write_rows(path: &Path, scenes: &[Measured]) -> Result<(), FileError> {
    write_csv(path, scenes.iter().flat_map(rows))
}

fn rows(measured: &Measured) -> impl Iterator<Item = Row<'_>> {
    let scene = measured.scene;
    let points = measured.curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    let algebraic = points.map(move |(curve, point)| Row::of_point(scene, curve, point));
    let discretisation = measured.ladder.rungs.iter().map(move |rung| Row::of_rung(scene, rung));
    let model = measured.models.iter().map(move |model| Row::of_model(scene, model));
    algebraic.chain(discretisation).chain(model)
}

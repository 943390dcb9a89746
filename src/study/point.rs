//! A solved point of a study.

use super::adhesion_row::AdhesionRow;
use super::check::Checksum;
use super::flow_row::FlowRow;
use crate::contact::{Observables, Status};
use csv::StringRecord;
use serde::{Deserialize, Serialize};

/// A solved point: a realisation under one of its loads, the status of the solver, and the results.
///
/// The fields are columns of a table, and so are those of its observables. What distinguishes the points of one
/// realisation from those of others is its name, the fingerprint of its setup, and the version of the program with the revision of its numerics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Name of the realisation.
    pub name: String,
    /// Points along y; 1 for lines.
    pub ny: usize,
    /// Points along x.
    pub nx: usize,
    /// Length of the cell along x.
    pub length: f64,
    /// Hurst exponent.
    pub hurst: Option<f64>,
    /// Roll-off wavelength, a length.
    pub rolloff_wavelength: Option<f64>,
    /// Short cut-off wavelength, a length.
    pub short_cutoff: Option<f64>,
    /// Seed of the random surface.
    pub seed: Option<u64>,
    /// Number of the load in its realisation, from 1.
    #[serde(rename = "load_number")]
    pub load: usize,
    /// Certificate `eta` that was requested.
    pub tolerance: f64,
    /// How the solver stopped.
    pub status: Status,
    /// Fingerprint of the setup.
    pub setup: String,
    /// Version of the program, with the revision of its numerics.
    pub version: String,
    /// The numbers that were found.
    #[serde(skip)]
    pub observables: Observables,
    /// What was found with adhesion; the observables are zero then.
    #[serde(skip)]
    pub adhesion: AdhesionRow,
    /// What flows through the contact, as far as it was asked for.
    #[serde(skip)]
    pub flow: FlowRow,
    /// Seconds of the solver, which differ from run to run.
    #[serde(skip)]
    pub seconds: f64,
}

/// What a point took.
#[derive(Serialize)]
struct Spent {
    seconds: f64,
}

impl Point {
    /// Points as lines of comma-separated values without a head, all numbers to the last bit, each line with its check sum.
    pub fn to_lines<'a>(points: impl IntoIterator<Item = &'a Self>) -> String {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        let mut rows = points.into_iter().map(Self::row);
        let written = rows.try_for_each(|row| csv.serialize((&row, Checksum::from_row(&row))));
        let text = written.ok().and_then(|()| String::from_utf8(csv.into_inner().ok()?).ok());
        text.expect("numbers and texts have a form in lines")
    }

    /// The points in such lines, as far as these are whole and as they were written.
    pub fn from_lines(text: &[u8]) -> Vec<Self> {
        let csv = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
        csv.into_records().flatten().filter_map(|record| Self::from_record(&record)).collect()
    }

    /// All that is written of the point.
    fn row(&self) -> impl Serialize {
        (self, self.observables, self.adhesion, self.flow, Spent { seconds: self.seconds })
    }

    fn from_record(record: &StringRecord) -> Option<Self> {
        let (point, observables, adhesion, flow, seconds, _): (Self, Observables, AdhesionRow, FlowRow, f64, String) =
            record.deserialize(None).ok()?;
        let point = Self { observables, adhesion, flow, seconds, ..point };
        Checksum::holds(&Checksum::names(point.row()), record).then_some(point)
    }

    /// Whether the certificate met the tolerance. Other points are kept in tables, but left out of means.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// Whether the point has the history of a setup with adhesion.
    pub fn has_adhesion(&self) -> bool {
        self.adhesion.states.is_some()
    }

    /// Whether the solver converged and the grid resolves the contact. Other points are kept in tables, but left out of
    /// means. With adhesion, grids that do not resolve the attraction are refused from the first.
    pub fn is_resolved(&self) -> bool {
        if self.has_adhesion() {
            return self.is_converged();
        }
        self.relative_area().is_some() && self.kappa_r().is_some()
    }

    /// Whether the solver converged and the grid gives the contact an area and a gradient, however large their errors.
    /// That is enough for an extrapolation over grids, which estimates the error itself.
    pub fn has_contact(&self) -> bool {
        let Observables { relative_area, kappa_r, .. } = self.observables;
        self.is_converged() && relative_area > 0.0 && kappa_r > 0.0 && kappa_r.is_finite()
    }

    /// The relative area, where the solver converged and the grid resolves the contact.
    pub fn relative_area(&self) -> Option<f64> {
        self.observables.resolved_area().filter(|_| self.is_converged())
    }

    /// `kappa_r`, where the solver converged and the grid resolves the contact.
    pub fn kappa_r(&self) -> Option<f64> {
        self.observables.resolved_kappa_r().filter(|_| self.is_converged())
    }
}

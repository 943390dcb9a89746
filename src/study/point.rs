//! A solved point of a study.

use super::check::Checksum;
use crate::contact::{Observables, Quantity, QuantityKind, Status};
use csv::StringRecord;
use serde::{Deserialize, Serialize};
use strum::IntoEnumIterator;

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
    /// The numbers of the contact, or of the last state of a history; zero with adhesion.
    #[serde(skip)]
    pub observables: Observables,
    /// Further numbers: what flows through the contact, as far as it was asked for, and of a history what its states add up to, and what its process
    /// knows of the last one.
    #[serde(skip)]
    pub further: Vec<(Quantity, f64)>,
    /// Seconds of the solver, which differ from run to run.
    #[serde(skip)]
    pub seconds: f64,
}

/// Columns of a point before its numbers.
const META: usize = 13;

/// The further numbers of a line, in the order of the table of quantities.
pub(super) fn further() -> impl Iterator<Item = Quantity> {
    Quantity::iter().filter(|it| it.row().is_known_by_process)
}

/// A further number as a word.
pub(super) fn word(quantity: Quantity, value: Option<f64>) -> String {
    match (value, quantity.row().kind) {
        (None, _) => String::new(),
        (Some(value), QuantityKind::Flag) => (value == 1.0).to_string(),
        (Some(value), QuantityKind::Whole) => format!("{value}"),
        (Some(value), QuantityKind::Number | QuantityKind::Bound) => format!("{value:?}"),
    }
}

/// The further number in a word.
fn number(word: &str) -> Option<f64> {
    match word {
        "true" => Some(1.0),
        "false" => Some(0.0),
        _ => word.parse().ok(),
    }
}

impl Point {
    /// Points as lines of comma-separated values without a head, all numbers to the last bit, each line with its check sum.
    pub fn to_lines<'a>(points: impl IntoIterator<Item = &'a Self>) -> String {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        let mut lines = points.into_iter().map(|point| {
            let (names, words) = point.words(true, further(), true);
            words.iter().cloned().chain([Checksum::from_words(&names, &words)]).collect::<Vec<_>>()
        });
        let written = lines.try_for_each(|line| csv.write_record(line));
        let text = written.ok().and_then(|()| String::from_utf8(csv.into_inner().ok()?).ok());
        text.expect("numbers and texts have a form in lines")
    }

    /// The points in such lines, as far as these are whole and as they were written.
    pub fn from_lines(text: &[u8]) -> Vec<Self> {
        let csv = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
        csv.into_records().flatten().filter_map(|record| Self::from_record(&record)).collect()
    }

    /// The names and the words of its columns, in their order, without a check sum: with or without the numbers of the contact, and with some further
    /// numbers and the seconds.
    pub(super) fn words(
        &self,
        has_observables: bool,
        further: impl IntoIterator<Item = Quantity>,
        has_seconds: bool,
    ) -> (Vec<String>, Vec<String>) {
        let mut csv = csv::Writer::from_writer(Vec::new());
        let written = if has_observables { csv.serialize((self, self.observables)) } else { csv.serialize(self) };
        written.expect("numbers and texts have a form in lines");
        let text = csv.into_inner().expect("lines fit in memory");
        let mut lines = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_slice()).into_records();
        let mut line = || lines.next().and_then(Result::ok).expect("a head and a line were written");
        let [mut names, mut words] = [line(), line()].map(|it| it.iter().map(str::to_owned).collect::<Vec<_>>());
        for quantity in further {
            names.push(quantity.name().into());
            words.push(word(quantity, self.get(quantity)));
        }
        if has_seconds {
            names.push("seconds".into());
            words.push(format!("{:?}", self.seconds));
        }
        (names, words)
    }

    fn from_record(record: &StringRecord) -> Option<Self> {
        let before = META + Quantity::found().count();
        let behind = record.len().checked_sub(before + 2)?;
        let head: StringRecord = record.iter().take(before).collect();
        let (point, observables): (Self, Observables) = head.deserialize(None).ok()?;
        let further: Vec<Quantity> = further().take(behind).collect();
        let words = record.iter().skip(before).zip(&further);
        let numbers = words.filter_map(|(word, quantity)| Some((*quantity, number(word)?))).collect();
        let seconds = record.get(record.len() - 2)?.parse().ok()?;
        let point = Self { observables, further: numbers, seconds, ..point };
        let (mut names, _) = point.words(true, further, true);
        names.push(Checksum::NAME.into());
        Checksum::holds(&names.into(), record).then_some(point)
    }

    /// The point in a row of a table under the names of its columns, if the row is as it was written.
    ///
    /// # Errors
    /// For a row that is no point.
    pub(super) fn from_named(record: &StringRecord, names: &StringRecord) -> csv::Result<Option<Self>> {
        let point: Self = record.deserialize(Some(names))?;
        let observables = record.deserialize(Some(names))?;
        let named = names.iter().zip(record).filter_map(|(name, word)| {
            let quantity = Quantity::find(name).filter(|it| it.row().is_known_by_process)?;
            Some((quantity, number(word)?))
        });
        let further = named.collect();
        Ok(Checksum::holds(names, record).then_some(Self { observables, further, ..point }))
    }

    /// A further number, if the point has it.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.further.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }

    /// The pull-off pressure of a history with adhesion: minus the lowest pressure, where the surfaces stuck.
    pub fn pull_off(&self) -> Option<f64> {
        self.get(Quantity::LowestPressure).map(|lowest| (-lowest).max(0.0))
    }

    /// Energy lost in all jumps; none where the surfaces parted under the load, since that jump has no end.
    pub fn lost(&self) -> Option<f64> {
        self.get(Quantity::LostInJumps).filter(|_| self.get(Quantity::Separated) == Some(0.0))
    }

    /// Whether the certificate met the tolerance. Other points are kept in tables, but left out of means.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// Whether the point is a history.
    pub fn is_history(&self) -> bool {
        self.get(Quantity::States).is_some()
    }

    /// Whether the surfaces are apart at the end of a history, so that there is no contact that a grid could resolve.
    pub fn is_apart(&self) -> bool {
        self.is_history() && self.observables.relative_area_counted == 0.0
    }

    /// Whether the point has the history of a setup with adhesion.
    pub fn has_adhesion(&self) -> bool {
        self.get(Quantity::Jumps).is_some()
    }

    /// Whether the point has the history of a solid that yields below its surface.
    pub fn yields(&self) -> bool {
        self.get(Quantity::ImprintDepth).is_some()
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

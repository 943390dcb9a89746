//! Adhesion between surface and solid.

use crate::adhesion::{AdhesiveMethod, Attraction, AttractionForm};
use crate::error::{AdhesionError, ConflictRule, FileError, SetupError};
use crate::files::{InputFile, columns_of};
use crate::quantity;
use serde::{Deserialize, Serialize};

/// The attraction between surface and solid, and the method that finds its states.
///
/// In a scene it is the section `adhesion`: a work of adhesion and a range, or a table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Adhesion {
    /// Work of adhesion, an energy per area.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "quantity::some_energy_per_area")]
    pub work: Option<f64>,
    /// Range of the attraction: the work of adhesion over the strength, a length.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "quantity::some_length")]
    pub range: Option<f64>,
    /// How the attraction falls with the gap.
    #[serde(skip_serializing_if = "is_default")]
    pub form: AttractionForm,
    /// A file of comma-separated values with the columns `gap` and `traction`, instead of work, range and form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<InputFile>,
    /// The method.
    #[serde(skip_serializing_if = "is_default")]
    pub method: AdhesiveMethod,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Adhesion {
    /// The attraction.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for a section that is not complete or says too much, [`SetupError::Table`] for a table of other columns, the
    /// errors of [`Attraction::new`] and
    /// [`Attraction::from_table`], and those of reading the table.
    pub fn attraction(&self) -> Result<Attraction, SetupError> {
        match (self.work, self.range, &self.table) {
            (Some(work), Some(range), None) => Ok(Attraction::new(self.form, work, range)?),
            (None, None, Some(file)) if self.form == AttractionForm::default() => read_table(file),
            (_, _, Some(_)) => Err(ConflictRule::AdhesionTwice.into()),
            (None, _, None) => Err(ConflictRule::AdhesionWithoutWork.into()),
            (_, None, None) => Err(ConflictRule::AdhesionWithoutRange.into()),
        }
    }
}

/// Reads the table of an attraction. Its gaps and tractions may have units.
fn read_table(file: &InputFile) -> Result<Attraction, SetupError> {
    let path = file.path();
    let wrong = |reason: String| SetupError::Table { path: path.into(), reason };
    let columns = columns_of(&file.text_bytes()?);
    let columns =
        columns.map_err(|reason| FileError::Format { path: path.into(), what: "table", reason: reason.into() })?;
    let column = |name: &str, kind: &str, read: fn(&str) -> Option<f64>| {
        let found = columns.iter().find(|column| column.name.eq_ignore_ascii_case(name));
        let missing = || wrong(format!("the column {name} is missing: name columns gap and traction"));
        let of_word = |word: &str| read(word).ok_or_else(|| format!("`{word}` in the column {name} is not a {kind}"));
        found.ok_or_else(missing)?.numbers(of_word).map_err(wrong)
    };
    let gaps = column("gap", "length", quantity::length_of)?;
    let tractions = column("traction", "pressure", quantity::pressure_of)?;
    Attraction::from_table(gaps, tractions).map_err(|error| match error {
        AdhesionError::Table { point, reason } => {
            let row = point.and_then(|point| Some(columns.first()?.words.get(point)?.row));
            wrong(row.map_or(reason.clone(), |row| format!("row {row}: {reason}")))
        }
        other => other.into(),
    })
}

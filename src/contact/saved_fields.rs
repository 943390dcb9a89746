//! Fields of states that are read again.

use crate::contact::{ArchiveReader, CutLayers, FieldKind, On};
use crate::error::FileError;
use crate::surface::Field;
use ndarray::Ix3;
use strum::IntoEnumIterator;

/// The fields that states in an archive have besides those of their contacts: each with its values in all states.
///
/// # Errors
/// [`FileError::Format`] for arrays that do not fit the states, and for values that are not finite where they must be known.
pub fn read_state_fields(reader: &ArchiveReader) -> Result<Vec<(FieldKind, Vec<Field>)>, FileError> {
    let mut fields = Vec::new();
    for kind in FieldKind::iter() {
        let row = kind.row();
        if !reader.has(row.array)? {
            continue;
        }
        let values = match row.on {
            On::Surface => reader.fields_with(row.array, row.may_be_unknown)?,
            On::Cut => fields_in_cut(reader, row.array)?,
        };
        fields.push((kind, values));
    }
    Ok(fields)
}

/// The layers of the cut that fields of the states lie in; none where they have no such fields.
///
/// # Errors
/// [`FileError::Format`] for an archive that is cut short.
pub fn read_cut_layers(reader: &ArchiveReader) -> Result<Option<CutLayers>, FileError> {
    if !reader.has("cut_interfaces")? {
        return Ok(None);
    }
    let row = reader.shared("cut_row")?.first().map_or(0.0, |row| *row) as usize;
    Ok(Some(CutLayers { row, interfaces: reader.shared("cut_interfaces")? }))
}

/// The values of a field in the layers of a cut, one array of each state, shape `(layers, nx)`.
fn fields_in_cut(reader: &ArchiveReader, array: &'static str) -> Result<Vec<Field>, FileError> {
    let wrong = |reason: &str| FileError::Format { path: reader.path().into(), what: "result", reason: reason.into() };
    let interfaces = reader.shared("cut_interfaces")?;
    let values = reader.read(array)?.into_dimensionality::<Ix3>();
    let values = values.map_err(|_| wrong("its cut does not have layers and columns for each state"))?;
    let expected = (reader.count(), interfaces.len().saturating_sub(1), reader.height()?.ncols());
    if values.dim() != expected || values.iter().any(|value| !value.is_finite()) {
        return Err(wrong("the layers of its cut do not fit its states, or are not finite"));
    }
    Ok(values.outer_iter().map(|it| it.as_standard_layout().into_owned()).collect())
}

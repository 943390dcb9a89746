//! Cuts through layers that are read again.

use crate::contact::{ArchiveReader, DepthCut};
use crate::error::FileError;
use crate::surface::Field;
use ndarray::Ix3;

/// The cuts of an archive, one of each state; none where it has none.
///
/// # Errors
/// [`FileError::Format`] for arrays that do not fit each other, or with values that are not finite.
pub fn read_cuts(reader: &ArchiveReader) -> Result<Vec<DepthCut>, FileError> {
    if !reader.has("cut_interfaces")? {
        return Ok(Vec::new());
    }
    let wrong = |reason: &str| FileError::Format { path: reader.path().into(), what: "result", reason: reason.into() };
    let interfaces = reader.shared("cut_interfaces")?;
    let row = reader.shared("cut_row")?.first().map_or(0.0, |row| *row) as usize;
    let columns = reader.height()?.ncols();
    let layers = |name: &'static str| -> Result<Vec<Field>, FileError> {
        let array = reader.read(name)?.into_dimensionality::<Ix3>();
        let array = array.map_err(|_| wrong("its cut does not have layers and columns for each state"))?;
        let is_right = array.dim() == (reader.count(), interfaces.len().saturating_sub(1), columns);
        match is_right && array.iter().all(|value| value.is_finite()) {
            true => Ok(array.outer_iter().map(|it| it.as_standard_layout().into_owned()).collect()),
            false => Err(wrong("the layers of its cut do not fit its states, or are not finite")),
        }
    };
    let pairs = layers("cut_plastic_strain")?.into_iter().zip(layers("cut_von_mises")?);
    let cut = |(plastic_strain, von_mises)| DepthCut { row, interfaces: interfaces.clone(), plastic_strain, von_mises };
    Ok(pairs.map(cut).collect())
}

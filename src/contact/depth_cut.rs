//! A cut through the layers below a surface.

use crate::contact::ArchiveReader;
use crate::error::FileError;
use crate::surface::Field;
use ndarray::Ix3;

/// What lies in the layers below one row of a surface, or below a line, of a solid that yields.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthCut {
    /// The row, from 0.
    pub row: usize,
    /// The depths of the interfaces of the layers, lengths, from 0 on: one more than there are layers.
    pub interfaces: Vec<f64>,
    /// Accumulated plastic strain, shape `(layers, nx)`.
    pub plastic_strain: Field,
    /// Von Mises stress, a pressure, means over the layers, shape `(layers, nx)`.
    pub von_mises: Field,
}

impl DepthCut {
    /// The cuts of an archive, one of each state; none where it has none.
    ///
    /// # Errors
    /// [`FileError::Format`] for arrays that do not fit each other, or with values that are not finite.
    pub fn read_all(reader: &ArchiveReader) -> Result<Option<Vec<Self>>, FileError> {
        if !reader.has("cut_interfaces")? {
            return Ok(None);
        }
        let wrong =
            |reason: &str| FileError::Format { path: reader.path().into(), what: "result", reason: reason.into() };
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
        let cut = |(plastic_strain, von_mises)| Self { row, interfaces: interfaces.clone(), plastic_strain, von_mises };
        Ok(Some(pairs.map(cut).collect()))
    }
}

//! Tables of studies as Parquet, which holds columns and their kinds.

use super::column::{Column, ColumnValues};
use super::plan::Plan;
use super::point::Point;
use crate::error::FileError;
use crate::files::write_beside;
use parquet::basic::{Compression, GzipLevel, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

impl Plan {
    /// Writes the columns of a share as Parquet, see [`Plan::columns`].
    ///
    /// # Errors
    /// The errors of [`write_beside`].
    pub fn write_parquet(&self, path: &Path, share: &[usize], points: &[Point]) -> Result<(), FileError> {
        write_beside(path, |file| {
            let mut writer = None;
            self.in_columns(share, points, |columns, is_first| {
                if is_first {
                    let properties =
                        WriterProperties::builder().set_compression(Compression::GZIP(GzipLevel::default()));
                    let made = SerializedFileWriter::new(Vec::new(), schema(columns)?, properties.build().into());
                    writer = Some(made?);
                }
                Ok(writer.as_mut().map_or(Ok(()), |writer| write(columns, writer))?)
            })?;
            let bytes = writer.map(SerializedFileWriter::into_inner).transpose().map_err(io::Error::other)?;
            file.write_all(&bytes.unwrap_or_default())
        })
    }
}

/// The names and kinds of columns.
fn schema(columns: &[Column]) -> Result<TypePtr> {
    let fields = columns.iter().map(field).collect::<Result<_>>()?;
    Ok(Arc::new(Type::group_type_builder("study").with_fields(fields).build()?))
}

fn field(column: &Column) -> Result<TypePtr> {
    let (physical, logical, repetition) = match column.values {
        ColumnValues::Whole(_) => (Physical::INT64, Some(LogicalType::integer(64, false)), Repetition::OPTIONAL),
        ColumnValues::Number(_) => (Physical::DOUBLE, None, Repetition::OPTIONAL),
        ColumnValues::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED),
    };
    let field = Type::primitive_type_builder(&column.name, physical);
    Ok(Arc::new(field.with_repetition(repetition).with_logical_type(logical).build()?))
}

/// Writes columns as a group of rows.
fn write<W: Write + Send>(columns: &[Column], writer: &mut SerializedFileWriter<W>) -> Result<()> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        if let Some(mut writer) = group.next_column()? {
            write_column(&column.values, &mut writer)?;
            writer.close()?;
        }
    }
    group.close().map(drop)
}

fn write_column(values: &ColumnValues, writer: &mut SerializedColumnWriter<'_>) -> Result<()> {
    match values {
        ColumnValues::Whole(values) => {
            let there: Vec<i64> = values.iter().flatten().map(|&value| value as i64).collect();
            writer.typed::<Int64Type>().write_batch(&there, Some(&levels(values)), None)?;
        }
        ColumnValues::Number(values) => {
            let there: Vec<f64> = values.iter().flatten().copied().collect();
            writer.typed::<DoubleType>().write_batch(&there, Some(&levels(values)), None)?;
        }
        ColumnValues::Text(values) => {
            let there: Vec<ByteArray> = values.iter().map(|value| value.as_str().into()).collect();
            writer.typed::<ByteArrayType>().write_batch(&there, None, None)?;
        }
    }
    Ok(())
}

/// 1 for each value that is there, 0 for each that is not.
fn levels<T>(values: &[Option<T>]) -> Vec<i16> {
    values.iter().map(|value| i16::from(value.is_some())).collect()
}

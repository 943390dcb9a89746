//! The files that are written beside the table of a study.

use super::plan::Plan;
use super::point::Point;
use super::table::Table;
use crate::error::FileError;
use crate::plot::{FigureStyle, write_figure};
use std::path::{Path, PathBuf};

impl Plan {
    /// Writes the files beside the table of a whole study, NAME.parquet and the figure in a style as NAME.svg and NAME.png, and
    /// returns these paths.
    ///
    /// # Errors
    /// [`FileError::Target`] or [`FileError::Write`].
    pub fn write_views(&self, table: &Path, points: &[Point], style: &FigureStyle) -> Result<[PathBuf; 3], FileError> {
        let paths = Table::new(table).views();
        let [parquet, svg, png] = &paths;
        let all: Vec<usize> = (0..self.realisations()).collect();
        self.write_parquet(parquet, &all, points)?;
        let figure = self.figure(&table.file_stem().unwrap_or_default().to_string_lossy(), points);
        write_figure(svg, &figure, style)?;
        write_figure(png, &figure, style)?;
        Ok(paths)
    }
}

//! Statistics of several files of heights: a row for each and one of their mean.

use super::exit_status::{ExitStatus, usage};
use super::output::write_json;
use super::surface_statistics::Statistics;
use super::terminal::stdout;
use super::units::{Units, significant};
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::error::FileError;
use asperity::files::write_csv;
use serde_json::{Map, Value};
use std::io::{self, Write};
use std::path::Path;

/// The name of the last row.
const MEAN_ROW: &str = "mean";
/// Columns without a mean: an angle, which is the same after half a turn.
const COLUMNS_WITHOUT_MEAN: [&str; 1] = ["std"];
/// The first columns that a person is shown.
const PRINTED_COLUMNS: [(&str, &str); 3] =
    [("rms_height", "rms height"), ("rms_gradient", "rms gradient"), ("voids", "voids")];

/// A row: a name and the numbers of columns in their order, none where one is not defined.
struct TableRow {
    name: String,
    values: Vec<(String, Option<f64>)>,
}

/// The statistics of several files.
pub(crate) struct SurfaceTable {
    rows: Vec<TableRow>,
    /// Columns in the order in which they first occur.
    columns: Vec<String>,
    warnings: Vec<String>,
    units: Units,
}

impl SurfaceTable {
    /// The table of files by their names.
    ///
    /// # Errors
    /// For files of which some have units and others do not, so that they have no mean.
    pub(crate) fn new(files: &[(String, Statistics)], units: Units) -> Result<Self> {
        let with_units = files.iter().find(|(_, it)| it.is_in_metres());
        if let (Some((known, _)), Some((unknown, _))) = (with_units, files.iter().find(|(_, it)| !it.is_in_metres())) {
            return usage(format!(
                "{unknown} has no units, but {known} has: give the unit with --file-unit for those without, in a call of their own"
            ));
        }
        let mut rows: Vec<TableRow> =
            files.iter().map(|(name, it)| TableRow { name: name.clone(), values: it.columns() }).collect();
        let mut columns: Vec<String> = Vec::new();
        for (name, _) in rows.iter().flat_map(|row| &row.values) {
            if !columns.contains(name) {
                columns.push(name.clone());
            }
        }
        let mean = |column: &String| {
            let values: Vec<f64> = rows.iter().filter_map(|row| row.find(column)).collect();
            let is_defined = !values.is_empty() && !COLUMNS_WITHOUT_MEAN.contains(&column.as_str());
            is_defined.then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        let means = columns.iter().map(|column| (column.clone(), mean(column))).collect();
        rows.push(TableRow { name: MEAN_ROW.into(), values: means });
        let told =
            files.iter().flat_map(|(name, it)| it.warnings.iter().map(move |warning| format!("{name}: {warning}")));
        Ok(Self { columns, warnings: told.collect(), rows, units })
    }

    /// Writes the table to a file, and prints what a person or, in JSON, a program wants to know of it.
    pub(crate) fn run(&self, out: Option<&Path>, is_json: bool, is_strict: bool) -> Result<ExitStatus> {
        warnings::refuse_if_strict(&self.warnings, is_strict)?;
        if let Some(path) = out {
            self.write(path)?;
        }
        match is_json {
            true => write_json(&self.json(), &mut stdout())?,
            false => self.print(&mut stdout())?,
        }
        warnings::print(&self.warnings);
        out.into_iter().for_each(wrote);
        Ok(ExitStatus::Done)
    }

    fn write(&self, path: &Path) -> Result<(), FileError> {
        let names: Vec<String> = std::iter::once("file".to_owned()).chain(self.columns.iter().cloned()).collect();
        let rows = self.rows.iter().map(|row| {
            // a number that is not defined is an empty cell, which enters nobody's mean
            let cell = |column: &String| row.find(column).map_or(String::new(), |value| format!("{value:?}"));
            std::iter::once(row.name.clone()).chain(self.columns.iter().map(cell)).collect()
        });
        write_csv(path, std::iter::once(names).chain(rows))
    }

    fn json(&self) -> Vec<Map<String, Value>> {
        let object = |row: &TableRow| {
            let values = self.columns.iter().map(|column| (column.clone(), row.find(column).into()));
            std::iter::once(("file".to_owned(), Value::from(row.name.clone()))).chain(values).collect()
        };
        self.rows.iter().map(object).collect()
    }

    fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let width = self.rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max(4);
        let titles = PRINTED_COLUMNS.map(|(_, title)| format!("{title:>16}")).concat();
        writeln!(out, "{:width$}{titles}", "file")?;
        for row in &self.rows {
            let cell = |(column, _): (&str, &str)| match row.find(column) {
                None => "-".to_owned(),
                Some(length) if column == "rms_height" => self.units.length(length),
                Some(value) => significant(value),
            };
            writeln!(
                out,
                "{:width$}{}",
                row.name,
                PRINTED_COLUMNS.map(|shown| format!("{:>16}", cell(shown))).concat()
            )?;
        }
        Ok(())
    }
}

impl TableRow {
    fn find(&self, column: &str) -> Option<f64> {
        self.values.iter().find(|it| it.0 == column).and_then(|it| it.1)
    }
}

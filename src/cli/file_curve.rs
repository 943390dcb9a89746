//! Curves of two quantities in results and tables, with error bars.

use super::exit_status::usage;
use super::result_file;
use anyhow::Result;
use asperity::contact::Quantity;
use asperity::error::FileError;
use asperity::files::{TextColumn, read_columns};
use asperity::plot::Dot;
use asperity::study::{SeedMean, first_changed_row};
use std::path::Path;

/// The column of the seeds in a table of a study, and how columns begin of what is varied along a curve.
const SEED_COLUMN: &str = "surface.seed";
const LOADING_COLUMNS: [&str; 2] = ["load.", "path."];

/// What is drawn along the horizontal axis of a curve.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Abscissa<'a> {
    /// A quantity of a result.
    Quantity(Quantity),
    /// A value from the lists of a study, by its key or the last part of it, such as `hurst`.
    Listed(&'a str),
}

impl Abscissa<'_> {
    /// Its name in tables.
    fn name(&self) -> &str {
        match self {
            Self::Quantity(quantity) => quantity.name(),
            Self::Listed(name) => name,
        }
    }

    /// Whether a column of a table holds the values of this abscissa.
    fn is(&self, column: &TextColumn) -> bool {
        match self {
            Self::Quantity(quantity) => column.name == quantity.name(),
            Self::Listed(name) => {
                column.name.contains('.') && (column.name == *name || key(&column.name) == name.replace('_', "-"))
            }
        }
    }
}

/// A curve in a file.
pub(crate) struct FileCurve {
    /// The name of the file, and of a study the values from its lists.
    pub name: String,
    /// The pairs that are known, in their order, with the error of the quantity upwards.
    pub dots: Vec<Dot>,
}

/// Numbers of two quantities, and the relative errors of the second one, row by row.
struct FileNumbers {
    pairs: Vec<[f64; 2]>,
    errors: Vec<f64>,
}

/// The curves of two quantities in a file: one, or of a study one for each combination of values. A curve of a study bears the name of the
/// file if `is_one_of_many`.
///
/// # Errors
/// For a file that is no result or table, that does not have a quantity, or that has no numbers of both.
pub(crate) fn curves_of(path: &Path, x: Abscissa<'_>, y: Quantity, is_one_of_many: bool) -> Result<Vec<FileCurve>> {
    let is_archive = path.is_dir() || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut curves = match is_archive {
        true => vec![FileCurve { dots: of_archive(path, x, y)?.dots(), name }],
        false => {
            let columns = read_columns(path)?;
            if let Some(row) = first_changed_row(&columns) {
                return usage(format!(
                    "row {row} of {} is not as it was written: its check sum does not fit. Make the table again, or take the column `{}` out to draw \
                     what is there",
                    path.display(),
                    columns[columns.len() - 1].name
                ));
            }
            let numbers = of_columns(path, &columns, x, y)?;
            let named = |values: &str| match (values.is_empty(), is_one_of_many) {
                (true, _) => name.clone(),
                (false, true) => format!("{name}, {values}"),
                (false, false) => values.to_owned(),
            };
            match columns.first().is_some_and(|column| column.name == "row") {
                true => of_study(&columns, &numbers, x, named),
                false => vec![FileCurve { dots: numbers.dots(), name }],
            }
        }
    };
    for curve in &mut curves {
        curve.dots.retain(|dot| is_known(dot, x, y));
    }
    curves.retain(|curve| !curve.dots.is_empty());
    match curves.is_empty() {
        true => usage(format!(
            "{} has no numbers of {} beside {}: choose other quantities",
            path.display(),
            y.name(),
            x.name()
        )),
        false => Ok(curves),
    }
}

/// Whether both numbers are known. An area of 0, or a `kappa` of it, is that of a contact that is not resolved.
fn is_known(dot: &Dot, x: Abscissa<'_>, y: Quantity) -> bool {
    let is_of_area = |it: Quantity| it.relative_error().is_some();
    let is_known = |value: f64, is_of_area: bool| value.is_finite() && (value != 0.0 || !is_of_area);
    is_known(dot.x, matches!(x, Abscissa::Quantity(it) if is_of_area(it))) && is_known(dot.y, is_of_area(y))
}

impl FileNumbers {
    fn new([x, y]: [Vec<f64>; 2], errors: Option<Vec<f64>>) -> Self {
        let errors = errors.unwrap_or_else(|| vec![f64::NAN; y.len()]);
        Self { pairs: x.into_iter().zip(y).map(<[f64; 2]>::from).collect(), errors }
    }

    /// A dot for each row.
    fn dots(&self) -> Vec<Dot> {
        (0..self.pairs.len()).map(|row| self.dot(&[row])).collect()
    }

    /// The dot of some rows: the means of their numbers that are known, with a bar of the standard deviation plus the error of the grid.
    fn dot(&self, rows: &[usize]) -> Dot {
        let known = || rows.iter().filter(|row| self.pairs[**row].iter().all(|it| it.is_finite()));
        let x = SeedMean::from_values(known().map(|row| (self.pairs[*row][0], f64::NAN)));
        let y = SeedMean::from_values(known().map(|row| {
            let value = self.pairs[*row][1];
            (value, value.abs() * self.errors[*row])
        }));
        Dot { x: x.mean, y: y.mean, spread: y.bar() }
    }
}

fn of_archive(path: &Path, x: Abscissa<'_>, y: Quantity) -> Result<FileNumbers> {
    let archive = result_file::open(path)?;
    let Abscissa::Quantity(x) = x else { return Err(missing(path, x.name()).into()) };
    let numbers = |it: Quantity| archive.numbers(it.name())?.ok_or_else(|| missing(path, it.name()));
    let pairs = [numbers(x)?, numbers(y)?];
    let errors = y.relative_error().map(|it| archive.numbers(it.name())).transpose()?.flatten();
    Ok(FileNumbers::new(pairs, errors))
}

fn of_columns(path: &Path, columns: &[TextColumn], x: Abscissa<'_>, y: Quantity) -> Result<FileNumbers> {
    let find = |it: Abscissa<'_>| columns.iter().find(|column| it.is(column));
    let numbers = |column: &TextColumn| -> Vec<f64> {
        column.words.iter().map(|word| word.text.parse().unwrap_or(f64::NAN)).collect()
    };
    let [x, y_numbers] =
        [x, Abscissa::Quantity(y)].map(|it| find(it).map(numbers).ok_or_else(|| missing(path, it.name())));
    let errors = y.relative_error().and_then(|it| find(Abscissa::Quantity(it)));
    Ok(FileNumbers::new([x?, y_numbers?], errors.map(numbers)))
}

/// The columns of the table of a study that say which rows are a curve, and which of these are a dot.
struct StudyColumns<'a> {
    /// Values from the lists that differ.
    varied: Vec<&'a TextColumn>,
    /// Loads and points of a path, or the value from a list that is drawn to the right.
    along: Vec<&'a TextColumn>,
    status: Option<&'a TextColumn>,
}

impl<'a> StudyColumns<'a> {
    fn new(columns: &'a [TextColumn], x: Abscissa<'_>) -> Self {
        let is_loading = |name: &str| LOADING_COLUMNS.iter().any(|beginning| name.starts_with(beginning));
        let is_along = |column: &TextColumn| match x {
            Abscissa::Quantity(_) => column.name == "load_number" || is_loading(&column.name),
            Abscissa::Listed(_) => x.is(column),
        };
        let is_varied =
            |column: &TextColumn| column.name.contains('.') && column.name != SEED_COLUMN && !is_along(column);
        let differs = |column: &TextColumn| column.words.windows(2).any(|pair| pair[0].text != pair[1].text);
        Self {
            varied: columns.iter().filter(|column| is_varied(column) && differs(column)).collect(),
            along: columns.iter().filter(|column| is_along(column)).collect(),
            status: columns.iter().find(|column| column.name == "status"),
        }
    }

    fn is_converged(&self, row: usize) -> bool {
        self.status.is_none_or(|column| column.words[row].text == "converged")
    }

    /// The values of a row that differ, in words.
    fn values(&self, row: usize) -> String {
        let name = |column: &TextColumn| key(&column.name).replace('-', " ");
        let values = self.varied.iter().map(|column| format!("{} {}", name(column), column.words[row].text));
        values.collect::<Vec<_>>().join(", ")
    }
}

/// The curves of a study: one for each combination of values from its lists, with a dot for each load, or one for each load as well where a list
/// is drawn to the right; over all seeds. Rows that did not converge are left out.
fn of_study(
    columns: &[TextColumn],
    numbers: &FileNumbers,
    x: Abscissa<'_>,
    named: impl Fn(&str) -> String,
) -> Vec<FileCurve> {
    let columns = StudyColumns::new(columns, x);
    let rows: Vec<usize> = (0..numbers.pairs.len()).filter(|row| columns.is_converged(*row)).collect();
    let curve = |rows: Vec<usize>| FileCurve {
        name: named(&columns.values(rows[0])),
        dots: groups(&rows, &columns.along).iter().map(|rows| numbers.dot(rows)).collect(),
    };
    groups(&rows, &columns.varied).into_iter().map(curve).collect()
}

/// Rows that have the same words in some columns, in their order.
fn groups(rows: &[usize], columns: &[&TextColumn]) -> Vec<Vec<usize>> {
    let are_same = |a: usize, b: usize| columns.iter().all(|column| column.words[a].text == column.words[b].text);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for &row in rows {
        match groups.iter_mut().find(|group| are_same(group[0], row)) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    groups
}

/// The last part of a key.
pub(crate) fn key(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or_default()
}

fn missing(path: &Path, name: &str) -> FileError {
    let reason =
        format!("it has no {name}: give another quantity, or a value from the lists of a study, such as hurst");
    FileError::Format { path: path.into(), what: "result or table", reason: reason.into() }
}

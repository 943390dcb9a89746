//! Curves of two quantities in results and tables, with error bars.

use super::exit_status::usage;
use anyhow::Result;
use asperity::contact::{ArchiveReader, Quantity};
use asperity::error::FileError;
use asperity::files::{TextColumn, read_columns};
use asperity::plot::Dot;
use asperity::study::SeedMean;
use std::path::Path;

/// The column of the seeds in a table of a study, and how columns begin of what is varied along a curve.
const SEED: &str = "surface.seed";
const ALONG: [&str; 2] = ["load.", "path."];

/// A curve in a file.
pub struct FileCurve {
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
pub fn curves_of(path: &Path, quantities: [Quantity; 2], is_one_of_many: bool) -> Result<Vec<FileCurve>> {
    let is_archive = path.is_dir() || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut curves = match is_archive {
        true => vec![FileCurve { dots: of_archive(path, quantities)?.dots(), name }],
        false => {
            let columns = read_columns(path)?;
            let numbers = of_columns(path, &columns, quantities)?;
            let named = |values: &str| match (values.is_empty(), is_one_of_many) {
                (true, _) => name.clone(),
                (false, true) => format!("{name}, {values}"),
                (false, false) => values.to_owned(),
            };
            match columns.first().is_some_and(|column| column.name == "row") {
                true => of_study(&columns, &numbers, named),
                false => vec![FileCurve { dots: numbers.dots(), name }],
            }
        }
    };
    for curve in &mut curves {
        curve.dots.retain(|dot| is_known(dot, quantities));
    }
    curves.retain(|curve| !curve.dots.is_empty());
    match curves.is_empty() {
        true => usage(format!(
            "{} has no numbers of {} beside {}: choose other quantities",
            path.display(),
            quantities[1].name(),
            quantities[0].name()
        )),
        false => Ok(curves),
    }
}

/// Whether both numbers are known. An area of 0, or a `kappa` of it, is that of a contact that is not resolved.
fn is_known(dot: &Dot, quantities: [Quantity; 2]) -> bool {
    let is_of_area = |it| matches!(it, Quantity::RelativeArea | Quantity::Kappa | Quantity::KappaR);
    let is_known = |(value, it): (f64, Quantity)| value.is_finite() && (value != 0.0 || !is_of_area(it));
    [dot.x, dot.y].into_iter().zip(quantities).all(is_known)
}

/// The quantity that is the relative error of the grid of another one.
fn relative_error(quantity: Quantity) -> Option<Quantity> {
    match quantity {
        Quantity::RelativeArea | Quantity::Kappa => Some(Quantity::RelativeAreaError),
        Quantity::KappaR => Some(Quantity::KappaRError),
        _ => None,
    }
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

fn of_archive(path: &Path, quantities: [Quantity; 2]) -> Result<FileNumbers> {
    let archive = ArchiveReader::open(path)?;
    let missing = |it: Quantity| missing(path, it);
    let [x, y] = quantities.map(|it| archive.numbers(it.name()).map_err(anyhow::Error::from));
    let pairs = [x?.ok_or_else(|| missing(quantities[0]))?, y?.ok_or_else(|| missing(quantities[1]))?];
    let errors = relative_error(quantities[1]).map(|it| archive.numbers(it.name())).transpose()?.flatten();
    Ok(FileNumbers::new(pairs, errors))
}

fn of_columns(path: &Path, columns: &[TextColumn], quantities: [Quantity; 2]) -> Result<FileNumbers> {
    let find = |it: Quantity| columns.iter().find(|column| column.name == it.name());
    let numbers = |column: &TextColumn| -> Vec<f64> {
        column.words.iter().map(|word| word.text.parse().unwrap_or(f64::NAN)).collect()
    };
    let [x, y] = quantities.map(|it| find(it).map(numbers).ok_or_else(|| missing(path, it)));
    Ok(FileNumbers::new([x?, y?], relative_error(quantities[1]).and_then(find).map(numbers)))
}

/// The columns of the table of a study that say which rows are a curve, and which of these are a dot.
struct StudyColumns<'a> {
    /// Values from the lists that differ.
    varied: Vec<&'a TextColumn>,
    /// Loads, and points of a path.
    along: Vec<&'a TextColumn>,
    status: Option<&'a TextColumn>,
}

impl<'a> StudyColumns<'a> {
    fn new(columns: &'a [TextColumn]) -> Self {
        let is_along = |name: &str| name == "load_number" || ALONG.iter().any(|beginning| name.starts_with(beginning));
        let is_listed = |name: &str| name.contains('.') && name != SEED && !is_along(name);
        let differs = |column: &TextColumn| column.words.windows(2).any(|pair| pair[0].text != pair[1].text);
        Self {
            varied: columns.iter().filter(|column| is_listed(&column.name) && differs(column)).collect(),
            along: columns.iter().filter(|column| is_along(&column.name)).collect(),
            status: columns.iter().find(|column| column.name == "status"),
        }
    }

    fn is_converged(&self, row: usize) -> bool {
        self.status.is_none_or(|column| column.words[row].text == "converged")
    }

    /// The values of a row that differ, in words.
    fn values(&self, row: usize) -> String {
        let key = |name: &'a str| name.rsplit('.').next().unwrap_or_default();
        let values = self.varied.iter().map(|column| format!("{} {}", key(&column.name), column.words[row].text));
        values.collect::<Vec<_>>().join(", ")
    }
}

/// The curves of a study: one for each combination of values from its lists, with a dot for each load, over all seeds. Rows that did not
/// converge are left out.
fn of_study(columns: &[TextColumn], numbers: &FileNumbers, named: impl Fn(&str) -> String) -> Vec<FileCurve> {
    let columns = StudyColumns::new(columns);
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

fn missing(path: &Path, quantity: Quantity) -> FileError {
    let reason = format!("it has no {}", quantity.name());
    FileError::Format { path: path.into(), what: "result or table", reason }
}

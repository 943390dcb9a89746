//! Rows of a study as columns, from which tables are written.

use super::plan::{Plan, StudyRow};
use super::point::{Point, further, word as word_of};
use crate::contact::{Load, Quantity, QuantityKind};
use crate::error::StudyError;
use crate::seen::plain;
use crate::setup::{ParameterAxis, Scalar, Setup, SetupTable};

/// A column of a table: a name, and a value for each row.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name of the column.
    pub name: String,
    /// The values, row by row.
    pub values: ColumnValues,
}

/// The values of a column, all of one kind.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Whole numbers, where there are any.
    Whole(Vec<Option<u64>>),
    /// Numbers, where there are any.
    Number(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<String>),
}

impl ColumnValues {
    /// The number of values.
    #[allow(clippy::len_without_is_empty, reason = "columns are made for at least one row")]
    pub fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Value number `i`, from 0, as a table of texts holds it.
    pub fn word(&self, i: usize) -> String {
        match self {
            Self::Whole(values) => values[i].map_or(String::new(), |value| value.to_string()),
            Self::Number(values) => values[i].map_or(String::new(), |value| format!("{value:?}")),
            Self::Text(values) => values[i].clone(),
        }
    }
}

/// A row with everything that its values need.
struct RowSource<'a> {
    row: StudyRow,
    point: &'a Point,
    /// The setup of the row, under its load.
    setup: SetupTable,
}

impl Plan {
    /// The columns of some rows with their `points`: number of the row, values from the lists, load, all fields of a
    /// [`Point`], and as `scene` the setup of the row, an inline TOML table on one line. Seconds are left out, since
    /// they differ from run to run. What flows, and of a history what its states add up to, follow the observables; with adhesion these are left out.
    ///
    /// # Errors
    /// The errors of [`Plan::realisation`].
    pub fn columns(&self, rows: &[StudyRow], points: &[Point]) -> Result<Vec<Column>, StudyError> {
        let mut sources: Vec<RowSource<'_>> = Vec::with_capacity(rows.len());
        let mut last: Option<(usize, Setup)> = None;
        for (&row, point) in rows.iter().zip(points) {
            let setup = match last.take() {
                Some((realisation, setup)) if realisation == row.realisation => setup,
                _ => self.realisation(row.realisation)?.setup,
            };
            let setup = Setup { load: self.loads()[row.load], ..setup };
            sources.push(RowSource { row, point, setup: setup.to_table() });
            last = Some((row.realisation, setup));
        }
        let first = self.realisation(0)?.setup.to_table();
        let whole = |name: &str, of: &dyn Fn(&RowSource<'_>) -> Option<u64>| {
            column(name, ColumnValues::Whole(sources.iter().map(of).collect()))
        };
        let number = |name: &str, of: &dyn Fn(&RowSource<'_>) -> Option<f64>| {
            column(name, ColumnValues::Number(sources.iter().map(of).collect()))
        };
        let text = |name: &str, of: &dyn Fn(&RowSource<'_>) -> String| {
            column(name, ColumnValues::Text(sources.iter().map(of).collect()))
        };
        let mut columns = vec![whole("row", &|it| Some(it.row.number as u64))];
        columns.extend(self.axes().iter().map(|axis| chosen(axis, &first, &sources)));
        columns.push(number(&self.load_name(), &|it| Some(self.loads()[it.row.load].value())));
        columns.extend([
            text("name", &|it| it.point.name.clone()),
            whole("ny", &|it| Some(it.point.ny as u64)),
            whole("nx", &|it| Some(it.point.nx as u64)),
            number("length", &|it| Some(it.point.length)),
            number("hurst", &|it| it.point.hurst),
            number("rolloff_wavelength", &|it| it.point.rolloff_wavelength),
            number("short_cutoff", &|it| it.point.short_cutoff),
            whole("seed", &|it| it.point.seed),
            whole("load_number", &|it| Some(it.point.load as u64)),
            number("tolerance", &|it| Some(it.point.tolerance)),
            text("status", &|it| it.point.status.name().into()),
            text("setup", &|it| it.point.setup.clone()),
            text("version", &|it| it.point.version.clone()),
        ]);
        if !self.has_adhesion() {
            columns.extend(observed(&sources));
        }
        let told = further().filter(|it| points.iter().any(|point| point.get(*it).is_some()));
        columns.extend(told.map(|it| match it.row().kind {
            QuantityKind::Number | QuantityKind::Bound => number(it.name(), &|row| row.point.get(it)),
            QuantityKind::Whole => whole(it.name(), &|row| row.point.get(it).map(|value| value as u64)),
            QuantityKind::Flag => text(it.name(), &|row| word_of(it, row.point.get(it))),
        }));
        columns.push(text("scene", &|it| it.setup.to_line()));
        Ok(columns)
    }

    /// The keys of the loads, such as `load.reduced-pressure`.
    pub(super) fn load_name(&self) -> String {
        format!("load.{}", self.loads().first().map_or("", Load::name).replace(' ', "-"))
    }
}

/// The columns of the observables.
fn observed(sources: &[RowSource<'_>]) -> Vec<Column> {
    let numbers: Vec<_> = sources.iter().map(|it| it.point.observables.numbers()).collect();
    let of = |(i, it): (usize, Quantity)| {
        let values = numbers.iter().map(|numbers| numbers[i]);
        match it.row().kind == QuantityKind::Whole {
            true => column(it.name(), ColumnValues::Whole(values.map(|value| Some(value as u64)).collect())),
            false => column(it.name(), ColumnValues::Number(values.map(Some).collect())),
        }
    };
    Quantity::found().enumerate().map(of).collect()
}

fn column(name: &str, values: ColumnValues) -> Column {
    Column { name: name.into(), values }
}

/// The column of a list: what the setups of the rows hold there, of the kind that the `first` setup of the study has.
fn chosen(axis: &ParameterAxis, first: &SetupTable, sources: &[RowSource<'_>]) -> Column {
    let scalars = || sources.iter().map(|it| it.setup.scalar(axis.path()));
    let values = match first.scalar(axis.path()) {
        Some(Scalar::Whole(_)) => ColumnValues::Whole(scalars().map(|it| it.and_then(whole)).collect()),
        Some(Scalar::Number(_)) => ColumnValues::Number(scalars().map(|it| it.and_then(number)).collect()),
        _ => ColumnValues::Text(scalars().map(|it| it.map_or(String::new(), word)).collect()),
    };
    column(axis.path(), values)
}

fn whole(scalar: Scalar) -> Option<u64> {
    match scalar {
        Scalar::Whole(whole) => Some(whole),
        _ => None,
    }
}

fn number(scalar: Scalar) -> Option<f64> {
    match scalar {
        Scalar::Whole(whole) => Some(whole as f64),
        Scalar::Number(number) => Some(number),
        Scalar::Text(_) => None,
    }
}

fn word(scalar: Scalar) -> String {
    match scalar {
        Scalar::Whole(whole) => whole.to_string(),
        Scalar::Number(number) => format!("{number:?}"),
        // names of files may hold what a terminal obeys
        Scalar::Text(text) => plain(&text).into_owned(),
    }
}

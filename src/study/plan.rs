//! A setup with lists in it: a study.

use super::expense::Expense;
use super::realisation::Realisation;
use super::shard::Shard;
use crate::contact::{Law, Load};
use crate::error::{SetupError, StudyError};
use crate::files::read_text_bytes;
use crate::quantity::{has_length_unit, has_pressure_unit};
use crate::setup::{ParameterAxis, Setup, SetupTable};
use std::path::{Path, PathBuf};

/// Name of the realisations in tables.
const NAME: &str = "study";

/// A setup with lists of values, which describes many setups: one realisation for each combination of values, each
/// solved under all loads.
///
/// The rows of the study are numbered from 1. The loads vary fastest, then the seeds, then the other lists (in the
/// order of [`crate::setup::Key::all`], the last list first). The result of a row depends on its realisation only, not on
/// the share or on other rows.
///
/// ```
/// use asperity::study::{Plan, Shard};
/// let plan = Plan::from_toml(
///     r#"
///     surface = { spectrum = { hurst = [0.3, 0.8], rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = "1-3" }
///     grid = { points = 256, size = 1.0 }
///     load = { reduced-pressure = [0.01, 0.1] }
///     "#,
/// )?;
/// assert_eq!((plan.rows(), plan.realisations()), (12, 6));
/// let row = plan.row(9)?;
/// assert_eq!((plan.words(row.realisation), row.load), ("hurst 0.8, seed 2".into(), 0));
/// let points = plan.solve(row.realisation, |_| ())?;
/// assert!(points[1].observables.relative_area > points[0].observables.relative_area);
/// let shares = ["1/2", "2/2"].map(|shard| plan.share(shard.parse().unwrap()));
/// assert_eq!(shares[0].as_ref().unwrap().len() + shares[1].as_ref().unwrap().len(), 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The first of the setups.
    table: SetupTable,
    /// The lists, without that of the loads.
    axes: Vec<ParameterAxis>,
    loads: Vec<Load>,
    realisations: usize,
    /// The first of the setups, under the first load.
    first: Setup,
    /// The files that it names.
    files: Vec<PathBuf>,
    /// Whether its lengths are metres, and its pressures pascals, since they have units.
    units: [bool; 2],
    /// The text that it was read from, to name lines of.
    text: String,
}

/// A row of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StudyRow {
    /// Number of the row, from 1.
    pub number: usize,
    /// Number of its realisation, from 0.
    pub realisation: usize,
    /// Number of its load in the realisation, from 0.
    pub load: usize,
}

impl Plan {
    /// Largest number of rows.
    pub const MOST_ROWS: usize = 10_000_000;

    /// The study that a TOML text describes.
    ///
    /// # Errors
    /// For a text that is no setup with lists, with the line, and for more than [`Plan::MOST_ROWS`] rows.
    pub fn from_toml(text: &str) -> Result<Self, StudyError> {
        Self::new(SetupTable::from_toml(text)?, text)
    }

    /// The study of a table of sections and keys, in which values may be lists.
    ///
    /// # Errors
    /// The errors of [`Plan::from_toml`].
    pub fn from_table(table: SetupTable) -> Result<Self, StudyError> {
        Self::new(table, "")
    }

    /// The study in a file. The files that it names are found beside it.
    ///
    /// # Errors
    /// The errors of [`SetupTable::read`] and [`Plan::from_toml`].
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let table = SetupTable::read(path)?;
        // results carry theirs in other forms
        let text = read_text_bytes(path).ok().and_then(|it| String::from_utf8(it).ok()).unwrap_or_default();
        Self::new(table, &text).map_err(|error| match error {
            StudyError::Setup(error) => error.in_file(path).into(),
            other => other,
        })
    }

    fn new(mut table: SetupTable, text: &str) -> Result<Self, StudyError> {
        let located = |error: SetupError| error.in_text(text);
        table.check_idle().and_then(|()| table.check_units()).map_err(located)?;
        table.check_force_units().map_err(located)?;
        let files = table.files();
        let has = |is_unit: fn(&str) -> bool| table.texts().into_iter().any(is_unit);
        let units = [has(has_length_unit), has(has_pressure_unit)];
        let loads = table.take_loads().map_err(located)?;
        let axes = table.take_axes().map_err(located)?;
        let first = table.clone().setup().map_err(located)?;
        let is_history = first.is_history()?;
        if is_history && loads.as_ref().is_some_and(|loads| loads.len() > 1) {
            return Err(StudyError::HistoryLoads);
        }
        if first.friction.is_some() && !is_history {
            return Err(StudyError::Friction);
        }
        let loads = loads.unwrap_or_else(|| vec![first.load]);
        let rows = axes.iter().fold(loads.len() as u128, |rows, axis| rows.saturating_mul(axis.len().into()));
        if rows > Self::MOST_ROWS as u128 {
            return Err(StudyError::TooManyRows { rows, most: Self::MOST_ROWS });
        }
        axes.iter().try_for_each(|axis| axis.check_varied()).map_err(located)?;
        let realisations = rows as usize / loads.len();
        Ok(Self { table, axes, realisations, first, loads, files, units, text: text.into() })
    }

    /// Whether its lengths are metres, and its pressures pascals.
    #[cfg(feature = "figures")]
    pub(super) fn units(&self) -> [bool; 2] {
        self.units
    }

    /// Whether each row is the history of a setup with adhesion.
    pub(super) fn has_adhesion(&self) -> bool {
        self.first.feels().attraction
    }

    /// Whether each row is the history of a solid that yields below its surface.
    #[cfg(feature = "figures")]
    pub(super) fn yields(&self) -> bool {
        self.first.feels().eigenstrain
    }

    /// The number of states of the history of each row; none where each row is a contact.
    ///
    /// # Errors
    /// The errors of [`Setup::is_history`] and [`Setup::expected_states`].
    pub fn states(&self) -> Result<Option<usize>, SetupError> {
        if self.first.is_history()? { self.first.expected_states().map(Some) } else { Ok(None) }
    }

    /// The law under which all contacts are elastic or yield; none for a solid that creeps, whose modulus depends on the time, and for one that yields
    /// below its surface, which has a law of its own.
    pub(super) fn law(&self) -> Option<Law> {
        let feels = self.first.feels();
        (!feels.memory && !feels.eigenstrain).then_some(self.first.law)
    }

    /// The paths of all files that it names, those in lists as well.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(PathBuf::as_path)
    }

    /// The lists, without that of the loads; the last list varies fastest.
    pub fn axes(&self) -> &[ParameterAxis] {
        &self.axes
    }

    /// The loads, under which each realisation is solved one after the other.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// The number of realisations.
    pub fn realisations(&self) -> usize {
        self.realisations
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.realisations * self.loads.len()
    }

    /// The row of a number, from 1.
    ///
    /// # Errors
    /// [`StudyError::NoRow`] for a number beyond the last row, and for 0.
    pub fn row(&self, number: usize) -> Result<StudyRow, StudyError> {
        let rows = self.rows();
        match number {
            0 => Err(StudyError::NoRow { number, rows }),
            _ if number > rows => Err(StudyError::NoRow { number, rows }),
            _ => Ok(StudyRow {
                number,
                realisation: (number - 1) / self.loads.len(),
                load: (number - 1) % self.loads.len(),
            }),
        }
    }

    /// The number of a realisation, from 0, if there is one of that number.
    ///
    /// # Errors
    /// [`StudyError::NoRow`] with the row that it would begin with.
    pub fn number(&self, realisation: usize) -> Result<usize, StudyError> {
        let first = realisation.saturating_mul(self.loads.len()).saturating_add(1);
        Ok(self.row(first)?.realisation)
    }

    /// The rows of some realisations, in their order.
    pub fn rows_of<'a>(&'a self, realisations: &'a [usize]) -> impl Iterator<Item = StudyRow> + 'a {
        let loads = self.loads.len();
        let row = move |realisation, load| StudyRow { number: 1 + realisation * loads + load, realisation, load };
        realisations.iter().flat_map(move |&realisation| (0..loads).map(move |load| row(realisation, load)))
    }

    /// Realisation number `i`, from 0.
    ///
    /// # Errors
    /// [`StudyError::Row`] for values that make no setup.
    pub fn realisation(&self, i: usize) -> Result<Realisation, StudyError> {
        let mut table = self.table.clone();
        self.places(i).zip(&self.axes).for_each(|(place, axis)| table.lay_axis(axis, place));
        let setup = table.setup().map_err(|error| self.in_row(i, error.in_text(&self.text)))?;
        Ok(Realisation { name: NAME.into(), setup, loads: self.loads.clone() })
    }

    /// The realisations of some numbers.
    ///
    /// # Errors
    /// The errors of [`Plan::realisation`].
    pub fn realisations_of(&self, numbers: &[usize]) -> Result<Vec<Realisation>, StudyError> {
        numbers.iter().map(|&i| self.realisation(i)).collect()
    }

    /// The values from the lists for realisation number `i`, in words; a list of one value does not tell realisations apart, and is left out.
    pub fn words(&self, i: usize) -> String {
        self.words_of(i, |_| true)
    }

    /// The values from the lists, without the seed, in words. They are the same for all realisations of one mean.
    pub fn words_but_seed(&self, i: usize) -> String {
        self.words_of(i, |axis| axis.path() != ParameterAxis::SEED)
    }

    /// The values from the lists, without the seed and the list at a path, in words.
    #[cfg(feature = "figures")]
    pub(super) fn words_but(&self, i: usize, path: &str) -> String {
        self.words_of(i, |axis| axis.path() != ParameterAxis::SEED && axis.path() != path)
    }

    fn words_of(&self, i: usize, is_named: impl Fn(&ParameterAxis) -> bool) -> String {
        let chosen = self.places(i).zip(&self.axes).filter(|(_, axis)| axis.len() > 1 && is_named(axis));
        chosen.map(|(place, axis)| format!("{} {}", axis.name(), axis.word(place))).collect::<Vec<_>>().join(", ")
    }

    /// Checks everything that can be checked without generating a surface, for all values except the seeds.
    ///
    /// # Errors
    /// [`StudyError::Row`].
    pub fn check(&self) -> Result<(), StudyError> {
        self.firsts().try_for_each(|i| {
            let checked = self.realisation(i)?.check();
            checked.map(drop).map_err(|error| self.in_row(i, error))
        })
    }

    /// The cost of a realisation of each group whose members differ only in the seed, with the number of the first
    /// realisation.
    ///
    /// # Errors
    /// [`StudyError::Row`].
    pub fn expenses(&self) -> Result<Vec<(usize, Expense)>, StudyError> {
        let of = |i| Ok((i, Expense::new(&self.realisation(i)?).map_err(|error| self.in_row(i, error))?));
        self.firsts().map(of).collect()
    }

    /// The number of realisations that differ only in the seed.
    pub fn seeds(&self) -> usize {
        self.axes.last().filter(|axis| axis.path() == ParameterAxis::SEED).map_or(1, |axis| axis.len() as usize)
    }

    /// The numbers of the realisations of a share, in their order. The realisations are distributed to the shares in
    /// turn, the longest first.
    ///
    /// # Errors
    /// [`StudyError::Row`].
    pub fn share(&self, shard: Shard) -> Result<Vec<usize>, StudyError> {
        if shard == Shard::WHOLE {
            return Ok((0..self.realisations).collect());
        }
        let mut groups = self.expenses()?;
        groups.sort_by(|(_, a), (_, b)| b.seconds.total_cmp(&a.seconds));
        let dealt = groups.iter().flat_map(|(first, _)| *first..first + self.seeds());
        let mut share: Vec<usize> = dealt.enumerate().filter(|(i, _)| shard.holds(*i)).map(|(_, it)| it).collect();
        share.sort_unstable();
        Ok(share)
    }

    /// The setup of a row, under its load.
    ///
    /// # Errors
    /// The errors of [`Plan::realisation`].
    pub fn setup(&self, row: StudyRow) -> Result<Setup, StudyError> {
        Ok(Setup { load: self.loads[row.load], ..self.realisation(row.realisation)?.setup })
    }

    /// The first realisation of each group that differs by its seeds only.
    fn firsts(&self) -> impl Iterator<Item = usize> {
        (0..self.realisations).step_by(self.seeds())
    }

    /// The places in the lists from which realisation number `i` takes its values.
    fn places(&self, i: usize) -> impl Iterator<Item = u64> {
        let mut rest = i as u64;
        let mut places: Vec<u64> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            places.push(rest % axis.len());
            rest /= axis.len();
        }
        places.into_iter().rev()
    }

    /// An error of a realisation, with its first row.
    pub(super) fn in_row(&self, i: usize, source: SetupError) -> StudyError {
        match self.axes.as_slice() {
            [] => source.into(),
            _ => StudyError::Row { row: self.first_row(i), values: self.words(i), source },
        }
    }

    /// The number of the first row of a realisation.
    pub(super) fn first_row(&self, i: usize) -> usize {
        1 + i * self.loads.len()
    }

    /// An error of a realisation under one of its loads, given by their numbers from 0, with its row. Errors of the table stay as they are.
    pub(super) fn in_row_of(&self, [i, load]: [usize; 2], error: StudyError) -> StudyError {
        let source = match error {
            StudyError::Setup(error) => error,
            StudyError::Solve(error) => error.into(),
            other => return other,
        };
        match self.loads.get(load) {
            Some(it) if self.loads.len() > 1 => {
                let values = [self.words(i), it.to_string()].into_iter().filter(|words| !words.is_empty());
                let values = values.collect::<Vec<_>>().join(", ");
                StudyError::Row { row: self.first_row(i) + load, values, source }
            }
            _ => self.in_row(i, source),
        }
    }
}

//! Files of spectra.

use super::spectrum_table::{SpectrumKind, SpectrumTable};
use crate::error::{FileError, SurfaceError};
use crate::files::{InputFile, TextWord, columns_of, write_beside};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use strum::{EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// The convention in which a table has its densities. Wavenumbers are `2 pi` over the wavelength in all of them.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, EnumString, IntoStaticStr,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum SpectrumConvention {
    /// Of an isotropic surface, `<h^2> = int C d^2q`; C in length^4.
    #[default]
    Surface,
    /// Of an isotropic surface, `<h^2> = (2 pi)^-2 int C d^2q`; C in length^4.
    SurfaceTwoPi,
    /// Of a profile, `<h^2> = int C dq` over both signs of q; C in length^3.
    Profile,
    /// Of a profile, `<h^2> = (2 pi)^-1 int C dq` over both signs of q; C in length^3.
    ProfileTwoPi,
}

impl SpectrumConvention {
    /// What it is a density of.
    pub fn kind(self) -> SpectrumKind {
        match self {
            Self::Surface | Self::SurfaceTwoPi => SpectrumKind::Surface,
            Self::Profile | Self::ProfileTwoPi => SpectrumKind::Profile,
        }
    }

    /// The factor by which its densities are larger than those without `2 pi`.
    pub fn factor(self) -> f64 {
        match self {
            Self::Surface | Self::Profile => 1.0,
            Self::SurfaceTwoPi => TAU.powi(2),
            Self::ProfileTwoPi => TAU,
        }
    }
}

/// A file of a spectrum, on disk or in memory: two columns (wavenumber, density), or a CSV file of contact.engineering. As text it is the
/// path or the name.
///
/// *Two columns* are numbers, separated by spaces, semicolons or commas, with decimal points or, where commas do not separate, decimal commas. Lines
/// before the first number and those that begin with `#` are left out. The convention is given with the file, or the file names
/// it itself in a line such as `# convention: profile`.
///
/// *Files of contact.engineering* name their convention and units themselves. The densities of surfaces come from the series `q/pi x 2D
/// PSD`, or else from `1D PSD along x`, which is that of profiles. Lines take the latter first.
///
/// ```
/// use asperity::surface::{SpectrumConvention, SpectrumFile};
/// let file = SpectrumFile::in_memory("psd.txt", *b"# q, C\n1 4.0\n10 4e-3\n");
/// let table = file.read(None, false)?;
/// assert_eq!(table.density(10.0), 4e-3);
/// # Ok::<(), asperity::error::FileError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "PathBuf", into = "String")]
pub struct SpectrumFile {
    file: InputFile,
}

/// A spectrum in a file, and how it is read.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSpectrum {
    /// The file.
    pub file: SpectrumFile,
    /// The convention of its two columns, where the file does not name it.
    pub convention: Option<SpectrumConvention>,
    /// A wavelength at and below which there is no roughness, a length; without it the spectrum ends where the table does.
    pub short_cutoff: Option<f64>,
}

/// A row of a file of a spectrum.
struct SpectrumRow {
    /// Its line in the file, from 1 on.
    line: u64,
    wavenumber: f64,
    density: f64,
}

/// The line that names the convention of two columns.
const CONVENTION: &str = "# convention:";

/// A data series of a file of contact.engineering: its name, its convention, and the density of a value at a wavenumber.
type DataSeries = (&'static str, SpectrumConvention, fn(f64, f64) -> f64);

const OF_SURFACE: DataSeries = ("q/π × 2D PSD", SpectrumConvention::SurfaceTwoPi, |q, value| PI / q * value);
const OF_PROFILE: DataSeries = ("1D PSD along x", SpectrumConvention::ProfileTwoPi, |_, value| value);

impl SpectrumFile {
    /// A file of some name that is not on disk.
    pub fn in_memory(name: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { file: InputFile::in_memory(name, bytes) }
    }

    /// The path, or the name of one in memory.
    pub fn path(&self) -> &Path {
        self.file.path()
    }

    /// The file as any other that a setup names.
    pub(crate) fn file_mut(&mut self) -> &mut InputFile {
        &mut self.file
    }

    /// Its spectrum, for a line or else a surface. Two columns have the convention `convention`, or else that which the file names, or else
    /// that of surfaces.
    ///
    /// # Errors
    /// For a file that cannot be read, or that has no spectrum in it.
    pub fn read(&self, convention: Option<SpectrumConvention>, is_line: bool) -> Result<SpectrumTable, FileError> {
        let bytes = self.file.text_bytes()?;
        let wrong =
            |reason: String| FileError::Format { path: self.path().into(), what: "spectrum", reason: reason.into() };
        let text = std::str::from_utf8(&bytes).map_err(|_| wrong("it is not a text".into()))?;
        let (rows, convention) = match text.lines().any(|line| line.contains("Data series")) {
            true => {
                let (rows, own) = named(text, is_line).map_err(wrong)?;
                (rows, chosen(convention, Some(own)).map_err(wrong)?)
            }
            false => (
                columns(text).map_err(wrong)?,
                chosen(convention, own_convention(text).map_err(wrong)?).map_err(wrong)?,
            ),
        };
        let wavenumber = rows.iter().map(|row| row.wavenumber).collect();
        let density = rows.iter().map(|row| row.density / convention.factor()).collect();
        let table = SpectrumTable::new(wavenumber, density, convention.kind());
        let kind = if is_line { SpectrumKind::Profile } else { SpectrumKind::Surface };
        table.and_then(|table| table.converted(kind)).map_err(|it| wrong(fault(it, &rows)))
    }
}

impl From<PathBuf> for SpectrumFile {
    fn from(path: PathBuf) -> Self {
        Self { file: path.into() }
    }
}

impl From<SpectrumFile> for String {
    fn from(file: SpectrumFile) -> Self {
        file.file.into()
    }
}

impl SpectrumTable {
    /// Writes it as two columns that a [`SpectrumFile`] reads, in a convention that the file names.
    ///
    /// # Errors
    /// [`FileError::Target`] for the spectrum of a profile that no isotropic surface has, where a surface is the convention; the errors of
    /// [`write_beside`].
    ///
    /// ```
    /// use asperity::surface::{SpectrumConvention, SpectrumFile, SpectrumKind, SpectrumTable};
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("psd.csv");
    /// let table = SpectrumTable::new(vec![1.0, 10.0], vec![4.0, 4e-3], SpectrumKind::Surface)?;
    /// table.write(&path, SpectrumConvention::SurfaceTwoPi)?;
    /// assert_eq!(SpectrumFile::from(path).read(None, false)?, table);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&self, path: &Path, convention: SpectrumConvention) -> Result<(), FileError> {
        let other = "a line has a profile spectrum, not a surface spectrum, and that of no isotropic surface gives this one: give the \
                     convention profile";
        let refused = |_| FileError::Target { path: path.into(), reason: other.into() };
        let converted = self.converted(convention.kind()).map_err(refused)?;
        let name: &str = convention.into();
        write_beside(path, |file| {
            writeln!(file, "{CONVENTION} {name}\nwavenumber,density")?;
            let rows = self.wavenumbers().iter();
            rows.map(|q| (q, converted.density(*q) * convention.factor()))
                .try_for_each(|(q, c)| writeln!(file, "{q:?},{c:?}"))
        })
    }
}

/// The convention that is given or named by the file, which must not contradict each other; without any that of surfaces.
fn chosen(given: Option<SpectrumConvention>, own: Option<SpectrumConvention>) -> Result<SpectrumConvention, String> {
    match (given, own) {
        (Some(given), Some(own)) if given != own => {
            let [given, own]: [&str; 2] = [given.into(), own.into()];
            Err(format!("its convention is {own}, but {given} is given: leave it out"))
        }
        (given, own) => Ok(given.or(own).unwrap_or_default()),
    }
}

/// The convention that a file of two columns names.
fn own_convention(text: &str) -> Result<Option<SpectrumConvention>, String> {
    let name = text.lines().find_map(|line| line.strip_prefix(CONVENTION)).map(str::trim);
    let unknown = |name: &str| format!("the convention `{name}` is not known");
    name.map(|name| name.parse().map_err(|_| unknown(name))).transpose()
}

/// What is wrong with the values of a table, and the row that is at fault.
fn fault(error: SurfaceError, rows: &[SpectrumRow]) -> String {
    match error {
        SurfaceError::SpectrumTable { place, reason } => match place.and_then(|place| rows.get(place)) {
            Some(row) => format!("row {}: {reason}", row.line),
            None => reason,
        },
        other => other.to_string(),
    }
}

/// The rows of two columns of numbers.
fn columns(text: &str) -> Result<Vec<SpectrumRow>, String> {
    let mut rows = Vec::new();
    for (line, content) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        let words = words(content);
        let number = |i: usize| words.get(i).and_then(|word: &String| word.replace(',', ".").parse::<f64>().ok());
        let is_left_out = words.is_empty() || content.starts_with('#') || rows.is_empty() && number(0).is_none();
        if is_left_out {
            continue;
        }
        let found = match words.as_slice() {
            [_] => return Err(format!("row {line} has a wavenumber and no density beside it")),
            [_, _, third, ..] if !third.starts_with('#') => {
                let advice = "give two columns, wavenumber and density, with decimal points";
                return Err(format!("row {line} has a third word, `{third}`: {advice}"));
            }
            _ => [number(0), number(1)],
        };
        match found {
            [Some(wavenumber), Some(density)] => rows.push(SpectrumRow { line, wavenumber, density }),
            [wavenumber, _] => {
                let word = &words[usize::from(wavenumber.is_some())];
                return Err(format!("row {line}: `{word}` is not a number"));
            }
        }
    }
    Ok(rows)
}

/// The words of a line as they are written. Commas separate words where nothing else does; otherwise those inside of a word are decimal commas.
fn words(line: &str) -> Vec<String> {
    let split = |separators: &[char]| -> Vec<String> {
        let words = line.split(separators).map(|word| word.trim_matches(','));
        words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    let words = split(&[';', ' ', '\t', '\r']);
    if words.len() < 2 { split(&[',', '\r']) } else { words }
}

/// The rows of a file of contact.engineering, and their convention.
fn named(text: &str, is_line: bool) -> Result<(Vec<SpectrumRow>, SpectrumConvention), String> {
    let columns = columns_of(text.as_bytes())?;
    let column = |name: &str| {
        let found = columns.iter().find(|column| column.name.starts_with(name));
        found.ok_or_else(|| format!("there is no column `{name}`"))
    };
    let in_unit = |name: &str, unit: &str| {
        let column = column(name)?;
        match column.name.replace(' ', "").ends_with(unit) {
            true => Ok(&column.words),
            false => Err(format!("the column `{}` is not in {unit}", column.name)),
        }
    };
    let (q, density) = (in_unit("Wavevector", "(1/m)")?, in_unit("PSD", "(m³)")?);
    let (series, subjects) = (&column("Data series")?.words, &column("Subject name")?.words);
    if let Some(other) = subjects.iter().find(|subject| subject.text != subjects[0].text) {
        let [first, other] = [&subjects[0].text, &other.text];
        return Err(format!("it has spectra of `{first}` and of `{other}`: keep the rows of one"));
    }
    let wanted = if is_line { [OF_PROFILE, OF_SURFACE] } else { [OF_SURFACE, OF_PROFILE] };
    let found = wanted.into_iter().find(|(name, ..)| series.iter().any(|it| it.text == *name));
    let (name, convention, density_of) =
        found.ok_or_else(|| format!("there is no series `{}` or `{}`", OF_SURFACE.0, OF_PROFILE.0))?;
    let number = |TextWord { row, text }: &TextWord| {
        text.parse::<f64>().map_err(|_| format!("row {row}: `{text}` is not a number"))
    };
    let row = |(_, (q, value)): (&TextWord, (&TextWord, &TextWord))| {
        let (wavenumber, value) = (number(q)?, number(value)?);
        Ok(SpectrumRow { line: q.row, wavenumber, density: density_of(wavenumber, value) })
    };
    // an average over no values is written as nan
    let rows = series.iter().zip(q.iter().zip(density)).filter(|(series, _)| series.text == name);
    let rows: Result<Vec<_>, String> = rows.map(row).collect();
    Ok((rows?.into_iter().filter(|row| !row.density.is_nan()).collect(), convention))
}

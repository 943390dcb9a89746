//! Archives of contacts that are read again.

use super::archive::CERTIFICATE;
use crate::contact::{ArchiveSeal, Certificate, Resolved, SavedContact, Status, Work};
use crate::error::FileError;
use crate::formats::{has_field, read_fields, read_fields_shape, read_text};
use crate::sentence::Sentence;
use crate::surface::Field;
use ndarray::{ArrayD, Axis, Ix2, concatenate};
use std::path::{Path, PathBuf};

/// An archive that [`archive`](crate::contact::archive) or one of its kin has written, or a folder with an archive of each state. Arrays are read when they are asked for; nothing in them is
/// believed but their shapes, which are checked.
#[derive(Debug)]
pub struct ArchiveReader {
    path: PathBuf,
    /// The archives that it consists of: one, or those of the states in a folder.
    parts: Vec<PathBuf>,
    setup: String,
    /// The number of axes of the heights.
    rank: usize,
    /// The number of contacts along a first axis, if there is one.
    list: Option<usize>,
}

impl ArchiveReader {
    /// Opens an archive, or a folder with an archive of each state, which a run leaves that was killed.
    ///
    /// # Errors
    /// [`FileError::Read`] for a file that cannot be read, and [`FileError::Format`] for one that is no result.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let parts = if path.is_dir() { parts_of(path)? } else { vec![path.to_owned()] };
        let Some(first) = parts.first() else {
            return Err(wrong(path, "it is a folder without archives of states: give a file .npz"));
        };
        let Some(setup) = read_text(first, "setup")? else {
            return Err(wrong(path, "it is not a saved result: give a file .npz with arrays and a setup"));
        };
        let [heights, pressure] = ["height", "pressure"].map(|name| read_fields_shape(first, name));
        let (rank, axes) = (heights?.len(), pressure?);
        let list = match axes.len() {
            _ if !(1..=2).contains(&rank) => {
                return Err(wrong(path, format!("its heights have {rank} axes: a line has 1, a surface 2")));
            }
            found if found == rank => None,
            found if found == rank + 1 && path.is_dir() => Some(parts.len()),
            found if found == rank + 1 => Some(axes[0]),
            found => return Err(wrong(path, format!("its pressure has {found} axes, but its heights have {rank}"))),
        };
        match list {
            Some(0) => Err(wrong(path, "it contains no contacts")),
            _ => Ok(Self { path: path.into(), parts, setup, rank, list }),
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text of its setup.
    pub fn setup(&self) -> &str {
        &self.setup
    }

    /// The number of axes of its heights: 1 or 2.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Whether fields have a first axis of loads or states.
    pub fn is_list(&self) -> bool {
        self.list.is_some()
    }

    /// The number of contacts.
    pub fn count(&self) -> usize {
        self.list.unwrap_or(1)
    }

    /// Whether there is an array of a name.
    ///
    /// # Errors
    /// [`FileError::Format`] for an archive that is cut short.
    pub fn has(&self, name: &'static str) -> Result<bool, FileError> {
        let mut has = false;
        for part in &self.parts {
            has |= has_field(part, name)?;
        }
        Ok(has)
    }

    /// What the seals of its archives say: that of the first one that is not whole.
    ///
    /// # Errors
    /// The errors of [`ArchiveSeal::read`].
    pub fn seal(&self) -> Result<ArchiveSeal, FileError> {
        for part in &self.parts {
            let seal = ArchiveSeal::read(part)?;
            if seal != ArchiveSeal::Whole {
                return Ok(seal);
            }
        }
        Ok(ArchiveSeal::Whole)
    }

    /// The heights, shape `(ny, nx)`.
    ///
    /// # Errors
    /// The errors of [`ArchiveReader::fields`].
    pub fn height(&self) -> Result<Field, FileError> {
        self.field("height", read_fields(&self.parts[0], "height")?)
    }

    /// The nodes whose heights were filled in, shape `(ny, nx)`; none if all were measured.
    ///
    /// # Errors
    /// The errors of [`ArchiveReader::fields`].
    pub fn filled(&self) -> Result<Option<ndarray::Array2<bool>>, FileError> {
        if !has_field(&self.parts[0], "filled")? {
            return Ok(None);
        }
        let filled = self.field("filled", read_fields(&self.parts[0], "filled")?)?;
        Ok(Some(filled.mapv(|it| it != 0.0)))
    }

    /// All numbers of an array that all contacts share, such as `size`.
    ///
    /// # Errors
    /// For an array that is not there.
    pub fn shared(&self, name: &'static str) -> Result<Vec<f64>, FileError> {
        Ok(read_fields(&self.parts[0], name)?.into_iter().collect())
    }

    /// All numbers of an array, those of the contacts one after the other.
    ///
    /// # Errors
    /// For an array that is not there.
    pub fn values(&self, name: &'static str) -> Result<Vec<f64>, FileError> {
        Ok(self.read(name)?.into_iter().collect())
    }

    /// An array; of a folder, those of its archives along a first axis.
    pub(super) fn read(&self, name: &'static str) -> Result<ArrayD<f64>, FileError> {
        let arrays: Vec<ArrayD<f64>> =
            self.parts.iter().map(|part| read_fields(part, name)).collect::<Result<_, _>>()?;
        let views: Vec<_> = arrays.iter().map(|array| array.view()).collect();
        match views.as_slice() {
            [one] => Ok(one.to_owned()),
            several => concatenate(Axis(0), several)
                .map_err(|_| self.wrong(format!("the archives of its states do not fit each other in `{name}`"))),
        }
    }

    /// The fields of a name, one of each contact, shape `(ny, nx)`.
    ///
    /// # Errors
    /// [`FileError::Format`] for an array that is not there, of another shape than the pressure, or with values that are not finite.
    pub fn fields(&self, name: &'static str) -> Result<Vec<Field>, FileError> {
        self.fields_with(name, false)
    }

    /// The fields of a name, which may have values that are not known, as NaN.
    pub(super) fn fields_with(&self, name: &'static str, may_be_unknown: bool) -> Result<Vec<Field>, FileError> {
        for part in &self.parts {
            let [array, pressure] = [name, "pressure"].map(|name| read_fields_shape(part, name));
            let (found, expected) = (array?, pressure?);
            if found != expected {
                return Err(self
                    .wrong(format!("its array `{name}` has the shape {found:?}, but its pressure has {expected:?}")));
            }
        }
        let array = self.read(name)?;
        match self.list {
            None => Ok(vec![self.field_with(name, array, may_be_unknown)?]),
            Some(_) => array.outer_iter().map(|it| self.field_with(name, it.to_owned(), may_be_unknown)).collect(),
        }
    }

    /// A field all of whose values are finite.
    fn field(&self, name: &str, array: ArrayD<f64>) -> Result<Field, FileError> {
        self.field_with(name, array, false)
    }

    fn field_with(&self, name: &str, array: ArrayD<f64>, may_be_unknown: bool) -> Result<Field, FileError> {
        let rows = if self.rank == 1 { array.insert_axis(Axis(0)) } else { array };
        let field = rows.into_dimensionality::<Ix2>();
        let field = field.map_err(|_| self.wrong(format!("its array `{name}` does not have {} axes", self.rank)))?;
        let is_wrong = |value: &&f64| !(value.is_finite() || may_be_unknown && value.is_nan());
        match field.iter().find(is_wrong) {
            Some(value) => Err(self.wrong(format!("its array `{name}` contains the value {value}"))),
            None => Ok(field.as_standard_layout().into_owned()),
        }
    }

    /// The numbers of a name, one of each contact, if there are any.
    ///
    /// # Errors
    /// [`FileError::Format`] for another number of them.
    pub fn numbers(&self, name: &'static str) -> Result<Option<Vec<f64>>, FileError> {
        if !self.has(name)? {
            return Ok(None);
        }
        let mut values = Vec::new();
        for part in &self.parts {
            match has_field(part, name)? {
                true => values.extend(read_fields(part, name)?),
                // a number that only some states have
                false => values.push(f64::NAN),
            }
        }
        let count = self.count();
        match values.len() == count {
            true => Ok(Some(values)),
            false => Err(self.wrong(format!("its array `{name}` has {} numbers, not {count}", values.len()))),
        }
    }

    /// The words of a name, one of each contact.
    ///
    /// # Errors
    /// [`FileError::Format`] for another number of them.
    pub fn words(&self, name: &str) -> Result<Vec<String>, FileError> {
        let (mut words, count) = (Vec::new(), self.count());
        for part in &self.parts {
            let text = read_text(part, name)?.unwrap_or_default();
            words.extend(text.lines().map(str::to_owned));
        }
        match words.len() == count {
            true => Ok(words),
            false => Err(self.wrong(format!("its text `{name}` has {} lines, not {count}", words.len()))),
        }
    }

    /// The contacts.
    ///
    /// # Errors
    /// [`FileError::Format`] for arrays that are missing or do not fit each other.
    pub fn contacts(&self) -> Result<Vec<SavedContact>, FileError> {
        let [pressures, displacements, gaps] = ["pressure", "displacement", "gap"].map(|name| self.fields(name));
        let (statuses, solvers) = (self.words("status")?, self.words("solver")?);
        let nan = vec![f64::NAN; self.count()];
        let column = |name| Ok::<_, FileError>(self.numbers(name)?.unwrap_or_else(|| nan.clone()));
        let (iterations, transforms, stiffness) = (column("iterations")?, column("transforms")?, column("stiffness")?);
        let (eta, coarser) = (column("certificate")?, self.values("coarser")?);
        let certificates = if self.has(CERTIFICATE)? { self.values(CERTIFICATE)? } else { Vec::new() };
        let fields = pressures?.into_iter().zip(displacements?).zip(gaps?).enumerate();
        let contact = |(i, ((pressure, displacement), gap)): (usize, ((Field, Field), Field))| {
            let status: Status =
                statuses[i].parse().map_err(|_| self.wrong(format!("its status {:?} is not known", statuses[i])))?;
            Ok(SavedContact {
                pressure,
                displacement,
                gap,
                status,
                solver: solvers[i].clone(),
                work: Work { iterations: iterations[i] as usize, transforms: transforms[i] as u64, seconds: 0.0 },
                coarser: coarser.get(6 * i..6 * i + 6).and_then(|it| Resolved::from_numbers(it.try_into().ok()?)),
                stiffness: Some(stiffness[i]).filter(|it| it.is_finite()),
                certificate: match certificates.get(9 * i..9 * i + 9).and_then(|it| it.try_into().ok()) {
                    Some(numbers) => Certificate::from_numbers(numbers),
                    None => Certificate { eta: eta[i], ..Certificate::UNKNOWN },
                },
            })
        };
        fields.map(contact).collect()
    }

    fn wrong(&self, reason: impl Into<Sentence>) -> FileError {
        wrong(&self.path, reason)
    }
}

/// The file of an archive, or of its first state if it is a folder that a killed run has left.
pub fn first_archive(path: &Path) -> PathBuf {
    let first = if path.is_dir() { parts_of(path).ok().and_then(|parts| parts.into_iter().next()) } else { None };
    first.unwrap_or_else(|| path.to_owned())
}

/// The archives in a folder, by their names.
fn parts_of(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let failed = |source| FileError::Read { path: folder.into(), source };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let mut parts = entries.map(|entry| Ok(entry.map_err(failed)?.path())).collect::<Result<Vec<_>, _>>()?;
    parts.retain(|path| path.extension().is_some_and(|ending| ending == "npz"));
    parts.sort_unstable();
    Ok(parts)
}

fn wrong(path: &Path, reason: impl Into<Sentence>) -> FileError {
    FileError::Format { path: path.into(), what: "result", reason: reason.into() }
}

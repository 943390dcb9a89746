//! Results that are read again from their archives.

use super::HistoryOutcome;
use super::saved_states::saved_states;
use crate::contact::{
    ArchiveReader, ArchiveSeal, Contact, FieldKind, Friction, PartialSlip, Problem, ResultClaim, SavedContact, State,
    StateField, Status, read_state_fields,
};
use crate::error::{FileError, SetupError, StudyError};
use crate::files::open_regular;
use crate::history::{Loading, Sliding};
use crate::setup::{Cell, Setup, SetupTable};
use crate::surface::{Field, Plateaus, Surface};
use std::path::Path;
use std::sync::Arc;

/// Heights that differ by less than this, over the largest one, are the same.
const SAME_HEIGHT: f64 = 1e-9;

/// The step of heights that were equal before they were interpolated, over the largest one.
const LEVEL: f64 = 1e-12;

/// A result in an archive `.npz` that this program, its page or its Python package has written: its setup, and what was found.
///
/// An archive that is as this revision of the numerics wrote it is believed: contacts have the certificates, numbers and
/// claims with which they were saved. Everything in another one is unchecked: no contact is converged, no state has a
/// claim, and `doubts` say why, in sentences. See [`ArchiveSeal`]. Of a contact in such an archive the pressure alone is
/// taken: displacement, gap and certificate follow from it, so that they tell what this pressure is worth. States of
/// histories have their numbers as they are in the file.
#[derive(Debug)]
pub struct SavedResult {
    /// The text of the setup.
    pub text: String,
    /// The setup.
    pub setup: Setup,
    /// The surface.
    pub surface: Arc<Surface>,
    /// Number of axes of its arrays.
    pub rank: usize,
    /// What was found.
    pub found: SavedFound,
    /// Why the results or their heights are to be doubted, in sentences.
    pub doubts: Vec<String>,
}

/// What is in a saved result.
#[derive(Debug)]
pub enum SavedFound {
    /// A contact with the further fields of its state, and its stick and slip areas if it has a tangential load.
    Contact(Box<State>, Option<Box<PartialSlip>>),
    /// The states of a list of loads or of a history.
    States(Box<HistoryOutcome>),
}

impl SavedResult {
    /// Reads a result.
    ///
    /// # Errors
    /// For a file that is no result, arrays that do not fit each other or the setup, and a setup that cannot be.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let reader = ArchiveReader::open(path)?;
        let in_file = |error: SetupError| error.in_file(path);
        let table = SetupTable::from_toml(reader.setup()).map_err(in_file)?;
        let table = table.with_files_of_result(path)?;
        let has_files = table.has_files_of_surface();
        let mut table = table.without_digests();
        let text = table.to_toml();
        table.take_auto().map_err(in_file)?;
        let setup = table.setup().map_err(in_file)?;
        let (name, seal) = (path.display().to_string(), reader.seal()?);
        let (surface, difference) = surface(&reader, &setup, has_files)?;
        let doubts = seal.doubt(&name).into_iter().chain(difference.map(|it| it.in_words(&name))).collect();
        let is_whole = seal == ArchiveSeal::Whole;
        let archive = SavedArchive { reader: &reader, is_whole, setup: &setup, surface: &surface };
        let found = match (reader.is_list(), setup.is_history()?) {
            (false, false) => archive.contact()?,
            (false, true) => {
                let reason = "it has one state of a history, without the states before it: save and load the history";
                return Err(unfit(path, reason.into()).into());
            }
            (true, false) => archive.loads()?,
            (true, true) => archive.history()?,
        };
        Ok(Self { text, rank: reader.rank(), setup, surface, found, doubts })
    }
}

fn unfit(path: &Path, reason: String) -> FileError {
    FileError::Format { path: path.into(), what: "result", reason: reason.into() }
}

/// The surface of a result, and whether its heights are others than those of the setup. It is made again, so that it knows its
/// shape, or it is that of the heights in the file where other files or an array gave them.
fn surface(
    reader: &ArchiveReader,
    setup: &Setup,
    has_files: bool,
) -> Result<(Arc<Surface>, Option<OtherHeights>), StudyError> {
    let saved = reader.height()?;
    if !setup.surface.is_measured() {
        let (found, expected) = (saved.dim(), setup.surface.grid(&setup.grid)?.shape());
        if <[usize; 2]>::from(found) != expected {
            let reason = format!("its heights have the shape {found:?}, but those of its setup have {expected:?}");
            return Err(unfit(reader.path(), reason).into());
        }
        let made = setup.surface()?;
        // with coupling, a traction raises the heights of the contacts of a history
        let is_raised = setup.friction.is_some() && setup.dundurs_beta() != 0.0 && reader.is_list();
        let difference = difference(&saved, &made.heights_as_given()).filter(|_| !is_raised);
        return Ok((made.into(), difference));
    }
    let shape = saved.dim();
    let points = if reader.rank() == 1 { vec![shape.1] } else { vec![shape.0, shape.1] };
    let cell = Cell { points, size: reader.shared("size")?, refine: None, ..setup.grid.clone() };
    let grid = cell.grid()?;
    let plateaus = plateaus(&grid, &saved, setup.grid.refine())?;
    let plain = Surface::new(grid, saved.clone()).map_err(SetupError::from)?;
    let surface = Surface::from_parts(grid, plain.height().clone(), plain.mean_height(), None, plateaus);
    let filled = reader.filled()?.filter(|nodes| nodes.dim() == grid.shape().into());
    let surface = surface.map_err(SetupError::from)?.with_filled(filled.as_ref());
    let difference = measured_difference(setup, &surface, &saved, has_files)?;
    Ok((surface.into(), difference))
}

/// Whether the heights of files, if these are still there, are those of the result.
fn measured_difference(
    setup: &Setup,
    surface: &Surface,
    saved: &Field,
    has_files: bool,
) -> Result<Option<OtherHeights>, StudyError> {
    for file in setup.files().filter(|file| file.is_on_disk() && file.path().exists()) {
        open_regular(file.path()).map_err(|source| FileError::Read { path: file.path().into(), source })?;
    }
    if !has_files {
        return Ok(None);
    }
    Ok(match setup.surface() {
        Err(error) => Some(OtherHeights::Unknown { reason: error.to_string() }),
        Ok(made) if made.grid() != surface.grid() => {
            let reason = "the files of heights have another grid now".into();
            Some(OtherHeights::Unknown { reason })
        }
        Ok(made) => difference(saved, &made.heights_as_given()),
    })
}

/// The difference of heights in a file from those of its setup, if there is any.
fn difference(saved: &Field, made: &Field) -> Option<OtherHeights> {
    let largest = made.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    let differences = saved.iter().zip(made).map(|(one, two)| (one - two).abs());
    let difference = differences.fold(0.0, f64::max) / largest;
    (difference > SAME_HEIGHT).then_some(OtherHeights::Known { difference })
}

/// Heights of a result that are not those which its setup makes now, such as those of a file that was edited since.
enum OtherHeights {
    /// They differ by at most this, over the largest height.
    Known { difference: f64 },
    /// They cannot be compared, and why.
    Unknown { reason: String },
}

impl OtherHeights {
    /// The difference in a sentence, for the file `name`.
    fn in_words(&self, name: &str) -> String {
        match self {
            Self::Known { difference } => format!(
                "The heights in {name} are not those of its setup: they differ by up to {difference:.1e} of the largest height."
            ),
            Self::Unknown { reason } => {
                format!("The heights in {name} cannot be compared with those of its setup: {reason}.")
            }
        }
    }
}

/// The plateaus of heights that interpolate those of every `factor`-th node, which say what the grid is worth; none if these are other heights.
fn plateaus(grid: &crate::Grid, height: &Field, factor: usize) -> Result<Option<Plateaus>, SetupError> {
    let every = grid.shape().map(|points| if points == 1 { 1 } else { factor });
    if factor < 2 || [0, 1].iter().any(|&axis| !grid.shape()[axis].is_multiple_of(every[axis])) {
        return Ok(None);
    }
    let [ny, nx] = [0, 1].map(|axis| grid.shape()[axis] / every[axis]);
    let largest = height.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    // heights that were equal differ by rounding after the interpolation
    let step = LEVEL * largest;
    let at = |(y, x)| (height[[every[0] * y, every[1] * x]] / step).round() * step;
    let coarse = Field::from_shape_fn([ny, nx], at);
    let surface = Surface::new(grid.with_shape([ny, nx])?, coarse)?.refined(factor)?;
    let is_same = surface.heights_as_given().iter().zip(height).all(|(one, two)| (one - two).abs() <= 100.0 * step);
    Ok(surface.plateaus().cloned().filter(|_| is_same))
}

/// An archive with its setup and its surface.
struct SavedArchive<'a> {
    reader: &'a ArchiveReader,
    /// Whether it is as it was written, by the same numerics.
    is_whole: bool,
    setup: &'a Setup,
    surface: &'a Arc<Surface>,
}

impl SavedArchive<'_> {
    /// The contact under one load.
    fn contact(&self) -> Result<SavedFound, StudyError> {
        let (setup, saved) = (self.setup, self.contacts()?.swap_remove(0));
        let problem = setup.problem_of(self.surface.clone())?;
        let contact = Sliding::measured(self.restored(saved, problem)?);
        let slip = match setup.friction {
            Some(friction) => self.slip(&contact, friction)?.map(Box::new),
            None => None,
        };
        let fields = self.fields()?.map(|mut of_all| of_all.swap_remove(0)).collect();
        Ok(SavedFound::Contact(Box::new(State::from_contact(contact, None).with_fields(fields)), slip))
    }

    /// The contact of a problem: as it was saved, or by its pressure alone where the file is not whole.
    fn restored(&self, saved: SavedContact, problem: Problem) -> Result<Contact, SetupError> {
        if self.is_whole {
            return Ok(saved.into_contact(problem)?);
        }
        // a certificate of a file that was changed would pass for that of the pressure beside it
        let mut contact = Contact::from_pressure(&problem, saved.pressure, saved.work, &saved.solver)?;
        contact.status = saved.status;
        Ok(contact)
    }

    /// The contacts of the file, which fit the surface. Those of a file that is not whole are not confirmed.
    fn contacts(&self) -> Result<Vec<SavedContact>, StudyError> {
        let (mut contacts, expected) = (self.reader.contacts()?, self.surface.grid().shape());
        if let Some(other) = contacts.iter().find(|it| it.pressure.shape() != expected) {
            let found = other.pressure.dim();
            let reason = format!("its pressure has the shape {found:?}, but its heights have {expected:?}");
            return Err(unfit(self.reader.path(), reason).into());
        }
        if !self.is_whole {
            contacts.iter_mut().for_each(|contact| contact.status = Status::Unconfirmed);
        }
        Ok(contacts)
    }

    /// The fields of what flows through the gaps, each of all contacts. A traction belongs to what [`SavedArchive::slip`] reads.
    fn fields(&self) -> Result<impl Iterator<Item = Vec<StateField>>, StudyError> {
        let fields = read_state_fields(self.reader)?.into_iter().filter(|(kind, _)| *kind != FieldKind::Traction);
        Ok(fields.map(|(kind, of_all)| of_all.into_iter().map(|values| StateField::new(kind, values)).collect()))
    }

    /// The stick and slip areas of a contact, if they are in the file: the area that sticks carries a lighter load, see [`PartialSlip`].
    fn slip(&self, pressed: &Contact, friction: Friction) -> Result<Option<PartialSlip>, StudyError> {
        if !self.reader.has("stick_pressure")? {
            return Ok(None);
        }
        let stick = self.reader.fields("stick_pressure")?.swap_remove(0);
        let load = pressed.problem.load();
        let ratio = friction.ratio(load).map_err(SetupError::from)?;
        let lighter = pressed.problem.clone().with_load(load.with_value(load.value() * (1.0 - ratio)));
        let lighter = lighter.map_err(SetupError::from)?;
        // the file has its pressure alone; displacement, gap and certificate follow from it by one transform pair
        let stuck = Contact::from_pressure(&lighter, stick, pressed.work, &pressed.solver);
        let mut stuck = stuck.map_err(SetupError::from)?;
        stuck.status = pressed.status;
        Ok(Some(PartialSlip { friction, ratio, pressed: pressed.clone(), stuck }))
    }

    /// The contacts under a list of loads.
    fn loads(&self) -> Result<SavedFound, StudyError> {
        let (setup, count) = (self.setup, self.reader.count());
        let loads = &setup.loads;
        if loads.len() < count {
            let reason = format!("it has {count} contacts, but {} loads", loads.len());
            return Err(unfit(self.reader.path(), reason).into());
        }
        let problem = setup.problem_of(self.surface.clone())?;
        // a hard indenter flattens the surface at each load, and the next load begins there
        let mut loading = Loading::new(problem.clone(), setup.solver(), setup.stop);
        let fields: Vec<Vec<StateField>> = self.fields()?.collect();
        let mut states = Vec::with_capacity(count);
        for (number, (saved, &load)) in self.contacts()?.into_iter().zip(loads).enumerate() {
            let contact = self.restored(saved, loading.problem(load)?)?;
            loading.take(&contact);
            let own = fields.iter().map(|of_all| of_all[number].clone()).collect();
            states.push(State::from_contact(Sliding::measured(contact), Some(number)).with_fields(own));
        }
        self.found(&problem, states)
    }

    /// The states of a history.
    fn history(&self) -> Result<SavedFound, StudyError> {
        let problem = self.setup.problem_of(self.surface.clone())?;
        let states = saved_states(self.reader, self.contacts()?, self.setup, &problem)?;
        self.found(&problem, states)
    }

    /// Some states as what was found. Those whose contact is not confirmed claim nothing.
    fn found(&self, problem: &Problem, states: Vec<State>) -> Result<SavedFound, StudyError> {
        let checked = |mut state: State| {
            if state.contact.status == Status::Unconfirmed {
                state.claim = ResultClaim::Unchecked;
            }
            Arc::new(state)
        };
        let states = states.into_iter().map(checked).collect();
        Ok(SavedFound::States(Box::new(HistoryOutcome::from_states(self.setup, problem, states)?)))
    }
}

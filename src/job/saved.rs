//! Results that are read again from their archives, and certified again.

use super::HistoryOutcome;
use super::doubts::Doubts;
use super::saved_states::certified_states;
use crate::contact::{
    ArchiveReader, CertifiedContact, Contact, FieldKind, Friction, Load, PartialSlip, SavedDoubt, State, StateField,
    Status, is_met, pressure_doubts, read_state_fields,
};
use crate::error::{FileError, SetupError, StudyError};
use crate::files::open_regular;
use crate::history::{Loading, Sliding};
use crate::setup::{Cell, Setup, SetupTable};
use crate::study::LoadCurve;
use crate::surface::{Field, Plateaus, Surface};
use std::path::Path;
use std::sync::Arc;

/// Heights that differ by less than this, over the largest one, are the same.
const SAME_HEIGHT: f64 = 1e-9;

/// The step of heights that were equal before they were interpolated, over the largest one.
const LEVEL: f64 = 1e-12;

/// A result in an archive `.npz` that this program, its page or its Python package has written: its setup, and what of it holds.
///
/// Heights, pressure and setup alone are believed. Each contact is certified again, see [`SavedContact::certified`](crate::contact::SavedContact::certified).
/// What does not hold is not converged, and `doubts` say why, in sentences.
///
/// States of histories are certified as far as their files allow: the pressure for the memory, the attraction or the traction in the file, and
/// these for the state. Numbers that belong to the way to a state are as they were saved: energies, shifts, errors in time.
/// The traction of rolling, and tractions with coupling or along both axes, are held against the limit of friction and the load alone. The stability of a
/// state with adhesion is not computed again.
#[derive(Debug)]
pub struct SavedResult {
    /// The text of the setup.
    pub text: String,
    /// The setup, under the first load.
    pub setup: Setup,
    /// The surface.
    pub surface: Arc<Surface>,
    /// Number of axes of its arrays.
    pub rank: usize,
    /// What was found.
    pub found: SavedFound,
    /// What is wrong, in sentences.
    pub doubts: Vec<String>,
}

/// What is in a saved result.
#[derive(Debug)]
pub enum SavedFound {
    /// A contact with the further fields of its state, and its stick and slip areas if it has a tangential load.
    Contact(Box<State>, Option<Box<PartialSlip>>),
    /// The states under a list of loads.
    Curve(Vec<State>),
    /// The states of a history.
    History(Box<HistoryOutcome>),
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
        let loads = table.take_loads().map_err(in_file)?;
        table.take_auto().map_err(in_file)?;
        let setup = table.setup().map_err(in_file)?;
        let name = path.display().to_string();
        let mut doubts = Doubts::new(&name, reader.count());
        let surface = surface(&reader, &setup, has_files, &mut doubts)?;
        let archive = SavedArchive { reader: &reader, setup: &setup, surface: &surface };
        let found = match (reader.is_list(), setup.is_history()?) {
            (false, false) => archive.contact(&mut doubts)?,
            (false, true) => {
                let reason = "it has one state of a history, without the states before it: save and load the history";
                return Err(unfit(path, reason.into()).into());
            }
            (true, false) => archive.curve(loads.unwrap_or_default(), &mut doubts)?,
            (true, true) => archive.history(&mut doubts)?,
        };
        let (rank, doubts) = (reader.rank(), doubts.in_words());
        Ok(Self { text, setup, surface, rank, found, doubts })
    }
}

fn unfit(path: &Path, reason: String) -> FileError {
    FileError::Format { path: path.into(), what: "result", reason }
}

/// The surface of a result: made again, or that of the heights in the file where other files or an array gave them.
fn surface(
    reader: &ArchiveReader,
    setup: &Setup,
    has_files: bool,
    doubts: &mut Doubts<'_>,
) -> Result<Arc<Surface>, StudyError> {
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
        doubts.add(None, difference.into_iter().collect());
        return Ok(made.into());
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
    doubts.add(None, measured_doubt(setup, &surface, &saved, has_files)?.into_iter().collect());
    Ok(surface.into())
}

/// Whether the heights of files, if these are still there, are those of the result.
fn measured_doubt(
    setup: &Setup,
    surface: &Surface,
    saved: &Field,
    has_files: bool,
) -> Result<Option<SavedDoubt>, StudyError> {
    for file in setup.files().filter(|file| file.is_on_disk() && file.path().exists()) {
        open_regular(file.path()).map_err(|source| FileError::Read { path: file.path().into(), source })?;
    }
    if !has_files {
        return Ok(None);
    }
    Ok(match setup.surface() {
        Err(error) => Some(SavedDoubt::UnknownHeights { reason: error.to_string() }),
        Ok(made) if made.grid() != surface.grid() => {
            let reason = "the files of heights have another grid now".into();
            Some(SavedDoubt::UnknownHeights { reason })
        }
        Ok(made) => difference(saved, &made.heights_as_given()),
    })
}

/// The difference of heights in a file from those of its setup, if there is any.
fn difference(saved: &Field, made: &Field) -> Option<SavedDoubt> {
    let largest = made.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    let differences = saved.iter().zip(made).map(|(one, two)| (one - two).abs());
    let difference = differences.fold(0.0, f64::max) / largest;
    (difference > SAME_HEIGHT).then_some(SavedDoubt::Heights { difference })
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
    setup: &'a Setup,
    surface: &'a Arc<Surface>,
}

impl SavedArchive<'_> {
    /// The contact under one load.
    fn contact(&self, doubts: &mut Doubts<'_>) -> Result<SavedFound, StudyError> {
        let (setup, saved) = (self.setup, self.contacts()?.swap_remove(0));
        let problem = setup.problem_of(self.surface.clone())?;
        let CertifiedContact { contact, doubts: found } =
            saved.certified(&problem, &setup.stop).map_err(SetupError::from)?;
        doubts.add(Some(0), found);
        let contact = Sliding::measured(contact);
        let slip = match setup.friction {
            Some(friction) => self.slip(&contact, friction, doubts)?.map(Box::new),
            None => None,
        };
        let fields = self.fields()?.map(|mut of_all| of_all.swap_remove(0)).collect();
        Ok(SavedFound::Contact(Box::new(State::from_contact(contact, None).with_fields(fields)), slip))
    }

    /// The contacts of the file, which fit the surface.
    fn contacts(&self) -> Result<Vec<crate::contact::SavedContact>, StudyError> {
        let (contacts, expected) = (self.reader.contacts()?, self.surface.grid().shape());
        match contacts.iter().find(|it| it.pressure.shape() != expected) {
            Some(it) => {
                let found = it.pressure.dim();
                let reason = format!("its pressure has the shape {found:?}, but its heights have {expected:?}");
                Err(unfit(self.reader.path(), reason).into())
            }
            None => Ok(contacts),
        }
    }

    /// The fields of what flows through the gaps, each of all contacts. A traction belongs to what [`SavedArchive::slip`] reads.
    fn fields(&self) -> Result<impl Iterator<Item = Vec<StateField>>, StudyError> {
        let fields = read_state_fields(self.reader)?.into_iter().filter(|(kind, _)| *kind != FieldKind::Traction);
        Ok(fields.map(|(kind, of_all)| of_all.into_iter().map(|values| StateField::new(kind, values)).collect()))
    }

    /// The stick and slip areas of a contact, if they are in the file.
    fn slip(
        &self,
        pressed: &Contact,
        friction: Friction,
        doubts: &mut Doubts<'_>,
    ) -> Result<Option<PartialSlip>, StudyError> {
        if !self.reader.has("stick_pressure")? {
            doubts.add(Some(0), vec![SavedDoubt::Missing { name: "stick_pressure" }]);
            return Ok(None);
        }
        let stick = self.reader.fields("stick_pressure")?.swap_remove(0);
        let load = pressed.problem.load();
        let ratio = friction.ratio(load).map_err(SetupError::from)?;
        let lighter = pressed.problem.clone().with_load(load.with_value(load.value() * (1.0 - ratio)));
        let lighter = lighter.map_err(SetupError::from)?;
        let mut found = pressure_doubts(&lighter, &stick);
        let stuck = Contact::from_pressure(&lighter, stick, pressed.work, &pressed.solver);
        let mut stuck = stuck.map_err(SetupError::from)?;
        if found.is_empty() && pressed.is_converged() && !is_met(&self.setup.stop, &stuck.certificate) {
            found.push(SavedDoubt::Certificate { eta: stuck.certificate.eta });
        }
        stuck.status = if found.is_empty() { pressed.status } else { Status::Unconfirmed };
        doubts.add(Some(0), found);
        Ok(Some(PartialSlip { friction, ratio, pressed: pressed.clone(), stuck }))
    }

    /// The contacts under a list of loads.
    fn curve(&self, loads: Vec<Load>, doubts: &mut Doubts<'_>) -> Result<SavedFound, StudyError> {
        let (setup, count) = (self.setup, self.reader.count());
        if loads.len() < count {
            let reason = format!("it has {count} contacts, but {} loads", loads.len());
            return Err(unfit(self.reader.path(), reason).into());
        }
        let curve = LoadCurve { setup: setup.clone(), loads };
        let problem = curve.problem_of(self.surface.clone())?;
        let mut loading = Loading::new(problem, setup.solver(), setup.stop);
        let mut states = Vec::with_capacity(count);
        let fields: Vec<Vec<StateField>> = self.fields()?.collect();
        for (number, (saved, &load)) in self.contacts()?.iter().zip(&curve.loads).enumerate() {
            let problem = loading.problem(load)?;
            let certified = saved.certified(&problem, &setup.stop).map_err(SetupError::from)?;
            doubts.add(Some(number), certified.doubts);
            loading.take(&certified.contact);
            let state = State::from_contact(Sliding::measured(certified.contact), Some(number));
            let own = fields.iter().map(|of_all| of_all[number].clone()).collect();
            states.push(state.with_fields(own));
        }
        Ok(SavedFound::Curve(states))
    }

    /// The states of a history.
    fn history(&self, doubts: &mut Doubts<'_>) -> Result<SavedFound, StudyError> {
        let problem = self.setup.problem_of(self.surface.clone())?;
        let states = certified_states(self.reader, self.contacts()?, self.setup, &problem, doubts)?;
        Ok(SavedFound::History(Box::new(HistoryOutcome::from_states(
            self.setup,
            &problem,
            states.into_iter().map(Arc::new).collect(),
        )?)))
    }
}

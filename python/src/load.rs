//! Results read again from their archives.

use crate::contact::Contact;
use crate::conversion::{Sections, section_mut, table_from_sections};
use crate::error::{bail, py_error};
use crate::history::History;
use crate::history_parts::named;
use crate::load_curve::LoadCurve;
use crate::prepared_array::sections_of_array;
use crate::saved::{SavedArrays, SavedContact, of_pressure};
use crate::setup::Setup;
use crate::surface::Surface;
use crate::warnings::warn_sentence;
use asperity::contact::{Friction, Load, PartialSlip, ResultClaim};
use asperity::error::SurfaceError;
use asperity::history::{HISTORY_QUANTITIES, HistoryField, HistoryState};
use asperity::job::HistoryOutcome;
use asperity::study::{self, Loading};
use asperity::surface::{Field, Plateaus};
use asperity::{Grid, Problem, setup};
use numpy::ndarray::Axis;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;

/// Heights that differ by less than this, over the largest one, are the same.
const SAME_HEIGHT: f64 = 1e-12;

/// Reads a saved result (.npz) again: a Contact, a LoadCurve or a History, of this package or of the command line.
///
/// The pressure of contacts and load curves is certified again: the certificate is that of the pressure in the file. In histories it is as it was
/// saved. The seconds of the work are 0, since files do not hold them.
#[pyfunction]
pub fn load(py: Python<'_>, path: PathBuf) -> PyResult<Py<PyAny>> {
    let saved = SavedArrays::open(path)?;
    let setup = Setup::from_toml(&saved.setup)?;
    let surface = surface(py, &saved, &setup)?;
    let rank = surface.rank;
    let of = SavedResult { saved, setup, surface: surface.surface, rank };
    let (is_list, is_history) = (of.saved.is_list(rank)?, of.setup.setup.is_history().map_err(py_error)?);
    match (is_list, is_history) {
        (false, false) => Ok(Py::new(py, of.contact(py)?)?.into_any()),
        (false, true) => bail(format!(
            "{} holds one state of a history, without the states before it: save and load the history",
            of.saved.name()
        )),
        (true, false) => Ok(Py::new(py, of.curve(py)?)?.into_any()),
        (true, true) => Ok(Py::new(py, of.history(py)?)?.into_any()),
    }
}

/// The surface of a result: made again, or that of the heights in the file where other files or an array gave them.
fn surface(py: Python<'_>, saved: &SavedArrays, setup: &Setup) -> PyResult<Surface> {
    let of = &setup.setup;
    let shape = saved.shape("height")?;
    if !of.surface.is_measured() {
        let made = py.detach(|| of.surface()).map_err(py_error)?;
        let rank = of.surface.rank(&of.grid).map_err(py_error)?;
        if made.grid().shape()[2 - rank..] != shape {
            return bail(format!("the heights in {} do not have the shape of those of its setup", saved.name()));
        }
        return Ok(Surface::from_surface(made.into(), Sections::new(), rank));
    }
    let size: Vec<f64> = saved.array("size")?.into_iter().collect();
    let mut sections = sections_of_array(Sections::new());
    let grid = section_mut(&mut sections, "grid");
    grid.insert("points".into(), json!(shape));
    grid.insert("size".into(), json!(size));
    let described = setup.sections().remove("grid").unwrap_or(Value::Null);
    for key in ["boundary", "datum"] {
        if let Some(value) = described.get(key) {
            grid.insert(key.into(), value.clone());
        }
    }
    let (_, cell) = table_from_sections(&sections)?.surface().map_err(py_error)?;
    let grid = cell.grid().map_err(py_error)?;
    let height = saved.fields("height", shape.len(), 1)?.swap_remove(0);
    let surface = py.detach(|| {
        let plateaus = plateaus(&grid, &height, of.grid.refine())?;
        let plain = asperity::Surface::new(grid, height)?;
        asperity::Surface::from_parts(grid, plain.height().clone(), plain.mean_height(), None, plateaus)
    });
    let surface = surface.map_err(py_error)?;
    Ok(Surface::from_surface(surface.into(), sections, shape.len()))
}

/// The plateaus of heights that interpolate those of every `factor`-th node, which say what the grid is worth; none if these are other heights.
fn plateaus(grid: &Grid, height: &Field, factor: usize) -> Result<Option<Plateaus>, SurfaceError> {
    let every = grid.shape().map(|points| if points == 1 { 1 } else { factor });
    let [ny, nx] = [0, 1].map(|axis| grid.shape()[axis] / every[axis]);
    if factor < 2 || [ny * every[0], nx * every[1]] != grid.shape() {
        return Ok(None);
    }
    let largest = height.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    // heights that were equal differ by rounding after the interpolation
    let step = SAME_HEIGHT * largest;
    let at = |(y, x)| (height[[every[0] * y, every[1] * x]] / step).round() * step;
    let coarse = Field::from_shape_fn([ny, nx], at);
    let surface = asperity::Surface::new(grid.with_shape([ny, nx])?, coarse)?.refined(factor)?;
    let is_same = surface.heights_as_given().iter().zip(height).all(|(one, two)| (one - two).abs() <= 100.0 * step);
    Ok(surface.plateaus().cloned().filter(|_| is_same))
}

/// A result in a file, with its setup and its surface.
struct SavedResult {
    saved: SavedArrays,
    setup: Setup,
    surface: Arc<asperity::Surface>,
    rank: usize,
}

impl SavedResult {
    /// The contact under one load.
    fn contact(&self, py: Python<'_>) -> PyResult<Contact> {
        let setup = &self.setup.setup;
        let problem = setup.problem_of(self.surface.clone()).map_err(py_error)?;
        let contacts = self.saved.contacts(self.rank, 1, self.surface.grid())?;
        let certified = |it: &SavedContact| it.certified(&problem, &setup.stop);
        let (contact, doubt) = py.detach(|| certified(&contacts[0])).map_err(py_error)?;
        self.warn(py, doubt.iter())?;
        let slip = setup.friction.map(|friction| self.slip(py, &contact, friction)).transpose()?.flatten();
        Ok(Contact { slip, ..Contact::new(contact, self.surface.clone(), setup.clone(), self.rank) })
    }

    /// The stick and slip areas of a contact, if they are in the file.
    fn slip(&self, py: Python<'_>, pressed: &asperity::Contact, friction: Friction) -> PyResult<Option<PartialSlip>> {
        if !self.saved.has("stick_pressure")? {
            return Ok(None);
        }
        let stick = self.saved.fields("stick_pressure", self.rank, 1)?.swap_remove(0);
        let (load, stop) = (pressed.problem.load(), &self.setup.setup.stop);
        let ratio = friction.ratio(load).map_err(py_error)?;
        let lighter = pressed.problem.clone().with_load(load.with_value(load.value() * (1.0 - ratio)));
        let lighter = lighter.map_err(py_error)?;
        let stuck = py.detach(|| of_pressure(&lighter, stick, stop, &pressed.solver)).map_err(py_error)?;
        Ok(Some(PartialSlip { friction, ratio, pressed: pressed.clone(), stuck }))
    }

    /// The contacts under a list of loads.
    fn curve(&self, py: Python<'_>) -> PyResult<LoadCurve> {
        let (setup, count) = (&self.setup.setup, self.saved.count(self.rank)?);
        let loads: Vec<Load> = self.setup.loads.iter().flatten().copied().collect();
        if loads.len() < count {
            return bail(format!("{} holds {count} contacts, but {} loads", self.saved.name(), loads.len()));
        }
        let curve = study::LoadCurve { setup: setup.clone(), loads };
        let problem = curve.problem_of(self.surface.clone()).map_err(py_error)?;
        let (mut loading, mut contacts, mut doubts) = (Loading::default(), Vec::new(), Vec::new());
        for (saved, &load) in self.saved.contacts(self.rank, count, self.surface.grid())?.iter().zip(&curve.loads) {
            let (contact, doubt) =
                py.detach(|| saved.certified(&loading.problem(&problem, load)?, &setup.stop)).map_err(py_error)?;
            doubts.extend(doubt);
            loading.take(contact.clone());
            let under = setup::Setup { load: contact.problem.load(), ..setup.clone() };
            contacts.push(Contact::new(contact, self.surface.clone(), under, self.rank));
        }
        self.warn(py, doubts.first().into_iter())?;
        LoadCurve::new(py, contacts, self.setup.clone())
    }

    /// The states of a history.
    fn history(&self, py: Python<'_>) -> PyResult<History> {
        let (setup, count) = (&self.setup.setup, self.saved.count(self.rank)?);
        let problem = setup.problem_of(self.surface.clone()).map_err(py_error)?;
        let mut columns = Vec::new();
        for quantity in HISTORY_QUANTITIES {
            columns.extend(self.saved.numbers(quantity.name, count)?.map(|values| (quantity.name, values)));
        }
        let mut fields = Vec::new();
        for (name, _) in HistoryField::MAKERS {
            if self.saved.has(name)? {
                fields.push((name, self.saved.fields(name, self.rank, count)?));
            }
        }
        let [claims, points] = [self.saved.words("claim", count)?, self.saved.words("point", count)?];
        let contacts = self.saved.contacts(self.rank, count, self.surface.grid())?;
        let mut states = Vec::with_capacity(count);
        for (i, contact) in contacts.iter().enumerate() {
            let point = points[i].parse().ok();
            let claim: ResultClaim =
                claims[i].parse().map_err(|_| py_error(format!("there is no claim {:?}", claims[i])))?;
            let problem = self.under_load(&problem, point, contact);
            let contact = contact.as_saved(&problem).map_err(py_error)?;
            let number = |name: &str| {
                let (_, values) = columns.iter().find(|(known, _)| *known == name)?;
                // the numbers that all states have may be undefined
                Some(values[i]).filter(|it| !it.is_nan() || ["relative_area", "kappa_r"].contains(&name))
            };
            let further = fields.iter().map(|(name, of)| named(name, of[i].clone())).collect::<PyResult<_>>()?;
            states.push(HistoryState::from_parts(contact, (point, claim), number, further));
        }
        let outcome = HistoryOutcome::from_states(setup, &problem, states).map_err(py_error)?;
        let (surface, setup, rank) = (self.surface.clone(), self.setup.clone(), self.rank);
        let problem =
            crate::problem::Problem { problem, surface, setup: setup.clone(), rank, preparation: Arc::default() };
        History::new(py, outcome, &problem, setup)
    }

    /// The problem under the load of a state: that of the point of the path, or its mean pressure between two points.
    fn under_load(&self, problem: &Problem, point: Option<usize>, contact: &SavedContact) -> Problem {
        let (setup, path) = (&self.setup.setup, self.setup.setup.path_points());
        if setup.adhesion.is_some() {
            return problem.clone();
        }
        let mean = contact.pressure.mean_axis(Axis(1)).and_then(|rows| rows.mean()).unwrap_or(0.0);
        let load = match (point.and_then(|at| path.get(at)), setup.load) {
            (Some(point), _) => point.load,
            (None, load) if path.is_empty() || !load.is_pressure() => load,
            (None, load) => load.with_value(load.value() * mean / problem.mean_pressure().unwrap_or(mean)),
        };
        problem.clone().with_load(load).unwrap_or_else(|_| problem.clone())
    }

    /// Warns about a pressure that is not what its file says.
    fn warn<'a>(&self, py: Python<'_>, doubts: impl Iterator<Item = &'a String>) -> PyResult<()> {
        let name = self.saved.name();
        doubts.into_iter().try_for_each(|doubt| warn_sentence(py, &format!("The pressure in {name} {doubt}.")))
    }
}

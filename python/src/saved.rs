//! The arrays of a saved result, and the contacts in them.

use crate::error::{BoxedError, bail, py_error};
use asperity::contact::{Certificate, Contact, Resolved, Solver, Status, Stop, Work};
use asperity::foreign::{Frame, Quantity, Replay};
use asperity::surface::{Field, has_field, read_fields, read_fields_shape, read_text};
use asperity::{Grid, Problem};
use numpy::ndarray::{ArrayD, Axis, Ix2};
use pyo3::prelude::*;
use std::path::PathBuf;

/// The relative difference of displacements up to which they are taken as the same.
const SAME: f64 = 1e-6;

/// A saved result (.npz) that is read.
pub struct SavedArrays {
    path: PathBuf,
    /// The text of its setup.
    pub setup: String,
}

/// A contact in a saved result.
pub struct SavedContact {
    pub pressure: Field,
    displacement: Field,
    gap: Field,
    status: Status,
    solver: String,
    work: Work,
    coarser: Option<Resolved>,
    /// Whether the stiffness was known.
    has_stiffness: bool,
    /// The certificate as it was saved.
    certificate: Certificate,
}

impl SavedArrays {
    /// Opens a saved result.
    pub fn open(path: PathBuf) -> PyResult<Self> {
        match read_text(&path, "setup").map_err(py_error)? {
            Some(setup) => Ok(Self { path, setup }),
            None => bail(format!("{} is not a saved result: give a file .npz that save has written", path.display())),
        }
    }

    /// The name of the file.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// Whether there is an array of a name.
    pub fn has(&self, name: &'static str) -> PyResult<bool> {
        has_field(&self.path, name).map_err(py_error)
    }

    /// The array of a name.
    pub fn array(&self, name: &'static str) -> PyResult<ArrayD<f64>> {
        read_fields(&self.path, name).map_err(py_error)
    }

    /// The shape of an array.
    pub fn shape(&self, name: &'static str) -> PyResult<Vec<usize>> {
        read_fields_shape(&self.path, name).map_err(py_error)
    }

    /// Whether fields of a rank have a first axis of loads or states.
    pub fn is_list(&self, rank: usize) -> PyResult<bool> {
        match self.shape("pressure")?.len() {
            axes if axes == rank => Ok(false),
            axes if axes == rank + 1 => Ok(true),
            axes => bail(format!("the pressure in {} has {axes} axes, but its heights have {rank}", self.name())),
        }
    }

    /// The number of loads or states of a list.
    pub fn count(&self, rank: usize) -> PyResult<usize> {
        Ok(if self.is_list(rank)? { self.shape("pressure")?[0] } else { 1 })
    }

    /// The fields of a name and a rank, one for each of `count` contacts.
    pub fn fields(&self, name: &'static str, rank: usize, count: usize) -> PyResult<Vec<Field>> {
        let array = self.array(name)?;
        let listed = if array.ndim() == rank { array.insert_axis(Axis(0)) } else { array };
        let wrong = || py_error(format!("the array {name} in {} does not have the shape of its contacts", self.name()));
        if listed.ndim() != rank + 1 || listed.len_of(Axis(0)) != count {
            return Err(wrong());
        }
        let field = |it: ArrayD<f64>| {
            let rows = if rank == 1 { it.insert_axis(Axis(0)) } else { it };
            rows.into_dimensionality::<Ix2>().map_err(|_| wrong())
        };
        listed.outer_iter().map(|it| field(it.to_owned())).collect()
    }

    /// The numbers of a name, one for each of `count` contacts, if there are any.
    pub fn numbers(&self, name: &'static str, count: usize) -> PyResult<Option<Vec<f64>>> {
        if !self.has(name)? {
            return Ok(None);
        }
        let values: Vec<f64> = self.array(name)?.into_iter().collect();
        match values.len() == count {
            true => Ok(Some(values)),
            false => bail(format!("the array {name} in {} has {} numbers, not {count}", self.name(), values.len())),
        }
    }

    /// The words of a name, one for each of `count` contacts.
    pub fn words(&self, name: &'static str, count: usize) -> PyResult<Vec<String>> {
        let text = read_text(&self.path, name).map_err(py_error)?.unwrap_or_default();
        let words: Vec<String> = text.lines().map(str::to_owned).collect();
        match words.len() == count {
            true => Ok(words),
            false => bail(format!("the text {name} in {} has {} lines, not {count}", self.name(), words.len())),
        }
    }

    /// The contacts on a grid.
    pub fn contacts(&self, rank: usize, count: usize, grid: &Grid) -> PyResult<Vec<SavedContact>> {
        let [pressures, displacements, gaps] = [
            self.fields("pressure", rank, count)?,
            self.fields("displacement", rank, count)?,
            self.fields("gap", rank, count)?,
        ];
        if pressures.iter().any(|it| <[usize; 2]>::from(it.dim()) != grid.shape()) {
            return bail(format!("the pressure in {} does not have the shape of its heights", self.name()));
        }
        if pressures.iter().chain(&displacements).chain(&gaps).flatten().any(|it| !it.is_finite()) {
            return bail(format!("a field in {} has values that are not finite", self.name()));
        }
        let (statuses, solvers) = (self.words("status", count)?, self.words("solver", count)?);
        let column = |name| Ok::<_, PyErr>(self.numbers(name, count)?.unwrap_or_else(|| vec![f64::NAN; count]));
        let (iterations, transforms, stiffness) = (column("iterations")?, column("transforms")?, column("stiffness")?);
        let [eta, eta_gap] = [column("certificate")?, column("certificate_gap")?];
        let [of_pressure, of_gap] = [column("pressure_error_bound")?, column("mean_gap_error_bound")?];
        let [load_error, penetration] = [column("load_error")?, column("penetration")?];
        let coarser: Vec<f64> = self.array("coarser")?.into_iter().collect();
        let contact = |(i, ((pressure, displacement), gap)): (usize, ((Field, Field), Field))| {
            let status = serde_json::from_value(statuses[i].as_str().into()).map_err(py_error)?;
            let coarser = coarser.get(6 * i..6 * i + 6).and_then(|it| Resolved::from_numbers(it.try_into().ok()?));
            let certificate = Certificate {
                eta: eta[i],
                eta_gap: eta_gap[i],
                pressure_error_bound: of_pressure[i],
                mean_gap_error_bound: of_gap[i],
                load_error: load_error[i],
                penetration: penetration[i],
                min_pressure: f64::NAN,
                above_hardness: f64::NAN,
                rounding: f64::NAN,
            };
            let work = Work { iterations: iterations[i] as usize, transforms: transforms[i] as u64, seconds: 0.0 };
            let (solver, has_stiffness) = (solvers[i].clone(), stiffness[i].is_finite());
            Ok(SavedContact { pressure, displacement, gap, status, solver, work, coarser, has_stiffness, certificate })
        };
        pressures.into_iter().zip(displacements).zip(gaps).enumerate().map(contact).collect()
    }
}

impl SavedContact {
    /// The contact of a problem with the certificate of its pressure, and what is wrong with the file, if anything is.
    pub fn certified(&self, problem: &Problem, stop: &Stop) -> Result<(Contact, Option<String>), BoxedError> {
        let pressure = self.pressure.as_slice().unwrap_or_default();
        let certificate = Certificate::new(problem, pressure);
        let mut displacement = vec![0.0; pressure.len()];
        problem.response().displacement(pressure, &mut displacement);
        let largest = displacement.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        let is_same = displacement.iter().zip(&self.displacement).all(|(u, saved)| (u - saved).abs() <= SAME * largest);
        let is_met = stop.is_met(&certificate);
        let (status, doubt) = match (self.status, is_met, is_same) {
            (status, is_met, false) => {
                let status = if is_met { status } else { Status::Ended };
                (status, Some("does not cause the displacement in it: one of them was changed".to_owned()))
            }
            (Status::Converged, false, true) => {
                let eta = certificate.eta;
                (Status::Ended, Some(format!("does not meet the tolerance of its setup: its certificate is {eta:.1e}")))
            }
            (status, ..) => (status, None),
        };
        Ok((self.made(problem, certificate, status)?, doubt))
    }

    /// The contact of a problem with the certificate in the file.
    pub fn as_saved(&self, problem: &Problem) -> Result<Contact, BoxedError> {
        self.made(problem, self.certificate, self.status)
    }

    fn made(&self, problem: &Problem, certificate: Certificate, status: Status) -> Result<Contact, BoxedError> {
        let fields = [&self.pressure, &self.displacement, &self.gap].map(Field::clone);
        let parts = (certificate, self.work, status);
        let contact = Contact::from_parts(problem.clone(), fields, parts, self.solver.clone(), self.coarser)?;
        if self.has_stiffness {
            contact.stiffness();
        }
        Ok(contact)
    }
}

/// The contact of a problem that has a pressure.
pub fn of_pressure(problem: &Problem, pressure: Field, stop: &Stop, solver: &str) -> Result<Contact, BoxedError> {
    let frame = Frame { values: pressure.into_iter().collect(), seconds: None };
    let replay = Replay::new(solver, Quantity::Pressure, [Ok(frame)].into_iter());
    Ok(replay.solve(problem, stop, &mut ())?)
}

//! One surface and the loads it is pressed with.

use super::row::{Identity, Row, Timed};
use crate::contact::{Contact, ContactModulus, Load, Multilevel, Problem, Solver, Stop};
use crate::error::{ProblemError, StudyError, SurfaceError};
use crate::grid::Grid;
use crate::surface::{Field, Indenter, Spectrum, Surface};

/// A surface and the loads it is pressed with, one after the other. The contact modulus is 1.
///
/// | field   | meaning                                       | unit |
/// |---------|-----------------------------------------------|------|
/// | `name`  | what it goes by in tables                     | -    |
/// | `grid`  | the points                                    | any  |
/// | `shape` | an indenter, or a spectrum with its seed      | any  |
/// | `loads` | reduced pressures `p* = <p>/(gbar E*)`, of which each but the first starts from the one before | - |
#[derive(Debug, Clone, PartialEq)]
pub struct Realisation {
    /// What it goes by in tables.
    pub name: String,
    /// The points.
    pub grid: Grid,
    /// Heights.
    pub shape: Shape,
    /// Reduced pressures, in the order in which they are solved.
    pub loads: Vec<f64>,
}

/// Where the heights come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A smooth indenter.
    Smooth(Indenter),
    /// Self-affine roughness.
    Rough {
        /// Its power spectrum.
        spectrum: Spectrum,
        /// Which realisation.
        seed: u64,
    },
}

/// A realisation under one of its loads.
pub struct Pressed<'a> {
    /// Number of the load, from 0.
    pub load: usize,
    /// The problem.
    pub problem: &'a Problem,
    /// Its solution, or the best state found.
    pub contact: &'a Contact,
}

impl Realisation {
    /// The surface.
    ///
    /// # Errors
    /// As [`Indenter::surface`] and [`Surface::rough`].
    pub fn surface(&self) -> Result<Surface, SurfaceError> {
        match self.shape {
            Shape::Smooth(indenter) => indenter.surface(self.grid),
            Shape::Rough { spectrum, seed } => Surface::rough(self.grid, &spectrum, seed),
        }
    }

    /// Solves it under its loads, each from the contact before, and shows each contact to `each`, which may end that.
    ///
    /// # Errors
    /// For surfaces and loads that cannot be, and those of `each`. What did not converge is shown all the same.
    pub fn press<E: From<StudyError>>(
        &self,
        stop: &Stop,
        mut each: impl FnMut(Pressed<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut start: Option<Field> = None;
        let surface = self.surface().map_err(StudyError::from)?;
        let mut problem =
            Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(1.0)).map_err(StudyError::from)?;
        for (load, reduced_pressure) in self.loads.iter().enumerate() {
            let mean_pressure = Load::ReducedPressure(*reduced_pressure);
            problem = problem.with_load(mean_pressure).map_err(StudyError::from)?;
            let contact = Multilevel.solve_from(start.as_ref(), &problem, stop, &mut ()).map_err(StudyError::from)?;
            each(Pressed { load, problem: &problem, contact: &contact })?;
            start = Some(contact.pressure);
        }
        Ok(())
    }

    /// Refuses what cannot be made or loaded, before anything is.
    ///
    /// # Errors
    /// As [`Spectrum::validate`], [`Indenter::surface`] and [`Problem::new`].
    pub fn check(&self) -> Result<(), StudyError> {
        match self.shape {
            Shape::Smooth(indenter) => indenter.check(&self.grid)?,
            Shape::Rough { spectrum, .. } => spectrum.validate(&self.grid)?,
        }
        let is_wrong = |load: &&f64| !(load.is_finite() && **load > 0.0);
        match self.loads.iter().find(is_wrong) {
            Some(&value) => Err(ProblemError::NotPositive { name: "reduced pressure", value }.into()),
            None => Ok(()),
        }
    }

    /// Its spectrum and seed, if it is rough.
    pub(super) fn roughness(&self) -> Option<(Spectrum, u64)> {
        match self.shape {
            Shape::Smooth(_) => None,
            Shape::Rough { spectrum, seed } => Some((spectrum, seed)),
        }
    }

    /// Its points among those of a table, if they are all there, one after the other.
    pub(super) fn find(&self, points: &[Timed], tolerance: f64) -> Option<Vec<Timed>> {
        let identity = Identity::of(self, tolerance);
        let is_it = |points: &&[Timed]| {
            let loads = points.iter().map(|timed| timed.row.reduced_pressure);
            loads.eq(self.loads.iter().copied()) && points.iter().all(|timed| timed.row.identity() == identity)
        };
        points.windows(self.loads.len().max(1)).find(is_it).map(<[Timed]>::to_vec)
    }

    /// Whether a point is one of its own.
    pub(super) fn includes(&self, row: &Row, tolerance: f64) -> bool {
        row.identity() == Identity::of(self, tolerance) && self.loads.contains(&row.reduced_pressure)
    }
}

//! The states that a setup describes: their number, their path, and what makes them.

use super::{Drive, Setup, Solid};
use crate::contact::{Feels, Load, Problem};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::history::{PathPoint, Process};

impl Setup {
    /// The drive of a run with several states. A contact that slides at one speed is a single state, solved like any other.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn drive_of_states(&self) -> Result<Option<&'static Drive>, SetupError> {
        Ok(self.drive()?.filter(|drive| drive.is_list || self.speed().is_none()))
    }

    /// The drive of a history: of states that depend on those before, which the contacts under a list of loads do not.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn history_drive(&self) -> Result<Option<&'static Drive>, SetupError> {
        Ok(self.drive_of_states()?.filter(|drive| !drive.is_list))
    }

    /// Whether the setup describes a history.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn is_history(&self) -> Result<bool, SetupError> {
        Ok(self.history_drive()?.is_some())
    }

    /// What the solid feels besides the pressure between the surfaces; the pressure alone where sections do not go together.
    pub fn feels(&self) -> Feels {
        self.drive().ok().flatten().map_or(Feels::PRESSURE, |drive| drive.feels)
    }

    /// The number of states of a history or a list of loads, an estimate where steps are chosen by the error in time; 0 for one contact.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn expected_states(&self) -> Result<usize, SetupError> {
        Ok(self.drive_of_states()?.map_or(0, |drive| (drive.states)(self)))
    }

    /// The states along the path, with a number of steps between two points if none is given.
    pub(super) fn states_of_path(&self, steps: usize) -> usize {
        let Some(path) = &self.path else { return 0 };
        // a path in time that begins at time 0 has a single state there
        let begins = usize::from(path.time.first() == Some(&0.0));
        begins + (path.len() - begins).saturating_mul(path.steps.unwrap_or(steps))
    }

    /// The speed of sliding, if there is one speed.
    pub(crate) fn speed(&self) -> Option<f64> {
        match self.sliding.as_ref()?.speed.as_slice() {
            [speed] => Some(*speed),
            _ => None,
        }
    }

    /// The points of the path of a history; with adhesion or a yield stress the load alone if it has none, and else none.
    pub fn path_points(&self) -> Vec<PathPoint> {
        let points = self.path.as_ref().map_or_else(Vec::new, |path| path.points(self.load));
        let has_load = self.yields() || (self.adhesion.is_some() && self.path.is_none());
        if points.is_empty() && has_load { vec![PathPoint::under(self.load)] } else { points }
    }

    /// Checks what belongs to a drive.
    pub(super) fn check_drive(&self, drive: &Drive, grid: &Grid) -> Result<(), SetupError> {
        self.viscoelastic.as_ref().map_or(Ok(()), |it| it.prony().map(drop))?;
        let path = self.path.as_ref().filter(|path| !(path.is_empty() && self.yields()));
        // an approach below 0 lifts the surface off a solid that creeps, which recovers then
        let lifts = self.creeps() && matches!(self.load, Load::Approach(_));
        path.map_or(Ok(()), |path| path.check(self.adhesion.is_some() || lifts))?;
        self.adhesion.as_ref().map_or(Ok(()), |it| it.attraction().map(drop))?;
        self.sliding.as_ref().map_or(Ok(()), super::SlidingMotion::check)?;
        self.rolling.as_ref().map_or(Ok(()), super::RollingMotion::check)?;
        self.check_beside(drive)?;
        (drive.check)(self, grid)
    }

    /// What makes the states of a problem, which is that of this setup; none for one contact.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`] and of the process.
    pub fn history(&self, problem: Problem) -> Result<Option<Box<dyn Process + '_>>, SetupError> {
        self.drive()?.map(|drive| (drive.make)(self, problem)).transpose()
    }

    /// Dundurs' constant; 0 for a solid of which only the contact modulus is known.
    pub(crate) fn dundurs_beta(&self) -> f64 {
        self.solid.as_ref().and_then(Solid::dundurs_beta).unwrap_or(0.0)
    }
}

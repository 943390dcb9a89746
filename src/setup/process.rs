//! The states that a setup describes: their number, their path, and what makes them.

use super::{Drive, Setup, Solid};
use crate::contact::{Load, Problem};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::history::{PathPoint, Process};

impl Setup {
    /// The drive that makes more than one state. A contact that slides at one speed is a single state, solved like any other.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn history_drive(&self) -> Result<Option<&'static Drive>, SetupError> {
        Ok(self.drive()?.filter(|_| self.speed().is_none()))
    }

    /// Whether the setup describes more than one state.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn is_history(&self) -> Result<bool, SetupError> {
        Ok(self.history_drive()?.is_some())
    }

    /// The number of states of a history, an estimate where steps are chosen by the error in time; 0 for one contact.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn expected_states(&self) -> Result<usize, SetupError> {
        Ok(self.history_drive()?.map_or(0, |drive| (drive.states)(self)))
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

    /// The setup whose loads go back after the last one, and then to 0. Mean gaps go back to the first one.
    pub fn unloaded(mut self) -> Self {
        let mut loads: Vec<f64> = self.path_points().iter().map(|point| point.load.value()).collect();
        let back: Vec<f64> = loads.iter().rev().skip(1).copied().collect();
        loads.extend(back);
        loads.extend((!matches!(self.load, Load::MeanGap(_))).then_some(0.0));
        self.path.get_or_insert_default().load = loads;
        self
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

    /// What makes the history of a problem, which is that of this setup; none for a contact without a history.
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

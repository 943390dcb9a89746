//! Contacts of a file.

use crate::contact::{Certificate, Contact, Problem, Resolved, Status, Work};
use crate::error::SurfaceError;
use crate::surface::Field;

/// A contact as an archive has it.
#[derive(Debug, Clone)]
pub struct SavedContact {
    /// Pressure, shape `(ny, nx)`.
    pub pressure: Field,
    /// Displacement, shape `(ny, nx)`.
    pub displacement: Field,
    /// Gap, shape `(ny, nx)`.
    pub gap: Field,
    /// How the solver stopped.
    pub status: Status,
    /// The name of the solver.
    pub solver: String,
    /// Work, of which the seconds are not known.
    pub work: Work,
    /// The contact on the next coarser grid.
    pub coarser: Option<Resolved>,
    /// The contact stiffness, if it was found.
    pub stiffness: Option<f64>,
    /// The certificate. Archives of earlier versions have its `eta` alone.
    pub certificate: Certificate,
}

impl SavedContact {
    /// The contact of a problem, as it was saved.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for fields that do not fit the grid.
    pub fn into_contact(self, problem: Problem) -> Result<Contact, SurfaceError> {
        let parts = (self.certificate, self.work, self.status);
        let fields = [self.pressure, self.displacement, self.gap];
        let contact = Contact::from_parts(problem, fields, parts, self.solver, self.coarser)?;
        Ok(match self.stiffness {
            Some(stiffness) => contact.with_stiffness(stiffness),
            None => contact,
        })
    }
}

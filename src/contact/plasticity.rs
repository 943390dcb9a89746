//! The plastic part of a contact.

use crate::contact::{Contact, chunks};
use crate::error::SurfaceError;
use crate::surface::Surface;
use ndarray::Array2;
use serde::Serialize;

/// The plastic part of a contact with a hardness: fractions and a length for the whole cell. All are zero for a hard
/// wall, but for the overlap of a surface that has yielded before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Plasticity {
    /// Fraction of the nodes that yield.
    pub area: f64,
    /// Mean overlap of the surfaces where they yield or have yielded, a length: the plastically displaced volume divided by the area of
    /// the cell.
    pub overlap: f64,
    /// Fraction of the load that is carried by nodes that yield.
    pub load_share: f64,
}

impl Plasticity {
    /// The plastic part of `contact`.
    pub(super) fn new(contact: &Contact) -> Self {
        let (law, n) = (contact.problem.law(), contact.pressure.len());
        let pressure = contact.pressure.as_slice().expect("results are made in standard layout");
        let yielding = |i: usize| if law.yields(pressure[i]) { 1.0 } else { 0.0 };
        let of_yielding = chunks::sum(n, |i| yielding(i) * pressure[i]);
        Self {
            area: chunks::sum(n, yielding) / n as f64,
            overlap: contact.mean_overlap(),
            load_share: if of_yielding > 0.0 { of_yielding / chunks::sum(n, |i| pressure[i]) } else { 0.0 },
        }
    }
}

impl Contact {
    /// The plastic part of the contact; zero without a hardness.
    pub fn plasticity(&self) -> Plasticity {
        Plasticity::new(self)
    }

    /// The nodes that yield; none on a hard wall.
    pub fn yielding(&self) -> Array2<bool> {
        let law = self.problem.law();
        self.pressure.mapv(|p| law.yields(p))
    }

    /// The surface after this contact: its heights minus the overlap of the nodes that yield. With this surface and a
    /// hard wall, the same load gives the same pressure as with the hardness, and smaller loads give the unloading
    /// curve.
    ///
    /// # Errors
    /// None that is known: heights less an overlap are finite.
    pub fn unloaded_surface(&self) -> Result<Surface, SurfaceError> {
        let surface = self.problem.surface();
        Surface::new(*surface.grid(), surface.height() - &self.overlap())
    }
}

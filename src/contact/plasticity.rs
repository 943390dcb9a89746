//! The plastic part of a contact.

use crate::contact::{Contact, chunks};
use crate::error::SurfaceError;
use crate::surface::Surface;
use ndarray::Array2;
use serde::Serialize;

/// The plastic part of a contact with a hardness: fractions and a length for the whole cell. All are zero for a hard
/// wall.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Plasticity {
    /// Fraction of the nodes that yield.
    pub area: f64,
    /// Mean overlap of the surfaces where they yield, a length: the plastically displaced volume divided by the area of
    /// the cell.
    pub overlap: f64,
    /// Fraction of the load that is carried by nodes that yield.
    pub load_share: f64,
}

impl Plasticity {
    /// The plastic part of `contact`.
    pub(super) fn new(contact: &Contact) -> Self {
        let (law, n) = (contact.problem.law(), contact.pressure.len() as f64);
        let of_yielding = |value: &dyn Fn(f64, f64) -> f64| -> f64 {
            let nodes = contact.pressure.iter().zip(&contact.gap).filter(|(p, _)| law.yields(**p));
            nodes.fold(0.0, |sum, (&p, &gap)| sum + value(p, gap))
        };
        let load = chunks::sum(contact.pressure.len(), |i| contact.pressure.as_slice().map_or(0.0, |p| p[i]));
        Self {
            area: of_yielding(&|_, _| 1.0) / n,
            overlap: of_yielding(&|_, gap| (-gap).max(0.0)) / n,
            load_share: of_yielding(&|p, _| p) / load,
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
        let (law, surface) = (self.problem.law(), self.problem.surface());
        let mut height = surface.height().to_owned();
        let nodes = height.iter_mut().zip(self.pressure.iter().zip(&self.gap));
        nodes.filter(|(_, (p, _))| law.yields(**p)).for_each(|(h, (_, &gap))| *h -= (-gap).max(0.0));
        Surface::new(*surface.grid(), height)
    }
}

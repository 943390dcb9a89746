//! Points told apart by the setup that they come from.

use super::point::Point;
use super::realisation::Realisation;
use crate::contact::{Contact, Observables};
use crate::error::StudyError;

/// Version of the program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The identity of a realisation: by its name, its setup and the version of the program, tables know its points.
pub(super) struct Identity<'a> {
    realisation: &'a Realisation,
    /// Fingerprint of the setup.
    setup: String,
}

impl<'a> Identity<'a> {
    /// The identity of a realisation.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn of(realisation: &'a Realisation) -> Result<Self, StudyError> {
        Ok(Self { realisation, setup: realisation.setup.fingerprint()? })
    }

    /// Whether a point is one of the realisation.
    pub fn includes(&self, point: &Point) -> bool {
        let Realisation { name, loads, .. } = self.realisation;
        (name, &self.setup, VERSION) == (&point.name, &point.setup, &point.version)
            && loads.contains(&point.observables.reduced_pressure)
    }

    /// The points of the realisation among those of a table, if they are all there, one after the other.
    pub fn find(&self, points: &[Point]) -> Option<Vec<Point>> {
        let loads = &self.realisation.loads;
        let is_it = |points: &&[Point]| {
            let found = points.iter().map(|point| point.observables.reduced_pressure);
            found.eq(loads.iter().copied()) && points.iter().all(|point| self.includes(point))
        };
        points.windows(loads.len().max(1)).find(is_it).map(<[Point]>::to_vec)
    }

    /// Solves the realisation, and shows each point with its contact.
    ///
    /// # Errors
    /// The errors of [`Realisation::press`].
    pub fn press(&self, mut each: impl FnMut(Point, &Contact)) -> Result<(), StudyError> {
        let mut load = 0;
        self.realisation.press(|contact| {
            load += 1;
            each(self.point(load, contact), contact);
            Ok::<(), StudyError>(())
        })
    }

    /// The point of a contact under the load of number `load`, from 1.
    fn point(&self, load: usize, contact: &Contact) -> Point {
        let Realisation { name, setup, .. } = self.realisation;
        let grid = contact.problem.surface().grid();
        let ([ny, nx], [_, length]) = (grid.shape(), grid.size());
        let spectrum = setup.surface.spectrum;
        Point {
            name: name.clone(),
            ny,
            nx,
            length,
            hurst: spectrum.map(|spectrum| spectrum.hurst),
            rolloff_wavelength: spectrum.map(|spectrum| spectrum.rolloff_wavelength),
            short_cutoff: spectrum.map(|spectrum| spectrum.short_cutoff),
            seed: spectrum.map(|_| setup.surface.seed()),
            load,
            tolerance: setup.stop.tolerance(),
            status: contact.status,
            setup: self.setup.clone(),
            version: VERSION.into(),
            observables: Observables::of(contact),
            seconds: contact.work.seconds,
        }
    }
}

//! Points, identified by their setup.

use super::followed_history::FollowedHistory;
use super::point::Point;
use super::realisation::Realisation;
use crate::contact::{Contact, Load, Observables, Observer};
use crate::digest::{fnv1a, version};
use crate::error::{SetupError, StudyError};
use crate::surface::RandomRoughness;

/// The identity of a realisation: tables recognise its points by its name, its setup, and the version of the program with the revision of its
/// numerics.
pub(super) struct Identity<'a> {
    realisation: &'a Realisation,
    /// Fingerprint of the setup; it includes the loads if these are not reduced pressures, since the points do not
    /// contain them.
    setup: String,
}

/// What the points of a realisation share: its name, the fingerprint of its setup, and the version with the revision of the numerics.
pub(super) type RowKey = [String; 3];

/// What the realisation of a point is known by.
pub(super) fn key_of(point: &Point) -> RowKey {
    [&point.name, &point.setup, &point.version].map(String::clone)
}

impl<'a> Identity<'a> {
    /// The identity of a realisation.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub(crate) fn new(realisation: &'a Realisation) -> Result<Self, StudyError> {
        let setup = realisation.setup.fingerprint()?;
        let is_reduced = !realisation.setup.is_history()?
            && realisation.loads.iter().all(|load| matches!(load, Load::ReducedPressure(_)));
        let with_loads =
            || format!("{:016x}", fnv1a([setup.as_bytes(), format!("{:?}", realisation.loads).as_bytes()]));
        Ok(Self { realisation, setup: if is_reduced { setup } else { with_loads() } })
    }

    /// What the realisation is known by.
    pub(crate) fn key(&self) -> RowKey {
        [self.realisation.name.clone(), self.setup.clone(), version()]
    }

    /// Whether a point with the key of the realisation is under one of its loads.
    pub(crate) fn includes(&self, point: &Point) -> bool {
        let mut loads = self.realisation.loads.iter().enumerate();
        loads.any(|(number, load)| is_under(point, number, load))
    }

    /// The points of the realisation among those with its key, if they are all there, one after the other.
    pub(crate) fn find(&self, points: &[&Point]) -> Option<Vec<Point>> {
        let loads = &self.realisation.loads;
        let is_it = |points: &&[&Point]| {
            points.iter().zip(loads).enumerate().all(|(i, (point, load))| is_under(point, i, load))
        };
        let found = points.windows(loads.len().max(1)).find(|points| !loads.is_empty() && is_it(points))?;
        Some(found.iter().copied().cloned().collect())
    }

    /// Solves the realisation, `watch`ed under each load, and returns its points, each of which is also shown. `locate` adds the number of the load
    /// that fails, from 0, to its error.
    ///
    /// # Errors
    /// The errors of [`Identity::press`], located.
    pub(crate) fn points<O: Observer>(
        &self,
        watch: impl FnMut(usize) -> O,
        mut show: impl FnMut(&Point),
        locate: impl FnOnce(usize, StudyError) -> StudyError,
    ) -> Result<Vec<Point>, StudyError> {
        let mut points = Vec::new();
        let pressed = self.press(watch, |point, _| {
            show(&point);
            points.push(point);
        });
        pressed.map_err(|error| locate(points.len(), error))?;
        Ok(points)
    }

    /// Solves the realisation, `watch`ed under each load, and shows each point with its contact.
    ///
    /// # Errors
    /// The errors of [`Realisation::press`].
    pub(crate) fn press<O: Observer>(
        &self,
        watch: impl FnMut(usize) -> O,
        mut each: impl FnMut(Point, &Contact),
    ) -> Result<(), StudyError> {
        if self.realisation.setup.is_history()? {
            return self.follow(watch, each);
        }
        let mut load = 0;
        self.realisation.press(watch, |contact| {
            load += 1;
            let found = self.realisation.setup.flow.measure(contact).map_err(SetupError::from)?;
            let own = contact.values().numbers().iter().filter(|(it, _)| it.row().is_known_by_process);
            let further = own.copied().chain(found.numbers).collect();
            each(Point { further, ..self.point(load, contact) }, contact);
            Ok::<(), StudyError>(())
        })
    }

    /// Follows the history of a realisation, and shows its point with the contact of the last state.
    fn follow<O: Observer>(
        &self,
        mut watch: impl FnMut(usize) -> O,
        mut each: impl FnMut(Point, &Contact),
    ) -> Result<(), StudyError> {
        let Some(&load) = self.realisation.loads.first() else { return Ok(()) };
        let found = FollowedHistory::follow(&self.realisation.under(load), &mut watch(0))?;
        let whole = self.point(1, &found.last);
        let point = Point {
            status: found.status,
            // with adhesion they say nothing of the way
            observables: match self.realisation.setup.adhesion {
                Some(_) => Observables::default(),
                None => whole.observables,
            },
            further: found.numbers,
            seconds: found.seconds,
            ..whole
        };
        each(point, &found.last);
        Ok(())
    }

    /// The point of a contact under the load of number `load`, from 1.
    fn point(&self, load: usize, contact: &Contact) -> Point {
        let Realisation { name, setup, .. } = self.realisation;
        let grid = contact.problem.surface().grid();
        let ([ny, nx], [_, length]) = (grid.shape(), grid.size());
        let roughness = &setup.surface.spectrum;
        let spectrum = roughness.as_ref().and_then(RandomRoughness::self_affine);
        Point {
            name: name.clone(),
            ny,
            nx,
            length,
            hurst: spectrum.map(|spectrum| spectrum.hurst),
            rolloff_wavelength: spectrum.and_then(|spectrum| spectrum.rolloff_wavelength()),
            short_cutoff: spectrum.map(|spectrum| spectrum.short_cutoff),
            seed: roughness.as_ref().map(|_| setup.surface.seed()),
            load,
            tolerance: setup.stop.tolerance(),
            status: contact.status,
            setup: self.setup.clone(),
            version: version(),
            observables: Observables::new(contact),
            further: Vec::new(),
            seconds: contact.work.seconds,
        }
    }
}

/// Whether a point has a load. If the point does not contain the value, the number of the load (from 0) decides.
fn is_under(point: &Point, number: usize, load: &Load) -> bool {
    match load {
        Load::ReducedPressure(value) if !point.is_history() => point.observables.reduced_pressure == *value,
        _ => point.load == number + 1,
    }
}

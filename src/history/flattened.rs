//! A surface that has yielded.

use crate::contact::{Contact, Problem};
use crate::error::HistoryError;
use crate::surface::Surface;
use std::sync::Arc;

/// A surface that has yielded under a load, below which it is elastic.
pub(super) struct Flattened {
    surface: Arc<Surface>,
    /// The highest mean pressure that it has carried.
    mean_pressure: f64,
}

impl Flattened {
    /// The surface after a contact, if some of its nodes yield.
    pub(crate) fn by(contact: &Contact) -> Option<Self> {
        let mean_pressure = contact.mean_pressure();
        let has_yielded = contact.plasticity().area > 0.0;
        let surface = has_yielded.then(|| contact.unloaded_surface().ok())??;
        Some(Self { surface: surface.into(), mean_pressure })
    }

    /// The problem of this surface instead of `problem` if its load is lower than a load that the surface has carried.
    ///
    /// # Errors
    /// [`HistoryError::Unload`] under a load that is no pressure.
    pub(crate) fn elastic(&self, problem: &Problem) -> Result<Option<Problem>, HistoryError> {
        let Some(mean_pressure) = problem.mean_pressure() else {
            return Err(HistoryError::Unload { load: problem.load().name() });
        };
        if mean_pressure > self.mean_pressure * (1.0 + 1e-12) {
            return Ok(None);
        }
        let elastic = problem.yielded(self.surface.clone(), mean_pressure);
        Ok(Some(elastic?))
    }
}

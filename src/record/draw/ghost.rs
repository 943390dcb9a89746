//! The curves of an earlier solve, in grey beside those of a later one.

use super::palette::{self, colour};
use super::traces::{CERTIFICATE, KAPPA_R, RELATIVE_AREA, Series};
use crate::contact::{Contact, Failure, Observer, Step, Wish};
use rerun::{RecordingStream, RecordingStreamResult, SeriesLines};
use std::ops::ControlFlow;

/// Entities under `ghost`, named as those under `trace`, and the names of their curves.
const SERIES: [(&str, &str); 3] = [KAPPA_R, RELATIVE_AREA, CERTIFICATE];

/// The curves of `kappa_r`, relative area and certificate of a solve, and of a line its final pressure, for later
/// recordings: see [`crate::record::Options`]. It observes the solve.
#[derive(Debug, Clone)]
pub struct Ghost {
    name: String,
    series: [Series; 3],
    /// Final pressure along a line.
    pressure: Option<Vec<f64>>,
}

impl Ghost {
    /// A ghost without steps. The `name` tells its curves from others.
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), series: Default::default(), pressure: None }
    }

    /// The final pressure along a line.
    pub fn pressure(&self) -> Option<&[f64]> {
        self.pressure.as_deref()
    }

    /// Records all curves under `root`, each value at its own step.
    pub fn log(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        for ((entity, name), series) in SERIES.into_iter().zip(&self.series) {
            let entity = entity_under(root, entity);
            let style = SeriesLines::new().with_names([format!("{}: {name}", self.name)]);
            to.log_static(entity.as_str(), &style.with_colors([colour(palette::GHOST)]).with_widths([1.8]))?;
            series.log(to, &entity.into())?;
        }
        Ok(())
    }
}

/// The entity of the ghost that belongs to that of the same name under `trace`.
pub fn entity_under(root: &str, name: &str) -> String {
    format!("{root}/ghost/{name}")
}

impl Observer for Ghost {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        let measures = step.measures();
        let certificate = step.certificate().map(f64::log10);
        let values = [Some(measures.kappa_r), Some(measures.relative_area), certificate];
        for (series, value) in self.series.iter_mut().zip(values) {
            series.add(step.work(), value);
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Adds the certificate of the final state and, of a line, its pressure.
    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.series[2].add(contact.work, Some(contact.certificate.eta.log10()));
        let is_line = contact.problem.surface().grid().is_line();
        self.pressure = is_line.then(|| contact.pressure.iter().copied().collect());
        Ok(())
    }
}

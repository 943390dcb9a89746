//! The curves of an earlier solve, in grey beside those of a later one.

use crate::contact::{Contact, Failure, Observer, Step, Wish};
use crate::record::draw::chart::observable_traces::{COMPARED, ObservableTraces, drawn, title, traced};
use crate::record::draw::ink::palette;
use rerun::{RecordingStream, RecordingStreamResult, SeriesLines};
use std::ops::ControlFlow;

/// The curves of `kappa_r`, relative area and certificate of a solve, and of a line its final pressure, for later
/// recordings: see [`crate::record::Options`]. It observes the solve.
#[derive(Debug, Clone)]
pub struct Ghost {
    name: String,
    traces: ObservableTraces,
    /// Final pressure along a line.
    pub(in crate::record) pressure: Option<Vec<f64>>,
}

impl Ghost {
    /// A ghost without steps. The `name` distinguishes its curves from others.
    pub fn new(name: &str) -> Self {
        let compared = traced().filter(|observable| COMPARED.contains(observable));
        Self { name: name.into(), traces: ObservableTraces::new(compared), pressure: None }
    }

    /// Records all curves under `root`, each value at its own step.
    pub(in crate::record) fn log(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        for &(observable, ref trace) in &self.traces.0 {
            let entity = entity_under(root, &drawn(observable));
            let style = SeriesLines::new().with_names([format!("{}: {}", self.name, title(observable))]);
            to.log_static(entity.as_str(), &style.with_colors([palette::colour(palette::GHOST)]).with_widths([1.8]))?;
            trace.drawn(observable).log(to, entity)?;
        }
        Ok(())
    }
}

/// The entity of the ghost that belongs to that of the same name under `trace`.
pub(crate) fn entity_under(root: &str, name: &str) -> String {
    format!("{root}/ghost/{name}")
}

impl Observer for Ghost {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        self.traces.add(step);
        Ok(ControlFlow::Continue(()))
    }

    /// Adds the numbers of the final state and, of a line, its pressure.
    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.traces.end(contact);
        let is_line = contact.problem.surface().grid().is_line();
        self.pressure = is_line.then(|| contact.pressure.iter().copied().collect());
        Ok(())
    }
}

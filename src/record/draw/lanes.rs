//! What a solver decided, as lanes of states over the steps.

use super::palette::{Palette, SERIES, colour};
use super::traces::times;
use crate::contact::{Contact, Decision, Step, Work};
use crate::diagnosis::Change;
use crate::plot::Colour;
use rerun::archetypes::{StateChange, StateConfiguration};
use rerun::{RecordingStream, RecordingStreamResult};

/// Names of the lanes, from above.
const LANES: [&str; 4] = ["1_grid", "2_step", "3_contact", "4_end"];
/// Nodes that enter and leave.
const CHANGES: [&str; 4] = ["same", "in", "out", "in and out"];

/// Lanes of the grid, the kind of step, the nodes that entered or left, and the end, under a root.
pub struct Lanes {
    pub root: String,
}

/// The states of the lanes, collected until they are flushed.
#[derive(Default)]
pub struct States {
    last: [String; LANES.len()],
    changes: [Vec<(Work, String)>; LANES.len()],
}

impl Lanes {
    /// Records the names and colours of the states.
    pub fn log_static(&self, to: &RecordingStream, palette: &Palette) -> RecordingStreamResult<()> {
        let kinds =
            Decision::NAMES.iter().enumerate().map(|(i, (name, label))| (*name, *label, SERIES[i % SERIES.len()]));
        self.log_states(to, LANES[1], kinds)?;
        let quiet = super::palette::FAINT;
        let colours = [quiet, palette.contact, SERIES[1], SERIES[0]];
        self.log_states(to, LANES[2], CHANGES.into_iter().zip(colours).map(|(name, colour)| (name, name, colour)))
    }

    fn log_states<'a>(
        &self,
        to: &RecordingStream,
        lane: &str,
        states: impl Iterator<Item = (&'a str, &'a str, Colour)> + Clone,
    ) -> RecordingStreamResult<()> {
        let configuration = StateConfiguration::new()
            .with_values(states.clone().map(|(name, ..)| name))
            .with_labels(states.clone().map(|(_, label, _)| label))
            .with_colors(states.map(|(.., rgb)| colour(rgb)));
        to.log_static(format!("{}/{lane}", self.root), &configuration)
    }

    /// Sends what changed so far.
    pub fn flush(&self, to: &RecordingStream, states: &mut States) -> RecordingStreamResult<()> {
        for (lane, changes) in LANES.iter().zip(&mut states.changes).filter(|(_, changes)| !changes.is_empty()) {
            let (work, names): (Vec<Work>, Vec<String>) = changes.drain(..).unzip();
            let states = StateChange::update_fields().with_state(names).columns_of_unit_batches()?;
            to.send_columns(format!("{}/{lane}", self.root), times(work.iter()), states)?;
        }
        Ok(())
    }
}

impl States {
    /// Adds a step on a grid of some points.
    pub fn add(&mut self, step: &Step<'_>, change: Change) {
        let [ny, nx] = step.problem().surface().grid().shape();
        let grid = if ny == 1 { nx.to_string() } else { format!("{ny} x {nx}") };
        self.enter(0, step.work(), &grid);
        self.enter(1, step.work(), step.decision().map_or("", Decision::name));
        if step.phase().inner == 0 {
            let kind = usize::from(change.entered > 0) + 2 * usize::from(change.left > 0);
            self.enter(2, step.work(), CHANGES[kind]);
        }
    }

    /// Adds the end of the run.
    pub fn end(&mut self, contact: &Contact) {
        self.enter(3, contact.work, &contact.status.to_string());
    }

    fn enter(&mut self, lane: usize, work: Work, state: &str) {
        if self.last[lane] != state {
            self.last[lane] = state.into();
            self.changes[lane].push((work, state.into()));
        }
    }
}

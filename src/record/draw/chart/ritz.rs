//! The extreme Ritz values of conjugate gradients, as curves.

use crate::contact::Work;
use crate::record::draw::chart::observable_traces::times;
use crate::record::draw::drawing::{Drawing, Place, RunDrawing, RunStep, Subject};
use crate::record::draw::ink::palette::{self, SERIES};
use crate::record::draw::ink::pane::{Pane, PaneView};
use rerun::{RecordingStream, RecordingStreamResult, Scalars, SeriesLines};

/// Names of the curves.
const NAMES: [&str; 2] = ["log10 smallest Ritz value", "log10 largest Ritz value"];

/// Both values of every step; one entity holds both.
struct RitzValues {
    entity: String,
}

/// The drawing of the Ritz values of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(RitzValues { entity: format!("{}/ritz", subject.root) }))
}

impl Drawing for RitzValues {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let pane = PaneView::falling("Ritz values of conjugate gradients", vec![self.entity.clone()]);
        vec![(Place::RunCurves, pane)]
    }

    fn fit(&mut self, _: &dyn Fn(&str) -> Option<[f64; 2]>) {}

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let colours = [SERIES[1], SERIES[0]].map(palette::colour);
        let style = SeriesLines::new().with_names(NAMES).with_colors(colours).with_widths([1.5, 1.5]);
        to.log_static(self.entity.as_str(), &style)
    }

    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        Some(Box::new(RitzValuesOfRun { entity: self.entity.clone(), values: Vec::new() }))
    }
}

/// The values of one run since they were sent last.
struct RitzValuesOfRun {
    entity: String,
    values: Vec<(Work, [f64; 2])>,
}

impl RunDrawing for RitzValuesOfRun {
    fn add(&mut self, step: &RunStep<'_, '_>) {
        let values = step.diagnosis.and_then(|diagnosis| diagnosis.ritz());
        self.values.extend(values.map(|values| (step.step.work(), values.map(f64::log10))));
    }

    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        if self.values.is_empty() {
            return Ok(());
        }
        let values = self.values.iter().flat_map(|(_, values)| *values);
        let columns = Scalars::new(values).columns(vec![NAMES.len(); self.values.len()])?;
        to.send_columns(self.entity.as_str(), times(&self.values), columns)?;
        self.values.clear();
        Ok(())
    }
}

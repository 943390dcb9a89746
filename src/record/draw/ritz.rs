//! The extreme Ritz values of conjugate gradients, as curves.

use super::palette::{self, SERIES};
use super::traces::times;
use crate::contact::Work;
use rerun::{RecordingStream, RecordingStreamResult, Scalars, SeriesLines};

/// Names of the curves.
const NAMES: [&str; 2] = ["log10 smallest Ritz value", "log10 largest Ritz value"];

/// Both values of every step, collected until they are flushed; one entity holds both.
pub struct RitzCurves {
    pub entity: String,
    values: Vec<(Work, [f64; 2])>,
}

impl RitzCurves {
    pub fn new(entity: String) -> Self {
        Self { entity, values: Vec::new() }
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let colours = [SERIES[1], SERIES[0]].map(palette::colour);
        let style = SeriesLines::new().with_names(NAMES).with_colors(colours).with_widths([1.5, 1.5]);
        to.log_static(self.entity.as_str(), &style)
    }

    pub fn add(&mut self, work: Work, values: [f64; 2]) {
        self.values.push((work, values.map(f64::log10)));
    }

    pub fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
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

//! Curves over the loads.

use crate::plot::Colour;
use crate::record::draw::ink::legible;
use crate::record::draw::ink::palette;
use crate::record::units::{value_with_unit, with_unit};
use rerun::{RecordingStream, RecordingStreamResult, Scalars, SeriesLines, SeriesPoints};

/// A curve over the loads.
#[derive(Debug, Clone)]
pub struct RecordedCurve {
    /// Title of the view that the curve shares with others.
    pub view: String,
    /// Name in the legend.
    pub name: String,
    /// The unit of its values, such as `Pa`; empty if there is none.
    pub unit: String,
    /// Red, green and blue, as on paper: on other grounds it is drawn as pale or dark as it must be to be seen.
    pub colour: [u8; 3],
    /// What it shows.
    pub kind: CurveKind,
}

/// What a curve shows, which decides how it looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveKind {
    /// Results of solves: a line with dots.
    Computed,
    /// A theory that leaves something out: a fine line.
    Theory,
    /// An exact solution: dashes over everything else, in the colour of exact values instead of its own.
    Exact,
}

/// The curves of a recording.
pub(crate) struct Curves {
    all: Vec<RecordedCurve>,
    /// The numbers of those that are shown, in their order.
    shown: Vec<usize>,
}

impl Curves {
    /// Curves of which all are shown.
    pub(crate) fn new(all: Vec<RecordedCurve>) -> Self {
        Self { shown: (0..all.len()).collect(), all }
    }

    /// Adds a curve, which is shown behind the others, and gives its number.
    pub(crate) fn push(&mut self, curve: RecordedCurve) -> usize {
        self.all.push(curve);
        self.shown.push(self.all.len() - 1);
        self.all.len() - 1
    }

    /// Shows some curves and no others, in this order.
    pub(crate) fn show(&mut self, shown: &[usize]) {
        self.shown = shown.to_vec();
    }

    /// Titles of the views and the entities in each, in the order in which they come first.
    pub(crate) fn views(&self) -> Vec<(&str, Vec<String>)> {
        let mut views: Vec<(&str, Vec<String>)> = Vec::new();
        for (i, curve) in self.shown.iter().filter_map(|i| Some((*i, self.all.get(*i)?))) {
            match views.iter_mut().find(|(title, _)| *title == curve.view) {
                Some((_, entities)) => entities.push(entity(i)),
                None => views.push((&curve.view, vec![entity(i)])),
            }
        }
        views
    }

    /// Records names and colours.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        for (i, RecordedCurve { name, colour, unit, .. }) in self.all.iter().enumerate() {
            let name = &with_unit(name, unit);
            let (name, colour) = (name.as_str(), palette::colour(legible(Colour(*colour))));
            let line = SeriesLines::new().with_names([name]).with_colors([colour]).with_widths([1.8]);
            let points = SeriesPoints::new().with_names([name]).with_colors([colour]).with_marker_sizes([3.0]);
            to.log_static(entity(i), &[&line as &dyn rerun::AsComponents, &points])?;
        }
        Ok(())
    }

    /// Records values at the current time.
    pub(crate) fn log(&self, to: &RecordingStream, values: &[f64]) -> RecordingStreamResult<()> {
        let mut finite = values.iter().take(self.all.len()).enumerate().filter(|(_, value)| value.is_finite());
        finite.try_for_each(|(i, &value)| to.log(entity(i), &Scalars::single(value)))
    }

    /// The values with their names, in Markdown.
    pub(crate) fn table(&self, values: &[f64]) -> String {
        let finite = self.all.iter().zip(values).filter(|(_, value)| value.is_finite());
        let written = |curve: &RecordedCurve, value: f64| match curve.unit.as_str() {
            "" => number(value),
            unit => value_with_unit(value, unit),
        };
        let rows: String =
            finite.map(|(curve, value)| format!("| {} | {} |\n", curve.name, written(curve, *value))).collect();
        if rows.is_empty() { rows } else { format!("| curve | value |\n|---|---|\n{rows}") }
    }
}

fn entity(i: usize) -> String {
    format!("/curve/{i}")
}

/// A number of five digits, in powers of ten where it is far from 1.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) { format!("{value:.4}") } else { format!("{value:.4e}") }
}

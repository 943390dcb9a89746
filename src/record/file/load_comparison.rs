//! Curves of several recordings over the quantity of their loads or states.

use crate::plot::AxisScale;
use crate::record::draw::{Chart, CurveKind, LoadAxis, Palette, RecordedCurve, SERIES};
use crate::record::playback::Playback;
use crate::record::units::split_unit;
use crate::setup::Theme;
use rerun::{RecordingStream, RecordingStreamResult};

/// Ratio of the largest value to the smallest positive one from which on the axis of values is logarithmic.
const WIDE: f64 = 12.0;

/// The curves of some runs over the quantity that all of them have along their loads or states: a chart for each name, on which each run has a curve over its
/// own values.
pub(crate) struct LoadComparison {
    pub charts: Vec<Chart>,
    /// The values of all curves, for each load of each run, one run after the other.
    values: Vec<Vec<f64>>,
}

impl LoadComparison {
    /// The comparison of runs with their names, in curves that are named; none if they have different quantities along their loads or states.
    pub(crate) fn new(runs: &[(&Playback, &str)], names: &[String]) -> Option<Self> {
        let axes: Vec<_> = runs.iter().map(|(playback, _)| playback.axis()).collect::<Option<_>>()?;
        let (quantity, _) = axes.first()?;
        if axes.iter().any(|(other, _)| other != quantity) {
            return None;
        }
        let mut curves = Vec::new();
        let mut values = Vec::new();
        for (place, ((playback, run), (_, along))) in runs.iter().zip(&axes).enumerate() {
            let of_names: Vec<_> = names.iter().map(|name| playback.curve_values(name)).collect();
            curves.extend(names.iter().map(|name| curve(name, run, place)));
            let before = place * names.len();
            let all = runs.len() * names.len();
            values.extend(along.keys().map(|load| {
                let mut row = vec![f64::NAN; all];
                for (number, of_name) in of_names.iter().enumerate() {
                    row[before + number] = of_name.get(load).copied().unwrap_or(f64::NAN);
                }
                row
            }));
        }
        let along = axes.iter().flat_map(|(_, along)| along.values().copied()).collect();
        let charts = Chart::all(&curves, &axis(quantity, along), Palette::new(Theme::Dark));
        Some(Self { charts, values })
    }

    /// Records the charts.
    pub(crate) fn log(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { charts, values } = self;
        charts.iter_mut().try_for_each(|chart| chart.log_all(to, values))
    }
}

/// The curve of a run under the name of a chart.
fn curve(name: &str, run: &str, place: usize) -> RecordedCurve {
    let (title, unit) = split_unit(name);
    let colour = SERIES[place % SERIES.len()].0;
    RecordedCurve { view: title.into(), name: run.into(), unit: unit.into(), colour, kind: CurveKind::Computed }
}

/// The axis of values of a quantity, whose name may have a unit.
fn axis(quantity: &str, values: Vec<f64>) -> LoadAxis {
    let (name, unit) = split_unit(quantity);
    let [low, high] = values.iter().fold([f64::INFINITY, 0.0], |[low, high], &value| [value.min(low), value.max(high)]);
    let scale = if low > 0.0 && high > WIDE * low { AxisScale::Log } else { AxisScale::Linear };
    LoadAxis { scale, ..LoadAxis::linear(name, values).with_unit(unit) }
}

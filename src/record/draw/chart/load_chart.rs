//! Charts: curves over the loads, on axes of their own.

use crate::plot::{Align, AxesFrame, Axis, Colour, Sheet, width};
use crate::record::draw::chart::curves::{CurveKind, RecordedCurve};
use crate::record::draw::chart::load_axis::LoadAxis;
use crate::record::draw::fields::range;
use crate::record::draw::ink::canvas::{self, PANE, strips};
use crate::record::draw::ink::palette::{Palette, colour};
use crate::record::units::{FittingUnit, with_unit};
use rerun::{LineStrips2D, Points2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};
use std::collections::BTreeMap;
use std::ops::RangeBounds;

/// What sets the time of a stream to that of a load or a state.
pub(crate) type TurnTo<'t> = dyn Fn(&RecordingStream, usize) + 't;

/// Timeline of loads.
pub(crate) const LOAD: &str = "load";

/// From the box to the legend, the length of a line in it, and the room before a name, over the size of words.
const LEGEND: [f64; 3] = [1.0, 1.6, 0.5];
/// Largest distance of the entries of the legend, divided by the size of the text.
const ENTRY: f64 = 1.6;
/// Largest share of the width of its pane that the legend takes; longer names are drawn smaller.
const MOST_LEGEND: f64 = 0.4;

/// Radii of the dot of a load, and of the marker at the current one.
const DOT: f32 = 2.0;
const MARKER: f32 = 4.5;
/// Ratio of the largest value to the smallest from which on the axis is logarithmic.
const WIDE: f64 = 12.0;
/// Share of the largest value below which the smallest one has zero beside it on the axis.
const NEAR_ZERO: f64 = 0.5;
/// A curve whose values differ by less than this part of the largest one does not change: solvers leave differences of 1e-8, their tolerance.
const LEAST_RELATIVE_CHANGE: f64 = 1e-7;
/// Share of a value that an axis around it alone reaches to either side.
const ALONE: f64 = 0.1;

/// Curves of one view, drawn up to the current load, where they have a marker.
///
/// Axes grow with what they show: then what was drawn is stretched to them, for all times. Each load would otherwise be drawn again whenever one more comes.
pub(crate) struct Chart {
    name: String,
    pub root: String,
    pub palette: &'static Palette,
    /// Curves and their numbers among all curves.
    curves: Vec<(usize, RecordedCurve)>,
    loads: LoadAxis,
    /// Room for the legend, over the size of words.
    aside: f64,
    frame: AxesFrame,
    /// The axes that curves are drawn on, before they are stretched; none before the first load.
    drawn: Option<DrawnAxes>,
    /// Values of all curves of the recording by their loads.
    values: BTreeMap<usize, Vec<f64>>,
    /// The first of the last loads that are not drawn yet, as their values are those of the loads before.
    behind: Option<usize>,
}

/// A frame, and the values at the number 1 of both of its axes.
#[derive(Clone)]
struct DrawnAxes {
    frame: AxesFrame,
    sizes: [f64; 2],
}

impl DrawnAxes {
    /// Where two values lie on the canvas.
    fn position(&self, values: [f64; 2]) -> Option<[f64; 2]> {
        let places = self.frame.places(values[0] / self.sizes[0], values[1] / self.sizes[1]);
        places.iter().all(|place| place.is_finite()).then(|| self.frame.position(places))
    }

    /// The scale and the shift, along x and y, that carry curves drawn on these axes to the same curves on other axes; none where one axis is linear and
    /// the other one logarithmic.
    fn stretched_to(&self, other: &Self) -> Option<[[f64; 2]; 2]> {
        let axes = [&self.frame.x, &self.frame.y];
        if axes.map(|axis| axis.scale) != [other.frame.x.scale, other.frame.y.scale] {
            return None;
        }
        let end = |end: usize| [0, 1].map(|i| axes[i].range[end] * self.sizes[i]);
        let [low, high] = [0, 1].map(|i| Some([self.position(end(i))?, other.position(end(i))?]));
        let ([low, low_onto], [high, high_onto]) = (low?, high?);
        let scale = [0, 1].map(|i| (high_onto[i] - low_onto[i]) / (high[i] - low[i]));
        let shift = [0, 1].map(|i| low_onto[i] - scale[i] * low[i]);
        Some([scale, shift])
    }
}

impl Chart {
    /// A chart for each view of `curves`, in the order in which they come first.
    pub(crate) fn all(curves: &[RecordedCurve], loads: &LoadAxis, palette: &'static Palette) -> Vec<Self> {
        let mut charts: Vec<Self> = Vec::new();
        for (number, curve) in curves.iter().enumerate() {
            match charts.iter_mut().find(|chart| chart.name == curve.view) {
                Some(chart) => chart.curves.push((number, curve.clone())),
                None => charts.push(Self::new(charts.len(), (number, curve.clone()), loads, palette)),
            }
        }
        charts.iter_mut().for_each(|chart| chart.fit(PANE));
        charts
    }

    /// Chart number `place` of a recording, with a curve and its number among all curves.
    pub(crate) fn new(
        place: usize,
        curve: (usize, RecordedCurve),
        loads: &LoadAxis,
        palette: &'static Palette,
    ) -> Self {
        let name = curve.1.view.clone();
        let mut chart = Self {
            root: format!("/chart/{place}"),
            palette,
            curves: vec![curve],
            loads: loads.clone(),
            aside: 0.0,
            frame: canvas::frame(PANE, [loads.whole(), around(&name, [])], 0.0),
            drawn: None,
            values: BTreeMap::new(),
            behind: None,
            name,
        };
        chart.fit(PANE);
        chart
    }

    /// Takes the value of a load along the axis, where it was not known before.
    pub(crate) fn place(&mut self, load: usize, value: f64) {
        self.loads.place(load, value);
    }

    /// The place of its first curve among some curves, by their numbers.
    pub(crate) fn place_among(&self, shown: &[usize]) -> Option<usize> {
        shown.iter().position(|number| self.curves.iter().any(|(own, _)| own == number))
    }

    /// Gives it the proportions of a pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        let longest = self.curves.iter().map(|(_, curve)| width(&curve.name, 1.0)).fold(0.0, f64::max);
        self.aside = (LEGEND.iter().sum::<f64>() + longest).min(MOST_LEGEND * pane[0] / canvas::TEXT);
        canvas::fit(&mut self.frame, pane, self.aside);
    }

    /// What is drawn against what.
    pub(crate) fn title(&self) -> String {
        format!("{} against {}", self.name, self.loads.title())
    }

    pub(crate) fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame, self.aside)
    }

    /// Records axes and legend.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame)?;
        let AxesFrame { size: [right, height], text, .. } = self.frame;
        let pitch = (ENTRY * text).min(height / self.curves.len() as f64);
        let [gap, sample, before] = LEGEND.map(|length| length * text);
        let room = self.aside * text - gap - sample - before;
        let mut words = Sheet::default();
        let mut samples = Vec::new();
        for (i, (_, curve)) in self.curves.iter().enumerate() {
            let (left, y) = (right + gap, pitch * (i as f64 + 0.5));
            let sample_ends = [left, left + sample].map(|x| [x as f32, y as f32]);
            samples.push((sample_ends.to_vec(), colour(self.colour(curve)), Radius::new_ui_points(2.0)));
            let size = text * (room / width(&curve.name, text)).min(1.0);
            words.words(&curve.name, [left + sample + before, y], size, Align::Left);
        }
        to.log_static(format!("{}/legend/lines", self.root), &strips(samples))?;
        to.log_static(format!("{}/legend/words", self.root), &canvas::written(self.palette, &words))
    }

    /// Adds the values of all curves of the recording under a load, and draws them at that load and at heavier ones, at the times to which
    /// `turn` goes.
    pub(crate) fn add(
        &mut self,
        to: &RecordingStream,
        turn: &TurnTo<'_>,
        load: usize,
        values: &[f64],
    ) -> RecordingStreamResult<()> {
        self.values.insert(load, values.to_vec());
        // a curve that does not change may never be shown
        if !self.changes() {
            self.behind = Some(self.behind.map_or(load, |behind| behind.min(load)));
            return Ok(());
        }
        let axes = [self.loads.whole(), self.fitted()];
        if self.drawn.is_none() || axes[0] != self.frame.x || axes[1] != self.frame.y {
            [self.frame.x, self.frame.y] = axes;
            if self.stretch(to, turn)? {
                return Ok(());
            }
        }
        let first = self.behind.take().map_or(load, |behind| behind.min(load));
        self.values.range(first..).try_for_each(|(&load, _)| self.draw(to, turn, load))
    }

    /// The axes of its frame.
    fn axes(&self) -> DrawnAxes {
        DrawnAxes { frame: self.frame.clone(), sizes: [self.loads.size(), self.unit().size] }
    }

    /// Stretches what was drawn to the axes of the frame. Where a scale has become another one, all loads are drawn again, and it returns that.
    fn stretch(&mut self, to: &RecordingStream, turn: &TurnTo<'_>) -> RecordingStreamResult<bool> {
        self.log_static(to)?;
        let axes = self.axes();
        let stretched = self.drawn.as_ref().and_then(|drawn| drawn.stretched_to(&axes));
        let [scale, shift] = stretched.unwrap_or([[1.0; 2], [0.0; 2]]).map(|both| both.map(|it| it as f32));
        let transform = Transform3D::from_translation([shift[0], shift[1], 0.0]).with_scale([scale[0], scale[1], 1.0]);
        let drawn = ["lines", "dots"].into_iter().chain(self.has_exact().then_some("exact"));
        for drawn in drawn {
            to.log_static(format!("{}/{drawn}", self.root), &transform)?;
        }
        if stretched.is_some() {
            return Ok(false);
        }
        (self.drawn, self.behind) = (Some(axes), None);
        self.values.keys().try_for_each(|&load| self.draw(to, turn, load))?;
        Ok(true)
    }

    /// Whether a layout shows the chart: it has a curve that changes, or one with the value of a single load.
    pub(crate) fn is_shown(&self) -> bool {
        self.changes() || self.curves.iter().any(|(number, _)| self.known(*number).count() == 1)
    }

    /// Whether one of its curves changes from load to load.
    fn changes(&self) -> bool {
        self.curves.iter().any(|(number, _)| {
            let [low, high] = range(self.known(*number));
            high - low > LEAST_RELATIVE_CHANGE * low.abs().max(high.abs())
        })
    }

    /// Fits the axis of the loads to those that came, before it is drawn again.
    pub(crate) fn settle_loads(&mut self) {
        self.loads = self.loads.settled();
        self.frame.x = self.loads.over(self.values.keys().copied());
    }

    /// Draws it on axes that fit the loads that came.
    pub(crate) fn settle(&mut self, to: &RecordingStream, turn: &TurnTo<'_>) -> RecordingStreamResult<()> {
        self.settle_loads();
        self.frame.y = self.fitted();
        self.stretch(to, turn)?;
        let behind = self.behind.take().unwrap_or(usize::MAX);
        self.values.range(behind..).try_for_each(|(&load, _)| self.draw(to, turn, load))
    }

    /// Draws the values of all curves of the recording under all loads at once, for all times.
    pub(crate) fn log_all(&mut self, to: &RecordingStream, values: &[Vec<f64>]) -> RecordingStreamResult<()> {
        self.values = values.iter().cloned().enumerate().collect();
        self.frame.x = self.loads.whole();
        self.frame.y = self.fitted();
        self.drawn = Some(self.axes());
        self.log_static(to)?;
        to.log_static(format!("{}/lines", self.root), &self.lines(values.len()))?;
        to.log_static(format!("{}/dots", self.root), &self.dots(values.len()))
    }

    /// Draws curves up to a load at the time of that load.
    fn draw(&self, to: &RecordingStream, turn: &TurnTo<'_>, load: usize) -> RecordingStreamResult<()> {
        turn(to, load);
        to.log(format!("{}/lines", self.root), &self.lines(load))?;
        to.log(format!("{}/dots", self.root), &self.dots(load))?;
        if self.has_exact() { to.log(format!("{}/exact", self.root), &self.dashes(load)) } else { Ok(()) }
    }

    /// Whether one of its curves is an exact solution.
    fn has_exact(&self) -> bool {
        self.curves.iter().any(|(_, curve)| curve.kind == CurveKind::Exact)
    }

    /// All curves but exact ones.
    fn lines(&self, load: usize) -> LineStrips2D {
        let curves = self.curves.iter().filter(|(_, curve)| curve.kind != CurveKind::Exact);
        let line = |(number, curve): &(usize, RecordedCurve)| {
            let points = self.points(*number, ..=load).map(|(_, point)| point.map(|p| p as f32)).collect();
            let width = if curve.kind == CurveKind::Computed { 1.3 } else { 0.9 };
            (points, colour(self.colour(curve)), Radius::new_ui_points(width))
        };
        strips(curves.map(line)).with_draw_order(30.0)
    }

    fn dashes(&self, load: usize) -> LineStrips2D {
        let curves = self.curves.iter().filter(|(_, curve)| curve.kind == CurveKind::Exact);
        let dashes = curves.flat_map(|(number, _)| {
            canvas::dashed(&self.points(*number, ..=load).map(|(_, point)| point).collect::<Vec<_>>())
        });
        LineStrips2D::new(dashes)
            .with_colors([colour(self.palette.exact)])
            .with_radii([Radius::new_ui_points(1.0)])
            .with_draw_order(38.0)
    }

    /// Dots of what is computed, and a marker on every curve at the load itself.
    fn dots(&self, load: usize) -> Points2D {
        let dots = self.curves.iter().flat_map(|(number, curve)| {
            let first = if curve.kind == CurveKind::Computed { 0 } else { load };
            let radius = move |at: usize| Radius::new_ui_points(if at == load { MARKER } else { DOT });
            let colour = colour(self.colour(curve));
            self.points(*number, first..=load).map(move |(at, point)| (point.map(|p| p as f32), (colour, radius(at))))
        });
        let (points, styles): (Vec<_>, Vec<_>) = dots.unzip();
        let (colours, radii): (Vec<_>, Vec<_>) = styles.into_iter().unzip();
        Points2D::new(points).with_colors(colours).with_radii(radii).with_draw_order(36.0)
    }

    /// The axis around all values.
    fn fitted(&self) -> Axis {
        let FittingUnit { name, size } = self.unit();
        around(&with_unit(&self.name, &name), self.all_known().map(|value| value / size))
    }

    /// The unit that fits all values.
    fn unit(&self) -> FittingUnit {
        let unit = self.curves.first().map_or("", |(_, curve)| &curve.unit);
        FittingUnit::new(unit, self.all_known().map(f64::abs).fold(0.0, f64::max))
    }

    /// Finite values of all curves.
    fn all_known(&self) -> impl Iterator<Item = f64> {
        self.curves.iter().flat_map(|(number, _)| self.known(*number))
    }

    /// Finite values of a curve.
    fn known(&self, number: usize) -> impl Iterator<Item = f64> {
        self.values.values().filter_map(move |values| values.get(number).copied()).filter(|value| value.is_finite())
    }

    /// Where a curve lies under some loads, with these.
    fn points(&self, number: usize, loads: impl RangeBounds<usize>) -> impl Iterator<Item = (usize, [f64; 2])> {
        self.values.range(loads).filter_map(move |(&load, values)| {
            let position = self.drawn.as_ref()?.position([*self.loads.values.get(load)?, *values.get(number)?])?;
            Some((load, position))
        })
    }

    fn colour(&self, curve: &RecordedCurve) -> Colour {
        match curve.kind {
            CurveKind::Exact => self.palette.exact,
            CurveKind::Computed | CurveKind::Theory => self.palette.on_ground(Colour(curve.colour)),
        }
    }
}

/// An axis around values: over whole decades if they are positive and far apart, else over whole steps between ticks.
fn around(name: &str, values: impl IntoIterator<Item = f64>) -> Axis {
    let [low, high] = range(values);
    if low > high {
        return Axis::linear(name, [0.0, 1.0]);
    }
    if low > 0.0 && high > WIDE * low {
        return Axis::log(name, [low.log10().floor(), high.log10().ceil()].map(|decade| 10f64.powf(decade)));
    }
    let low = if low > 0.0 && low < NEAR_ZERO * high { 0.0 } else { low };
    let room = if high > low { 0.0 } else { (ALONE * high.abs()).max(f64::MIN_POSITIVE) };
    let [low, high] = [low - room, high + room];
    match Axis::linear(name, [low, high]).ticks().as_slice() {
        [(first, _), (second, _), ..] => {
            let step = second - first;
            Axis::linear(name, [(low / step).floor() * step, (high / step).ceil() * step])
        }
        _ => Axis::linear(name, [low, high]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve that was drawn on other axes lies, once it is stretched, where it would be drawn on the new ones.
    #[test]
    fn a_stretched_curve_lies_on_its_new_axes() {
        let axes = |x: Axis, y: Axis, sizes| DrawnAxes { frame: canvas::frame(PANE, [x, y], 0.0), sizes };
        let drawn = axes(Axis::log("t", [1.0, 10.0]), Axis::linear("y", [-1.0, 2.0]), [1.0, 1e-3]);
        let onto = axes(Axis::log("t", [1e-2, 1e3]), Axis::linear("y", [-5.0, 40.0]), [10.0, 1e-6]);
        let [scale, shift] = drawn.stretched_to(&onto).unwrap();
        for values in [[1.0, 0.0], [2.5, 1.9e-3], [300.0, -7e-3]] {
            let [before, after] = [&drawn, &onto].map(|axes| axes.position(values).unwrap());
            assert!(
                (0..2).all(|i| (scale[i] * before[i] + shift[i] - after[i]).abs() < 1e-6 * after[i].abs().max(1.0))
            );
        }
        assert!(drawn.stretched_to(&axes(drawn.frame.x.clone(), Axis::log("y", [1.0, 2.0]), [1.0; 2])).is_none());
    }

    #[test]
    fn axes_reach_around_values_over_whole_steps_or_decades() {
        let ranges = [
            (vec![], [0.0, 1.0]),
            (vec![1.42, 1.71], [1.4, 1.75]),
            (vec![0.2, 1.7], [0.0, 2.0]),
            (vec![3e-4, 0.9], [1e-4, 1.0]),
            (vec![1.1, 84.0], [1.0, 100.0]),
            (vec![1.47, 38.0], [1.0, 100.0]),
            (vec![-3.2, -0.4], [-3.5, 0.0]),
        ];
        for (values, expected) in ranges {
            let found = around("y", values.clone()).range;
            assert!((0..2).all(|end| (found[end] - expected[end]).abs() < 1e-9), "{values:?}: {found:?}");
        }
        let [low, high] = around("y", [2.0]).range;
        assert!(low < 2.0 && 2.0 < high);
        let [low, high] = around("y", [0.0]).range;
        assert!(low <= 0.0 && 0.0 < high);
    }
}

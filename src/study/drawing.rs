//! The figure of a study: area and `kappa_r` against the load, for each combination of values.

use super::means::{LoadMeans, SeedMean};
use super::plan::Plan;
use super::point::Point;
use crate::contact::Load;
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol, label, unit};
use crate::quantity::{LENGTHS, PRESSURES};

/// Largest number of curves; more cannot be distinguished.
pub(super) const MOST: usize = 12;

/// The colour and the symbol of a curve: neighbours differ in both, and of [`MOST`] curves no two have both in common.
pub(super) fn look(curve: usize) -> (Colour, Mark) {
    (Colour::of_curve(curve), Mark::Joined { symbol: Symbol::of_curve(curve), filled: true })
}

impl Plan {
    /// The figure of all `points` of the study: area and `kappa_r` against the load as it was prescribed, with one curve for
    /// each combination of values. The mean is over the seeds, and bars show the standard deviation of single
    /// realisations plus the error of the grid. Points that did not converge or are not resolved are left out. At most twelve curves are drawn.
    ///
    /// With adhesion it is the pull-off pressure and the energy lost in jumps, against the last list of numbers. Of solids that yield below their surface it
    /// is the depth of the imprint and the plastic work, which a body keeps that is unloaded in the end.
    pub fn figure(&self, title: &str, points: &[Point]) -> Figure {
        if self.has_adhesion() || self.yields() {
            return self.history_figure(title, points);
        }
        let all = self.means(points);
        let curves: Vec<&[LoadMeans]> = all.chunks(self.loads().len()).take(MOST).collect();
        let loads = LoadPlaces::new(self.loads(), self.units());
        let area = panel(
            "relative contact area",
            (&curves, &loads),
            |it| it.relative_area,
            |[low, high]| Axis::log("aᵣₑₗ", [low / 1.2, high * 1.2]),
        );
        let kappa_r = panel(
            "area per load, with the rms gradient in contact",
            (&curves, &loads),
            |it| it.kappa_r,
            |[low, high]| {
                let margin = (0.06 * (high - low)).max(0.02 * high);
                Axis::linear("κᵣ", [low - margin, high + margin])
            },
        );
        // the legend of the first panel is that of both
        let mut kappa_r = kappa_r;
        kappa_r.series.iter_mut().for_each(|series| series.name.clear());
        let title = format!("{title}: means, with bars of standard deviation plus error of the grid");
        Figure { title, panels: vec![area, kappa_r] }
    }
}

/// The load along the x axis, as it was prescribed: its name, and its value under the load of a number from 0.
struct LoadPlaces {
    name: String,
    /// The loads, if they are no reduced pressures.
    values: Option<Vec<f64>>,
}

impl LoadPlaces {
    fn new(loads: &[Load], [in_metres, in_pascals]: [bool; 2]) -> Self {
        let largest = loads.iter().map(Load::value).fold(0.0, f64::max);
        let (kind, (unit, size)) = match loads.first() {
            None | Some(Load::ReducedPressure(_)) => return Self { name: "p*".into(), values: None },
            Some(kind @ Load::MeanPressure(_)) => (kind, unit(in_pascals, &PRESSURES, largest)),
            Some(kind @ (Load::MeanGap(_) | Load::Approach(_))) => (kind, unit(in_metres, &LENGTHS, largest)),
            Some(kind @ Load::Force(_)) => (kind, ("", 1.0)),
        };
        let values = loads.iter().map(|load| load.value() / size).collect();
        Self { name: label(kind.name(), unit), values: Some(values) }
    }

    fn place(&self, means: &LoadMeans) -> f64 {
        self.values.as_ref().map_or(means.reduced_pressure, |values| values[means.load_number - 1])
    }
}

/// A panel of the means of a quantity, with a curve for each combination of values. All error bars are within its axes; one that reaches to 0 on a
/// logarithmic axis is cut.
fn panel(
    title: &str,
    (curves, loads): (&[&[LoadMeans]], &LoadPlaces),
    of: fn(&LoadMeans) -> SeedMean,
    axis: impl FnOnce([f64; 2]) -> Axis,
) -> Panel {
    let means = || curves.iter().copied().flatten();
    let places = ends(means().map(|it| loads.place(it)));
    let x = Axis::log(loads.name.clone(), [places[0] / 1.3, places[1] * 1.3]);
    let bars = means().map(of).flat_map(|it| [it.mean - it.bar(), it.mean, it.mean + it.bar()]);
    let mut panel = Panel::new(title, x, axis(ends(bars)));
    for (i, curve) in curves.iter().enumerate() {
        let dot = |it: &LoadMeans| Dot { x: loads.place(it), y: of(it).mean, spread: of(it).bar() };
        let label = curve.first().map_or("", |it| &it.values);
        let dots = curve.iter().filter(|it| of(it).count > 0).map(dot);
        let (colour, mark) = look(i);
        panel.add(label, colour, mark, dots);
    }
    panel
}

/// The smallest and the largest of the positive, finite values; 1 if there are none.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = values.filter(|value| value.is_finite() && *value > 0.0);
    let [low, high] = ends.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(value), high.max(value)]);
    if low <= high { [low, high] } else { [1.0, 1.0] }
}

//! The figure of a study of histories: what they end with, against what is varied.

use super::drawing::{MOST, look};
use super::plan::Plan;
use super::point::Point;
use super::spread::Spread;
use crate::contact::Quantity;
use crate::plot::{Axis, Dot, Figure, Panel};
use crate::setup::Scalar;
use std::collections::BTreeMap;

/// What a panel shows: its title, the symbol of its axis, and the number that is drawn.
type HistoryPlot = (&'static str, &'static str, fn(&Point) -> Option<f64>);

/// Panels of histories with adhesion: what holds the surfaces together.
const OF_ADHESION: [HistoryPlot; 2] = [
    ("pull-off pressure", "-min <p>", |it| it.pull_off().filter(|_| it.is_converged())),
    ("energy lost in jumps, per area", "Δ", |it| it.lost().filter(|_| it.is_converged())),
];

/// Panels of solids that yield below their surface: what they keep when they are unloaded.
const OF_YIELDING: [HistoryPlot; 2] = [
    ("depth of the imprint", "max u - min u", |it| it.get(Quantity::ImprintDepth).filter(|_| it.is_converged())),
    ("plastic work, per area", "W", |it| it.get(Quantity::PlasticWork).filter(|_| it.is_converged())),
];

/// The curves of a panel, by the other values: places along `x`, and what was found there.
type HistoryCurves<'a> = BTreeMap<usize, (String, Vec<(f64, &'a [Point])>)>;

impl Plan {
    /// The figure of all `points` of a study of histories with adhesion, or on a solid that yields below its surface: two numbers of their ends against the
    /// last list of numbers, with one curve for each combination of the other values. The mean is over the seeds, and bars show the standard deviation of
    /// single realisations.
    pub(super) fn history_figure(&self, title: &str, points: &[Point]) -> Figure {
        let plots = if self.has_adhesion() { &OF_ADHESION } else { &OF_YIELDING };
        let (name, curves) = self.history_curves(points);
        let places = ends(curves.values().flat_map(|(_, dots)| dots.iter().map(|dot| dot.0)));
        let panel = |&(title, symbol, of): &HistoryPlot| {
            let series: Vec<(String, Vec<Dot>)> = curves
                .values()
                .map(|(label, dots)| {
                    let dot = |&(x, points): &(f64, &[Point])| {
                        let spread = Spread::from_values(points.iter().filter_map(of));
                        (spread.count > 0).then_some(Dot { x, y: spread.mean, spread: spread.deviation })
                    };
                    (label.clone(), dots.iter().filter_map(dot).collect())
                })
                .collect();
            let [_, top] = ends(series.iter().flat_map(|(_, dots)| dots.iter().map(|dot| dot.y + dot.spread)));
            let top = if top > 0.0 { 1.08 * top } else { 1.0 };
            let margin = (0.05 * (places[1] - places[0])).max(1e-3 * places[1].abs()).max(f64::MIN_POSITIVE);
            let x = Axis::linear(name.clone(), [places[0] - margin, places[1] + margin]);
            let mut panel = Panel::new(title, x, Axis::linear(symbol, [0.0, top]));
            for (i, (label, dots)) in series.into_iter().enumerate() {
                let (colour, mark) = look(i);
                panel.add(label, colour, mark, dots);
            }
            panel
        };
        let is_known = |(_, _, of): &&HistoryPlot| points.iter().any(|point| of(point).is_some());
        let title = format!("{title}: means, with bars of standard deviation");
        Figure { title, panels: plots.iter().filter(is_known).map(panel).collect() }
    }

    /// The name of what is varied along `x`, and the curves over it. A study without a list of numbers has its realisations along `x`.
    fn history_curves<'a>(&self, points: &'a [Point]) -> (String, HistoryCurves<'a>) {
        let number = |i: usize, path: &str| match self.realisation(i).ok()?.setup.to_table().scalar(path)? {
            Scalar::Whole(whole) => Some(whole as f64),
            Scalar::Number(number) => Some(number),
            Scalar::Text(_) => None,
        };
        let varied = self.axes().iter().rev().find(|axis| {
            axis.path() != crate::setup::ParameterAxis::SEED && axis.len() > 1 && number(0, axis.path()).is_some()
        });
        let name = varied.map_or("realisation".into(), |axis| axis.path().to_owned());
        let mut curves = HistoryCurves::new();
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        for (group, points) in points.chunks(self.seeds()).enumerate() {
            let first = group * self.seeds();
            let label = varied.map_or_else(String::new, |axis| self.words_but(first, axis.path()));
            let next = known.len();
            let curve = *known.entry(label.clone()).or_insert(next);
            let x = varied.map_or(Some(1.0 + first as f64), |axis| number(first, axis.path()));
            if let Some(x) = x.filter(|_| curve < MOST) {
                curves.entry(curve).or_insert_with(|| (label, Vec::new())).1.push((x, points));
            }
        }
        curves.values_mut().for_each(|(_, dots)| dots.sort_by(|a, b| a.0.total_cmp(&b.0)));
        (name, curves)
    }
}

/// The smallest and the largest of the finite values; 0 and 1 if there are none.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values
        .filter(|value| value.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [f64::min(low, value), f64::max(high, value)]);
    if low <= high { [low, high] } else { [0.0, 1.0] }
}

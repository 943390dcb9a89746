//! The figure of a study: area and `kappa_r` against the load, for each combination of values.

use super::plan::Plan;
use super::point::Point;
use super::spread::Spread;
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};
use std::collections::BTreeMap;

/// Largest number of curves; more cannot be distinguished.
pub(super) const MOST: usize = 12;
pub(super) const COLOURS: [Colour; 6] =
    [Colour::BLUE, Colour::VERMILION, Colour::GREEN, Colour::PURPLE, Colour::ORANGE, Colour::SKY];
pub(super) const SYMBOLS: [Symbol; 2] = [Symbol::Circle, Symbol::Square];

/// What a panel shows: its title, and the number that is drawn.
type PlottedValue = (&'static str, fn(&Point) -> Option<f64>);

const AREA: PlottedValue = ("relative contact area", Point::relative_area);
const KAPPA: PlottedValue = ("κ_r", Point::kappa_r);

/// The mean over the seeds of what is drawn, and its scatter, under one load of one choice from the lists.
struct MeanPoint {
    reduced_pressure: f64,
    values: [Spread; 2],
}

impl Plan {
    /// The figure of all `points` of the study: area and `kappa_r` against the reduced pressure, with one curve for
    /// each combination of values. The mean is over the seeds, and bars show the standard deviation of single
    /// realisations. Points that did not converge or are not resolved are left out. At most twelve curves are drawn.
    ///
    /// With adhesion it is the pull-off pressure and the energy lost in jumps, against the last list of numbers.
    pub fn figure(&self, title: &str, points: &[Point]) -> Figure {
        if self.has_adhesion() {
            return self.adhesion_figure(title, points);
        }
        let curves: Vec<(String, Vec<MeanPoint>)> = self.curves(points).into_iter().collect();
        let dots: Vec<&MeanPoint> = curves.iter().flat_map(|(_, means)| means).collect();
        let pressures = ends(dots.iter().map(|it| it.reduced_pressure));
        let panel = |number: usize, (name, _): PlottedValue| {
            let values = ends(dots.iter().map(|it| it.values[number].mean));
            let x = Axis::log("p*", [pressures[0] / 1.3, pressures[1] * 1.3]);
            let y = if number == 0 {
                Axis::log("a_rel", [values[0] / 1.5, values[1] * 1.5])
            } else {
                let margin = (0.15 * (values[1] - values[0])).max(0.02 * values[1]);
                Axis::linear("κ_r", [values[0] - margin, values[1] + margin])
            };
            let mut panel = Panel::new(name, x, y);
            for (i, (label, means)) in curves.iter().enumerate() {
                let dot = |it: &MeanPoint| Dot {
                    x: it.reduced_pressure,
                    y: it.values[number].mean,
                    spread: it.values[number].deviation,
                };
                let symbol = SYMBOLS[i / COLOURS.len() % SYMBOLS.len()];
                let mark = Mark::Joined { symbol, filled: true };
                panel.add(
                    label.clone(),
                    COLOURS[i % COLOURS.len()],
                    mark,
                    means.iter().filter(|it| it.values[number].count > 0).map(dot),
                );
            }
            panel
        };
        Figure { title: title.into(), panels: vec![panel(0, AREA), panel(1, KAPPA)] }
    }

    /// The means over the seeds under each load, by what is chosen from the lists, in the order of the rows.
    fn curves(&self, points: &[Point]) -> Vec<(String, Vec<MeanPoint>)> {
        let (loads, seeds) = (self.loads().len(), self.seeds());
        let groups = points.chunks(loads * seeds).take(MOST).enumerate();
        let curve = |(group, points): (usize, &[Point])| {
            let mut by_load: BTreeMap<usize, Vec<&Point>> = BTreeMap::new();
            for point in points {
                by_load.entry(point.load).or_default().push(point);
            }
            let means = by_load.values().map(|found| {
                let spread = |of: fn(&Point) -> Option<f64>| Spread::from_values(found.iter().filter_map(|it| of(it)));
                MeanPoint {
                    reduced_pressure: spread(|it| Some(it.observables.reduced_pressure)).mean,
                    values: [spread(AREA.1), spread(KAPPA.1)],
                }
            });
            (self.words_but_seed(group * seeds), means.collect())
        };
        groups.map(curve).collect()
    }
}

/// The smallest and the largest of the positive, finite values; 1 if there are none.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = values.filter(|value| value.is_finite() && *value > 0.0);
    let [low, high] = ends.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(value), high.max(value)]);
    if low <= high { [low, high] } else { [1.0, 1.0] }
}

//! The figure of a study: area and `kappa_r` against the load, for each combination of values.

use super::means::{LoadMeans, SeedMean};
use super::plan::Plan;
use super::point::Point;
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};

/// Largest number of curves; more cannot be distinguished.
pub(super) const MOST: usize = 12;
pub(super) const COLOURS: [Colour; 6] =
    [Colour::BLUE, Colour::VERMILION, Colour::GREEN, Colour::PURPLE, Colour::ORANGE, Colour::SKY];
pub(super) const SYMBOLS: [Symbol; 2] = [Symbol::Circle, Symbol::Square];

impl Plan {
    /// The figure of all `points` of the study: area and `kappa_r` against the reduced pressure, with one curve for
    /// each combination of values. The mean is over the seeds, and bars show the standard deviation of single
    /// realisations plus the error of the grid. Points that did not converge or are not resolved are left out. At most twelve curves are drawn.
    ///
    /// With adhesion it is the pull-off pressure and the energy lost in jumps, against the last list of numbers.
    pub fn figure(&self, title: &str, points: &[Point]) -> Figure {
        if self.has_adhesion() {
            return self.adhesion_figure(title, points);
        }
        let all = self.means(points);
        let curves: Vec<&[LoadMeans]> = all.chunks(self.loads().len()).take(MOST).collect();
        let area = panel(
            "relative contact area",
            &curves,
            |it| it.relative_area,
            |[low, high]| Axis::log("a_rel", [low / 1.5, high * 1.5]),
        );
        let kappa_r = panel(
            "κ_r",
            &curves,
            |it| it.kappa_r,
            |[low, high]| {
                let margin = (0.15 * (high - low)).max(0.02 * high);
                Axis::linear("κ_r", [low - margin, high + margin])
            },
        );
        let title = format!("{title}: means, with bars of standard deviation plus error of the grid");
        Figure { title, panels: vec![area, kappa_r] }
    }
}

/// A panel of the means of a quantity, with a curve for each combination of values.
fn panel(
    title: &str,
    curves: &[&[LoadMeans]],
    of: fn(&LoadMeans) -> SeedMean,
    axis: impl FnOnce([f64; 2]) -> Axis,
) -> Panel {
    let means = || curves.iter().copied().flatten();
    let pressures = ends(means().map(|it| it.reduced_pressure));
    let x = Axis::log("p*", [pressures[0] / 1.3, pressures[1] * 1.3]);
    let mut panel = Panel::new(title, x, axis(ends(means().map(|it| of(it).mean))));
    for (i, curve) in curves.iter().enumerate() {
        let dot = |it: &LoadMeans| Dot { x: it.reduced_pressure, y: of(it).mean, spread: of(it).bar() };
        let symbol = SYMBOLS[i / COLOURS.len() % SYMBOLS.len()];
        let label = curve.first().map_or("", |it| &it.values);
        let dots = curve.iter().filter(|it| of(it).count > 0).map(dot);
        panel.add(label, COLOURS[i % COLOURS.len()], Mark::Joined { symbol, filled: true }, dots);
    }
    panel
}

/// The smallest and the largest of the positive, finite values; 1 if there are none.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = values.filter(|value| value.is_finite() && *value > 0.0);
    let [low, high] = ends.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(value), high.max(value)]);
    if low <= high { [low, high] } else { [1.0, 1.0] }
}

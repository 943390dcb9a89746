//! Fig. 2: rough lines.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::{StatementVerdict, Verdict};
use crate::study::{Estimate, Point, Spread};
use std::collections::BTreeMap;

/// The figure, and what the paper says of it.
pub(crate) fn reproduce(lines: &Rough, points: &Points) -> Reproduction {
    let nx = points.finest();
    let title = format!("Fig. 2: rough lines, {nx} points, {} profiles each", lines.seeds_on(0).len());
    let panels = vec![lines.area_panel(points), lines.kappa_panel(points, [1.5, 4.2])];
    let kappa_r =
        |measure: Measure| Verdict::number("fig2.kappa_r", measure.name(), points.average(None, nx, measure.kappa_r()));
    let mut verdicts = vec![kappa_r(Measure::Counted), kappa_r(Measure::Resolved).beside()];
    if lines.loads.len() > 1 {
        verdicts.push(Verdict::number("fig2.variation", "counted", variation(points)));
        verdicts.push(is_constant(lines, points));
    }
    if lines.hurst.len() > 1 {
        verdicts.push(depends_on_hurst(points));
    }
    Reproduction::new(title, panels, lines.ramp_of(points, lines.lines()), verdicts)
}

/// Fall of `kappa` from the lightest to the heaviest load in per cent of that at the lightest, averaged over Hurst exponents.
fn variation(points: &Points) -> Estimate {
    let fall = |rows: &[&Point]| match rows {
        [first, .., last] => 100.0 * (1.0 - last.observables.kappa_counted / first.observables.kappa_counted),
        _ => f64::NAN,
    };
    let mut falls: BTreeMap<Option<u64>, Vec<f64>> = BTreeMap::new();
    for rows in points.realisations(points.finest()) {
        falls.entry(rows[0].seed).or_default().push(fall(&rows));
    }
    Estimate::from_values(falls.into_values().map(|falls| Spread::from_values(falls).mean))
}

/// Whether `kappa`, averaged over loads, differs between all neighbouring Hurst exponents.
fn depends_on_hurst(points: &Points) -> Verdict {
    let (exponents, nx) = (points.exponents(), points.finest());
    let average = |&hurst: &f64| {
        let Estimate { mean, error, .. } = points.average(Some(hurst), nx, Measure::Counted.kappa());
        format!("{mean:.2} ± {error:.2}")
    };
    let words: Vec<String> = exponents.iter().map(average).collect();
    let changes = |pair: &[f64]| {
        let [counted, resolved] = Measure::ALL.map(|measure| points.contrast([pair[0], pair[1]], nx, measure.kappa()));
        // counting is off by more at low exponents, whose segments are short, and so in their difference as well
        let change = Estimate { grid: (counted.mean - resolved.mean).abs(), ..counted };
        StatementVerdict::changes(
            change.times(100.0 / points.average(Some(pair[0]), nx, Measure::Counted.kappa()).mean),
        )
    };
    Verdict::statement("fig2.hurst", words.join(", "), StatementVerdict::all(exponents.windows(2).map(changes)))
}

/// The range of a quantity over loads and Hurst exponents, in per cent.
fn range(lines: &Rough, points: &Points, quantity: ObservableFn) -> f64 {
    let means = lines.pairs().map(|(hurst, load)| points.at(hurst, load, points.finest(), quantity).mean);
    let [low, high] = means.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], mean| [low.min(mean), high.max(mean)]);
    100.0 * (high / low - 1.0)
}

/// Whether `kappa_r` varies over loads and Hurst exponents by less than a fifth of what `kappa` does.
fn is_constant(lines: &Rough, points: &Points) -> Verdict {
    let ranges = |points: &Points, measure: Measure| {
        [measure.kappa(), measure.kappa_r()].map(|quantity| range(lines, points, quantity))
    };
    let [[kappa, counted], [_, resolved]] = Measure::ALL.map(|measure| ranges(points, measure));
    let words = format!("varies by {counted:.0} % counted, {resolved:.0} % resolved, κ by {kappa:.0} %");
    let distance = points.counted(|points, measure| {
        let [kappa, kappa_r] = ranges(points, measure);
        0.2 * kappa - kappa_r
    });
    Verdict::statement("fig2.constant", words, StatementVerdict::is_positive(distance))
}

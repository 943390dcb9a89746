//! Fig. 2: rough lines.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::Verdict;
use crate::study::{Estimate, Point, Spread};
use std::collections::BTreeMap;

/// The figure, and what the paper says of it.
pub fn reproduce(lines: &Rough, points: &Points) -> Reproduction {
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

/// Whether `kappa`, averaged over loads, differs between neighbouring Hurst exponents by more than twice the error.
fn depends_on_hurst(points: &Points) -> Verdict {
    let (exponents, nx, kappa) = (points.exponents(), points.finest(), Measure::Counted.kappa());
    let average = |&hurst: &f64| {
        let Estimate { mean, error, .. } = points.average(Some(hurst), nx, kappa);
        format!("{mean:.2} ± {error:.2}")
    };
    let words: Vec<String> = exponents.iter().map(average).collect();
    let differs = |pair: &[f64]| {
        let Estimate { mean, error, .. } = points.contrast([pair[0], pair[1]], nx, kappa);
        mean.abs() > 2.0 * error
    };
    Verdict::statement("fig2.hurst", words.join(", "), exponents.windows(2).all(differs))
}

/// Whether `kappa_r` varies over loads and Hurst exponents by less than a fifth of what `kappa` does.
fn is_constant(lines: &Rough, points: &Points) -> Verdict {
    let range = |quantity: ObservableFn| {
        let means = lines.pairs().map(|(hurst, load)| points.at(hurst, load, points.finest(), quantity).mean);
        let [low, high] =
            means.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], mean| [low.min(mean), high.max(mean)]);
        100.0 * (high / low - 1.0)
    };
    let measure = Measure::Counted;
    let [kappa, kappa_r] = [range(measure.kappa()), range(measure.kappa_r())];
    let words = format!("varies by {kappa_r:.0} %, κ by {kappa:.0} %, counted");
    Verdict::statement("fig2.constant", words, kappa_r < 0.2 * kappa)
}

//! Fig. 2: rough lines.

use super::means::{Points, Quantity};
use super::measure::Measure;
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::Verdict;
use crate::study::{Estimate, Point};

/// The figure, and what the paper says of it.
pub fn reproduce(lines: &Rough, points: &Points) -> Reproduction {
    let nx = points.finest();
    let title = format!("Fig. 2: rough lines, {nx} points, {} profiles each", lines.seeds_on(0).len());
    let panels = vec![lines.area_panel(points), lines.kappa_panel(points, [1.5, 4.2])];
    let kappa_r =
        |measure: Measure| Verdict::number("fig2.kappa_r", measure.name(), points.overall(nx, measure.kappa_r()));
    let mut verdicts = vec![kappa_r(Measure::Counted), kappa_r(Measure::Resolved).beside()];
    if lines.loads.len() > 1 {
        verdicts.push(Verdict::number("fig2.variation", "counted", variation(points)));
        verdicts.push(is_constant(lines, points));
    }
    if lines.hurst.len() > 1 {
        verdicts.push(depends_on_hurst(points));
    }
    Reproduction::of(title, panels, lines.ramp_of(points, lines.lines()), verdicts)
}

/// Fall of `kappa` from the lightest to the heaviest load in per cent of that at the lightest.
fn variation(points: &Points) -> Estimate {
    let fall = |rows: &Vec<&Point>| match rows.as_slice() {
        [first, .., last] => 100.0 * (1.0 - last.observables.kappa / first.observables.kappa),
        _ => f64::NAN,
    };
    let all = points.realisations(points.finest());
    let of = |hurst| Estimate::of(all.iter().filter(|rows| rows[0].hurst == Some(hurst)).map(fall));
    Estimate::mean_of(&points.exponents().into_iter().map(of).collect::<Vec<_>>())
}

/// Averages over loads of each Hurst exponent, in words.
fn words(averages: &[Estimate]) -> String {
    let word = |it: &Estimate| format!("{:.3} ± {:.3}", it.mean, it.error);
    averages.iter().map(word).collect::<Vec<_>>().join(", ")
}

/// How many standard errors lie between two means, as far as a sample of as many realisations can tell.
fn apart(pair: &[Estimate]) -> f64 {
    (pair[0].mean - pair[1].mean).abs() / pair[0].error.hypot(pair[1].error)
}

/// Whether `kappa`, averaged over loads, differs between neighbouring Hurst exponents by more than twice the error.
fn depends_on_hurst(points: &Points) -> Verdict {
    let average = |hurst| points.average(hurst, points.finest(), Measure::Counted.kappa());
    let kappa: Vec<Estimate> = points.exponents().into_iter().map(average).collect();
    Verdict::statement("fig2.hurst", words(&kappa), kappa.windows(2).all(|pair| apart(pair) > 2.0))
}

/// Whether `kappa_r` varies over loads and Hurst exponents by less than a fifth of what `kappa` does.
fn is_constant(lines: &Rough, points: &Points) -> Verdict {
    let range = |quantity: Quantity| {
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

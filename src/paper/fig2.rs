//! Fig. 2: rough lines.

use super::means::{Points, Quantity};
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::Verdict;
use crate::study::{Point, Spread};

/// Why corrected values are smaller.
const COUNTED: &str = "The paper counts nodes, which finds 0.37 of a node too many in each contact segment.";

/// The figure, and what the paper says of it.
pub fn reproduce(lines: &Rough, points: &Points) -> Reproduction {
    let nx = points.finest();
    let title = format!("Fig. 2: rough lines, {nx} points, {} profiles each", lines.seeds.len());
    let panels = vec![lines.area_panel(points), lines.kappa_panel(points, [1.5, 4.2])];
    let mut verdicts = vec![
        Verdict::number("fig2.kappa_r", "nodes counted", points.overall(nx, |it| it.kappa_r)),
        Verdict::number("fig2.kappa_r", "corrected", points.overall(nx, |it| it.kappa_r_corrected)).because(COUNTED),
    ];
    if lines.loads.len() > 1 {
        verdicts.push(Verdict::number("fig2.variation", "nodes counted", variation(points)));
        verdicts.push(is_constant(lines, points));
    }
    if lines.hurst.len() > 1 {
        verdicts.push(depends_on_hurst(lines, points));
    }
    Reproduction::of(title, panels, lines.ramp_of(points, lines.lines()), verdicts)
}

/// Fall of `kappa` from the lightest to the heaviest load in per cent of that at the lightest, over all realisations.
fn variation(points: &Points) -> Spread {
    let fall = |rows: Vec<&Point>| match rows.as_slice() {
        [first, .., last] => 100.0 * (1.0 - last.observables.kappa / first.observables.kappa),
        _ => f64::NAN,
    };
    Spread::of(points.realisations(points.finest()).into_iter().map(fall))
}

/// Whether `kappa`, averaged over loads, differs between Hurst exponents by more than twice the error of the means.
fn depends_on_hurst(lines: &Rough, points: &Points) -> Verdict {
    let mean = |&hurst: &f64| {
        let groups = points.realisations(points.finest()).into_iter().filter(|rows| rows[0].hurst == Some(hurst));
        Spread::of(groups.map(|rows| Spread::of(rows.iter().map(|row| row.observables.kappa)).mean))
    };
    let kappa: Vec<Spread> = lines.hurst.iter().map(mean).collect();
    let words: Vec<String> = kappa.iter().map(|kappa| format!("{:.2}", kappa.mean)).collect();
    let differ = |pair: &[Spread]| (pair[0].mean - pair[1].mean).abs() > 2.0 * pair[0].error().hypot(pair[1].error());
    Verdict::statement("fig2.hurst", format!("{} over loads", words.join(", ")), kappa.windows(2).all(differ))
}

/// Whether `kappa_r` varies over loads and Hurst exponents by less than a fifth of what `kappa` does.
fn is_constant(lines: &Rough, points: &Points) -> Verdict {
    let range = |quantity: Quantity| {
        let means = lines.pairs().map(|(hurst, load)| points.at(hurst, load, points.finest(), quantity).mean);
        means.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], mean| [low.min(mean), high.max(mean)])
    };
    let [kappa, raw, corrected] = [range(|it| it.kappa), range(|it| it.kappa_r), range(|it| it.kappa_r_corrected)];
    let holds = corrected[1] / corrected[0] - 1.0 < 0.2 * (kappa[1] / kappa[0] - 1.0);
    let words = format!("{:.2} to {:.2}, corrected {:.2} to {:.2}", raw[0], raw[1], corrected[0], corrected[1]);
    Verdict::statement("fig2.constant", words, holds)
}

//! Fig. 4: rough surfaces.

use super::fit::Fit;
use super::means::Points;
use super::measure::Measure;
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::Verdict;
use crate::plot::{Colour, Mark};
use crate::study::Estimate;

/// Why values differ.
const COARSER: &str = "Counting nodes overestimates the area, more so on coarser grids. Possible reasons: a coarser effective resolution, another contact criterion, or another average than here.";
/// Why the fit lies below the points.
const HEAVY: &str = "The least-squares fit gives most weight to the largest loads, where kappa is smallest.";

/// The figure, and what the paper says of it.
pub(crate) fn reproduce(surfaces: &Rough, points: &Points) -> Reproduction {
    let finest = points.finest();
    let found = points.on(finest).map(|row| row.observables);
    let pairs: Vec<(f64, f64)> = found.map(|it| (it.reduced_pressure, it.relative_area_counted)).collect();
    // the empirical fit, one constant in Persson's error function
    let fit = Fit::proportional(&pairs);
    let mut panel = surfaces.kappa_panel(points, [1.6, 3.2]);
    if let Some(Fit { area, .. }) = fit {
        let name = format!("erf(√π κ p*/2)/p*, κ = {:.3}", area.kappa(0.0));
        panel.add_curve(name, Colour::VERMILION, Mark::Dashed, |p| area.kappa(p));
    }
    let waves = surfaces.points_per_wave(finest);
    let title = format!("Fig. 4: rough surfaces, {finest} x {finest} points, {waves} per shortest wavelength");
    let panels = vec![surfaces.area_panel(points), panel];
    let ramp = surfaces.ramp_of(points, surfaces.surfaces());
    Reproduction::new(title, panels, ramp, verdicts(surfaces, points, fit))
}

/// Of the paper's grid, as its `eps_c` is read, extrapolated if it is not among the grids; and beside it of all grids, of the
/// continuum, and of the fit.
fn verdicts(surfaces: &Rough, points: &Points, fit: Option<Fit>) -> Vec<Verdict> {
    let (grids, side, counted) = (points.grids(), surfaces.paper_side(), Measure::Counted);
    let kinds = [("fig4.kappa", counted.kappa()), ("fig4.kappa_r", counted.kappa_r())];
    let at = |(key, quantity)| {
        let (how, here) = match grids.contains(&side) {
            true => (format!("counted, {side}^2"), points.average(None, side, quantity)),
            false => {
                (format!("counted, extrapolated to {side}^2"), points.limit(None, None, Some(side), counted, quantity))
            }
        };
        Verdict::number(key, &how, here).because(COARSER)
    };
    let mut verdicts: Vec<Verdict> = kinds.into_iter().map(at).collect();
    let mut beside = |key, how: String, here: Estimate| verdicts.push(Verdict::number(key, &how, here).beside());
    for &nx in grids.iter().filter(|nx| **nx != side) {
        kinds
            .iter()
            .for_each(|&(key, quantity)| beside(key, format!("counted, {nx}^2"), points.average(None, nx, quantity)));
    }
    let resolved = Measure::Resolved;
    for (key, quantity) in [("fig4.kappa", resolved.kappa()), ("fig4.kappa_r", resolved.kappa_r())] {
        beside(key, "resolved, continuum".into(), points.limit(None, None, None, resolved, quantity));
    }
    verdicts.extend(fit.map(|fit| {
        let how = format!("of the empirical fit on {}^2", points.finest());
        Verdict::exact("fig4.kappa", &how, fit.area.kappa(0.0)).because(HEAVY).beside()
    }));
    verdicts
}

//! Fig. 4: rough surfaces.

use super::fit::Fit;
use super::means::{Points, Quantity};
use super::reproduction::Reproduction;
use super::rough::Rough;
use super::verdict::Verdict;
use crate::plot::{Colour, Mark};

/// Why values move from grid to grid.
const FINER: &str = "Counted nodes exceed the area, the more so the coarser the grid; with the paper's spectrum the paper's values come out on about 4096^2 points.";
/// Why the fit lies below the points.
const HEAVY: &str = "The squares of the fit weigh most at the heaviest loads, where kappa is smallest.";

/// The figure, and what the paper says of it.
pub fn reproduce(surfaces: &Rough, points: &Points) -> Reproduction {
    let finest = points.finest();
    let found = points.on(finest).map(|row| row.observables);
    let pairs: Vec<(f64, f64)> = found.map(|it| (it.reduced_pressure, it.relative_area)).collect();
    // the empirical fit, one constant in Persson's error function
    let fit = Fit::proportional(&pairs);
    let mut panel = surfaces.kappa_panel(points, [1.6, 3.2]);
    if let Some(Fit { area, .. }) = fit {
        let name = format!("erf(√π κ p*/2)/p*, κ = {:.3}", area.kappa(0.0));
        panel.add_curve(name, Colour::VERMILION, Mark::Dashed, |p| area.kappa(p));
    }
    let waves = surfaces.points_per_wave(finest);
    let title = format!("Fig. 4: rough surfaces, {finest} x {finest} points, {waves} per shortest wavelength");
    let (panels, ramp) = (vec![surfaces.area_panel(points), panel], surfaces.ramp_of(points, surfaces.surfaces()));
    Reproduction::of(title, panels, ramp, verdicts(surfaces, points, fit))
}

/// On each grid, from two on extrapolated to the paper's, and of the fit.
fn verdicts(surfaces: &Rough, points: &Points, fit: Option<Fit>) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    let (grids, finest) = (points.grids(), points.finest());
    let mut add = |points: &Points, nx: usize, place: String| {
        let number = |key, how: &str, quantity: Quantity| {
            Verdict::number(key, &format!("{how}, {place}"), points.overall(nx, quantity)).because(FINER)
        };
        verdicts.push(number("fig4.kappa", "counted", |it| it.kappa));
        verdicts.push(number("fig4.kappa_r", "counted", |it| it.kappa_r));
        verdicts.push(number("fig4.kappa_r", "corrected", |it| it.kappa_r_corrected));
    };
    grids.iter().for_each(|&nx| add(points, nx, format!("{nx}^2")));
    if grids.len() > 1 {
        let side = surfaces.paper_side();
        add(&points.extrapolated(Some(side)), finest, format!("extrapolated to {side}^2"));
    }
    verdicts.extend(fit.map(|fit| {
        let how = format!("of the empirical fit on {finest}^2");
        Verdict::exact("fig4.kappa", &how, fit.area.kappa(0.0)).because(HEAVY)
    }));
    verdicts
}

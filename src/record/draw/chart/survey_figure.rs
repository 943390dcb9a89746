//! The survey of heights, as a figure: a line's heights, the power spectrum, and the gradient from scale to scale.

use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};
use crate::record::draw::ink::ruler::Ruler;
use crate::surface::{Band, Scale, Surface, Survey};
use std::f64::consts::TAU;

/// Columns of a line's heights.
const COLUMNS: usize = 1000;
/// Room above and below values on a logarithmic axis, a factor.
const ROOM: f64 = 2.0;
/// Decades of a spectrum below its largest density.
const DECADES: f64 = 1e-16;

/// The figure of a surface, lengths in `unit`.
pub(crate) fn figure(surface: &Surface, survey: &Survey, unit: &str) -> Figure {
    let heights = surface.grid().is_line().then(|| heights(surface, unit));
    let panels = [spectrum(&survey.spectrum, survey, unit), gradients(survey, unit)];
    Figure { title: String::new(), panels: heights.into_iter().chain(panels.into_iter().flatten()).collect() }
}

/// The heights of a line: the lowest and the highest in each column.
fn heights(surface: &Surface, unit: &str) -> Panel {
    let (h, spacing) = (surface.heights(), surface.grid().spacing()[1]);
    let [low, high] = crate::record::draw::fields::range(h.iter().copied());
    let [x, y] = [("x", [0.0, surface.grid().size()[1]]), ("h", [low, high])];
    let [x, y] = [x, y].map(|(symbol, range)| Ruler::new(symbol, unit, range));
    let width = h.len().div_ceil(COLUMNS);
    let dots = h.chunks(width).enumerate().flat_map(|(column, part)| {
        let at = column as f64 * width as f64 * spacing / x.unit;
        let ends = crate::record::draw::fields::range(part.iter().copied());
        ends.map(|h| Dot::at(at, h / y.unit))
    });
    let mut panel = Panel::new("Heights", x.axis.clone(), y.axis.clone());
    panel.add("", Colour::BLUE, Mark::Line, dots.collect::<Vec<_>>());
    panel
}

/// The power spectrum, with its power law.
fn spectrum(bands: &[Band], survey: &Survey, unit: &str) -> Option<Panel> {
    let largest = bands.iter().map(|band| band.density).fold(0.0, f64::max);
    let shown: Vec<&Band> = bands.iter().filter(|band| band.density > DECADES * largest).collect();
    let x = axis("q", &format!("1/{unit}"), shown.iter().map(|band| band.wavenumber))?;
    let y = axis("C(q)", "", shown.iter().map(|band| band.density))?;
    let mut panel = Panel::new("Power spectrum", x, y);
    panel.add("", Colour::BLUE, Mark::Line, shown.iter().map(|band| Dot::at(band.wavenumber, band.density)));
    if let Some(law) = survey.power_law {
        let [shortest, longest] = law.wavelengths;
        let fitted = || shown.iter().filter(|band| (shortest..=longest).contains(&band.wavelength()));
        let mean = |of: fn(&Band) -> f64| fitted().map(|band| of(band).ln()).sum::<f64>() / fitted().count() as f64;
        let (q, density) = (mean(|band| band.wavenumber), mean(|band| band.density));
        let at =
            |wavelength: f64| Dot::at(TAU / wavelength, (density + law.exponent * ((TAU / wavelength).ln() - q)).exp());
        panel.add(format!("H = {:.2}", law.hurst), Colour::VERMILION, Mark::Dashed, [at(longest), at(shortest)]);
    }
    Some(panel)
}

/// The rms gradient over the distance, along each axis.
fn gradients(survey: &Survey, unit: &str) -> Option<Panel> {
    let scales = || survey.axes.iter().flat_map(|axis| &axis.scales).filter(|scale| scale.rms_gradient > 0.0);
    let x = axis("s", unit, scales().map(|scale| scale.distance))?;
    let y = axis("rms gradient", "", scales().map(|scale| scale.rms_gradient))?;
    let mut panel = Panel::new("Gradient over the distance", x, y);
    let looks = [(Colour::BLUE, Symbol::Circle), (Colour::VERMILION, Symbol::Square)];
    for (along, (colour, symbol)) in survey.axes.iter().rev().zip(looks) {
        let dot = |scale: &Scale| Dot::at(scale.distance, scale.rms_gradient);
        panel.add(
            format!("along {}", along.axis),
            colour,
            Mark::Joined { symbol, filled: true },
            along.scales.iter().map(dot),
        );
    }
    Some(panel)
}

/// A logarithmic axis over positive values; none without any.
fn axis(symbol: &str, unit: &str, values: impl Iterator<Item = f64>) -> Option<Axis> {
    let [low, high] = crate::record::draw::fields::range(values);
    let name = if unit.trim_matches(['1', '/']).is_empty() { symbol.to_owned() } else { format!("{symbol} [{unit}]") };
    (low > 0.0 && high.is_finite()).then(|| Axis::log(name, [low / ROOM, high * ROOM]))
}

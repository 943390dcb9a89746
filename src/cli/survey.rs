//! The description of heights, as text.

use super::output::{TextRow, row, write_rows};
use super::units::Units;
use asperity::surface::{Noise, Scale, Scales, Survey};
use std::io::{self, Write};

/// Names and values of what long and short waves of heights are like.
pub(crate) fn rows(survey: &Survey, units: Units) -> Vec<TextRow> {
    let [along_y, along_x] = survey.tilt.map(|tilt| format!("{tilt:.3e}"));
    let is_map = survey.axes.iter().any(|axis| axis.axis == "y");
    let tilt = if is_map { format!("{along_y} along y, {along_x} along x") } else { along_x };
    let curvature = format!("{:.1} % of the mean square height about the plane", 100.0 * survey.curvature_share);
    let mut rows = vec![row("tilt", tilt), row("curvature", curvature), row("noise", noise(&survey.noise, units))];
    if let Some(law) = &survey.power_law {
        let [shortest, longest] = law.wavelengths.map(|it| units.length(it));
        let (exponent, hurst, error) = (law.exponent, law.hurst, law.hurst_error);
        let range = format!("at wavelengths of {shortest} to {longest}");
        rows.push(row("power spectrum", format!("C(q) ~ q^{exponent:.2} (H = {hurst:.2} ± {error:.2}) {range}")));
    }
    for axis in &survey.axes {
        rows.push(row(&format!("smooth along {}", axis.axis), smooth(axis, units)));
    }
    rows
}

/// How much noise there is, and above which wavelengths there is more roughness than noise.
fn noise(noise: &Noise, units: Units) -> String {
    if noise.rms <= 0.0 {
        return "none that can be told from roughness".to_owned();
    }
    let (rms, shortest) = (units.length(noise.rms), units.length(noise.shortest_wavelength));
    let share = 100.0 * noise.share;
    format!("{rms} rms, {share:.0} % of the mean square gradient; above it are wavelengths over {shortest}")
}

/// Below which wavelengths heights are smooth along an axis.
fn smooth(axis: &Scales, units: Units) -> String {
    axis.smooth_wavelength.map_or("at no wavelength: rough down to the spacing".into(), |wavelength| {
        format!("below wavelengths of {}", units.length(wavelength))
    })
}

/// Writes the differences of heights at each scale along each axis.
pub(crate) fn write_scales(survey: &Survey, out: &mut impl Write) -> io::Result<()> {
    survey.axes.iter().try_for_each(|axis| {
        let distance = format!("distance along {}", axis.axis);
        writeln!(out, "\n  {distance:<25} {:<13} {:<13} rms curvature", "rms step", "rms gradient")?;
        write_rows(axis.scales.iter().map(differences), out)
    })
}

/// The rms differences of heights at a distance, and the gradient and the curvature by them.
fn differences(scale: &Scale) -> TextRow {
    let Scale { distance, rms_step, rms_gradient, rms_curvature } = scale;
    (format!("{distance:.4e}"), format!("{rms_step:<13.4e} {rms_gradient:<13.4e} {rms_curvature:.4e}"))
}

//! The description of heights, as text.

use super::output::write_rows;
use asperity::surface::{Noise, Scale, Scales, Survey};
use std::io::{self, Write};

/// Writes the description of heights, and their differences at each scale.
pub fn write(survey: &Survey, out: &mut impl Write) -> io::Result<()> {
    let [along_y, along_x] = survey.tilt.map(|tilt| format!("{tilt:.3e}"));
    let is_map = survey.axes.iter().any(|axis| axis.axis == "y");
    let tilt = if is_map { format!("{along_y} along y, {along_x} along x") } else { along_x };
    let share = 100.0 * survey.curvature_share;
    let overall = [("tilt", tilt), ("curvature", format!("{share:.1} % of the mean square height about the plane"))];
    let law = survey.power_law.map(|law| {
        let [shortest, longest] = law.wavelengths;
        let (exponent, hurst) = (law.exponent, law.hurst);
        format!(
            "C(q) ~ q^{exponent:.2} (H = {hurst:.2} ± {:.2}) at wavelengths of {shortest:.3e} to {longest:.3e}",
            law.hurst_error
        )
    });
    let Noise { rms, share, shortest_wavelength } = survey.noise;
    let noise = format!(
        "{rms:.3e} rms, {:.0} % of the mean square gradient; above it are wavelengths over {shortest_wavelength:.3e}",
        100.0 * share
    );
    let artefacts = survey.artefacts.iter().map(|it| ("artefact".to_owned(), it.sentence()));
    write_rows(artefacts, out)?;
    let overall = overall.into_iter().chain([("noise", noise)]);
    write_rows(overall.chain(law.map(|law| ("power spectrum", law))).map(owned), out)?;
    survey.axes.iter().try_for_each(|axis| write_axis(axis, out))
}

fn write_axis(axis: &Scales, out: &mut impl Write) -> io::Result<()> {
    let Scales { noise, noise_share, shortest_wavelength, .. } = axis;
    let smooth = axis.smooth_wavelength.map_or("at no wavelength: rough down to the spacing".into(), |wavelength| {
        format!("below wavelengths of {wavelength:.3e}")
    });
    let rows = [
        ("noise", format!("{noise:.3e} rms, {:.0} % of the mean square gradient", 100.0 * noise_share)),
        ("above the noise", format!("wavelengths over {shortest_wavelength:.3e}")),
        ("smooth", smooth),
    ];
    write_rows(rows.map(|(name, value)| (format!("{name} along {}", axis.axis), value)), out)?;
    writeln!(
        out,
        "  {:<25} {:<13} {:<13} rms curvature",
        format!("distance along {}", axis.axis),
        "rms step",
        "rms gradient"
    )?;
    write_rows(axis.scales.iter().map(row), out)
}

fn row(scale: &Scale) -> (String, String) {
    let Scale { distance, rms_step, rms_gradient, rms_curvature } = scale;
    (format!("{distance:.4e}"), format!("{rms_step:<13.4e} {rms_gradient:<13.4e} {rms_curvature:.4e}"))
}

fn owned((name, value): (&str, String)) -> (String, String) {
    (name.to_owned(), value)
}
